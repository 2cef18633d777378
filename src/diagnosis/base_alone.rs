//! The answer for sessions that measure other things than whole points: the base as every kind of
//! measurement shows it, and whether more than noise is left of each. Names are searched in whole
//! points only; where there are none, none is said.

use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::effects::CATALOGUE;
use crate::fit::noise::Noise;
use crate::fit::problem::Problem;
use crate::fit::{DEFAULT_EFFECTS, Identification, IdentifyError, identify_watched};
use crate::model::GapStep;
use crate::observations::figures::KindFigures;
use crate::sessions::Session;

use super::candidates::NotTestable;
use super::{
    DiagnoseError, Diagnosis, Floor, FloorFrom, Gaps, HeldOut, Options, Progress, Unexplained,
    Verdict, Watch,
};

/// What is left is more than the stated noise from this ratio on …
const MORE: f64 = 1.15;
/// … where chance would make so much of it rarely; and at any ratio where it would hardly ever.
const RARELY: f64 = 0.05;
const HARDLY_EVER: f64 = 0.002;
/// Names are searched where whole points are so large a part of the samples.
const ENOUGH_POINTS: f64 = 0.5;

/// Whether names can be searched in the whole points of a session.
pub(crate) fn has_enough_points(session: &Session, options: &Options) -> bool {
    if session.has_plain_points() {
        return true;
    }
    let points = Problem::new(session, options.joint_values);
    let all = Problem::observing(session, options.joint_values);
    points.samples() as f64 >= ENOUGH_POINTS * all.samples() as f64
}

/// Errors by kind of a session that has more than plain points; empty for one that has not.
pub(crate) fn kinds(
    session: &Session,
    options: &Options,
    watch: Watch,
) -> Result<Vec<KindFigures>, DiagnoseError> {
    if session.has_plain_points() {
        return Ok(Vec::new());
    }
    Ok(identified(session, options, watch)?.kinds)
}

fn identified(
    session: &Session,
    options: &Options,
    watch: Watch,
) -> Result<Identification, DiagnoseError> {
    let effects = DEFAULT_EFFECTS
        .iter()
        .filter(|id| options.allowed.exists(id));
    let effects: Vec<String> = effects.map(|id| (*id).to_owned()).collect();
    let go_on = || watch(&Progress::Preparing);
    let answer = identify_watched(session, &effects, &[], options.joint_values, &go_on);
    answer.map_err(|error| match error {
        IdentifyError::Cancelled => DiagnoseError::Cancelled,
        _ => DiagnoseError::NothingToFit,
    })
}

/// The answer without a search.
///
/// # Errors
/// No sample to fit, or the watcher stops it.
pub(crate) fn diagnose(
    session: &Session,
    options: &Options,
    watch: Watch,
) -> Result<Diagnosis, DiagnoseError> {
    let identification = identified(session, options, watch)?;
    let (ratio, p) = beside_stated(&identification);
    let present = p < HARDLY_EVER || ratio.is_some_and(|r| r > MORE && p < RARELY);
    let gap = gaps(
        identification.gap.before.rms_mm,
        identification.gap.after.rms_mm,
    );
    let held_out = identification.held_out.as_ref();
    let held_out = HeldOut {
        how: match held_out {
            Some(_) => "the samples that the session holds out".to_owned(),
            None => "the session holds out no sample".to_owned(),
        },
        samples: held_out.map_or(0, |gap| gap.samples),
        gaps: held_out.map(|gap| gaps(gap.before.rms_mm, gap.after.rms_mm)),
    };
    let step = |what: &str, pick: fn(&Gaps) -> f64| GapStep {
        what: what.to_owned(),
        gap_mm: pick(&gap),
        held_out_mm: held_out.gaps.as_ref().map(pick),
    };
    let history = vec![
        step("nominal robot", |g| g.start_mm),
        step(super::conclude::base_in_words(&session.robot), |g| g.end_mm),
    ];
    let floor = Floor {
        mm: gap.end_mm / ratio.unwrap_or(1.0).max(1e-9),
        from: match ratio {
            Some(_) => FloorFrom::Instrument,
            None => FloorFrom::Estimated,
        },
    };
    Ok(Diagnosis {
        session: session.name.clone(),
        samples: session.samples.len(),
        verdict: if present {
            Verdict::Unexplained
        } else {
            Verdict::Noise
        },
        data_problems: Vec::new(),
        floor,
        gap,
        held_out,
        identified: identification.parameters.clone(),
        found: Vec::new(),
        equivalent: Vec::new(),
        unexplained: unexplained(present, p, ratio, &gap, &floor),
        not_testable: not_testable(session, options),
        not_found: Vec::new(),
        outliers: identification.outliers.clone(),
        next_poses: Vec::new(),
        noise: Noise::white(floor.mm / f64::sqrt(3.0)),
        model: identification.model.clone(),
        identification,
        history,
    })
}

fn gaps(before: f64, after: f64) -> Gaps {
    Gaps {
        start_mm: before,
        identified_mm: after,
        end_mm: after,
    }
}

/// The noise that is left beside the stated one, over all kinds that state one, and the chance of as
/// much; `None` and 1 where none does.
fn beside_stated(identification: &Identification) -> (Option<f64>, f64) {
    let (mut squares, mut rows) = (0.0, 0);
    for kind in &identification.kinds {
        if let (Some(stated), Some(found)) = (kind.stated_sigma, kind.found_sigma) {
            squares += kind.rows as f64 * (found / stated).powi(2);
            rows += kind.rows;
        }
    }
    let freedom = rows.saturating_sub(identification.quality.rank);
    if freedom == 0 {
        return (None, 1.0);
    }
    let chi_squared = ChiSquared::new(freedom as f64);
    let p = chi_squared.map_or(1.0, |d| d.sf(squares));
    (Some((squares / freedom as f64).sqrt()), p)
}

fn unexplained(
    present: bool,
    p: f64,
    ratio: Option<f64>,
    gap: &Gaps,
    floor: &Floor,
) -> Unexplained {
    let says = match ratio {
        Some(ratio) if present => format!(
            "what is left is {ratio:.2} times the stated noise, and no name is searched for it here"
        ),
        None => "no σ is stated, so that nothing says whether what is left is noise".to_owned(),
        Some(_) => String::new(),
    };
    let left = (gap.end_mm.powi(2) - floor.mm.powi(2)).max(0.0).sqrt();
    Unexplained {
        present,
        p,
        rms_mm: if present { left } else { 0.0 },
        place: None,
        resembles: Vec::new(),
        says,
        shapes: Vec::new(),
        noise: None,
        correction: None,
    }
}

fn not_testable(session: &Session, options: &Options) -> Vec<NotTestable> {
    let measured = session.kinds_in_words().unwrap_or_default();
    let because = format!("names are searched in whole points, and this session has {measured}");
    let effects = CATALOGUE.iter().map(|effect| effect.about().id);
    let wanted = effects.filter(|id| options.allowed.exists(id) && !DEFAULT_EFFECTS.contains(id));
    wanted
        .map(|effect| NotTestable {
            effect,
            joint: None,
            because: because.clone(),
        })
        .collect()
}
