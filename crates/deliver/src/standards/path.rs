//! Path accuracy and repeatability after ISO 9283:1998, clauses 8.2 and 8.3, from time series in which a
//! commanded path was followed several times.
//!
//! ```text
//! x_ij  where the attained path of cycle j crosses the plane through the commanded point i, normal to
//!       the commanded path;  x̄_i their barycentre,  l_ij = |x_ij − x̄_i|
//! AT_p  = max_i |x̄_i − x_ci|,            RT_p = max_i ( l̄_i + 3 S_li )
//! AT_a  = max_i |ā_i − a_ci|, …           RT_a = max_i 3 S_ai, …         a, b, c as of a pose
//! ```
//!
//! The commanded path is where the nominal robot carries the tool at the commanded joint values, as often
//! as the series states them. Cycles are found in the series itself: from a sample on, and again later,
//! the commanded values follow each other in the same order, each within half the way to its neighbours
//! (so that cycles need not be sampled at the same instants). Positions held at rest are no path: it needs
//! `time_s`, motion, and commanded points that follow a line that bends little from one to the next.

use nalgebra::{Point3, Vector3};

use crate::kinematics::JointKind;

use super::attained::{Attained, Turned, attained, of_turns};
use super::points::Points;

/// Points of a path at which it is judged: the standard asks for at least so many.
const FEWEST_POINTS: usize = 10;
/// Cycles that the standard asks for.
pub(crate) const PATH_CYCLES: usize = 10;
/// A commanded value belongs to a point of the first cycle within this part of the way to its neighbours.
const HALF: f64 = 0.51;
/// Without speeds: samples further apart in time than this are positions, s.
const LONGEST_PAUSE_S: f64 = 1.0;
/// Most corners of a path's polygon are below this, rad; at most one in ten is a corner of the path.
const BEND: f64 = 0.6;
/// A path that turns back by more than this is two, rad.
const BACK: f64 = 2.6;

/// One commanded path that was followed several times.
#[derive(Debug, Clone, PartialEq)]
pub struct PathFigures {
    /// First sample of each cycle, from 0.
    pub starts: Vec<usize>,
    /// Points of the commanded path at which it is judged.
    pub points: usize,
    /// Length of the commanded path, mm.
    pub length_mm: f64,
    /// Load, kg.
    pub load_kg: Option<f64>,
    /// As measured.
    pub before: PathAttained,
    /// As it would be with corrected commands.
    pub after: Option<PathAttained>,
    /// Orientations as measured: `AT_a` … and `RT_a` …, degrees.
    pub orientation: Option<Turned>,
}

/// What the attained paths give, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathAttained {
    /// `AT_p`.
    pub accuracy: f64,
    /// `RT_p`.
    pub repeatability: f64,
}

/// The paths of a session, and which samples are on them.
pub(super) fn paths(points: &Points<'_>) -> (Vec<PathFigures>, Vec<bool>) {
    let mut on_paths = vec![false; points.inputs.len()];
    let mut all = Vec::new();
    for cycles in CommandedSeries::new(points).map_or_else(Vec::new, |series| series.families()) {
        if let Some(figures) = figures(points, &cycles) {
            all.push(figures);
            for i in cycles.into_iter().flatten() {
                on_paths[i] = true;
            }
        }
    }
    (all, on_paths)
}

/// Commanded values in the order of time, without those that only last.
struct CommandedSeries<'p, 'a> {
    points: &'p Points<'a>,
    samples: Vec<usize>,
    /// rad, and mm by the robot's reach, by sample of the series.
    q: Vec<Vec<f64>>,
    /// Way to the farther neighbour.
    step: Vec<f64>,
}

/// Cycles of one path: the samples of each, as many in all.
type Family = Vec<Vec<usize>>;

impl<'p, 'a> CommandedSeries<'p, 'a> {
    /// `None` where the session is no time series of a motion.
    fn new(points: &'p Points<'a>) -> Option<Self> {
        let (inputs, session) = (&points.inputs, points.session);
        let time = session.samples.time_s.as_ref()?;
        if points.robot.joints.len() < 2 {
            return None;
        }
        let reach = points.robot.reach_mm();
        let value = |i: usize| -> Vec<f64> {
            let joints = points.robot.joints.iter().zip(&inputs.q);
            let scaled = joints.map(|(joint, q)| match joint.kind {
                JointKind::Revolute => q[i],
                JointKind::Prismatic => q[i] / reach,
            });
            scaled.collect()
        };
        let mut series = Self {
            points,
            samples: Vec::new(),
            q: Vec::new(),
            step: Vec::new(),
        };
        for i in (0..inputs.len()).filter(|i| points.usable[*i]) {
            let q = value(i);
            if series.q.last() != Some(&q) {
                series.samples.push(i);
                series.q.push(q);
            }
        }
        let n = series.samples.len();
        series.step = (0..n)
            .map(|k| {
                let around = [k.checked_sub(1), Some(k + 1).filter(|k| *k < n)];
                let ways = around
                    .into_iter()
                    .flatten()
                    .map(|j| largest_difference(&series.q[k], &series.q[j]));
                ways.fold(0.0, f64::max)
            })
            .collect();
        let speeds: Vec<_> = session.samples.speed.iter().flatten().collect();
        let moving = if speeds.is_empty() {
            let mut pauses: Vec<f64> = series
                .samples
                .windows(2)
                .map(|w| time[w[1]] - time[w[0]])
                .filter(|s| s.is_finite())
                .collect();
            pauses.sort_by(f64::total_cmp);
            pauses
                .get(pauses.len() / 2)
                .is_some_and(|s| (0.0..=LONGEST_PAUSE_S).contains(s))
        } else {
            speeds.into_iter().flatten().any(|v| v.abs() > 0.0)
        };
        moving.then_some(series)
    }

