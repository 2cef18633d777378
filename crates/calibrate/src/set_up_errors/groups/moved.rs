//! Groups of samples that are elsewhere as a whole: a socket, a target, a setup that was moved between two visits, a
//! station, a plane, an anchor that is not where the session states.
//!
//! The residuals of every group in the base model are regressed on the coordinates of its place, before a row and from
//! it on; where that explains much, the group is split in two, or its place is taken as unknown, and everything is
//! fitted again. Only the residuals of that fit decide.

use nalgebra::{SMatrix, SVector};

use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::effects::place::MOST;
use crate::fit::base_model;
use crate::model::Model;
use crate::observations::compared::{ComparedObservation, compared_with};
use crate::sessions::{Group, Session, SessionCorrection};
use crate::text::Text;

use super::evidence::MOST_PLACES;
use super::evidence::{RESIDUAL_SHARE, evidence, in_numbers, is_believed};
use crate::set_up_errors::fits::fitted;
use crate::set_up_errors::thresholds::{EVIDENCE, MOST_SAMPLES};

/// At most so many groups are taken to have moved; if most of them had, none would be a reference.
const MOST_MOVED: usize = 4;
/// So many suspicions are tried before the next is believed.
const MOST_TRIED: usize = 3;
/// Fewest samples on either side of a move …
const FEWEST: usize = 3;
/// … and so many measured numbers for each of its coordinates: three distances determine a place however wrong they
/// are.
const NUMBERS_FOR_EACH: usize = 2;
/// A socket alone, of which several move, need not explain the whole error: the residual has to fall to less than this
/// share. Another group absorbs a part of many an effect, and has to explain as much as any place.
const SOCKET_RESIDUAL_SHARE: f64 = 0.9;
/// What the regression explains as a logarithm before a fit is made. The base has taken up a part of a move, so
/// that a fit shows more.
const WORTH_A_FIT: f64 = EVIDENCE / 3.0;

/// A suspicion: how much it explains, as a logarithm, and what takes it back.
struct Suspicion {
    gain: f64,
    group: Group,
    index: usize,
    /// The first row that is elsewhere; `None`: all are, and the session states otherwise.
    from: Option<usize>,
}

impl Suspicion {
    fn correction(&self) -> SessionCorrection {
        let (group, index) = (self.group, self.index);
        match self.from {
            Some(from) => SessionCorrection::Split { group, index, from },
            None => SessionCorrection::Free { group, index },
        }
    }

    /// A session in which it is taken back, and free to be fitted.
    fn trial(&self, session: &Session) -> Session {
        let mut trial = session.clone();
        self.correction().apply(&mut trial);
        if self.group == Group::Target {
            // Which of them is where it is stated is asked later.
            SessionCorrection::FreeTargets.apply(&mut trial);
        }
        trial
    }
}

/// What moved.
pub(super) struct Moved {
    /// The session with the groups that moved taken as two each, and with those free that are elsewhere; all targets
    /// are free where one of them moved.
    pub(super) session: Session,
    /// The fitted model, and its residual and the one before, mm.
    pub(super) model: Model,
    pub(super) before_mm: f64,
    pub(super) residual_mm: f64,
    /// What is reported, in the order in which the corrections are made.
    pub(super) problems: Vec<DataProblem>,
}

/// What moved in a session.
pub(super) fn moved(session: &Session, values: JointValues) -> Option<Moved> {
    let several = |group: &Group| (2..=MOST_PLACES).contains(&group.count(session));
    let arm = base_model::is_arm(session);
    let groups: Vec<Group> = Group::ALL
        .into_iter()
        .filter(|group| arm || *group != Group::Target)
        .filter(several)
        .collect();
    if groups.is_empty() || session.samples.len() > MOST_SAMPLES * 4 {
        return None;
    }
    let (mut model, mut before) = fitted(session, values)?;
    let before_mm = before;
    let mut problems = Vec::new();
    let mut now: Option<Session> = None;
    for _ in 0..MOST_MOVED {
        let here = now.as_ref().unwrap_or(session);
        let suspicions = suspicions(here, values, &model, &groups).into_iter();
        let tried = suspicions.take(MOST_TRIED);
        let tried =
            tried.filter_map(|suspicion| FittedSuspicion::of(suspicion, here, values, before));
        let Some(best) = tried.min_by(|a, b| a.residual_mm.total_cmp(&b.residual_mm)) else {
            break;
        };
        let numbers = in_numbers(before, best.residual_mm);
        problems.push(problem(here, &best.suspicion, numbers));
        (now, model, before) = (Some(best.session), best.model, best.residual_mm);
    }
    Some(Moved {
        session: now?,
        model,
        before_mm,
        residual_mm: before,
        problems,
    })
}

