//! Mistakes in a part of the rows that are seen beside the robot as it was drawn.
//!
//! ```text
//! C(change, part) = Σ_i ½(ν + 3) ln(1 + r_i²/(ν σ²)) + 3 n ln σ − 3 Σ_part ln|factor| + price,
//! ```
//!
//! `r_i` the distance of the point of row i from where the nominal robot has it, with the change where row i is in the
//! part, wherever the instrument stands. Every change is tried in every part: a setup, a target, a stretch between
//! eighths of the rows, all of them. The ends of the likeliest stretches are then those rows between which the change
//! gains most. It is said where it is likelier by far than the session as it stands, and leaves these rows as near as the others. Of changes that are about as likely the fitted robot says which it is.

use nalgebra::{Isometry3, Matrix3, Vector3};

use crate::answers::diagnosis::DataProblem;
use crate::effects::{Inputs, JointValues};
use crate::kinematics::JointKind;
use crate::model::Model;
use crate::numeric::{likeliest_stretch, median};
use crate::sessions::{Group, Session, SessionCorrection};
use crate::text::{Text, length};

use super::nearest::{cost, cost_of, left, motion, moved};
use super::rows::{Part, RowsInOrder};
use crate::set_up_errors::arm_hypotheses::{Change, of_rows};
use crate::set_up_errors::groups;
use crate::set_up_errors::thresholds::{EQUAL, EVIDENCE, GROSS_SHARE, PLAUSIBLE_SHARE};

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
/// Rows that are corrected leave at most so many times what the others leave, and have left at least as many times
/// more before.
const ALIKE: f64 = 4.0;
/// Changes within so much of the likeliest, as a logarithm, are told apart by a fit.
const NEAR: f64 = 12.0;
/// So many are fitted.
const MOST_FITTED: usize = 4;
/// One mistake may hide another.
const MOST_MISTAKES: usize = 3;

/// The session without them; `None` where there is none.
pub(in crate::set_up_errors) fn corrected(
    session: &Session,
    values: JointValues,
    problems: &mut Vec<DataProblem>,
) -> Option<Session> {
    session.samples.z_mm.as_ref()?;
    let mut now: Option<Session> = None;
    for _ in 0..MOST_MISTAKES {
        let here = now.as_ref().unwrap_or(session);
        let changes = of_rows(here);
        let search = Search::over(here, values, &changes, MOST_ROWS);
        if !search.is_gross() {
            break;
        }
        let exact = Search::over(here, values, &changes, MOST_EXACT);
        let Some(found) = search.best(&exact) else {
            break;
        };
        let mut better = here.clone();
        for mend in found.iter().filter_map(|problem| problem.mend.as_ref()) {
            mend.apply(&mut better);
        }
        problems.extend(found);
        now = Some(better);
    }
    now
}

/// Points as a change has them, and where the nominal robot is then.
struct Seen {
    pairs: Vec<Pair>,
    /// By how much a volume of measured points grows, as a logarithm.
    ln_volume: f64,
}

/// Where the robot is, and what was measured, mm.
type Pair = (Vector3<f64>, Vector3<f64>);

impl Seen {
    fn of(part: &Session, values: JointValues, mends: &[SessionCorrection]) -> Self {
        let mut changed = part.clone();
        let mut ln_volume = 0.0;
        for mend in mends.iter().filter(|mend| !is_frame(mend)) {
            mend.apply(&mut changed);
            ln_volume += match mend {
                SessionCorrection::ScaleLengths(factor) => 3.0 * factor.ln(),
                SessionCorrection::ScaleCoordinate { factor, .. } => factor.ln(),
                _ => 0.0,
            };
        }
        let nominal = Model::nominal(changed.robot.clone());
        let predicted = nominal.predict(&Inputs::new(&changed, values));
        let places = (0..changed.samples.len()).map(|k| Vector3::from(predicted.get(k)));
        let measured = (0..changed.samples.len()).map(|k| changed.samples.coordinates(k).into());
        Self {
            pairs: places.zip(measured).collect(),
            ln_volume,
        }
    }
}

fn is_frame(mend: &SessionCorrection) -> bool {
    *mend == SessionCorrection::FreeFrame
}

/// By how much a target moves, and how far each row is from the robot then, mm.
type Moved = (Vector3<f64>, Vec<(usize, f64)>);

/// A change in a part of the rows, and what it costs.
#[derive(Clone, Copy)]
struct Trial {
    change: usize,
    part: Part,
    cost: f64,
}

