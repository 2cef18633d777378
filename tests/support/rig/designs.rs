//! Orders of measuring beyond those of `Rig::new`: repeats, a pause, equal steps.

use super::{Random, Rig, Shot};

impl Rig {
    /// The same poses so many times over, each round in an order of its own.
    pub fn repeated(&mut self, times: usize, random: &mut Random) {
        let once = self.shots.clone();
        let mut all = Vec::new();
        for _ in 0..times {
            let mut round = once.clone();
            for k in (1..round.len()).rev() {
                round.swap(k, random.below(k + 1));
            }
            all.extend(round);
        }
        self.shots = in_this_order(all);
    }

    /// So many turns, each in the order of the first.
    pub fn turns(&mut self, times: usize) {
        let once = std::mem::take(&mut self.shots);
        self.shots = in_this_order(once.repeat(times));
    }

    /// Nothing is measured for so long, half way through.
    pub fn pause(&mut self, seconds: f64) {
        let half = self.shots.len() / 2;
        for shot in &mut self.shots[half..] {
            shot.time += seconds;
        }
    }

    /// A turn in equal steps, from one side, as a wheel is read.
    pub fn equal_steps(&mut self) {
        let count = self.shots.len() as f64;
        for (i, shot) in self.shots.iter_mut().enumerate() {
            shot.q = (-180.0 + 360.0 * (i as f64 + 0.5) / count).to_radians();
            shot.speed = shot.speed.abs();
            shot.dir = 1.0;
        }
        self.shots = in_this_order(std::mem::take(&mut self.shots));
    }
}

/// Times and travels as they follow from the order.
fn in_this_order(mut shots: Vec<Shot>) -> Vec<Shot> {
    let mut last: Option<Shot> = None;
    for (i, shot) in shots.iter_mut().enumerate() {
        shot.time = 6.0 * i as f64;
        shot.travel = last.map_or(f64::INFINITY, |last| {
            let moved = (shot.q - last.q).abs();
            let before = if last.dir == shot.dir {
                last.travel
            } else {
                0.0
            };
            before + moved
        });
        last = Some(*shot);
    }
    shots
}