/// A suspicion that was fitted and is believed.
struct FittedSuspicion {
    suspicion: Suspicion,
    session: Session,
    model: Model,
    residual_mm: f64,
}

impl FittedSuspicion {
    fn of(
        suspicion: Suspicion,
        session: &Session,
        values: JointValues,
        before_mm: f64,
    ) -> Option<Self> {
        let group = suspicion.group;
        let trial = suspicion.trial(session);
        let (model, residual_mm) = fitted(&trial, values)?;
        let free = match group {
            Group::Target => session.targets.len(),
            _ => 1,
        };
        let numbers = free * numbers_of(group) + 1;
        let samples = session.samples.len();
        let evidence = evidence(samples, rows_of(group), before_mm, residual_mm, numbers);
        let share = match group {
            Group::Socket => SOCKET_RESIDUAL_SHARE,
            _ => RESIDUAL_SHARE,
        };
        is_believed(evidence, before_mm, residual_mm, share).then_some(Self {
            suspicion,
            session: trial,
            model,
            residual_mm,
        })
    }
}

/// The number of coordinates of a group's place.
fn numbers_of(group: Group) -> usize {
    match group {
        Group::Target | Group::Socket | Group::Anchor | Group::Plane => 3,
        Group::Setup | Group::Station => 6,
    }
}

/// How many rows one measurement of a group has.
fn rows_of(group: Group) -> usize {
    match group {
        Group::Target | Group::Socket | Group::Setup => 3,
        Group::Station => 2,
        Group::Plane | Group::Anchor => 1,
    }
}

/// What may be elsewhere, what explains most first; of every group the best.
fn suspicions(
    session: &Session,
    values: JointValues,
    model: &Model,
    groups: &[Group],
) -> Vec<Suspicion> {
    let all = compared_with(session, values, model);
    let square: f64 = all.iter().map(square_of).sum();
    let rows: usize = all.iter().map(|one| one.residual.rows).sum();
    let mut found = Vec::new();
    for &group in groups {
        for index in 0..group.count(session) {
            let own: Vec<&ComparedObservation> = all
                .iter()
                .filter(|one| group.of(session, one.sample) == Some(index))
                .collect();
            let stated = group.is_stated(session, index) && group != Group::Target;
            let Some((explained, from)) = best_of(session, group, &own, stated) else {
                continue;
            };
            let residual = (square - explained)
                .max(1e-9 * square)
                .max(f64::MIN_POSITIVE);
            let gain = 0.5 * rows as f64 * (square / residual).ln();
            if gain > WORTH_A_FIT {
                found.push(Suspicion {
                    gain,
                    group,
                    index,
                    from,
                });
            }
        }
    }
    found.sort_by(|a, b| b.gain.total_cmp(&a.gain));
    found
}

fn square_of(one: &ComparedObservation) -> f64 {
    let rows = one.residual.rows;
    one.residual.left[..rows].iter().map(|e| e * e).sum()
}