/// What may be wrong, as it would be said.
struct Candidate {
    what: Text,
    proposal: Text,
    /// None for all.
    rows: Vec<(usize, usize)>,
    mends: Vec<SessionCorrection>,
    /// Where the target is that they are about, if it is elsewhere too, mm.
    target: Option<(usize, Vector3<f64>)>,
    cost: f64,
    /// Place in the list of changes, simplest first.
    order: usize,
}

/// Rows that are looked at, as they stand.
struct Search<'a> {
    session: &'a Session,
    values: JointValues,
    changes: &'a [Change],
    rows: RowsInOrder,
    few: Session,
    as_it_stands: Seen,
}

impl<'a> Search<'a> {
    fn over(session: &'a Session, values: JointValues, changes: &'a [Change], most: usize) -> Self {
        let rows = RowsInOrder::of(session, most);
        let few = rows.select(session);
        let as_it_stands = Seen::of(&few, values, &[]);
        Self {
            session,
            values,
            changes,
            rows,
            few,
            as_it_stands,
        }
    }

    fn as_it_stands_mm(&self) -> Vec<f64> {
        let none = vec![false; self.rows.len()];
        self.lengths(&self.as_it_stands, &none, false).0
    }

    /// Whether points are far from the nominal robot.
    fn is_gross(&self) -> bool {
        let gross = GROSS_SHARE * self.session.robot.length_along_links_mm();
        let lengths = self.as_it_stands_mm();
        let wrong = lengths.iter().filter(|length| **length > gross).count();
        lengths.len() >= FEWEST_ROWS && wrong >= FEWEST_IN_A_PART
    }

    /// How far each point is from the robot where a part of them is as `seen` has it; `own`: it is seen from another
    /// place. With the motions, those of the part behind the others.
    fn lengths(&self, seen: &Seen, mask: &[bool], own: bool) -> (Vec<f64>, Motions) {
        let setups = Group::Setup.count(&self.few).max(1);
        let setup = |k: usize| Group::Setup.of(&self.few, k).unwrap_or(0);
        let frame = |k: usize| setup(k) + if own && mask[k] { setups } else { 0 };
        let pair = |k: usize| {
            if mask[k] {
                seen.pairs[k]
            } else {
                self.as_it_stands.pairs[k]
            }
        };
        let of_frame = |of: usize| {
            let here = (0..mask.len()).filter(|k| frame(*k) == of).map(pair);
            motion(&here.collect::<Vec<_>>())
        };
        let motions: Motions = (0..2 * setups).map(of_frame).collect();
        let length = |k: usize| motions[frame(k)].map_or(0.0, |motion| left(&motion, &pair(k)));
        ((0..mask.len()).map(length).collect(), motions)
    }

    fn is_frame(&self, change: usize) -> bool {
        self.changes[change].mends.iter().any(is_frame)
    }

    fn seen(&self, change: usize) -> Seen {
        Seen::of(&self.few, self.values, &self.changes[change].mends)
    }

    /// What a change costs in a part.
    fn cost(&self, change: usize, seen: &Seen, part: Part) -> f64 {
        let mask = self.rows.mask(self.session, part);
        let (lengths, _) = self.lengths(seen, &mask, self.is_frame(change));
        let inside = mask.iter().filter(|own| **own).count() as f64;
        let numbers = if self.is_frame(change) { 6 } else { 0 };
        cost(&lengths).1 - inside * seen.ln_volume + self.price(part, numbers)
    }

    /// The logarithm of how many there are to choose from, and of so many numbers that are fitted besides.
    fn price(&self, part: Part, numbers: usize) -> f64 {
        let n = self.rows.len() as f64;
        let place = match part {
            Part::All => 0.0,
            Part::Stretch(..) => 2.0 * n.ln(),
            Part::Group(group, _) => (group.count(self.session) as f64).ln(),
        };
        (self.changes.len() as f64).ln() + place + 0.5 * numbers as f64 * (3.0 * n).ln()
    }

