//! Mistakes in a part of the rows that are visible with the nominal robot.
//!
//! ```text
//! C(change, part) = Σ_i ½(ν + 3) ln(1 + r_i²/(ν σ²)) + 3 n ln σ − 3 Σ_part ln|factor| + price,
//! ```
//!
//! `r_i` the distance of the point of row i from where the nominal robot has it, with the change where row i is in the
//! part, wherever the instrument is. Every change is tried in every part: a setup, a stretch between eighths of the
//! rows, all of them. The ends of the likeliest stretches are then those rows between which the change gains most. A
//! change that is much likelier than the uncorrected session, and leaves these rows as near as the others, is tested
//! with the fitted robot.

use nalgebra::{Isometry3, Vector3};

use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::fit::target_places::own_parts;
use crate::kinematics::JointKind;
use crate::numeric::{likeliest_stretch, median};
use crate::sessions::{Group, Session, SessionCorrection};
use crate::text::{Text, length};

use crate::set_up_errors::changes::{Change, of_rows};
use crate::set_up_errors::fits;
use crate::set_up_errors::groups::{self, evidence};
use crate::set_up_errors::nearest::{Nominal, Pair, cost, cost_of, distance, motion};
use crate::set_up_errors::rows::{Part, RowsInOrder};
use crate::set_up_errors::thresholds::{EQUAL, EVIDENCE, GROSS_SHARE, PLAUSIBLE_SHARE, size_mm};

/// Rows that the search looks at …
const MOST_ROWS: usize = 160;
/// … and by which the ends of a stretch are found.
const MOST_EXACT: usize = 4000;
/// With fewer rows that count nothing is reported.
const FEWEST_ROWS: usize = 16;
/// Fewest rows that differ.
const FEWEST_IN_A_PART: usize = 4;
/// Ends of stretches that are tried.
const GRID: usize = 8;
/// The residuals of corrected rows are at most so many times those of the others, and were at least as many times
/// larger before.
const ALIKE: f64 = 4.0;
/// Changes within so much of the likeliest, as a logarithm, are compared by a fit.
const NEAR: f64 = 12.0;
/// So many are fitted.
const MOST_FITTED: usize = 4;

/// The likeliest of them.
pub(in crate::set_up_errors) fn gross(session: &Session, values: JointValues) -> Vec<DataProblem> {
    if session.samples.z_mm.is_none() {
        return Vec::new();
    }
    let changes = of_rows(session);
    let search = Search::over(session, values, &changes, MOST_ROWS);
    if !search.is_gross() {
        return Vec::new();
    }
    let exact = Search::over(session, values, &changes, MOST_EXACT);
    search.best(&exact).unwrap_or_default()
}

/// Points as a change has them, and where the nominal robot is then.
struct Seen {
    pairs: Vec<Pair>,
    /// By how much a volume of measured points grows, as a logarithm.
    ln_volume: f64,
}

impl Seen {
    fn of(part: &Session, values: JointValues, corrections: &[SessionCorrection]) -> Self {
        let mut changed = part.clone();
        let mut ln_volume = 0.0;
        for correction in corrections
            .iter()
            .filter(|correction| !is_frame(correction))
        {
            correction.apply(&mut changed);
            ln_volume += match correction {
                SessionCorrection::ScaleLengths(factor) => 3.0 * factor.ln(),
                SessionCorrection::ScaleCoordinate { factor, .. } => factor.ln(),
                _ => 0.0,
            };
        }
        let nominal = Nominal::of(&changed, values);
        Self {
            pairs: nominal.pairs(&nominal.inputs),
            ln_volume,
        }
    }
}

fn is_frame(correction: &SessionCorrection) -> bool {
    *correction == SessionCorrection::FreeFrame
}

/// A change in a part of the rows, and its cost.
#[derive(Clone, Copy)]
struct Trial {
    change: usize,
    part: Part,
    cost: f64,
}

