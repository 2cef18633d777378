//! A component of the deviation over the value of a joint, time, load or temperature, before and after.

use std::sync::Arc;

use super::{About, ChartChoice, ChartKind, ChartPlaceholder, HoverTarget, Scene, Seen, Shown};
use crate::gui::cache::points::at;
use crate::gui::core::loaded_session::Component;
use crate::gui::core::quantity::{Over, Variable};
use crate::gui::core::regions::boundaries;
use crate::gui::help::{self, Word};
use crate::present::chart::{Chart, Deviation, Form, LegendSymbol, Series};
use crate::present::numbers::significant;
use crate::present::table::{Cell, Table};
use crate::text::{Template, within};

/// A component of the deviation, mm, over a quantity of the samples.
pub(crate) struct Along {
    variable: Variable,
    about: About,
}

const fn along(variable: Variable, id: &'static str, names: [Template; 2], word: Word) -> Along {
    let about = About::new(id, names, word, ChartChoice::Joint);
    Along { variable, about }
}

pub(crate) static ANGLE: Along = along(
    Variable::Joint,
    "deviation",
    [phrase!("angle"), phrase!("Deviation over angle")],
    help::DEVIATION,
);
pub(crate) static TIME: Along = along(
    Variable::Time,
    "deviation over time",
    [phrase!("time"), phrase!("Deviation over time")],
    help::OVER_TIME,
);
pub(crate) static LOAD: Along = along(
    Variable::Load,
    "deviation over load",
    [phrase!("load"), phrase!("Deviation over load")],
    help::OVER_LOAD,
);
pub(crate) static TEMPERATURE: Along = along(
    Variable::Temperature,
    "deviation over temperature",
    [
        phrase!("temperature"),
        phrase!("Deviation over temperature"),
    ],
    help::OVER_TEMPERATURE,
);

impl Along {
    pub(super) fn over(&self, scene: &Scene) -> Over {
        Over {
            variable: self.variable,
            joint: scene.joint(),
        }
    }
}

impl ChartKind for Along {
    fn about(&self) -> About {
        self.about
    }

    fn show(&self, scene: &Arc<Scene>) -> Result<Shown, ChartPlaceholder> {
        let over = self.over(scene);
        let missing = || {
            let [title, why] = over.needs();
            ChartPlaceholder::new(title, why)
        };
        over.column(&scene.loaded_session).ok_or_else(missing)?;
        let seen = Seen::of(scene, over);
        let extent = seen.extent().ok_or_else(missing)?;
        let component = scene.component.name();
        let name = match self.variable {
            Variable::Joint => say!("deviation chart, {component}", component),
            _ => say!(
                "{chart} chart, {component}",
                chart = within(self.about.name()),
                component
            ),
        };
        Ok(Shown {
            description: describe(&seen, over),
            chart: chart(&seen, over, extent),
            name,
            pointed: HoverTarget::Samples(Box::new(seen)),
        })
    }

    /// Every sample: inner units, in measuring order.
    fn numbers(&self, scene: &Scene) -> Table {
        let over = self.over(scene);
        let session = &scene.loaded_session;
        let component = scene.component.name();
        let along = over.heading(session);
        let [before, after] = ["before", "after"].map(|when| format!("{component} {when}, mm"));
        let mut table = Table::new(["sample", &along, "side", &before, &after]);
        for sample in scene.usable() {
            let [x, before] = at(session, None, (over, scene.component), 0, sample);
            let [_, after] = at(session, scene.answer(), (over, scene.component), 1, sample);
            let x = over.cell(session, x);
            let side = over.side(session, sample);
            let numbers = [x, side, before, after].map(Cell::from);
            table.row([Cell::from(sample + 1)].into_iter().chain(numbers));
        }
        table
    }
}

fn chart(seen: &Seen, over: Over, [x, mm]: [[f64; 2]; 2]) -> Chart {
    let scene = &seen.scene;
    // Regions divide the angle of joint 1.
    let divided = over.variable == Variable::Joint && over.joint == 0;
    let boundaries = boundaries(&scene.document.regions);
    let boundaries = boundaries.iter().filter(|_| divided);
    let scale = &seen.scales[0];
    let sign = LegendSymbol::Mark(Form::Disc);
    // The marks themselves are those in sight.
    let series = scene.legend(sign).into_iter().map(|entry| Series {
        entry,
        samples: Vec::new(),
    });
    let name = scene.component.name();
    let label = over.label(&scene.loaded_session);
    let number = |mm: f64| significant(scene.units.length_value(mm), 3);
    let made = Deviation {
        component: name,
        is_length: scene.component == Component::Length,
        across: scale.axis(&label),
        lengths: scene.lengths(&number),
        x: x.map(|x| scale.shown(x)),
        mm,
        sides: seen.has_sides(),
        tolerance_mm: scene.document.tolerance_mm,
        floor_mm: None,
        boundaries: boundaries.map(|b| scale.shown(b.at_rad)).collect(),
        series: series.collect(),
    };
    made.chart(
        say!("{name} deviation over {label}", name, label),
        note(seen, over),
    )
}

/// What has to be said.
pub(super) fn note(seen: &Seen, over: Over) -> String {
    let mut notes = Vec::new();
    let session = &seen.scene.loaded_session;
    let component = seen.scene.component;
    let polar = [Component::Tangential, Component::Radial, Component::Axial];
    if let [first, _, ..] = &session.session.robot.joints[..]
        && polar.contains(&component)
    {
        // The axis below may be another joint's.
        notes.push(say!(
            "{component} to {first}",
            component = component.name(),
            first = first.name
        ));
    }
    let never_changes = seen.extent().is_none_or(|[x, _]| x[0] == x[1]);
    if never_changes && over.variable != Variable::Joint {
        let what = over.label(session);
        notes.push(say!("the {quantity} never changes", quantity = what));
    }
    notes.extend(seen.notes());
    notes.join(" · ")
}

/// What is seen, in words.
pub(super) fn describe(seen: &Seen, over: Over) -> String {
    let scene = &seen.scene;
    let units = scene.units;
    let Some([x, _]) = seen.extent() else {
        return say!("no sample to show").to_owned();
    };
    let mut says = say!(
        "{component} deviation of {samples} samples over {label} from {from} to {to}",
        component = scene.component.name(),
        samples = seen.points(0).samples.len(),
        label = over.label(&scene.loaded_session),
        from = seen.scales[0].describe(x[0]),
        to = seen.scales[0].describe(x[1])
    );
    for (when, name) in [say!("before"), say!("after")].into_iter().enumerate() {
        if let Some([_, mm]) = seen.points(when).extent {
            let [from, to] = mm.map(|mm| units.length(mm));
            let between = say!("{from} to {to}", from, to);
            says += &format!(", {name} {between}");
        }
    }
    if let Some(tolerance) = scene.document.tolerance_mm {
        let tolerance = say!("tolerance {tolerance}", tolerance = units.length(tolerance));
        says += &format!(", {tolerance}");
    }
    says
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::testing::workbench;
    use crate::gui::workbench::Workbench;

    /// Deviations of all samples along the angle, before or after.
    fn deviations(workbench: &Workbench, when: usize) -> Vec<f64> {
        let scene = Arc::new(workbench.scene());
        let over = ANGLE.over(&scene);
        let seen = Seen::of(&scene, over);
        let samples = seen.points(when).samples.iter();
        samples.map(|s| seen.place(when, *s as usize)[1]).collect()
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
            let scene = Arc::new(workbench.scene());
            let shown = ANGLE.show(&scene).expect("it is shown");
            shown.chart.bounds[1][1] - shown.chart.bounds[0][1]
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
