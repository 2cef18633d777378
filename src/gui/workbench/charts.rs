//! Which charts there are, and what they are made of.

use std::sync::Arc;

use crate::gui::cache::{Made, Work};
use crate::gui::charts::effect::{EffectCurve, Sketches};
use crate::gui::charts::{CHARTS, ChartKind, HoverTarget, Scene, effect, find};
use crate::gui::jobs::{Kind as JobKind, Watch};
use crate::gui::view::{Front, Step};
use crate::present::drawing::Drawing;
use crate::present::numbers::{notation, write_numbers};
use crate::present::table::Table;

use super::Workbench;

impl Workbench {
    /// The chart: the chosen one, else what suits the step.
    pub(crate) fn kind(&self) -> &'static dyn ChartKind {
        let scene = self.scene();
        let chosen = self.view.chart.and_then(find);
        let chosen = chosen.filter(|chart| chart.is_offered(&scene));
        chosen.unwrap_or_else(|| self.suiting())
    }

    /// Without a choice of the user: the table that is exported, the gap that is searched, the deviation.
    fn suiting(&self) -> &'static dyn ChartKind {
        let scene = self.scene();
        let suits = |chart: &&&dyn ChartKind| chart.is_offered(&scene) && chart.suits(&scene);
        *CHARTS.iter().rfind(suits).unwrap_or(&CHARTS[0])
    }

    /// Whether this is the chart that is shown.
    pub(crate) fn shows(&self, id: &str) -> bool {
        self.kind().about().id == id
    }

    /// What any chart is made of, except what the background works out for it.
    pub(crate) fn scene(&self) -> Scene {
        let view = &self.view;
        Scene {
            document: Arc::clone(self.history.present()),
            loaded_session: Arc::clone(self.loaded_session()),
            step: view.step,
            plane: view.plane,
            effect: view.effect,
            after_alone: view.only_after,
            component: view.component,
            joint: view.joint,
            units: self.units(),
            identified: self.shown_outcome(),
            search: self.search_of_this().cloned(),
            preview: {
                let newest = self.derived.preview.made().cloned();
                newest.filter(|_| self.export().is_some())
            },
            worked_out: None,
        }
    }

    /// What a chart is made of. While the answer is a newer one, what was worked out for the one before.
    pub(crate) fn scene_of(&self, chart: &dyn ChartKind) -> Scene {
        let scene = self.scene();
        let seen = |made: &&Made| made.inputs.identified.is_some() == self.identified().is_some();
        let made = chart.work(&scene).and_then(|work| self.made(&work));
        let worked_out = made.filter(seen).map(|made| made.result.clone());
        Scene {
            worked_out,
            ..scene
        }
    }

    /// Makes the table of what a chart shows, in the background: of a million samples it takes seconds.
    pub(super) fn numbers_of(&self, chart: &str) -> Option<impl FnOnce() -> Table + Send + use<>> {
        let kind = find(chart)?;
        let (scene, notation) = (self.scene_of(kind), notation());
        Some(move || {
            // As the window writes them.
            write_numbers(notation);
            kind.numbers(&scene)
        })
    }

    /// A chart as it is shown, on paper, and what it shows; of many samples with what is seen of them there.
    pub(super) fn on_paper(&self, chart: &str) -> Result<(Drawing, String), String> {
        let kind = find(chart).ok_or(say!("there is no such chart"))?;
        let scene = self.scene_of(kind);
        let shown = kind.show(&scene).map_err(|missing| missing.title)?;
        let mut chart = shown.chart;
        if let HoverTarget::Samples(samples) = &shown.pointed {
            let [[from, _], [to, _]] = chart.bounds;
            chart.items.extend(samples.in_sight([from, to]));
        }
        let session = crate::report::document::clean(&self.loaded_session().session.name);
        let says = format!("{session}: {}", chart.title);
        Ok((chart.on_paper(&session), says))
    }

    /// Copies what a chart shows as a table, as soon as that is made.
    pub(crate) fn copy_numbers(&mut self, chart: &'static str) {
        let Some(numbers) = self.numbers_of(chart) else {
            return;
        };
        let work = move |_: &Watch| numbers().tabbed();
        self.jobs.start(
            JobKind::Once,
            say!("copying the numbers of a chart"),
            work,
            move |bench: &mut Self, text| bench.copied = Some((chart, text)),
        );
    }

    /// The chart and its numbers that are ready to be copied, once.
    pub(crate) fn take_copied(&mut self) -> Option<(&'static str, String)> {
        self.copied.take()
    }

    /// The curve of an effect that was found, as its card shows it.
    pub(crate) fn sketch(&self, index: usize) -> Option<&EffectCurve> {
        let work = effect::sketches(self.search_of_this()?);
        let curves: &Sketches = self.made(&work)?.result.downcast_ref()?;
        curves.get(index)?.as_ref()
    }

    /// Shows this chart. Choosing what suits the step means: follow the steps.
    pub(crate) fn show_chart(&mut self, chart: &'static str) {
        self.view.chart = (chart != self.suiting().about().id).then_some(chart);
        self.view.front = Front::Chart;
    }

    /// Shows the curve of an effect that was found, in the component that it has most of.
    pub(crate) fn show_effect(&mut self, index: usize) {
        let loaded_session = Arc::clone(self.loaded_session());
        let strongest = self
            .diagnosis()
            .and_then(|d| effect::strongest(&loaded_session, d, index));
        if let Some(component) = strongest {
            (self.view.effect, self.view.component) = (index, component);
            self.view.step = Step::Gap;
            self.show_chart(effect::ID);
        }
    }

    /// What all plots have worked out in the background.
    pub(super) fn works(&self) -> Vec<Work> {
        let view = &self.view;
        let mut all = Vec::new();
        all.extend((view.heat && !view.in_space()).then(|| Work::heat(view.plane)));

        all.extend(self.wanted_figures());
        let searched = self
            .search_of_this()
            .filter(|_| self.view.step == Step::Gap);
        all.extend(searched.map(effect::sketches));
        all.extend(self.kind().work(&self.scene()));
        all
    }
}