/// A possible mistake, with its message.
struct Candidate {
    what: Text,
    proposal: Text,
    rows: Vec<(usize, usize)>,
    correction: SessionCorrection,
    /// The target that they are about, if it may be elsewhere too.
    target: Option<usize>,
    /// Place in the list of changes, simplest first.
    order: usize,
}

/// The rows that are searched, uncorrected.
struct Search<'a> {
    session: &'a Session,
    values: JointValues,
    changes: &'a [Change],
    rows: RowsInOrder,
    few: Session,
    /// The setup of each row, and how many there are.
    setup: Vec<usize>,
    setups: usize,
    uncorrected: Seen,
}

impl<'a> Search<'a> {
    fn over(session: &'a Session, values: JointValues, changes: &'a [Change], most: usize) -> Self {
        let rows = RowsInOrder::of(session, most);
        let few = rows.select(session);
        let setup = |k: usize| Group::Setup.of(&few, k).unwrap_or(0);
        Self {
            setup: (0..rows.len()).map(setup).collect(),
            setups: Group::Setup.count(&few).max(1),
            uncorrected: Seen::of(&few, values, &[]),
            session,
            values,
            changes,
            rows,
            few,
        }
    }

    fn uncorrected_mm(&self) -> Vec<f64> {
        let none = vec![false; self.rows.len()];
        self.lengths(&self.uncorrected, &none, false).0
    }

    fn gross_mm(&self) -> f64 {
        GROSS_SHARE * size_mm(self.session)
    }

    fn plausible_mm(&self) -> f64 {
        PLAUSIBLE_SHARE * self.few.samples.spread_mm()
    }

    /// Whether points are far from the nominal robot.
    fn is_gross(&self) -> bool {
        let lengths = self.uncorrected_mm();
        let wrong = lengths.iter().filter(|length| **length > self.gross_mm());
        lengths.len() >= FEWEST_ROWS && wrong.count() >= FEWEST_IN_A_PART
    }

    /// How far each point is from the robot where a part of them is changed to `seen`; `own`: it is measured from
    /// another place. With the motions, those of the part behind the others.
    fn lengths(&self, seen: &Seen, mask: &[bool], own: bool) -> (Vec<f64>, Motions) {
        let frame = |k: usize| self.setup[k] + if own && mask[k] { self.setups } else { 0 };
        let pair = |k: usize| {
            if mask[k] {
                seen.pairs[k]
            } else {
                self.uncorrected.pairs[k]
            }
        };
        let of_frame = |of: usize| {
            let here = (0..mask.len()).filter(|k| frame(*k) == of).map(pair);
            motion(&here.collect::<Vec<_>>())
        };
        let motions: Motions = (0..2 * self.setups).map(of_frame).collect();
        let length = |k: usize| motions[frame(k)].map_or(0.0, |motion| distance(&motion, &pair(k)));
        ((0..mask.len()).map(length).collect(), motions)
    }

    fn is_frame(&self, change: usize) -> bool {
        self.changes[change].corrections.iter().any(is_frame)
    }

    fn seen(&self, change: usize) -> Seen {
        Seen::of(&self.few, self.values, &self.changes[change].corrections)
    }

    /// What a change costs in a part, with the logarithm of how many there are to choose from, and of the six numbers of
    /// a frame.
    fn cost(&self, change: usize, seen: &Seen, part: Part) -> f64 {
        let n = self.rows.len() as f64;
        let mask = self.rows.mask(self.session, part);
        let is_frame = self.is_frame(change);
        let (lengths, _) = self.lengths(seen, &mask, is_frame);
        let inside = mask.iter().filter(|own| **own).count() as f64;
        let place = match part {
            Part::All => 0.0,
            Part::Stretch(..) => 2.0 * n.ln(),
            Part::Group(group, _) => (group.count(self.session) as f64).ln(),
        };
        let frame = if is_frame { 3.0 * (3.0 * n).ln() } else { 0.0 };
        let price = (self.changes.len() as f64).ln() + place + frame;
        cost(&lengths).1 - inside * seen.ln_volume + price
    }

