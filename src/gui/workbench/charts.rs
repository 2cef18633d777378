//! Which charts there are, and what they are made of.

use std::borrow::Cow;
use std::sync::Arc;

use crate::gui::charts::{CHARTS, ChartKind, ChartPlaceholder, Scene, Shown, effect, find};
use crate::gui::jobs::{Kind as JobKind, Watch};
use crate::gui::view::{Front, Message, Step};
use crate::present::chart::Chart;
use crate::present::drawing::Drawing;
use crate::present::numbers::{notation, write_numbers};
use crate::text::current;

use super::Workbench;

impl Workbench {
    /// The chart: the chosen one, else what suits the step.
    pub(crate) fn kind(&self) -> &'static ChartKind {
        let scene = self.scene();
        let chosen = self.view.chart.and_then(find);
        let chosen = chosen.filter(|chart| (chart.is_offered)(&scene));
        chosen.unwrap_or_else(|| self.suiting())
    }

    /// Without a choice of the user: the table that is exported, the gap that is searched, the deviation.
    fn suiting(&self) -> &'static ChartKind {
        let scene = self.scene();
        let suits = |chart: &&&ChartKind| (chart.is_offered)(&scene) && (chart.suits)(&scene);
        CHARTS.iter().rfind(suits).unwrap_or(&CHARTS[0])
    }

    /// Whether this is the chart that is shown.
    pub(crate) fn shows(&self, id: &str) -> bool {
        self.kind().id == id
    }

    /// What any chart is made of.
    pub(crate) fn scene(&self) -> Scene {
        let view = &self.view;
        Scene {
            document: Arc::clone(self.history.present()),
            loaded_session: Arc::clone(self.loaded_session()),
            step: view.step,
            effect: view.effect,
            only_after: self.only_after(),
            component: view.component,
            joint: view.joint,
            units: self.units(),
            identified: self.shown_outcome(),
            search: self.search_of_this().cloned(),
            preview: self.export().and_then(|made| made.ok().cloned()),
            written: (current(), notation()),
        }
    }

    /// The chart that is shown, or why there is none. While a newer one is being made it is the one before.
    pub(crate) fn charted(&self) -> Option<&Result<Shown, ChartPlaceholder>> {
        let ((id, scene), made) = self.derived.chart.made()?;
        let of_this = self.shows(id)
            && Arc::ptr_eq(&scene.loaded_session, self.loaded_session())
            && scene.identified.is_some() == self.answer().is_some();
        of_this.then_some(&**made)
    }

    /// A chart as it is shown, on paper, and what it shows; of many samples with what is seen of them there.
    pub(super) fn on_paper(
        &self,
        chart: &str,
    ) -> Option<impl FnOnce() -> Result<(Drawing, String), String> + Send + use<>> {
        let (kind, scene) = (find(chart)?, self.scene());
        Some(move || {
            write_numbers(scene.written.1);
            let shown = (kind.show)(&scene).map_err(|missing| missing.title)?;
            let [[from, _], [to, _]] = shown.chart.bounds;
            let items = shown.in_sight([from, to]).map(Cow::into_owned).collect();
            let chart = Chart {
                items,
                ..shown.chart
            };
            let session = crate::report::document::clean(&scene.loaded_session.session.name);
            let says = format!("{session}: {}", chart.title);
            Ok((chart.on_paper(&session), says))
        })
    }

    /// Makes what a chart shows a table in the background, for who copies it: of a million samples it takes seconds.
    pub(crate) fn copy_numbers(
        &mut self,
        chart: &'static str,
        copied: impl FnOnce(String) + Send + 'static,
    ) {
        let (Some(kind), scene) = (find(chart), self.scene()) else {
            return;
        };
        let work = move |_: &Watch| {
            // As the window writes them.
            write_numbers(scene.written.1);
            (kind.numbers)(&scene).tabbed()
        };
        let of = kind.name().to_lowercase();
        let says = say!("Copy numbers: {of}", of);
        self.jobs
            .start(JobKind::Once, says, work, |bench: &mut Self, text| {
                copied(text);
                bench.view.message = Some(Message::done(say!("Copied"), Vec::new()));
            });
    }

    /// The curve of an effect that was found, as its card shows it.
    pub(crate) fn sketch(&self, index: usize) -> Option<&Shown> {
        let (search, curves) = self.derived.sketches.made()?;
        let of_this = Arc::ptr_eq(search, self.search_of_this()?);
        curves.get(index).filter(|_| of_this)?.as_ref()
    }

    /// Shows this chart. Choosing what suits the step means: follow the steps.
    pub(crate) fn show_chart(&mut self, chart: &'static str) {
        self.view.chart = (chart != self.suiting().id).then_some(chart);
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
        workbench.charted().is_some()
    }

    fn go(workbench: &mut Workbench, step: Step) -> &'static str {
        workbench.execute(|bench| bench.view.step = step);
        workbench.receive();
        workbench.kind().id
    }

    fn choose(workbench: &mut Workbench, chart: &'static str) {
        workbench.execute(|bench| bench.show_chart(chart));
        workbench.receive();
        assert_eq!(workbench.kind().id, chart);
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
        assert_eq!(workbench.kind().id, TIME);
    }

    #[test]
    fn a_chart_is_worked_out_once_for_each_change_and_again_after_it() {
        let mut workbench = workbench();
        choose(&mut workbench, HISTOGRAM);
        let made = |workbench: &Workbench| {
            let made = workbench.derived.chart.made();
            Arc::clone(&made.expect("it is charted").1)
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
        assert_eq!(workbench.kind().id, POSITION, "nothing was found yet");
        workbench.execute(Workbench::search);
        workbench.receive();
        workbench.execute(|bench| bench.view.component = Component::Axial);
        workbench.execute(|bench| bench.show_effect(0));
        workbench.receive();
        assert_eq!(workbench.kind().id, effect::ID);
        assert_eq!(workbench.view.component, Component::Tangential);
        let shown = workbench.charted().expect("it is charted");
        let name = shown.as_ref().map(|shown| &*shown.name).unwrap_or_default();
        assert_eq!(name, "curve of backlash, tangential");
        // It belongs to the step that finds the gap.
        assert_eq!(go(&mut workbench, Step::Export), TABLE);
        assert_eq!(go(&mut workbench, Step::Gap), effect::ID);
    }
}
