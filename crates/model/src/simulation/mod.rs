//! Sessions of a robot whose errors are known: for trying out a plan before the machine is there,
//! for practice, and to check the program against itself.
//!
//! A [`Scenario`] has the robot, the poses, the effects, and how it is measured; [`simulate`] makes the session that a
//! technician would have brought home, and the [`Truth`] that no one would. The points come from [`Model::predict`]:
//! the exact equations, not the linearised ones that a search may use.
//!
//! - `scenario`: what a scenario is; `format_v1`: its file, `truepose-scenario/1`; `request`: one from few words.
//! - `motion`: from a sweep or a list to stops, each with the side from which it was reached.
//! - `circumstances`: speeds, loads and temperatures of the stops.
//! - `noise`: what the instrument adds to a point; `measured`: every other way to measure.
//! - `truth`: the simulated effects.
//!
//! Everything random comes from one seed, in separate streams for order, conditions, noise and
//! outliers: another noise does not change the poses. The same scenario and seed give the same
//! session to the last bit.

pub(crate) mod circumstances;
mod error;
pub(crate) mod format_v1;
pub(crate) mod measured;
pub(crate) mod motion;
pub(crate) mod noise;
mod random;
pub(crate) mod request;
pub(crate) mod scenario;
pub(crate) mod truth;

use std::ops::ControlFlow;

pub use format_v1::{LoadedScenario, load_scenario, parse_scenario};
pub use request::{
    HiddenEffect, MOST_REFLECTORS, RequestedPoses, RequestedTemperature, SimulationRequest,
};
pub use scenario::{
    Circumstances, Measure, Noise, NoiseKind, Order, Outliers, Poses, Scenario, Stop, Sweep,
    Temperature,
};
pub use truth::Truth;

pub use crate::progress::unwatched;
pub use error::SimulateError;

use crate::budget;
use crate::diagnostic::{Diagnostic, Place, Rejected, Severity};
use crate::effects::{Inputs, JointValues};
use crate::lanes::LANES;
use crate::model::{Model, Positions};
use crate::sessions::{Samples, Session};
use random::{Stream, random};

/// Plays a scenario with this seed. `watch` hears now and then which part is done (0 to 1), and
/// may break it off.
///
/// # Errors
/// See [`SimulateError`].
pub fn simulate(
    scenario: &Scenario,
    seed: u64,
    mut watch: impl FnMut(f64) -> ControlFlow<()>,
) -> Result<(Session, Truth), SimulateError> {
    let problems = scenario.problems();
    if problems.iter().any(|p| p.severity == Severity::Error) {
        return Err(Rejected::of(problems).into());
    }
    let stops = motion::stops(scenario, &mut random(seed, Stream::Order));
    let mut samples =
        circumstances::samples(scenario, &stops, &mut random(seed, Stream::Circumstances));
    let mut session = session_of(scenario, std::mem::take(&mut samples));
    let model = Model::new(scenario.robot.clone(), scenario.effects.clone());
    let exact = predict(&model, &session, &mut watch)?;
    let columns = [&exact.x_mm, &exact.y_mm, &exact.z_mm];
    if columns.into_iter().flatten().any(|v| !v.is_finite()) {
        let found = text!("a point is too far away for its numbers");
        let place = Place::default().in_field("effects");
        let expected = text!("smaller lengths and effects");
        return Err(Rejected::because(Diagnostic::error(place, found, expected)).into());
    }
    let (measured, outliers) = noise::measured(scenario, &exact, seed);
    let resolved = noise::resolved(scenario.resolution_mm, measured);
    session.samples.x_mm = resolved.x_mm;
    session.samples.y_mm = resolved.y_mm;
    session.samples.z_mm = (!scenario.planar).then_some(resolved.z_mm);
    if scenario.measure != [Measure::Point] || scenario.instrument.tracker.is_some() {
        measured::measure(scenario, &model, &mut session, &outliers, seed)?;
    }
    // A session that would be refused when it is read is none.
    session.whole()?;
    let truth = Truth {
        name: session.name.clone(),
        seed,
        effects: model.terms().to_vec(),
        noise: scenario.noise,
        outliers,
        exact,
    };
    match watch(1.0) {
        ControlFlow::Continue(()) => Ok((session, truth)),
        ControlFlow::Break(()) => Err(SimulateError::Stopped),
    }
}

fn session_of(scenario: &Scenario, samples: Samples) -> Session {
    Session {
        name: scenario.name.clone(),
        note: scenario.note.clone(),
        robot: scenario.robot.clone(),
        targets: scenario.targets.clone(),
        instrument: scenario.instrument.clone(),
        tolerance_mm: scenario.tolerance_mm,
        regions: scenario.regions.clone(),
        compensated_by: None,
        samples,
        path: None,
    }
}

/// Where the reflectors really are.
fn predict(
    model: &Model,
    session: &Session,
    watch: &mut impl FnMut(f64) -> ControlFlow<()>,
) -> Result<Positions, SimulateError> {
    let inputs = Inputs::new(session, JointValues::Commanded);
    let n = inputs.len();
    let mut exact = Positions::default();
    let starts: Vec<usize> = (0..n).step_by(LANES).collect();
    for some in starts.chunks(budget::AT_ONCE) {
        model.visit_blocks(&inputs, false, some.iter().copied(), |_, block| {
            let [x, y, z] = &block.point;
            exact.x_mm.extend_from_slice(&x[..block.len]);
            exact.y_mm.extend_from_slice(&y[..block.len]);
            exact.z_mm.extend_from_slice(&z[..block.len]);
        });
        if watch(0.9 * exact.x_mm.len() as f64 / n as f64).is_break() {
            return Err(SimulateError::Stopped);
        }
    }
    Ok(exact)
}

#[cfg(test)]
mod tests;