    /// Setups and stretches in which a change may hold.
    fn parts(&self) -> Vec<Part> {
        let n = self.rows.len();
        let setups = (0..self.setups).filter(|_| self.setups > 1);
        let mut all = vec![Part::All];
        all.extend(setups.map(|setup| Part::Group(Group::Setup, setup)));
        for first in 0..GRID {
            let ends = first + 1..=GRID.min(first + GRID - 1);
            all.extend(ends.map(|end| Part::Stretch(first * n / GRID, end * n / GRID)));
        }
        all
    }

    /// The likeliest part for every change, likeliest first.
    fn tried(&self) -> Vec<Trial> {
        let parts = self.parts();
        let likeliest = |change: usize| {
            let seen = self.seen(change);
            // The frame of all rows, or of all of a setup, is fitted anyway.
            let is_open = |part: &Part| !self.is_frame(change) || matches!(part, Part::Stretch(..));
            let open = parts.iter().copied().filter(is_open);
            let costs = open.map(|part| (self.cost(change, &seen, part), part));
            let (cost, part) = costs.min_by(|a, b| a.0.total_cmp(&b.0))?;
            Some(Trial { change, part, cost })
        };
        let mut best: Vec<Trial> = (0..self.changes.len()).filter_map(likeliest).collect();
        best.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        best
    }

    /// The same change between those rows where it gains most, compared with the uncorrected rows; `None` where its
    /// residuals are larger than those of the others.
    fn settled(&self, mut trial: Trial) -> Option<Trial> {
        let seen = self.seen(trial.change);
        let own = self.is_frame(trial.change);
        // Two stretches may each ask for the other.
        let mut tried_stretches = Vec::new();
        let (mask, after, before) = loop {
            let mask = self.rows.mask(self.session, trial.part);
            let (lengths, motions) = self.lengths(&seen, &mask, own);
            let far = |motion: Option<Isometry3<f64>>, pair: &Pair| Some(distance(&motion?, pair));
            let of_row = |k: usize| {
                let there = self.setup[k] + if own { self.setups } else { 0 };
                let uncorrected = far(motions[self.setup[k]], &self.uncorrected.pairs[k])?;
                Some((uncorrected, far(motions[there], &seen.pairs[k])?))
            };
            let both: Vec<(f64, f64)> = (0..mask.len()).map(of_row).collect::<Option<_>>()?;
            let Part::Stretch(first, end) = trial.part else {
                break (mask, lengths, both);
            };
            if tried_stretches.contains(&(first, end)) {
                break (mask, lengths, both);
            }
            tried_stretches.push((first, end));
            let (sigma, _) = cost(&lengths);
            let gain = both.iter().map(|(uncorrected, then)| {
                cost_of(*uncorrected, sigma) - cost_of(*then, sigma) + seen.ln_volume
            });
            let (first, end) = likeliest_stretch(gain);
            if end - first < FEWEST_IN_A_PART || end - first == mask.len() {
                return None;
            }
            trial.part = Part::Stretch(first, end);
        };
        // Rows that the change does not move have no information on it, in the part or elsewhere.
        let (of_part, of_change) = (&self.uncorrected.pairs, &seen.pairs);
        let moved: Vec<bool> = (0..mask.len())
            .map(|k| mask[k] && (own || of_part[k] != of_change[k]))
            .collect();
        let corrected = typical(&moved, true, |k| after[k])?;
        let others = typical(&moved, false, |k| after[k]).unwrap_or(corrected);
        let earlier = typical(&moved, true, |k| before[k].0)?;
        let alike = corrected <= ALIKE * others && earlier >= ALIKE * corrected;
        trial.cost = self.cost(trial.change, &seen, trial.part);
        (alike && corrected.max(others) < self.plausible_mm()).then_some(trial)
    }

