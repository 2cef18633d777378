//! A short way through poses: each time to the nearest (the joint that takes longest counts, as joints
//! move together), then two ends of a stretch are exchanged while that shortens the way (2-opt, Croes
//! 1958).

use super::candidate::usual_speed;
use crate::budget;
use crate::kinematics::Robot;

/// The time from one pose to another at usual speeds, s.
pub(crate) fn seconds(robot: &Robot, from: &[f64], to: &[f64]) -> f64 {
    let joints = robot.joints.iter().zip(from.iter().zip(to));
    let each = joints.map(|(joint, (a, b))| (a - b).abs() / usual_speed(joint.kind));
    each.fold(0.0, f64::max)
}

/// The order in which poses are visited, from `start` on.
pub(crate) fn short(robot: &Robot, poses: &[&[f64]], start: &[f64]) -> Vec<usize> {
    let at = |k: usize| poses[k];
    let mut order: Vec<usize> = Vec::with_capacity(poses.len());
    let mut remaining: Vec<usize> = (0..poses.len()).collect();
    while !remaining.is_empty() {
        let here = order.last().map_or(start, |k| at(*k));
        let time = |k: usize| seconds(robot, here, at(k));
        let nearest =
            (0..remaining.len()).min_by(|a, b| time(remaining[*a]).total_cmp(&time(remaining[*b])));
        order.push(remaining.remove(nearest.unwrap_or(0)));
    }
    // The way between two that follow one another; from the start, and nothing behind the end.
    let way = |order: &[usize], a: Option<usize>, b: usize| {
        let Some(to) = order.get(b) else { return 0.0 };
        seconds(robot, a.map_or(start, |a| at(order[a])), at(*to))
    };
    for _ in 0..budget::STEPS {
        let mut shorter = false;
        for first in 0..order.len() {
            for last in first + 1..order.len() {
                let before = first.checked_sub(1);
                let now = way(&order, before, first) + way(&order, Some(last), last + 1);
                let then = way(&order, before, last) + way(&order, Some(first), last + 1);
                if then < now - 1e-9 {
                    order[first..=last].reverse();
                    shorter = true;
                }
            }
        }
        if !shorter {
            break;
        }
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::column;

    #[test]
    fn a_joint_sweeps_once_however_its_poses_are_listed() {
        let robot = column();
        let all: Vec<[f64; 1]> = [0.3, -0.2, 1.1, 0.9, -0.7, 0.1].map(|q| [q]).to_vec();
        let poses: Vec<&[f64]> = all.iter().map(<[f64; 1]>::as_slice).collect();
        let order = short(&robot, &poses, &[-1.0]);
        let visited: Vec<f64> = order.iter().map(|k| all[*k][0]).collect();
        assert_eq!(visited, [-0.7, -0.2, 0.1, 0.3, 0.9, 1.1]);
    }
}