    /// Setups and stretches in which a change may hold.
    fn parts(&self) -> Vec<Part> {
        let n = self.rows.len();
        let setups = Group::Setup.count(self.session);
        let setups = (0..setups).filter(|_| setups > 1);
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
        let mut best = Vec::new();
        for change in 0..self.changes.len() {
            let seen = self.seen(change);
            let mut own: Option<Trial> = None;
            // The frame of all rows, or of all of a setup, is fitted anyway.
            let is_open =
                |part: &&Part| !self.is_frame(change) || matches!(part, Part::Stretch(..));
            for &part in parts.iter().filter(is_open) {
                let cost = self.cost(change, &seen, part);
                if own.is_none_or(|own| cost < own.cost) {
                    own = Some(Trial { change, part, cost });
                }
            }
            best.extend(own);
        }
        best.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        best
    }

    /// The same change between those rows where it gains most, beside these rows as they stand; `None` where it does
    /// not leave them as the others are left.
    fn settled(&self, mut trial: Trial) -> Option<Trial> {
        let seen = self.seen(trial.change);
        let own = self.is_frame(trial.change);
        let setups = Group::Setup.count(&self.few).max(1);
        // Two stretches may each ask for the other.
        let mut looked_at = Vec::new();
        let (after, before) = loop {
            let mask = self.rows.mask(self.session, trial.part);
            let (lengths, motions) = self.lengths(&seen, &mask, own);
            let setup = |k: usize| Group::Setup.of(&self.few, k).unwrap_or(0);
            let there = |k: usize| motions[setup(k) + if own { setups } else { 0 }];
            let far = |motion: Option<Isometry3<f64>>, pair: &Pair| Some(left(&motion?, pair));
            let of_rows = |k: usize| {
                let stands = far(motions[setup(k)], &self.as_it_stands.pairs[k])?;
                Some([stands, far(there(k), &seen.pairs[k])?])
            };
            let both: Vec<[f64; 2]> = (0..mask.len()).map(of_rows).collect::<Option<_>>()?;
            let Part::Stretch(first, end) = trial.part else {
                break (lengths, both);
            };
            if looked_at.contains(&(first, end)) {
                break (lengths, both);
            }
            looked_at.push((first, end));
            let (sigma, _) = cost(&lengths);
            let gain = both.iter().map(|[stands, then]| {
                cost_of(*stands, sigma) - cost_of(*then, sigma) + seen.ln_volume
            });
            let (first, end) = likeliest_stretch(gain);
            if end - first < FEWEST_IN_A_PART || end - first == mask.len() {
                return None;
            }
            trial.part = Part::Stretch(first, end);
        };
        let mask = self.rows.mask(self.session, trial.part);
        let inside = |values: &dyn Fn(usize) -> f64, is: bool| {
            median((0..mask.len()).filter(|k| mask[*k] == is).map(values))
        };
        let corrected = inside(&|k| after[k], true)?;
        let others = inside(&|k| after[k], false).unwrap_or(corrected);
        let stood = inside(&|k| before[k][0], true)?;
        let plausible = PLAUSIBLE_SHARE * self.few.samples.spread_mm();
        let alike = corrected <= ALIKE * others && stood >= ALIKE * corrected;
        trial.cost = self.cost(trial.change, &seen, trial.part);
        (alike && corrected.max(others) < plausible).then_some(trial)
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

    fn candidate(&self, trial: Trial) -> Candidate {
        let change = &self.changes[trial.change];
        let rows = self.rows.ranges(self.session, trial.part);
        let in_rows = |mend: &SessionCorrection| SessionCorrection::InRows {
            rows: rows.clone(),
            by: Box::new(mend.clone()),
        };
        Candidate {
            what: self.rows.said(self.session, trial.part, &change.what),
            proposal: text!(
                "{proposal}; these samples are corrected, and commands that go out are not",
                proposal = &change.proposal
            ),
            mends: change.mends.iter().map(in_rows).collect(),
            rows: if trial.part == Part::All {
                Vec::new()
            } else {
                rows.clone()
            },
            target: None,
            cost: trial.cost,
            order: trial.change,
        }
    }

    /// A target that does not turn with the last joint: its points fit a place before that joint far better than any in
    /// the tool.
    fn before_the_last_joint(&self) -> Option<Candidate> {
        let joint = self
            .few
            .robot
            .joints
            .len()
            .checked_sub(1)
            .filter(|last| *last > 0)?;
        if self.few.robot.joints[joint].kind != JointKind::Revolute {
            return None;
        }
        let factor = 0.0;
        let hold = SessionCorrection::ScaleJoint { joint, factor };
        let held = Placeable::of(&self.few, self.values, std::slice::from_ref(&hold));
        let turning = Placeable::of(&self.few, self.values, &[]);
        let numbers = 3;
        let of_target = |target: usize| {
            let part = Part::Group(Group::Target, target);
            let mask = self.rows.mask(self.session, part);
            let inside = mask.iter().filter(|own| **own).count();
            if inside < 2 * FEWEST_IN_A_PART || mask.len() - inside < 2 * FEWEST_IN_A_PART {
                return None;
            }
            let (mut lengths, motions) = self.lengths_of_others(&mask);
            let setup = |k: usize| Group::Setup.of(&self.few, k).unwrap_or(0);
            let mut with = |places: &Placeable| {
                let (by, left) = places.nearest(&mask, |k| motions[setup(k)])?;
                for (k, left) in left {
                    lengths[k] = left;
                }
                Some((cost(&lengths).1 + self.price(part, numbers), by))
            };
            let (elsewhere, _) = with(&turning)?;
            let (cost, by) = with(&held)?;
            (elsewhere - cost > EVIDENCE).then_some((cost, target, by))
        };
        let targets = Group::Target.count(self.session);
        let tried = (0..targets).filter(|_| targets > 1).filter_map(of_target);
        let (cost, target, by) = tried.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let rows = self
            .rows
            .ranges(self.session, Part::Group(Group::Target, target));
        let thing = Group::Target.called(Group::Target.name_of(self.session, target));
        let known = self.session.instrument.targets_sigma_mm;
        let gross = GROSS_SHARE * self.session.robot.length_along_links_mm();
        let off = known.filter(|_| by.norm() > gross);
        Some(Candidate {
            what: text!(
                "{thing} does not turn with joint {joint}: it sits before it",
                thing,
                joint = joint + 1
            ),
            proposal: text!("put the target on the tool, or leave it out of the session"),
            mends: vec![SessionCorrection::InRows {
                rows: rows.clone(),
                by: Box::new(hold),
            }],
            rows,
            target: off.map(|_| (target, by)),
            cost,
            order: 0,
        })
    }

    /// What is left of the points outside a part, and where the instrument stands by them.
    fn lengths_of_others(&self, mask: &[bool]) -> (Vec<f64>, Motions) {
        let (_, motions) = self.lengths(&self.as_it_stands, mask, true);
        let setup = |k: usize| Group::Setup.of(&self.few, k).unwrap_or(0);
        let length = |k: usize| {
            let pair = &self.as_it_stands.pairs[k];
            motions[setup(k)].map_or(0.0, |motion| left(&motion, pair))
        };
        ((0..mask.len()).map(length).collect(), motions)
    }

    /// What is likeliest, if it is likely enough.
    fn best(&self, exact: &Search) -> Option<Vec<DataProblem>> {
        let before = cost(&self.as_it_stands_mm()).1;
        let tried = self.tried();
        let is_likely = |cost: f64, before: f64| before - cost > EVIDENCE;
        let likely = tried
            .into_iter()
            .take_while(|trial| is_likely(trial.cost, before));
        // Settled in all the rows, where costs are others.
        let before = cost(&exact.as_it_stands_mm()).1;
        let settled = likely.take(2 * MOST_FITTED).filter_map(|trial| {
            let part = exact.translated(&self.rows, trial.part);
            exact.settled(Trial { part, ..trial })
        });
        let mut near: Vec<Candidate> = settled.map(|trial| exact.candidate(trial)).collect();
        near.extend(exact.before_the_last_joint());
        near.retain(|candidate| is_likely(candidate.cost, before));
        near.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        // What is wrong in all rows is found by fits, which know more twins.
        let first = near.first().filter(|first| !first.rows.is_empty())?;
        let least = first.cost;
        near.retain(|candidate| candidate.cost < least + NEAR && !candidate.rows.is_empty());
        near.truncate(MOST_FITTED);
        self.told_apart(near)
    }

    /// Of candidates the one that leaves least beside the fitted robot, with those that say the same.
    fn told_apart(&self, candidates: Vec<Candidate>) -> Option<Vec<DataProblem>> {
        let as_it_stands = groups::left_mm(self.session, self.values)?;
        let with = |candidate: Candidate| {
            let mut changed = self.session.clone();
            for mend in &candidate.mends {
                mend.apply(&mut changed);
            }
            if let Some((index, _)) = candidate.target {
                let group = Group::Target;
                SessionCorrection::Free { group, index }.apply(&mut changed);
            }
            Some((groups::left_mm(&changed, self.values)?, candidate))
        };
        let mut fitted: Vec<(f64, Candidate)> = candidates.into_iter().filter_map(with).collect();
        let least = fitted.iter().map(|one| one.0).min_by(f64::total_cmp)?;
        let (rows, axes) = (self.rows.len(), self.few.samples.axes());
        if groups::evidence(rows, axes, as_it_stands, least, axes) < EVIDENCE {
            return None;
        }
        fitted.retain(|one| one.0 <= EQUAL * least);
        fitted.sort_by_key(|one| one.1.order);
        let mut fitted = fitted.into_iter();
        let (left_mm, main) = fitted.next()?;
        let twins: Vec<Text> = fitted.map(|one| one.1.what).collect();
        Some(self.problems(main, &twins, as_it_stands, left_mm))
    }

    fn problems(
        &self,
        candidate: Candidate,
        twins: &[Text],
        before_mm: f64,
        after_mm: f64,
    ) -> Vec<DataProblem> {
        let evidence = text!(
            "the base model leaves {before} as it stands and {after} with these samples corrected; more than 1000 times likelier",
            before = length(before_mm, 3),
            after = length(after_mm, 3)
        );
        let what = if twins.is_empty() {
            candidate.what
        } else {
            text!(
                "{what}; in these samples the same as: {others}",
                what = candidate.what,
                others = Text::listed(twins, "; ")
            )
        };
        let of_target = candidate.target.map(|(index, by)| {
            let group = Group::Target;
            let mend = SessionCorrection::Free { group, index };
            groups::target_elsewhere(self.session, index, by, evidence.clone(), mend)
        });
        let rows = candidate.rows.iter().flat_map(|(first, end)| *first..*end);
        let mut mends = candidate.mends.into_iter();
        let main = DataProblem {
            what,
            evidence,
            proposal: candidate.proposal,
            mend: mends.next(),
            samples: rows.collect(),
        };
        [main].into_iter().chain(of_target).collect()
    }
}

/// Where the instrument stands, of each setup and of each in another part.
type Motions = Vec<Option<Isometry3<f64>>>;

/// Points of targets whose place in the tool is not known.
struct Placeable {
    pairs: Vec<Pair>,
    /// How each moves with its target's place.
    turns: Vec<Matrix3<f64>>,
}

impl Placeable {
    fn of(part: &Session, values: JointValues, mends: &[SessionCorrection]) -> Self {
        let pairs = Seen::of(part, values, mends).pairs;
        let along = |axis: usize| {
            let mut moved = part.clone();
            let mut by_mm = [0.0; 3];
            by_mm[axis] = 1.0;
            for target in 0..moved.targets.len() {
                SessionCorrection::MoveTarget { target, by_mm }.apply(&mut moved);
            }
            Seen::of(&moved, values, mends).pairs
        };
        let [x, y, z] = [0, 1, 2].map(along);
        let turn =
            |k: usize| Matrix3::from_columns(&[&x, &y, &z].map(|there| there[k].0 - pairs[k].0));
        Self {
            turns: (0..pairs.len()).map(turn).collect(),
            pairs,
        }
    }