    /// The part of other rows that are looked at here.
    fn translated(&self, from: &RowsInOrder, part: Part) -> Part {
        let at = |k: usize| match from.counted.get(k) {
            Some(place) => self.rows.counted.partition_point(|own| own < place),
            None => self.rows.len(),
        };
        match part {
            Part::Stretch(first, end) => Part::Stretch(at(first), at(end)),
            other => other,
        }
    }

    fn candidate(&self, trial: Trial) -> Option<Candidate> {
        let change = &self.changes[trial.change];
        let rows = self.rows.ranges(self.session, trial.part);
        Some(Candidate {
            what: self.rows.described(self.session, trial.part, &change.what),
            proposal: text!(
                "{proposal}; these samples are corrected, and commands that go out are not",
                proposal = &change.proposal
            ),
            correction: in_rows(&rows, change.corrections.first()?),
            rows,
            target: None,
            order: trial.change,
        })
    }

    /// Each target as one that does not turn with the last joint.
    fn before_the_last_joint(&self) -> Vec<Candidate> {
        let joint = self.session.robot.joints.len() - 1;
        let turns = self.session.robot.joints[joint].kind == JointKind::Revolute;
        let targets = Group::Target.count(self.session);
        let several = joint > 0 && turns && targets > 1;
        // The other targets agree with the robot, uncorrected, and its own points do not.
        let is_apart = |target: &usize| {
            let mask = self
                .rows
                .mask(self.session, Part::Group(Group::Target, *target));
            let inside = mask.iter().filter(|own| **own).count();
            let (lengths, motions) = self.lengths(&self.uncorrected, &mask, true);
            let uncorrected = |k: usize| {
                let motion = motions[self.setup[k]];
                motion.map_or(f64::INFINITY, |m| distance(&m, &self.uncorrected.pairs[k]))
            };
            let [others, own] = [
                typical(&mask, false, |k| lengths[k]),
                typical(&mask, true, uncorrected),
            ]
            .map(|mm| mm.unwrap_or(f64::INFINITY));
            inside.min(mask.len() - inside) >= 2 * FEWEST_IN_A_PART
                && others < self.plausible_mm()
                && own >= ALIKE * others
        };
        let of_target = |target: usize| {
            let part = Part::Group(Group::Target, target);
            let rows = self.rows.ranges(self.session, part);
            let factor = 0.0;
            Candidate {
                what: text!(
                    "{thing} does not turn with joint {joint}: it sits before it",
                    thing = Group::Target.called(Group::Target.name_of(self.session, target)),
                    joint = joint + 1
                ),
                proposal: text!("put the target on the tool, or leave it out of the session"),
                correction: in_rows(&rows, &SessionCorrection::ScaleJoint { joint, factor }),
                rows,
                target: Some(target),
                order: 0,
            }
        };
        let apart = (0..targets).filter(|_| several).filter(is_apart);
        apart.map(of_target).collect()
    }

    /// The likeliest, if it is likely enough.
    fn best(&self, exact: &Search) -> Option<Vec<DataProblem>> {
        let before = cost(&self.uncorrected_mm()).1;
        let likely = self.tried().into_iter();
        let likely = likely.take_while(|trial| before - trial.cost > EVIDENCE);
        // Settled in all the rows, where costs are others.
        let before = cost(&exact.uncorrected_mm()).1;
        let settled = likely.take(2 * MOST_FITTED).filter_map(|trial| {
            let part = exact.translated(&self.rows, trial.part);
            exact.settled(Trial { part, ..trial })
        });
        let mut near: Vec<Trial> = settled.filter(|t| before - t.cost > EVIDENCE).collect();
        near.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        let least = near.first().map_or(0.0, |first| first.cost);
        // What is wrong in all rows is found by fits, which know more equivalent changes.
        if near.first().is_some_and(|first| first.part == Part::All) {
            return None;
        }
        near.retain(|trial| trial.cost < least + NEAR && trial.part != Part::All);
        near.truncate(MOST_FITTED);
        let mut candidates: Vec<Candidate> = near
            .into_iter()
            .filter_map(|trial| exact.candidate(trial))
            .collect();
        candidates.extend(exact.before_the_last_joint());
        self.distinguished(candidates)
    }

