//! The picture of a laser: the deviation of one axis over its position, a line for each run and direction, with what
//! the table corrects and what is left as predicted with it; the figures of ISO 230-2 are next to it.

use super::{ChartChoice, ChartKind, ChartPlaceholder, Scene, Shown};
use crate::gui::core::quantity::{Over, Variable};
use crate::gui::help::Word;
use crate::gui::view::Step;
use crate::kinematics::JointKind;
use crate::language::spoken;
use crate::present::chart::{AxisDeviation, AxisStage, axis_figures};
use crate::present::numbers::fixed;
use crate::present::table::{Cell, Table};
use crate::standards::{AxisTest, Series, axis_test};

pub(crate) static OF_AXIS: ChartKind = ChartKind {
    // Where the sides are known: a run has a direction.
    is_offered: |scene| {
        let dir = scene.loaded_session.session.samples.dir.get(scene.joint());
        !scene.loaded_session.is_empty() && dir.is_some_and(Option::is_some)
    },
    // A test of one axis and nothing else: no second reflector, load, speed or setup that would be a series of
    // its own. While the diagnosis runs its steps are seen.
    suits: |scene| {
        let session = &scene.loaded_session.session;
        let samples = &session.samples;
        let alone = session.robot.joints.len() == 1
            && session.targets.len() < 2
            && samples.load_kg.is_none()
            && samples.setups.is_none()
            && samples.speed.iter().all(Option::is_none);
        alone && (scene.step != Step::Gap || scene.diagnosis().is_some())
    },
    ..ChartKind::new(
        "deviation over position",
        Word {
            name: phrase!("Deviation over position"),
            means: phrase!(
                "The picture that a laser's software shows: the deviation along the motion of one axis, a line for each run, whole where the position was approached in positive direction and dashed in negative. The thick line is what the table corrects, with the interval that holds it in 19 of 20 calibrations; what the model leaves is the same runs without it"
            ),
        },
        ChartChoice::Axis,
        show,
        numbers,
    )
};

fn show(scene: &Scene) -> Result<Shown, ChartPlaceholder> {
    let axis = &tested(scene)?;
    let series = best(axis)?;
    let over = Over {
        variable: Variable::Joint,
        joint: axis.joint,
    };
    let scale = over.scale(&scene.loaded_session, scene.units, 0.0);
    let label = over.label(&scene.loaded_session);
    let unit = unit(scene, axis);
    let stage = if scene.only_after {
        AxisStage::Predicted
    } else {
        AxisStage::Both
    };
    let made = AxisDeviation {
        axis,
        series,
        stage,
        across: scale.axis(&label),
        position: &|outer| scale.shown(axis.kind.to_base_units(outer)),
        unit,
    };
    let mut notes = vec![figures(series, unit)];
    if axis.series.len() + axis.more > 1 {
        notes.push(spoken(series.fixed.in_words(axis)));
    }
    notes.retain(|note| !note.is_empty());
    let title = |label: &str| say!("Deviation over {label}, run by run", label);
    let chart = made.chart(title(&label), notes.join(" · "));
    Ok(Shown::new(chart, title(say!("position"))))
}

/// Every approach, in the units of the axis.
fn numbers(scene: &Scene) -> Table {
    let Ok(axis) = &tested(scene) else {
        return Table::default();
    };
    let Ok(series) = best(axis) else {
        return Table::default();
    };
    let of = |what: &str| format!("{what}, {}", axis.unit);
    let mut table = Table::new([
        &format!("position, {}", axis.position_unit),
        "side",
        "run",
        &of("deviation"),
        &of("deviation with the table"),
    ]);
    for (k, at) in series.deviations.iter().enumerate() {
        let after = series.corrected.as_ref().map(|all| &all[k]);
        for (side, before, after) in [
            (1.0, &at.up, after.map(|p| &p.up)),
            (-1.0, &at.down, after.map(|p| &p.down)),
        ] {
            for (run, e) in before.iter().enumerate() {
                let left = after.map(|all| all[run]);
                table.row([
                    at.commanded.into(),
                    side.into(),
                    (run + 1).into(),
                    (*e).into(),
                    Cell::from(left),
                ]);
            }
        }
    }
    table
}

fn tested(scene: &Scene) -> Result<AxisTest, ChartPlaceholder> {
    let calibration = scene.answer().map(|answer| &answer.calibration);
    let found = axis_test(&scene.loaded_session.session, calibration, scene.joint());
    found.map_err(|error| ChartPlaceholder::new(spoken(error.describe()), ""))
}

/// The best of its series.
fn best(axis: &AxisTest) -> Result<&Series, ChartPlaceholder> {
    let why = say!(
        "Positions of the joint that were reached with everything else alike make a run, from either direction"
    );
    let none = || ChartPlaceholder::new(say!("There is no run of this joint to show"), why);
    axis.series.first().ok_or_else(none)
}

/// What deviations are shown in, and how many of it are one of the axis' own.
fn unit(scene: &Scene, axis: &AxisTest) -> (&'static str, f64) {
    match axis.kind {
        JointKind::Revolute => (axis.unit, 1.0),
        JointKind::Prismatic => (scene.units.length_name(), scene.units.length_value(1.0)),
    }
}

/// To a tenth of a micrometre or of a second, as the tables of the standard are.
fn figures(series: &Series, (unit, factor): (&str, f64)) -> String {
    let decimals = match unit {
        "mm" => 4,
        "in" => 6,
        _ => 1,
    };
    axis_figures(series, unit, &|value| fixed(value * factor, decimals))
}
