//! Which chart stands below the workspace, and what it is made of.

use std::sync::Arc;

use crate::gui::cache::charts::envelope::Envelope;
use crate::gui::cache::charts::over::{Over, Variable};
use crate::gui::cache::charts::{Asked, Charted, effect};
use crate::gui::cache::plot_cache::Backdrop;
use crate::gui::core::search::terms;
use crate::gui::view::{Chart, Step};

use super::Workbench;

impl Workbench {
    /// The chart below the workspace: the chosen one, else what suits the step.
    pub(crate) fn chart(&self) -> Chart {
        let chosen = self.view.chart.filter(|chart| self.offers(*chart));
        chosen.unwrap_or_else(|| self.suiting())
    }

    /// Where nobody has chosen: the table that is exported, the gap that is searched, the deviation.
    fn suiting(&self) -> Chart {
        if self.offers(Chart::Table) {
            Chart::Table
        } else if self.view.step == Step::Gap && self.offers(Chart::Gap) {
            Chart::Gap
        } else {
            Chart::Angle
        }
    }

    /// Whether there is anything to show in a chart, or at least something to say.
    pub(crate) fn offers(&self, chart: Chart) -> bool {
        let alone = self.subject().is_empty();
        match chart {
            Chart::Gap => self.answer().is_some() && !alone,
            Chart::Effect => self.view.step == Step::Gap && self.has_curve(),
            Chart::Table => {
                let made = self.export().and_then(Result::ok);
                let shown = self.view.step == Step::Export || alone;
                // A description of the robot has no curve; then the samples are more to look at.
                made.is_some_and(|made| shown && (alone || made.export.reads_as.is_some()))
            }
            _ => !alone,
        }
    }

    /// Whether the chosen effect was found.
    fn has_curve(&self) -> bool {
        let found = self.diagnosis().map(terms).unwrap_or_default();
        found.get(self.view.effect).is_some_and(Option::is_some)
    }

    /// The joint that charts are about.
    pub(crate) fn chart_joint(&self) -> usize {
        let joints = self.subject().session.robot.joints.len();
        self.view.joint.min(joints.saturating_sub(1))
    }

    /// What the chart stands over, if it is one of the deviation over something.
    pub(crate) fn over(&self) -> Option<Over> {
        self.over_in(self.chart())
    }

    /// What this chart stands over.
    pub(crate) fn over_in(&self, chart: Chart) -> Option<Over> {
        let variable = match chart {
            Chart::Angle => Variable::Joint,
            Chart::Time => Variable::Time,
            Chart::Load => Variable::Load,
            Chart::Temperature => Variable::Temperature,
            _ => return None,
        };
        let joint = self.chart_joint();
        Some(Over { variable, joint })
    }

    /// What the chart has to be made of.
    pub(super) fn charting(&self) -> Asked {
        match self.chart() {
            Chart::Orders => Asked::Orders(self.chart_joint(), self.gears()),
            Chart::Histogram => Asked::Histogram,
            Chart::Effect => {
                let search = self.searched.clone();
                let index = self.view.effect;
                search.map_or(Asked::Nothing, |search| {
                    Asked::Effect(effect::Asked { search, index })
                })
            }
            _ => self.over().map_or(Asked::Nothing, Asked::Over),
        }
    }

    /// Orders of gears of the charts' joint, as far as a search or the model knows them.
    fn gears(&self) -> Vec<usize> {
        let joint = self.chart_joint();
        let found = self.diagnosis().map(terms).unwrap_or_default();
        let added = self.document().added.iter().map(|a| &a.term);
        let gears = added
            .chain(found.iter().flatten())
            .filter(|term| term.joint == joint && term.effect.about().setting.takes_fractions());
        let orders = gears.map(|term| crate::gui::units::whole(term.setting));
        let mut orders: Vec<usize> = orders.collect();
        orders.sort_unstable();
        orders.dedup();
        orders
    }

    /// What the chart is made of; `None` until it is worked out. While the answer is a newer one
    /// it is that of the answer before.
    pub(crate) fn charted(&self) -> Option<&Charted> {
        let backdrop = self.backdrop()?;
        let scenery = &backdrop.scenery;
        let same = scenery.component == self.view.component
            && scenery.outcome.is_some() == self.outcome().is_some()
            && scenery.chart == self.charting();
        backdrop.charted.as_deref().filter(|_| same)
    }

