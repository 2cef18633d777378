//! A component of the deviation over the value of a joint, time, load or temperature, before and after.

use super::{ChartChoice, ChartKind, ChartPlaceholder, Scene, Series, Shown, not_drawn};
use crate::gui::core::loaded_session::Component;
use crate::gui::core::quantity::{Over, Variable};
use crate::gui::core::regions::boundaries;
use crate::gui::help;
use crate::numeric::extent;
use crate::present::chart::{self, Deviation, Form, LegendSymbol};
use crate::present::numbers::significant;
use crate::present::table::{Cell, Table};
use crate::text::within;

pub(crate) static ANGLE: ChartKind = ChartKind {
    name: phrase!("Deviation over angle"),
    ..ChartKind::new(
        "deviation",
        help::DEVIATION,
        ChartChoice::Joint,
        |scene| show(scene, Variable::Joint, &ANGLE),
        |scene| numbers(scene, Variable::Joint),
    )
};
pub(crate) static TIME: ChartKind = ChartKind::new(
    "deviation over time",
    help::OVER_TIME,
    ChartChoice::Joint,
    |scene| show(scene, Variable::Time, &TIME),
    |scene| numbers(scene, Variable::Time),
);
pub(crate) static LOAD: ChartKind = ChartKind::new(
    "deviation over load",
    help::OVER_LOAD,
    ChartChoice::Joint,
    |scene| show(scene, Variable::Load, &LOAD),
    |scene| numbers(scene, Variable::Load),
);
pub(crate) static TEMPERATURE: ChartKind = ChartKind::new(
    "deviation over temperature",
    help::OVER_TEMPERATURE,
    ChartChoice::Joint,
    |scene| show(scene, Variable::Temperature, &TEMPERATURE),
    |scene| numbers(scene, Variable::Temperature),
);

fn over(scene: &Scene, variable: Variable) -> Over {
    let joint = scene.joint();
    Over { variable, joint }
}

fn show(scene: &Scene, variable: Variable, kind: &ChartKind) -> Result<Shown, ChartPlaceholder> {
    let (over, session) = (over(scene, variable), &*scene.loaded_session);
    let stages = scene.stages(over);
    let all = || stages.iter().flat_map(|(_, marks)| marks);
    let [x, mm] = [0, 1].map(|k| extent(all().map(|(_, mark)| mark.at[k])));
    if x[0] > x[1] || mm[0] > mm[1] {
        let [title, why] = over.needs();
        return Err(ChartPlaceholder::new(title, why));
    }
    let scale = over.scale(session, scene.units, x[1] - x[0]);
    // Regions divide the angle of joint 1.
    let divided = variable == Variable::Joint && over.joint == 0;
    let boundaries = boundaries(&scene.document.regions);
    let boundaries = boundaries.iter().filter(|_| divided);
    // The marks themselves are those in sight.
    let legend = scene.legend(LegendSymbol::Mark(Form::Disc)).into_iter();
    let entries = legend.map(|entry| chart::Series {
        entry,
        samples: Vec::new(),
    });
    let component = scene.component.name();
    let label = over.label(session);
    let number = |mm: f64| significant(scene.units.length_value(mm), 3);
    let made = Deviation {
        component,
        is_length: scene.component == Component::Length,
        across: scale.axis(&label),
        lengths: scene.lengths(&number),
        x: x.map(|x| scale.shown(x)),
        mm,
        sides: all().any(|(_, mark)| mark.form != Form::Disc),
        tolerance_mm: scene.document.tolerance_mm,
        floor_mm: None,
        boundaries: boundaries.map(|b| scale.shown(b.at_rad)).collect(),
        series: entries.collect(),
    };
    let title = say!("{name} deviation over {label}", name = component, label);
    let chart = made.chart(title, String::new());
    let name = match variable {
        Variable::Joint => say!("deviation chart, {component}", component),
        _ => say!(
            "{chart} chart, {component}",
            chart = within(&kind.name()),
            component
        ),
    };
    let place = |[x, mm]: [f64; 2]| [scale.shown(x), scene.units.length_value(mm)];
    let mut shown = Shown::of(chart, name, &stages, place);
    shown.chart.note = note(scene, (x[0] == x[1]).then_some(over), &shown.series);
    Ok(shown)
}