    /// Of candidates the one with the smallest residual of the fitted robot, with the equivalent ones.
    fn distinguished(&self, candidates: Vec<Candidate>) -> Option<Vec<DataProblem>> {
        let (rows, axes) = (self.rows.len(), self.few.samples.axes());
        let few = fits::some_samples(self.session);
        let fitted = |corrections: &[&SessionCorrection]| {
            let mut changed = self.session.clone();
            for correction in corrections {
                correction.apply(&mut changed);
            }
            fits::fitted(&fits::some_samples(&changed), self.values)
        };
        let (_, before) = fits::fitted(&few, self.values)?;
        let with = |candidate: Candidate| {
            let Some(index) = candidate.target else {
                return Some((fitted(&[&candidate.correction])?.1, candidate, None));
            };
            // Its points fit a place before that joint far better than any in the tool.
            let group = Group::Target;
            let free = SessionCorrection::Free { group, index };
            let (_, elsewhere) = fitted(&[&free])?;
            let (model, residual_mm) = fitted(&[&candidate.correction, &free])?;
            let mut own = own_parts(&model).into_iter();
            let by = own
                .find(|own| own.0 == index)
                .map_or(Vector3::zeros(), |own| own.1);
            let known = self.session.instrument.targets_sigma_mm.is_some();
            let off = (known && by.norm() > self.gross_mm()).then_some((index, by, free));
            let likelier = evidence(rows, axes, elsewhere, residual_mm, 0) > EVIDENCE;
            likelier.then_some((residual_mm, candidate, off))
        };
        let mut fitted: Vec<_> = candidates.into_iter().filter_map(with).collect();
        let least = fitted.iter().map(|one| one.0).min_by(f64::total_cmp)?;
        if evidence(rows, axes, before, least, axes) < EVIDENCE {
            return None;
        }
        fitted.retain(|one| one.0 <= EQUAL * least);
        fitted.sort_by_key(|one| one.1.order);
        let mut fitted = fitted.into_iter();
        let (residual_mm, main, off) = fitted.next()?;
        let twins: Vec<Text> = fitted.map(|one| one.1.what).collect();
        let evidence = corrected_in_numbers(before, residual_mm);
        let of_target = off.map(|(index, by, free)| {
            groups::target_elsewhere(self.session, index, by, evidence.clone(), free)
        });
        let rows = main.rows.iter().flat_map(|(first, end)| *first..*end);
        let main = DataProblem {
            samples: rows.collect(),
            ..DataProblem::of_all(
                Change::with_equivalents(main.what, &twins),
                evidence,
                main.proposal,
                main.correction,
            )
        };
        Some([main].into_iter().chain(of_target).collect())
    }
}

/// The median of the rows in a part, or of the others.
fn typical(mask: &[bool], is_inside: bool, of: impl Fn(usize) -> f64) -> Option<f64> {
    median((0..mask.len()).filter(|k| mask[*k] == is_inside).map(of))
}

/// The place of the instrument, of each setup and of each in another part.
type Motions = Vec<Option<Isometry3<f64>>>;

fn in_rows(rows: &[(usize, usize)], by: &SessionCorrection) -> SessionCorrection {
    SessionCorrection::InRows {
        rows: rows.to_vec(),
        by: Box::new(by.clone()),
    }
}

pub(super) fn corrected_in_numbers(before_mm: f64, after_mm: f64) -> Text {
    text!(
        "the base model leaves {before} as it stands and {after} with these samples corrected; more than 1000 times likelier",
        before = length(before_mm, 3),
        after = length(after_mm, 3)
    )
}
