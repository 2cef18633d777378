//! A session with an evenly spread part of its samples.

use super::thresholds::MOST_SAMPLES;
use crate::fit::spread::spread;
use crate::sessions::{Samples, Session, Setups};

/// Some samples, so that a trial is quick.
pub(super) fn thinned(session: &Session) -> Session {
    thinned_to(session, MOST_SAMPLES)
}

pub(super) fn thinned_to(session: &Session, most: usize) -> Session {
    let held_out = session.samples.held_out.as_deref();
    let counts = (0..session.samples.len()).map(|i| held_out.is_none_or(|h| !h[i]));
    let keep = spread(&counts.collect::<Vec<_>>(), most);
    let old = &session.samples;
    let pick = |c: &Vec<f64>| -> Vec<f64> { keep.iter().map(|i| c[*i]).collect() };
    let each = |c: &[Option<Vec<f64>>]| c.iter().map(|c| c.as_ref().map(pick)).collect();
    let samples = Samples {
        q: old.q.iter().map(pick).collect(),
        q_read: each(&old.q_read),
        x_mm: pick(&old.x_mm),
        y_mm: pick(&old.y_mm),
        z_mm: old.z_mm.as_ref().map(pick),
        target: old
            .target
            .as_ref()
            .map(|t| keep.iter().map(|i| t[*i]).collect()),
        dir: each(&old.dir),
        speed: each(&old.speed),
        setups: old.setups.as_ref().map(|s| Setups {
            names: s.names.clone(),
            index: keep.iter().map(|i| s.index[*i]).collect(),
        }),
        ..Samples::default()
    };
    // Field by field: a clone of the whole would copy a million samples first.
    Session {
        name: String::new(),
        note: String::new(),
        robot: session.robot.clone(),
        targets: session.targets.clone(),
        instrument: session.instrument.clone(),
        tolerance_mm: session.tolerance_mm,
        regions: Vec::new(),
        compensated_by: None,
        samples,
        path: None,
    }
}
