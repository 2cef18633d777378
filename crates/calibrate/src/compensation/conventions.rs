//! A session compared with a model whose own session had set-up errors: its raw values are read with the corrections
//! of the model.
//!
//! A session of the same controller has the same conventions. Another one may have been corrected since, or measured
//! from another place: where the residual is much smaller without the model's corrections, or with the frame of the
//! instrument fitted again, it is read that way, and that is reported.

use std::borrow::Cow;

use crate::model::{Calibration, SetUp};
use crate::sessions::{Session, SessionCorrection, Setups};
use crate::text::{Template, Text};
use crate::thresholds;

use super::as_read::verify_as_read;
use super::verification::{Verification, VerifyError, is_own};

/// What the program calls a frame that it fits to samples which name none.
const NEW_FRAME: &str = "fitted here";

/// Compares a raw session with a calibration, by the corrections of the latter.
pub(super) fn verified(
    calibration: &Calibration,
    session: &Session,
    notes: &[Text],
) -> Result<Verification, VerifyError> {
    let set_up = &calibration.set_up;
    let by = |read: &Session, note: Option<Text>| {
        let notes = notes.iter().cloned().chain(note).collect();
        verify_as_read(calibration, read, notes)
    };
    let own = is_own(calibration, session);
    let reads_plain = if own {
        set_up.leaves_own_samples()
    } else {
        set_up.is_empty()
    };
    if reads_plain || session.samples.corrected.is_some() {
        return by(session, None);
    }
    let note = text!(
        "read as the model's own session was: {how}",
        how = set_up.describe()
    );
    let note = (!set_up.is_empty()).then_some(note);
    let first = by(&set_up.applied(session, own), note)?;
    if own {
        return Ok(first);
    }
    let mut best = first;
    let mut others: Vec<(Cow<Session>, Template)> = Vec::new();
    if let Some(elsewhere) = with_a_new_frame(set_up, session) {
        let note = phrase!("the instrument was moved: its frame is fitted to these samples");
        others.push((Cow::Owned(elsewhere), note));
    }
    let note = phrase!(
        "the set-up errors of the model's session are not in this one: it is read as it stands"
    );
    others.push((Cow::Borrowed(session), note));
    for (read, note) in others {
        if let Ok(other) = by(&read, Some(note.into()))
            && thresholds::FAR * other.model.rms_mm < best.model.rms_mm
        {
            best = other;
        }
    }
    Ok(best)
}

/// The session as the model reads it, in a frame that the model does not know; `None` where no correction freed the
/// frame.
fn with_a_new_frame(set_up: &SetUp, session: &Session) -> Option<Session> {
    let free = set_up.corrections().contains(&SessionCorrection::FreeFrame)
        && session.samples.setups.is_none();
    free.then(|| {
        let mut read = set_up.applied(session, false).into_owned();
        read.samples.setups = Some(Setups {
            names: vec![NEW_FRAME.to_owned()],
            index: vec![0; read.samples.len()],
        });
        read
    })
}
