//! Open questions: rivals that the samples cannot rule out, effects that they cannot show, and poses that would
//! decide.

use crate::budget;
use crate::effects::Term;
use crate::set_up_errors::DataProblem;
use crate::text::Text;

use super::equal_steps;
use super::testable::not_testable;
use crate::answers::diagnosis::Equivalent;
use crate::answers::pose::NextPose;
use crate::diagnosis::candidates::table::NotTestable;
use crate::diagnosis::evidence::Fit;
use crate::diagnosis::evidence::rival::Rival;
use crate::diagnosis::search::SearchResult as SearchEnd;
use crate::diagnosis::search::prepare::PreparedSearch;
use crate::diagnosis::search::{aliases, other_settings};
use crate::diagnosis::search::{exceeds_when_tested, is_likelier};

/// Open pairs, for the proposal of poses.
pub struct Undecided<'u, 'a> {
    pub(crate) prepared: &'u PreparedSearch<'a>,
    pub(crate) fit: &'u Fit,
    pub(crate) rivals: &'u [&'u Rival],
    pub(crate) not_testable: &'u [NotTestable],
}

/// Poses to measure next, and for each rival what would distinguish it from the model.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Proposal {
    pub(crate) poses: Vec<NextPose>,
    pub(crate) separate_by: Vec<Text>,
}

impl Proposal {
    /// No poses for so many rivals.
    fn not_looked_for(rivals: usize) -> Self {
        Self {
            poses: Vec::new(),
            separate_by: vec![text!("not looked for: the search was stopped"); rivals],
        }
    }
}

/// Proposes poses.
pub(crate) type Planner<'p> = &'p dyn Fn(&Undecided) -> Proposal;

/// Open questions.
pub(super) struct OpenQuestions {
    /// Rivals that the samples cannot rule out.
    pub(super) rivals: Vec<Rival>,
    /// The message about equal steps of the commands.
    pub(super) equal_steps: Option<DataProblem>,
    pub(super) not_testable: Vec<NotTestable>,
}

impl OpenQuestions {
    pub(super) fn of(prepared: &PreparedSearch, end: &SearchEnd) -> Self {
        let (regression, fit) = (&prepared.regression, &end.fit);
        let mut rivals = aliases::open_rivals(regression, fit);
        // What is likelier and significant on its own has taken the place already; what is not is no rival.
        let mut held = 0;
        rivals.retain(|r| {
            if !is_likelier(&r.fit, fit) {
                return true;
            }
            held += 1;
            held <= budget::LIKELIEST && exceeds_when_tested(prepared, &r.fit, fit)
        });
        let others = &end.other_ends;
        rivals.extend(aliases::under_another_noise(regression, fit, others));
        let settings = other_settings::open_settings(regression, fit);
        let equal_steps = equal_steps::equal_steps(prepared, &settings)
            .or_else(|| equal_steps::of_withdrawn(prepared, &end.withdrawn));
        rivals.extend(settings);
        let base = regression.fit(&regression.base, &[]);
        Self {
            rivals,
            equal_steps,
            not_testable: not_testable(regression, &base),
        }
    }

    /// Poses that would decide.
    pub(super) fn proposal(
        &self,
        prepared: &PreparedSearch,
        fit: &Fit,
        planner: Planner,
    ) -> Proposal {
        if prepared.regression.work.was_stopped() {
            return Proposal::not_looked_for(self.rivals.len());
        }
        planner(&Undecided {
            prepared,
            fit,
            rivals: &self.rivals.iter().collect::<Vec<_>>(),
            not_testable: &self.not_testable,
        })
    }
}

pub(super) fn equivalents(
    rivals: &[Rival],
    fit: &Fit,
    proposal: &Proposal,
    is_dropped: impl Fn(&Term) -> bool,
) -> Vec<Equivalent> {
    let robot = &fit.model.robot;
    let ids = |terms: &[Term]| -> Vec<String> { terms.iter().map(|t| t.name_on(robot)).collect() };
    let mut all: Vec<Equivalent> = Vec::new();
    for (rival, separate_by) in rivals.iter().zip(&proposal.separate_by) {
        if rival.removed.iter().any(&is_dropped) {
            continue;
        }
        let (explanation, instead) = (ids(&rival.removed), ids(&rival.instead));
        let mut there = all.iter_mut();
        let known = there.find(|e| e.explanation == explanation && e.instead == instead);
        if let Some(known) = known {
            // One name at several other settings is listed once.
            known.orders.extend(rival.other_settings());
            continue;
        }
        if all.len() == budget::LISTED {
            continue;
        }
        all.push(Equivalent {
            explanation,
            instead,
            odds: (fit.ln_evidence - rival.fit.ln_evidence).exp(),
            separate_by: separate_by.clone(),
            orders: rival.other_settings(),
            model: rival.fit.model.clone(),
        });
    }
    for one in all.iter_mut().filter(|e| !e.orders.is_empty()) {
        let orders = one
            .orders
            .iter()
            .map(|o| crate::diagnosis::candidates::shown(*o));
        let orders = orders.collect::<Vec<_>>().join(", ");
        one.separate_by = text!(
            "orders (or leads) {orders}, the same at these steps: {separate_by}",
            orders,
            separate_by = &one.separate_by
        );
    }
    all
}