#[cfg(test)]
mod tests {
    use crate::gui::core::loaded_session::Component;
    use crate::gui::testing::workbench;

    use super::*;

    const POSITION: &str = "deviation over position";
    const ANGLE: &str = "deviation";
    const TIME: &str = "deviation over time";
    const ORDERS: &str = "order spectrum";
    const HISTOGRAM: &str = "histogram";
    const GAP: &str = "gap by step";
    const TABLE: &str = "correction table";

    fn is_worked_out(workbench: &Workbench) -> bool {
        workbench.scene_of(workbench.kind()).worked_out.is_some()
    }

    fn go(workbench: &mut Workbench, step: Step) -> &'static str {
        workbench.execute(|bench| bench.view.step = step);
        workbench.receive();
        workbench.kind().about().id
    }

    fn choose(workbench: &mut Workbench, chart: &'static str) {
        workbench.execute(|bench| bench.show_chart(chart));
        workbench.receive();
        assert_eq!(workbench.kind().about().id, chart);
    }

    #[test]
    fn every_step_shows_what_suits_it_until_somebody_chooses() {
        let mut workbench = workbench();
        for step in Step::ALL {
            // Where a diagnosis is watched there is room for its steps.
            let suits = if step == Step::Gap { ANGLE } else { POSITION };
            assert_eq!(go(&mut workbench, step), suits, "nothing is identified");
        }
        workbench.execute(|bench| bench.identify(None));
        workbench.receive();
        assert_eq!(go(&mut workbench, Step::Identify), POSITION);
        assert_eq!(go(&mut workbench, Step::Gap), GAP);
        assert_eq!(go(&mut workbench, Step::Export), TABLE);
        choose(&mut workbench, ORDERS);
        for step in Step::ALL {
            assert_eq!(go(&mut workbench, step), ORDERS, "it was chosen");
        }
        // Choosing the table again means: follow the steps.
        go(&mut workbench, Step::Export);
        choose(&mut workbench, TABLE);
        assert_eq!(go(&mut workbench, Step::Gap), GAP);
        go(&mut workbench, Step::Identify);
        choose(&mut workbench, TIME);
        choose(&mut workbench, POSITION);
        assert_eq!(go(&mut workbench, Step::Gap), GAP);
        choose(&mut workbench, TIME);
        workbench.execute(|bench| bench.identify(None));
        assert_eq!(workbench.kind().about().id, TIME);
    }

    #[test]
    fn a_chart_is_worked_out_once_for_each_change_and_again_after_it() {
        let mut workbench = workbench();
        choose(&mut workbench, HISTOGRAM);
        let made = |workbench: &Workbench| {
            let made = workbench.derived.plots.last();
            let made = made.and_then(|(_, slot)| slot.made());
            Arc::clone(&made.expect("it is charted").result)
        };
        let first = made(&workbench);
        workbench.execute(|bench| bench.view.hovered = Some(3));
        workbench.execute(|bench| bench.view.only_after = true);
        workbench.receive();
        assert!(
            Arc::ptr_eq(&first, &made(&workbench)),
            "nothing has changed"
        );
        workbench.execute(|bench| bench.view.component = Component::Radial);
        workbench.receive();
        assert!(is_worked_out(&workbench));
        let radial = made(&workbench);
        assert!(!Arc::ptr_eq(&first, &radial));
        workbench.execute(|bench| bench.identify(None));
        workbench.receive();
        assert!(
            !Arc::ptr_eq(&radial, &made(&workbench)),
            "there is an after now"
        );
        choose(&mut workbench, ORDERS);
        assert!(is_worked_out(&workbench));
    }

    #[test]
    fn the_curve_of_a_found_effect_is_charted_in_the_component_that_it_has() {
        let mut workbench = workbench();
        workbench.execute(|bench| bench.show_effect(0));
        assert_eq!(
            workbench.kind().about().id,
            POSITION,
            "nothing was found yet"
        );
        workbench.execute(Workbench::search);
        workbench.receive();
        workbench.execute(|bench| bench.view.component = Component::Axial);
        workbench.execute(|bench| bench.show_effect(0));
        workbench.receive();
        assert_eq!(workbench.kind().about().id, effect::ID);
        assert_eq!(workbench.view.component, Component::Tangential);
        let scene = workbench.scene_of(workbench.kind());
        let shown = workbench.kind().show(&scene);
        let name = shown.map(|shown| shown.name).unwrap_or_default();
        assert_eq!(name, "curve of backlash, tangential");
        // It belongs to the step that finds the gap.
        assert_eq!(go(&mut workbench, Step::Export), TABLE);
        assert_eq!(go(&mut workbench, Step::Gap), effect::ID);
    }
}
