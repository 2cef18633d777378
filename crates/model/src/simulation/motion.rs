//! The way of the robot: stops in order, each with the side from which every joint came.
//!
//! - A *sweep* in order moves away from `from`: side +1 towards larger values. Back again it is −1.
//!   Every stop of a way is reached from that way's side, the first one too: the robot overshoots
//!   its ends and comes back, as ISO 230-2 asks.
//! - A *shuffled* sweep holds the same stops (twice for both ways, times the repeats). A joint comes
//!   from where it was: home (0) before the first stop. The same stop never follows itself, as far
//!   as that can be had.
//! - *Random* poses come from home as well.
//! - A *list* states the sides; what it leaves out is unknown.
//!
//! A joint that has not moved came from no side: 0.

use rand::RngExt;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;

use super::scenario::{Order, Poses, Scenario, Stop, Sweep};
use crate::kinematics::JointKind;
use crate::units::{deg_from_rad, rad_from_deg};

/// The stops of a scenario without problems.
pub(crate) fn stops(scenario: &Scenario, random: &mut ChaCha8Rng) -> Vec<Stop> {
    let robot = &scenario.robot;
    let joints = robot.joints.len();
    match &scenario.poses {
        Poses::List(stops) => stops.clone(),
        Poses::Sweep(sweep) => {
            let places = places(sweep, robot.joints[sweep.joint].kind);
            let on_the_way = match sweep.order {
                Order::Sweep => in_order(sweep, &places),
                Order::Random => shuffled(sweep, &places, random),
            };
            let stop = |(place, side): (f64, f64)| {
                let (mut q, mut dir) = (vec![0.0; joints], vec![0.0; joints]);
                (q[sweep.joint], dir[sweep.joint]) = (place, side);
                Stop { q, dir: Some(dir) }
            };
            on_the_way.into_iter().map(stop).collect()
        }
        Poses::Random(count) => {
            let mut before = vec![0.0; joints];
            let mut stop = |_| {
                let anywhere = |joint: &crate::kinematics::Joint| {
                    let limits = joint.limits.map_or((0.0, 0.0), |l| (l.from, l.to));
                    limits.0 + (limits.1 - limits.0) * random.random::<f64>()
                };
                let q: Vec<f64> = robot.joints.iter().map(anywhere).collect();
                let moved = q.iter().zip(&before).map(|(q, before)| side(*before, *q));
                let dir = Some(moved.collect());
                before.clone_from(&q);
                Stop { q, dir }
            };
            (0..*count).map(&mut stop).collect()
        }
    }
}

/// The side from which a joint reaches `to`; 0 where it does not move.
pub(crate) fn side(from: f64, to: f64) -> f64 {
    if from == to {
        0.0
    } else {
        (to - from).signum()
    }
}

/// The places of one way, worked out in the user's unit: whole degrees stay whole.
fn places(sweep: &Sweep, kind: JointKind) -> Vec<f64> {
    let turns = kind == JointKind::Revolute;
    let outer = |v: f64| if turns { deg_from_rad(v) } else { v };
    let inner = |v: f64| if turns { rad_from_deg(v) } else { v };
    let tidy = |v: f64| (v * 1e9).round() / 1e9;
    let (from, to) = (tidy(outer(sweep.from)), tidy(outer(sweep.to)));
    let step = tidy(outer(sweep.step.abs())) * if to < from { -1.0 } else { 1.0 };
    let mut places = Vec::new();
    let mut k = 0.0;
    while k < sweep.steps() {
        places.push(inner(tidy(from + step * k)));
        k += 1.0;
    }
    places
}

fn in_order(sweep: &Sweep, places: &[f64]) -> Vec<(f64, f64)> {
    let there = if sweep.to < sweep.from { -1.0 } else { 1.0 };
    let mut way = Vec::new();
    for _ in 0..sweep.repeats {
        way.extend(places.iter().map(|place| (*place, there)));
        if sweep.both_ways {
            way.extend(places.iter().rev().map(|place| (*place, -there)));
        }
    }
    way
}

fn shuffled(sweep: &Sweep, places: &[f64], random: &mut ChaCha8Rng) -> Vec<(f64, f64)> {
    let times = sweep.repeats * if sweep.both_ways { 2 } else { 1 };
    let mut order: Vec<f64> = places
        .iter()
        .copied()
        .cycle()
        .take(places.len() * times)
        .collect();
    order.shuffle(random);
    for i in 1..order.len() {
        if order[i] == order[i - 1] {
            // Another stop takes its place, one that starts no new pair where it came from.
            let apart = |k: usize| {
                let fits_here = order[k] != order[i];
                let before = k == i + 1 || order[k - 1] != order[i];
                let after = order.get(k + 1) != Some(&order[i]);
                fits_here && before && after
            };
            if let Some(k) = (i + 1..order.len()).find(|k| apart(*k)) {
                order.swap(i, k);
            }
        }
    }
    let mut before = 0.0;
    let mut reached = |place: f64| {
        let from = side(before, place);
        before = place;
        (place, from)
    };
    order.into_iter().map(&mut reached).collect()
}