/// What has to be said; of what never changes as well.
pub(super) fn note(scene: &Scene, constant: Option<Over>, series: &[Series]) -> String {
    let mut notes = Vec::new();
    let session = &scene.loaded_session;
    let polar = [Component::Tangential, Component::Radial, Component::Axial];
    if let [first, _, ..] = &session.session.robot.joints[..]
        && polar.contains(&scene.component)
    {
        // The axis below may be another joint's.
        notes.push(say!(
            "{component} to {first}",
            component = scene.component.name(),
            first = first.name
        ));
    }
    if let Some(over) = constant.filter(|over| over.variable != Variable::Joint) {
        let what = over.label(session);
        notes.push(say!("the {quantity} never changes", quantity = what));
    }
    notes.extend(not_drawn(series, scene.usable().len()));
    notes.join(" · ")
}

/// Every sample: inner units, in measuring order.
pub(super) fn numbers(scene: &Scene, variable: Variable) -> Table {
    let (over, session) = (over(scene, variable), &scene.loaded_session);
    let component = scene.component.name();
    let along = over.heading(session);
    let [before, after] = ["before", "after"].map(|when| format!("{component} {when}, mm"));
    let mut table = Table::new(["sample", &along, "side", &before, &after]);
    for sample in scene.usable() {
        let [before, after] = [0, 1].map(|when| scene.value(when, sample));
        let x = over.cell(session, over.of(session, sample));
        let side = session.side(over.joint, sample);
        let numbers = [x, side, before, after].map(Cell::from);
        table.row([Cell::from(sample + 1)].into_iter().chain(numbers));
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::testing::workbench;
    use crate::gui::workbench::Workbench;

    fn shown(workbench: &Workbench) -> Shown {
        show(&workbench.scene(), Variable::Joint, &ANGLE).expect("it is shown")
    }

    /// Deviations of all samples along the angle, before or after.
    fn deviations(workbench: &Workbench, when: usize) -> Vec<f64> {
        let shown = shown(workbench);
        let series = shown.series.get(when).into_iter();
        let samples = 0..workbench.loaded_session().len();
        let places = series.flat_map(|all| samples.clone().filter_map(|sample| all.at(sample)));
        places.map(|[_, mm]| mm).collect()
    }

    #[test]
    fn the_components_of_a_deviation_have_its_length() {
        let mut workbench = workbench();
        let mut of = |component: Component| {
            workbench.execute(|bench| bench.view.component = component);
            deviations(&workbench, 0)[5]
        };
        let length = of(Component::Length);
        let polar = [Component::Tangential, Component::Radial, Component::Axial].map(&mut of);
        let cartesian = [Component::X, Component::Y, Component::Z].map(&mut of);
        for e in [polar, cartesian] {
            let found = e.iter().map(|v| v * v).sum::<f64>().sqrt();
            assert!((found - length).abs() < 1e-12);
        }
    }

    #[test]
    fn a_zero_offset_of_minus_three_degrees_is_tangential_and_negative() {
        let workbench = workbench();
        let all = deviations(&workbench, 0);
        let mean = all.iter().sum::<f64>() / all.len() as f64;
        let expected = -245.0 * 3.0_f64.to_radians().sin();
        assert!((mean - expected).abs() < 0.2, "{mean} {expected}");
    }

    #[test]
    fn what_is_left_is_there_once_it_is_identified_and_can_be_looked_at_alone() {
        let mut workbench = workbench();
        let left = |workbench: &Workbench| deviations(workbench, 1).len();
        let high = |workbench: &Workbench| {
            let [low, high] = shown(workbench).chart.bounds;
            high[1] - low[1]
        };
        assert_eq!(left(&workbench), 0);
        workbench.execute(|bench| bench.identify(None));
        workbench.receive();
        assert_eq!(left(&workbench), workbench.loaded_session().len());
        let both = high(&workbench);
        workbench.execute(|bench| bench.view.only_after = true);
        assert!(high(&workbench) < 0.1 * both);
    }
}
