//! A session's deviations at the stages of the work, and the plots of them.

use crate::compensation::with_table::moved_by_correction;
use crate::compensation::{Verification, VerifyError};
use crate::effects::JointValues;
use crate::fit::base_model;
use crate::fit::gap::{Deviations, deviations};
use crate::fit::problem::Problem;
use crate::model::{Calibration, Model};
use crate::numeric::extent;
use crate::present::chart::{ColourRole, shortened};
use crate::sessions::Session;
use crate::text::capital;

use super::ReportError;
use super::document::{Block, Section};
use super::parts::or_unnamed;
use super::plots::{Stage, Stages, deviation, workspace};
use crate::present::numbers::short;

/// A session's samples as measured, with corrected commands, and against the model.
///
/// # Errors
/// If the calibration is another robot's.
pub fn stages(
    session: &Session,
    calibration: &Calibration,
    verification: &Verification,
    floor_mm: Option<f64>,
) -> Result<Stages, ReportError> {
    let session = &*session.whole().map_err(VerifyError::from)?;
    calibration.sound().map_err(VerifyError::from)?;
    let mut all = as_measured(session, floor_mm);
    if !session.samples.observed.is_empty() {
        all.stages[0].deviations = verification.before.clone();
    }
    // What a correction moves is moved in the base frame, whatever the setups are.
    let drawn = Model::nominal(session.robot.clone());
    let before = deviations(&Problem::new(session, JointValues::Commanded), &drawn);
    let mut more = Vec::new();
    let moved = moved_by_correction(calibration, session)?;
    // What a correction moves is seen in points.
    if let Some(moved) = moved.filter(|_| session.samples.observed.is_empty()) {
        let mut corrected = Deviations::default();
        for i in 0..before.length_mm.len() {
            let planar = session.samples.z_mm.is_none();
            let by = moved.get(i);
            let e: [f64; 3] = std::array::from_fn(|k| {
                let by = if planar && k == 2 { 0.0 } else { by[k] };
                before.axes_mm[k][i] + by
            });
            corrected.length_mm.push(crate::lanes::dot(e, e).sqrt());
            for (column, e) in corrected.axes_mm.iter_mut().zip(e) {
                column.push(e);
            }
        }
        more.push(Stage {
            name: capital(say!("with corrected commands")),
            role: ColourRole::Corrected,
            deviations: corrected,
        });
    }
    more.push(Stage {
        name: say!("Model residuals").to_owned(),
        role: ColourRole::After,
        deviations: verification.after.clone(),
    });
    all.stages.extend(more);
    Ok(all)
}

/// A session's samples as measured, held against the nominal robot.
/// One that cannot be computed with ([`Session::checked`] says why) has none.
pub fn as_measured(session: &Session, floor_mm: Option<f64>) -> Stages {
    let as_measured = |deviations| Stage {
        name: capital(say!("as measured")),
        role: ColourRole::Before,
        deviations,
    };
    let Ok(session) = session.whole() else {
        return Stages {
            stages: vec![as_measured(Deviations::default())],
            floor_mm,
            tolerance_mm: session.tolerance_mm,
            ..Stages::default()
        };
    };
    let session = &*session;
    let problem = Problem::new(session, JointValues::Commanded);
    let nominal = base_model::nominal(&session.robot, session, &problem);
    // Deviations are shown over the joint that moved farthest, in its own unit.
    let joints = &session.robot.joints;
    let travel = |k: usize| {
        let [low, high] = extent(session.samples.q[k].iter());
        (high - low).max(0.0)
    };
    let farthest = (0..joints.len())
        .rev()
        .max_by(|a, b| travel(*a).total_cmp(&travel(*b)));
    let k = farthest.unwrap_or(0);
    let dir = session.samples.dir.get(k).and_then(Option::as_ref);
    let n = session.samples.len();
    Stages {
        nominal: nominal.predict(&problem.inputs),
        over: say!(
            "joint {joint} ({name}), {unit}",
            joint = k + 1,
            name = shortened(&or_unnamed(&joints[k].name), 40),
            unit = joints[k].kind.sign().trim()
        ),
        in_degrees: joints[k].kind.sign().trim() == "°",
        values: problem.inputs.q[k]
            .iter()
            .map(|q| joints[k].kind.to_display(*q))
            .collect(),
        side: (0..n)
            .map(|i| dir.map_or(0.0, |d| if d[i].is_nan() { 0.0 } else { d[i] }))
            .collect(),
        stages: vec![as_measured(deviations(&problem, &nominal))],
        floor_mm,
        tolerance_mm: session.tolerance_mm,
    }
}

/// The plots.
pub(super) fn section(stages: &Stages) -> Section {
    let along = &stages.stages[0].deviations.axes_mm;
    let points = along[0].iter().any(|e| e.is_finite());
    let mut blocks = Vec::new();
    let (places, magnification) = workspace(stages);
    let mut caption = say!(
        "Measured points with their deviations, magnified {magnification} times",
        magnification = short(magnification)
    );
    if stages.stages.len() > 2 {
        caption += "; ";
        caption += say!(
            "corrected commands act through the joints alone, the model holds what a controller can be told besides"
        );
    }
    if points {
        blocks.push(Block::Plot(places, caption));
    }
    blocks.push(Block::Plot(
        deviation(stages),
        say!("Length of the deviation; the scales differ from panel to panel").to_owned(),
    ));
    Section::new(say!("Deviations"), blocks)
}
