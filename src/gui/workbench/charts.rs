//! Which chart stands below the workspace, and what it is made of.

use std::sync::Arc;

use crate::gui::cache::envelope::Envelope;
use crate::gui::cache::plot_cache::Backdrop;
use crate::gui::charts::{CHARTS, Kind, Scene, effect, find};

use crate::gui::view::Step;

use super::Workbench;

impl Workbench {
    /// The chart below the workspace: the chosen one, else what suits the step.
    pub(crate) fn chart(&self) -> &'static dyn Kind {
        let scene = self.scene();
        let chosen = self.view.chart.and_then(find);
        let chosen = chosen.filter(|chart| chart.is_offered(&scene));
        chosen.unwrap_or_else(|| self.suiting())
    }

    /// Where nobody has chosen: the table that is exported, the gap that is searched, the deviation.
    fn suiting(&self) -> &'static dyn Kind {
        let scene = self.scene();
        let suits = |chart: &&&dyn Kind| chart.is_offered(&scene) && chart.suits(&scene);
        *CHARTS.iter().rfind(suits).unwrap_or(&CHARTS[0])
    }

    /// What any chart is made of, except what the background works out for it.
    pub(crate) fn scene(&self) -> Scene<'_> {
        let search = self.searched.as_ref();
        Scene {
            document: self.document(),
            subject: self.subject(),
            view: &self.view,
            units: self.units(),
            answer: self.answer(),
            search: search.filter(|search| Arc::ptr_eq(&search.subject, self.subject())),
            made: self.export().and_then(Result::ok),
            worked_out: None,
        }
    }

    /// What a chart is made of. While the answer is a newer one, what was worked out for it is that
    /// of the answer before; nothing until it is there.
    pub(crate) fn scene_of(&self, chart: &dyn Kind) -> Scene<'_> {
        let mut scene = self.scene();
        let work = chart.work(&scene);
        let backdrop = self
            .backdrop()
            .filter(|b| self.is_of_what_is_seen(b) && work.is_some() && b.scenery.chart == work);
        scene.worked_out = backdrop.and_then(|b| b.charted.as_deref());
        scene
    }

    fn is_of_what_is_seen(&self, backdrop: &Backdrop) -> bool {
        let scenery = &backdrop.scenery;
        scenery.component == self.view.component
            && scenery.outcome.is_some() == self.outcome().is_some()
    }

    /// The joint that charts are about.
    pub(crate) fn chart_joint(&self) -> usize {
        self.scene().joint()
    }

    /// The extremes around the joint's angle of many samples; `None` where they are few, or until
    /// they are found.
    pub(crate) fn around(&self) -> Option<&Envelope> {
        let seen = |b: &&Backdrop| self.is_of_what_is_seen(b);
        self.backdrop().filter(seen)?.around.as_deref()
    }

    pub(super) fn choose_chart(&mut self, chart: &'static str) {
        // Whoever chooses what suits the step is content with what suits the next.
        self.view.chart = (chart != self.suiting().about().id).then_some(chart);
    }

    pub(super) fn show_effect(&mut self, index: usize) {
        let subject = Arc::clone(self.subject());
        let strongest = self
            .diagnosis()
            .and_then(|d| effect::strongest(&subject, d, index));
        if let Some(component) = strongest {
            self.view.component = component;
            self.view.effect = index;
            self.view.step = Step::Gap;
            self.view.chart = Some(effect::ID);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::core::edit::Edit;
    use crate::gui::core::loaded_session::Component;
    use crate::gui::testing::workbench;
    use crate::gui::workbench::Command;

    const ANGLE: &str = "deviation";
    const TIME: &str = "deviation over time";
    const ORDERS: &str = "order spectrum";
    const HISTOGRAM: &str = "histogram";
    const GAP: &str = "gap by step";
    const TABLE: &str = "correction table";

    fn is_worked_out(workbench: &Workbench) -> bool {
        workbench.scene_of(workbench.chart()).worked_out.is_some()
    }

    fn go(workbench: &mut Workbench, step: Step) -> &'static str {
        workbench.execute(Command::GoTo(step));
        workbench.receive();
        workbench.chart().about().id
    }

    fn choose(workbench: &mut Workbench, chart: &'static str) {
        workbench.execute(Command::Chart(chart));
        workbench.receive();
        assert_eq!(workbench.chart().about().id, chart);
    }

    #[test]
    fn every_step_shows_what_suits_it_until_somebody_chooses() {
        let mut workbench = workbench();
        for step in Step::ALL {
            assert_eq!(go(&mut workbench, step), ANGLE, "nothing is identified");
        }
        workbench.execute(Command::Edit(Edit::Identify));
        workbench.receive();
        assert_eq!(go(&mut workbench, Step::Identify), ANGLE);
        assert_eq!(go(&mut workbench, Step::Gap), GAP);
        assert_eq!(go(&mut workbench, Step::Export), TABLE);
        choose(&mut workbench, ORDERS);
        for step in Step::ALL {
            assert_eq!(go(&mut workbench, step), ORDERS, "it was chosen");
        }
        // Whoever chooses the table again wants no more than what suits.
        go(&mut workbench, Step::Export);
        choose(&mut workbench, TABLE);
        assert_eq!(go(&mut workbench, Step::Gap), GAP);
        go(&mut workbench, Step::Identify);
        choose(&mut workbench, TIME);
        choose(&mut workbench, ANGLE);
        assert_eq!(go(&mut workbench, Step::Gap), GAP);
        choose(&mut workbench, TIME);
        workbench.execute(Command::Edit(Edit::Identify));
        assert_eq!(workbench.chart().about().id, TIME);
    }

    #[test]
    fn a_chart_is_worked_out_once_for_each_change_and_again_after_it() {
        let mut workbench = workbench();
        choose(&mut workbench, HISTOGRAM);
        let made = |workbench: &Workbench| {
            let backdrop = workbench.backdrop().expect("it is made");
            Arc::clone(backdrop.charted.as_ref().expect("it is charted"))
        };
        let first = made(&workbench);
        workbench.execute(Command::Hover(Some(3)));
        workbench.execute(Command::OnlyAfter(true));
        workbench.receive();
        assert!(
            Arc::ptr_eq(&first, &made(&workbench)),
            "nothing has changed"
        );
        workbench.execute(Command::Component(Component::Radial));
        workbench.receive();
        assert!(is_worked_out(&workbench));
        let radial = made(&workbench);
        assert!(!Arc::ptr_eq(&first, &radial));
        workbench.execute(Command::Edit(Edit::Identify));
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
        workbench.execute(Command::ShowEffect(0));
        assert_eq!(workbench.chart().about().id, ANGLE, "nothing was found yet");
        workbench.execute(Command::Search);
        workbench.receive();
        workbench.execute(Command::Component(Component::Axial));
        workbench.execute(Command::ShowEffect(0));
        workbench.receive();
        assert_eq!(workbench.chart().about().id, effect::ID);
        assert_eq!(workbench.view().component, Component::Tangential);
        let scene = workbench.scene_of(workbench.chart());
        let shown = workbench.chart().show(&scene);
        let name = shown.map(|shown| shown.name).unwrap_or_default();
        assert_eq!(name, "curve of backlash, tangential");
        // It belongs to the step that finds the gap.
        assert_eq!(go(&mut workbench, Step::Export), TABLE);
        assert_eq!(go(&mut workbench, Step::Gap), effect::ID);
    }
}