/// Where two places of a group, or one where the session states another, explain most.
fn best_of(
    session: &Session,
    group: Group,
    own: &[&ComparedObservation],
    stated: bool,
) -> Option<(f64, Option<usize>)> {
    let n = own.len();
    let fewest = (NUMBERS_FOR_EACH * numbers_of(group))
        .div_ceil(rows_of(group))
        .max(FEWEST);
    if n < 2 * fewest {
        return None;
    }
    let mut sums = vec![Sums::default()];
    for one in own {
        let mut next = sums[sums.len() - 1].clone();
        next.add(one, group);
        sums.push(next);
    }
    let whole = sums[n].explained();
    let mut best = stated.then_some((whole, None));
    // Two places have a place and a row more to pay for, as a logarithm.
    let price = 0.5 * (numbers_of(group) + 1) as f64 * (n as f64).ln() * mean_square(own);
    for k in fewest..=n - fewest {
        let from = own[k].sample;
        if own[k - 1].sample == from || is_of_all(session, group, from) {
            continue;
        }
        let two = sums[k].explained() + sums[n].less(&sums[k]).explained();
        let worth = if stated { two - price } else { two };
        if best.is_none_or(|best| worth > best.0) {
            best = Some((worth, Some(from)));
        }
    }
    best
}

fn mean_square(own: &[&ComparedObservation]) -> f64 {
    let rows: usize = own.iter().map(|one| one.residual.rows).sum();
    own.iter().map(|one| square_of(one)).sum::<f64>() / rows.max(1) as f64
}

/// Whether no other setup is measured from a row on: then all that follows moved, which is a shift of the frame
/// and has its name.
fn is_of_all(session: &Session, group: Group, from: usize) -> bool {
    if group != Group::Setup {
        return false;
    }
    let own = group.of(session, from);
    (from..session.samples.len()).all(|row| group.of(session, row) == own)
}

/// Products of a group's columns with themselves and with the residuals.
#[derive(Debug, Clone, Default)]
struct Sums {
    gram: SMatrix<f64, MOST, MOST>,
    pull: SVector<f64, MOST>,
}

impl Sums {
    fn add(&mut self, one: &ComparedObservation, group: Group) {
        let by = one.by(group);
        for (row, by) in by.iter().enumerate().take(one.residual.rows) {
            let by = SVector::<f64, MOST>::from_column_slice(by);
            self.gram += by * by.transpose();
            self.pull += by * one.residual.left[row];
        }
    }

    fn less(&self, other: &Self) -> Self {
        Self {
            gram: self.gram - other.gram,
            pull: self.pull - other.pull,
        }
    }

    /// By how much the sum of squares falls where the numbers are free.
    fn explained(&self) -> f64 {
        // Numbers of different units: each scaled by its effect on the rows.
        let scale = SVector::<f64, MOST>::from_fn(|k, _| {
            let own = self.gram[(k, k)].sqrt();
            if own > 0.0 { 1.0 / own } else { 0.0 }
        });
        let mut gram = self.gram;
        let mut pull = self.pull;
        for k in 0..MOST {
            pull[k] *= scale[k];
            for j in 0..MOST {
                gram[(k, j)] *= scale[k] * scale[j];
            }
            gram[(k, k)] += 1e-6;
        }
        let solved = nalgebra::Cholesky::new(gram).map(|factor| factor.solve(&pull));
        solved.map_or(0.0, |x| x.dot(&pull))
    }
}

fn problem(session: &Session, suspicion: &Suspicion, evidence: Text) -> DataProblem {
    let (group, index) = (suspicion.group, suspicion.index);
    let thing = group.called(group.name_of(session, index));
    let from = suspicion.from.unwrap_or(0);
    let rows = 0..session.samples.len();
    let (what, proposal) = match suspicion.from {
        Some(from) => (
            text!(
                "{thing} is elsewhere from sample {sample} on",
                thing,
                sample = from + 1
            ),
            text!(
                "its samples from there on are taken as those of a new one, whose place is fitted; fasten it, or give it another name"
            ),
        ),
        None => (
            text!("{thing} is not where the session states", thing),
            text!("its place is fitted; measure it again, or leave it out of the session"),
        ),
    };
    DataProblem {
        what,
        evidence,
        proposal,
        mend: Some(suspicion.correction()),
        samples: rows
            .filter(|row| *row >= from && group.of(session, *row) == Some(index))
            .collect(),
    }
}