    /// By how much the target has to move that its points are nearest to the robot, and how far they are then: the
    /// least squares of those three quarters that are nearest.
    fn nearest(
        &self,
        mask: &[bool],
        motion: impl Fn(usize) -> Option<Isometry3<f64>>,
    ) -> Option<Moved> {
        let rows = (0..mask.len()).filter(|k| mask[*k]);
        let of = |k: usize| {
            let motion = motion(k)?;
            let (place, measured) = &self.pairs[k];
            let turn = motion.rotation.to_rotation_matrix().into_inner() * self.turns[k];
            // In the tool, as the turn has no scale.
            Some((k, turn.tr_mul(&(measured - moved(&motion, place)))))
        };
        let mut by_row: Vec<(usize, Vector3<f64>)> = rows.map(of).collect::<Option<_>>()?;
        let mean = |some: &[(usize, Vector3<f64>)]| {
            some.iter().map(|one| one.1).sum::<Vector3<f64>>() / some.len().max(1) as f64
        };
        let mut by = mean(&by_row);
        for _ in 0..3 {
            by_row.sort_by(|a, b| (a.1 - by).norm().total_cmp(&(b.1 - by).norm()));
            by = mean(&by_row[..(by_row.len() * 3 / 4).max(1)]);
        }
        let left = by_row.iter().map(|(k, own)| (*k, (own - by).norm()));
        Some((by, left.collect()))
    }
}
