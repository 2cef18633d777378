//! Which targets are where the session states, once a fit with all of them free has shown where they are.
//!
//! Those that are keep their stated places: they determine the tool. One that is elsewhere is free, from the row on
//! from which it is. Where its samples lie at the stated place of another, their names are wrong. Where the samples do
//! not determine which targets are at their places, all get the uncertainty by which they disagree.

use std::collections::BTreeSet;

use nalgebra::Vector3;

use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::fit::problem::Problem;
use crate::fit::target_places::{
    Agreement, SeenTarget, across_mm, agreement, last_axis, seen_targets, sigma_between,
};
use crate::model::Model;
use crate::sessions::{Group, Session, SessionCorrection};
use crate::text::{Text, length};

use super::evidence::{RESIDUAL_SHARE, evidence, in_numbers, is_believed};
use super::moved::{Moved, moved};
use super::targets::{self, AS_WELL, Contradicted, contradicted};
use crate::set_up_errors::fits::residual_mm;

/// What was found elsewhere.
pub(super) struct Placed {
    pub(super) problems: Vec<DataProblem>,
    /// Whether names were corrected, and nothing else: what they hid is still to be found.
    pub(super) is_renamed: bool,
}

/// What is elsewhere in a session, if anything.
pub(super) fn placed(session: &Session, values: JointValues) -> Option<Placed> {
    let free = contradicted(session, values);
    let moved = moved(free.as_ref().map_or(session, |free| &free.session), values);
    let shown = match (moved, free) {
        (Some(moved), free) => Shown::of_moved(session, moved, free.as_ref()),
        (None, free) => Shown::of_free(session, free?),
    };
    shown.placed(values)
}

/// What a fit shows of targets that are free.
struct Shown<'a> {
    session: &'a Session,
    /// With all targets free, those that moved as two.
    free: Session,
    model: Model,
    before_mm: f64,
    residual_mm: f64,
    /// What moved.
    problems: Vec<DataProblem>,
    /// Of which target each new one is, in order.
    origins: Vec<usize>,
    /// Whether targets are free in it at all.
    is_of_targets: bool,
}

impl<'a> Shown<'a> {
    fn of_moved(session: &'a Session, moved: Moved, free: Option<&Contradicted>) -> Self {
        let origin = |problem: &DataProblem| match problem.mend {
            Some(SessionCorrection::Split { group, index, .. }) => {
                (group == Group::Target).then_some(index)
            }
            _ => None,
        };
        let origins: Vec<usize> = moved.problems.iter().filter_map(origin).collect();
        Self {
            session,
            free: moved.session,
            model: moved.model,
            before_mm: free.map_or(moved.before_mm, |free| free.before_mm),
            residual_mm: moved.residual_mm,
            problems: moved.problems,
            is_of_targets: free.is_some() || !origins.is_empty(),
            origins,
        }
    }

    fn of_free(session: &'a Session, free: Contradicted) -> Self {
        Self {
            session,
            free: free.session,
            model: free.model,
            before_mm: free.before_mm,
            residual_mm: free.residual_mm,
            problems: Vec::new(),
            origins: Vec::new(),
            is_of_targets: true,
        }
    }

    /// At whose place a target should be.
    fn origin(&self, mut target: usize) -> Option<usize> {
        let own = self.session.targets.len();
        while target >= own {
            target = *self.origins.get(target - own)?;
        }
        self.session.has_placed(target).then_some(target)
    }

    fn placed(self, values: JointValues) -> Option<Placed> {
        let sigma = self.session.instrument.targets_sigma_mm;
        let Some(sigma) = sigma.filter(|_| self.is_of_targets) else {
            return Some(Placed {
                problems: self.problems,
                is_renamed: false,
            });
        };
        let problem = Problem::observing(&self.free, values);
        let seen = seen_targets(&problem, &self.model, sigma, |target| self.origin(target));
        let (numbers, seen): (Vec<usize>, Vec<SeenTarget>) = seen.into_iter().unzip();
        let place = |target: usize| {
            let own = &self.session.targets[target];
            let placed = self.session.has_placed(target);
            placed.then_some(own.position_mm.coords)
        };
        let stated: Vec<_> = (0..self.session.targets.len()).map(place).collect();
        let about = last_axis(&self.session.robot);
        let Agreement::Settled { places_mm, at } = agreement(&seen, &stated, about) else {
            return Some(self.open(&seen, &stated));
        };
        let wrong = seen.iter().zip(&at).zip(&numbers);
        let wrong = wrong.filter_map(|((one, at), number)| {
            let at = at.filter(|at| *at != one.of)?;
            Some((*number, one.of, at))
        });
        let wrong: Vec<(usize, usize, usize)> = wrong.collect();
        if let Some(renamed) = self.renamed(&wrong, values) {
            return Some(renamed);
        }
        let mut problems = self.problems.clone();
        for (k, (one, at)) in seen.iter().zip(&at).enumerate() {
            let number = numbers[k];
            let own = self.session.targets.get(number);
            if let Some(own) = own.filter(|_| *at != Some(one.of)) {
                let by = places_mm[k] - own.position_mm.coords;
                problems.push(self.elsewhere(number, by));
            }
        }
        if problems.is_empty() {
            return None;
        }
        let session = self.with(&problems);
        // What was taken for their places explains the samples as free ones do, or they are not.
        let residual_mm = residual_mm(&session, values).unwrap_or(f64::INFINITY);
        if residual_mm > AS_WELL * self.residual_mm {
            return Some(self.open(&seen, &stated));
        }
        Some(Placed {
            problems,
            is_renamed: false,
        })
    }

