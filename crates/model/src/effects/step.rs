//! The step of an identification.

use super::about::{Form, Setting};
use super::place::PlaceKind;
use super::term::Term;

impl Term {
    /// The coefficients after a step, which moves no fade by more than a factor [`e^½`](super::term::fade) at
    /// once: far from the solution a linear step means nothing for it.
    pub(crate) fn step(&mut self, by: &[f64]) {
        let held = self.held;
        for (k, (coefficient, by)) in self.coefficients.iter_mut().zip(by).enumerate() {
            if !held.contains(k) {
                *coefficient += by;
            }
        }
        let free_turn = match self.effect.about().setting {
            Setting::Setup => true,
            Setting::Place => PlaceKind::of(self) == Some(PlaceKind::Station),
            _ => false,
        };
        if free_turn && !held.contains(0) {
            super::rotation::unwind(&mut self.coefficients);
        }
        if let (Form::Fading(_), Some(by)) = (self.effect.about().form, by.get(1)) {
            let before = self.coefficients[1] - by;
            let moved = before + by.clamp(-LONGEST_STEP, LONGEST_STEP);
            self.coefficients[1] = moved.clamp(-FARTHEST, FARTHEST);
        }
    }
}

/// How far a fade moves in one step, and from its setting, as logarithms.
const LONGEST_STEP: f64 = 0.5;
const FARTHEST: f64 = 3.0;