    fn families(&self) -> Vec<Family> {
        let n = self.samples.len();
        // Candidates for the same place are near each other in the joint that travels most.
        let joints = self.q.first().map_or(0, Vec::len);
        let travel = |j: usize| {
            let values = self.q.iter().map(|q| q[j]);
            let (low, high) = values.fold((f64::MAX, f64::MIN), |(l, h), v| (l.min(v), h.max(v)));
            high - low
        };
        let Some(widest) = (0..joints).max_by(|a, b| travel(*a).total_cmp(&travel(*b))) else {
            return Vec::new();
        };
        let mut sorted: Vec<usize> = (0..n).collect();
        sorted.sort_by(|a, b| self.q[*a][widest].total_cmp(&self.q[*b][widest]));
        let mut families = Vec::new();
        let mut s = 0;
        while s + FEWEST_POINTS <= n {
            let (here, reach) = (self.q[s][widest], HALF * self.step[s]);
            let from = sorted.partition_point(|k| self.q[*k][widest] < here - reach);
            let near = sorted[from..]
                .iter()
                .take_while(|k| self.q[**k][widest] <= here + reach);
            let mut starts: Vec<usize> =
                near.copied().filter(|k| *k >= s + FEWEST_POINTS).collect();
            starts.sort_unstable();
            let family = self.family(s, &starts);
            s = family
                .iter()
                .flatten()
                .flatten()
                .max()
                .map_or(s, |last| *last)
                + 1;
            families.extend(
                family
                    .iter()
                    .flat_map(|cycles| self.between_reversals(cycles)),
            );
        }
        families
    }

    /// The cycles that go on like the samples from `s` on.
    fn family(&self, s: usize, candidates: &[usize]) -> Option<Family> {
        let mut starts = vec![s];
        for k in candidates {
            let last = starts[starts.len() - 1];
            if !(0..FEWEST_POINTS).all(|i| self.alike(s + i, k + i)) {
                continue;
            }
            if *k >= last + FEWEST_POINTS {
                starts.push(*k);
            } else if last != s
                && largest_difference(&self.q[*k], &self.q[s])
                    < largest_difference(&self.q[last], &self.q[s])
            {
                // Of neighbours the nearer one.
                if let Some(last) = starts.last_mut() {
                    *last = *k;
                }
            }
        }
        if starts.len() < 2 {
            return None;
        }
        let ends = starts.iter().skip(1).copied().chain([self.samples.len()]);
        let longest = starts.iter().zip(ends).map(|(from, to)| to - from).min()?;
        let goes_on = |i: &usize| starts.iter().all(|p| self.alike(s + i, p + i));
        let length = (0..longest).take_while(goes_on).count();
        let cycles: Family = starts.iter().map(|p| (*p..p + length).collect()).collect();
        self.is_a_line(&cycles[0]).then_some(cycles)
    }

    /// Whether sample `b` is where the first cycle is at `a`, under the same conditions.
    fn alike(&self, a: usize, b: usize) -> bool {
        let (Some(i), Some(j)) = (self.samples.get(a), self.samples.get(b)) else {
            return false;
        };
        let inputs = &self.points.inputs;
        let same = |c: Option<&[f64]>| c.is_none_or(|c| c[*i].total_cmp(&c[*j]).is_eq());
        let target = inputs.target.as_ref().is_none_or(|t| t[*i] == t[*j]);
        target
            && same(inputs.load_kg.as_deref())
            && same(inputs.setup.as_deref())
            && largest_difference(&self.q[a], &self.q[b]) <= HALF * self.step[a]
    }

    /// Whether commanded points follow a line, rather than being positions far from each other.
    fn is_a_line(&self, cycle: &[usize]) -> bool {
        let at: Vec<Point3<f64>> = cycle
            .iter()
            .map(|k| self.points.commanded(self.samples[*k]))
            .collect();
        let ways: Vec<Vector3<f64>> = at.windows(2).map(|w| w[1] - w[0]).collect();
        let bends = ways.windows(2).filter(|w| w[0].angle(&w[1]) > BEND).count();
        10 * bends <= cycle.len() && ways.iter().any(|w| w.norm() > 0.0)
    }