    /// The session with the corrections of these problems.
    fn with(&self, problems: &[DataProblem]) -> Session {
        let mut session = self.session.clone();
        for correction in problems.iter().filter_map(|problem| problem.mend.as_ref()) {
            correction.apply(&mut session);
        }
        session
    }

    fn elsewhere(&self, target: usize, by_mm: Vector3<f64>) -> DataProblem {
        let numbers = in_numbers(self.before_mm, self.residual_mm);
        let correction = SessionCorrection::Free {
            group: Group::Target,
            index: target,
        };
        targets::problem(self.session, target, by_mm, numbers, correction)
    }

    /// All targets known no better than they agree.
    fn open(self, seen: &[SeenTarget], stated: &[Option<Vector3<f64>>]) -> Placed {
        let across = across_mm(seen, stated);
        let names: BTreeSet<usize> = seen.iter().map(|one| one.of).collect();
        let called =
            |target: &usize| Group::Target.called(Group::Target.name_of(self.session, *target));
        let mut problems = self.problems.clone();
        problems.push(DataProblem::of_all(text!(
                "{things}: nothing tells which is where the session states; their places in the tool disagree by {size}",
                things = Text::listed(names.iter().map(called), ", "),
                size = length(across, 3)
            ), in_numbers(self.before_mm, self.residual_mm), text!(
                "where the tool is, is known no better than that; measure where the targets sit, and correct the session"
            ), SessionCorrection::TargetsWithin(sigma_between(
                across,
                names.len(),
            ))));
        Placed {
            problems,
            is_renamed: false,
        }
    }

    /// The session with these targets, of others and at the places of others, under their right names.
    fn renamed(&self, wrong: &[(usize, usize, usize)], values: JointValues) -> Option<Placed> {
        let column = self.free.samples.target.as_deref()?;
        let mut rows: Vec<(usize, usize, u32)> = Vec::new();
        for (row, seen) in column.iter().enumerate() {
            if let Some((_, of, at)) = wrong.iter().find(|w| w.0 == *seen as usize) {
                rows.push((row, *of, u32::try_from(*at).ok()?));
            }
        }
        rows.first()?;
        let mut pairs: Vec<(usize, usize)> = rows.iter().map(|r| (r.1, r.2 as usize)).collect();
        pairs.sort_unstable();
        pairs.dedup();
        let mut session = self.session.clone();
        SessionCorrection::RenameTargets(rows.iter().map(|r| (r.0, r.2)).collect())
            .apply(&mut session);
        let residual_mm = residual_mm(&session, values)?;
        let samples = session.samples.len();
        let axes = session.samples.axes();
        let evidence = evidence(samples, axes, self.before_mm, residual_mm, 1 + pairs.len());
        if !is_believed(evidence, self.before_mm, residual_mm, RESIDUAL_SHARE) {
            return None;
        }
        let mut problems = Vec::new();
        for &(of, at) in &pairs {
            let exchanged = pairs.contains(&(at, of));
            if exchanged && at < of {
                continue;
            }
            let own = |r: &&(usize, usize, u32)| {
                let here = (r.1, r.2 as usize);
                here == (of, at) || exchanged && here == (at, of)
            };
            let rows: Vec<(usize, u32)> = rows.iter().filter(own).map(|r| (r.0, r.2)).collect();
            let mut called = vec![of];
            called.extend(exchanged.then_some(at));
            problems.push(DataProblem {
                what: self.misnamed(of, at, exchanged, &called, &rows),
                evidence: text!(
                    "the base model leaves {before} as it stands and {after} with the right names; more than 1000 times likelier",
                    before = length(self.before_mm, 3),
                    after = length(residual_mm, 3)
                ),
                proposal: text!("the names are corrected in these samples; correct them in the file"),
                samples: rows.iter().map(|row| row.0).collect(),
                mend: Some(SessionCorrection::RenameTargets(rows)),
            });
        }
        Some(Placed {
            problems,
            is_renamed: true,
        })
    }

    /// Which names are wrong, and where.
    fn misnamed(
        &self,
        of: usize,
        at: usize,
        exchanged: bool,
        called: &[usize],
        rows: &[(usize, u32)],
    ) -> Text {
        let name =
            |target: usize| Group::Target.called(Group::Target.name_of(self.session, target));
        let what = if exchanged {
            text!(
                "{thing} and {other} are exchanged",
                thing = name(of),
                other = name(at)
            )
        } else {
            text!(
                "samples of {thing} are those of {other}",
                thing = name(of),
                other = name(at)
            )
        };
        let (Some(first), Some(last)) = (rows.first(), rows.last()) else {
            return what;
        };
        let column = self.session.samples.target.iter().flatten().enumerate();
        let own = column.filter(|(_, target)| called.contains(&(**target as usize)));
        let own: Vec<usize> = own.map(|(row, _)| row).collect();
        let within = own.iter().filter(|row| (first.0..=last.0).contains(row));
        if within.count() > rows.len() {
            text!(
                one "{what}, in {count} sample",
                "{what}, in {count} samples",
                what,
                count = rows.len()
            )
        } else if own.len() == rows.len() {
            what
        } else if own.last() == Some(&last.0) {
            text!(
                "{what}, from sample {sample} on",
                what,
                sample = first.0 + 1
            )
        } else {
            text!(
                "{what}, from sample {sample} to {last}",
                what,
                sample = first.0 + 1,
                last = last.0 + 1
            )
        }
    }
}
