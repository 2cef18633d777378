//! Starting values of the measuring frames of the setups of a session.

use crate::effects::{MEASURING_FRAME, Term};
use crate::kinematics::quaternion::log;
use crate::sessions::Session;
use nalgebra::Isometry3;

/// A frame for each setup, or the one of the instrument; `motion` locates it from the samples that it is asked for.
pub(super) fn frames_from(
    session: &Session,
    motion: impl Fn(&dyn Fn(usize) -> bool) -> Option<Isometry3<f64>>,
) -> Vec<Term> {
    let setups = session.samples.setups.as_ref();
    let frame = |setup: usize| {
        let mut term = Term::absent(&MEASURING_FRAME, 0, setup as f64);
        term.label = setups.map(|s| s.names[setup].as_str().into());
        let inside = |i: usize| setups.is_none_or(|s| s.index[i] as usize == setup);
        if let Some(motion) = motion(&inside) {
            let turn = log(&motion.rotation);
            let shift = motion.translation.vector;
            term.coefficients = [turn.as_slice(), shift.as_slice()].concat();
        }
        term
    };
    (0..setups.map_or(1, |s| s.names.len()))
        .map(frame)
        .collect()
}