    /// The extremes of a chart of many samples; `None` where they are few, or until they are found.
    pub(crate) fn envelope(&self) -> Option<&Envelope> {
        match self.charted()? {
            Charted::Over(envelope) => Some(envelope),
            _ => None,
        }
    }

    /// The extremes around the joint's angle, as [`Self::envelope`].
    pub(crate) fn around(&self) -> Option<&Envelope> {
        let seen = |b: &&Backdrop| {
            b.scenery.component == self.view.component
                && b.scenery.outcome.is_some() == self.outcome().is_some()
        };
        self.backdrop().filter(seen)?.around.as_deref()
    }

    pub(super) fn choose_chart(&mut self, chart: Chart) {
        // Whoever chooses what suits the step is content with what suits the next.
        self.view.chart = (chart != self.suiting()).then_some(chart);
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
            self.view.chart = Some(Chart::Effect);
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

    fn go(workbench: &mut Workbench, step: Step) -> Chart {
        workbench.execute(Command::GoTo(step));
        workbench.receive();
        workbench.chart()
    }

    fn choose(workbench: &mut Workbench, chart: Chart) {
        workbench.execute(Command::Chart(chart));
        workbench.receive();
        assert_eq!(workbench.chart(), chart);
    }

    #[test]
    fn every_step_shows_what_suits_it_until_somebody_chooses() {
        let mut workbench = workbench();
        for step in Step::ALL {
            assert_eq!(
                go(&mut workbench, step),
                Chart::Angle,
                "nothing is identified"
            );
        }
        workbench.execute(Command::Edit(Edit::Identify));
        workbench.receive();
        assert_eq!(go(&mut workbench, Step::Identify), Chart::Angle);
        assert_eq!(go(&mut workbench, Step::Gap), Chart::Gap);
        assert_eq!(go(&mut workbench, Step::Export), Chart::Table);
        choose(&mut workbench, Chart::Orders);
        for step in Step::ALL {
            assert_eq!(go(&mut workbench, step), Chart::Orders, "it was chosen");
        }
        // Whoever chooses the table again wants no more than what suits.
        go(&mut workbench, Step::Export);
        choose(&mut workbench, Chart::Table);
        assert_eq!(go(&mut workbench, Step::Gap), Chart::Gap);
        go(&mut workbench, Step::Identify);
        choose(&mut workbench, Chart::Time);
        choose(&mut workbench, Chart::Angle);
        assert_eq!(go(&mut workbench, Step::Gap), Chart::Gap);
        choose(&mut workbench, Chart::Time);
        workbench.execute(Command::Edit(Edit::Identify));
        assert_eq!(workbench.chart(), Chart::Time);
    }

    #[test]
    fn a_chart_is_worked_out_once_for_each_change_and_again_after_it() {
        let mut workbench = workbench();
        choose(&mut workbench, Chart::Histogram);
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
        assert!(workbench.charted().is_some());
        let radial = made(&workbench);
        assert!(!Arc::ptr_eq(&first, &radial));
        workbench.execute(Command::Edit(Edit::Identify));
        workbench.receive();
        assert!(
            !Arc::ptr_eq(&radial, &made(&workbench)),
            "there is an after now"
        );
        choose(&mut workbench, Chart::Orders);
        assert!(matches!(workbench.charted(), Some(Charted::Orders(_))));
    }

    #[test]
    fn the_curve_of_a_found_effect_is_charted_in_the_component_that_it_has() {
        let mut workbench = workbench();
        workbench.execute(Command::ShowEffect(0));
        assert_eq!(workbench.chart(), Chart::Angle, "nothing was found yet");
        workbench.execute(Command::Search);
        workbench.receive();
        workbench.execute(Command::Component(Component::Axial));
        workbench.execute(Command::ShowEffect(0));
        workbench.receive();
        assert_eq!(workbench.chart(), Chart::Effect);
        assert_eq!(workbench.view().component, Component::Tangential);
        let Some(Charted::Effect(Some(curve))) = workbench.charted() else {
            panic!("it has a curve");
        };
        assert_eq!(curve.effect, "backlash");
        // It belongs to the step that finds the gap.
        assert_eq!(go(&mut workbench, Step::Export), Chart::Table);
        assert_eq!(go(&mut workbench, Step::Gap), Chart::Effect);
    }
}