    /// The way there and the way back are two paths.
    fn between_reversals(&self, cycles: &Family) -> Vec<Family> {
        let at = |i: usize| self.points.commanded(self.samples[cycles[0][i]]);
        let last = cycles[0].len() - 1;
        let turns = |i: &usize| (at(*i) - at(i - 1)).angle(&(at(i + 1) - at(*i))) > BACK;
        let mut cuts: Vec<usize> = (1..last).filter(turns).collect();
        cuts.insert(0, 0);
        cuts.push(last);
        let parts = cuts.windows(2).filter(|w| w[1] - w[0] + 1 >= FEWEST_POINTS);
        let of = |part: &[usize]| -> Family {
            let within = |cycle: &Vec<usize>| cycle[part[0]..=part[1]].to_vec();
            let sampled = |cycle: Vec<usize>| cycle.iter().map(|k| self.samples[*k]).collect();
            cycles.iter().map(within).map(sampled).collect()
        };
        parts.map(of).collect()
    }
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max)
}

/// Where an attained path crosses a plane: between two samples, and how far from one to the other.
struct Crossing {
    samples: [usize; 2],
    part: f64,
}

/// The crossing nearest to sample `i` of a cycle.
fn crossing(
    points: &Points<'_>,
    cycle: &[usize],
    i: usize,
    (at, normal): (Point3<f64>, Vector3<f64>),
    compensated: bool,
) -> Option<Crossing> {
    let height = |k: usize| (points.attained(cycle[k], compensated) - at).dot(&normal);
    let crosses = |k: usize| {
        let (from, to) = (height(k), height(k + 1));
        (from <= 0.0 && to >= 0.0 && to > from).then(|| Crossing {
            samples: [cycle[k], cycle[k + 1]],
            part: from / (from - to),
        })
    };
    let last = cycle.len().checked_sub(2)?;
    // Outwards from the commanded point; a path that closes crosses the plane again far from it.
    let outwards = (0..FEWEST_POINTS).flat_map(|by| [i.checked_sub(by), Some(i + by)]);
    let mut near = outwards.flatten().filter(|k| *k <= last);
    near.find_map(crosses)
}

fn between(points: &Points<'_>, crossing: &Crossing, compensated: bool) -> Point3<f64> {
    let [a, b] = crossing.samples.map(|i| points.attained(i, compensated));
    a + (b - a) * crossing.part
}

/// The turn from the orientation commanded at a sample to the one attained at a crossing.
fn turn(points: &Points<'_>, crossing: &Crossing, commanded: usize) -> Option<Vector3<f64>> {
    let [a, b] = crossing.samples.map(|i| points.turned(i));
    let here = a?.try_slerp(&b?, crossing.part, 1e-12)?;
    points.turn(&here, commanded)
}

fn figures(points: &Points<'_>, cycles: &Family) -> Option<PathFigures> {
    let at: Vec<Point3<f64>> = cycles[0].iter().map(|i| points.commanded(*i)).collect();
    let plane = |i: usize| {
        let way = at[(i + 1).min(at.len() - 1)] - at[i.saturating_sub(1)];
        Some((at[i], way.try_normalize(1e-9)?))
    };
    let crossings = |compensated: bool| -> Vec<(usize, Vec<Crossing>)> {
        let of = |i: usize| {
            let plane = plane(i)?;
            let all = cycles
                .iter()
                .map(|cycle| crossing(points, cycle, i, plane, compensated));
            Some((i, all.collect::<Option<Vec<_>>>()?))
        };
        (0..at.len()).filter_map(of).collect()
    };
    let state = |crossings: &[(usize, Vec<Crossing>)], compensated: bool| {
        let of = |(i, all): &(usize, Vec<Crossing>)| {
            let x: Vec<_> = all
                .iter()
                .map(|c| between(points, c, compensated))
                .collect();
            attained(&x, &at[*i]).map(|(_, figures)| figures)
        };
        let all: Vec<Attained> = crossings.iter().filter_map(of).collect();
        let most = |pick: fn(&Attained) -> f64| all.iter().map(pick).fold(0.0, f64::max);
        (all.len() >= FEWEST_POINTS).then(|| PathAttained {
            accuracy: most(|a| a.accuracy),
            repeatability: most(|a| a.repeatability),
        })
    };
    let measured = crossings(false);
    let turned = |(i, all): &(usize, Vec<Crossing>)| {
        let turns: Option<Vec<_>> = all.iter().map(|c| turn(points, c, cycles[0][*i])).collect();
        of_turns(&turns?)
    };
    let orientation = measured.iter().filter_map(turned).reduce(|a, b| Turned {
        accuracy: [0, 1, 2].map(|k: usize| a.accuracy[k].abs().max(b.accuracy[k].abs())),
        repeatability: [0, 1, 2].map(|k: usize| a.repeatability[k].max(b.repeatability[k])),
    });
    Some(PathFigures {
        starts: cycles.iter().map(|cycle| cycle[0]).collect(),
        points: measured.len(),
        length_mm: at.windows(2).map(|w| (w[1] - w[0]).norm()).sum(),
        load_kg: points.inputs.load_kg.as_ref().map(|l| l[cycles[0][0]]),
        before: state(&measured, false)?,
        after: if points.compensated() {
            state(&crossings(true), true)
        } else {
            None
        },
        orientation,
    })
}
