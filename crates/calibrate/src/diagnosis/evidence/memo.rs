//! What was worked out before: a search comes to the same fits again on its several ways.

use std::cell::RefCell;
use std::sync::Arc;

use super::fit::Fit;
use crate::diagnosis::candidates::Placed;
use crate::model::Model;
use crate::model::shapes::Shape;

/// The last answers, each with the fit that it is for.
pub(crate) struct Memo<T> {
    most: usize,
    computed: RefCell<Vec<(Start, T)>>,
}

impl<T: Clone> Memo<T> {
    /// For so many answers, the last one at least.
    pub(crate) fn new(most: usize) -> Self {
        Self {
            most: most.max(1),
            computed: RefCell::new(Vec::new()),
        }
    }

    /// The answer for a fit, worked out unless it is known.
    pub(crate) fn of(&self, fit: &Fit, work: impl FnOnce() -> T) -> T {
        let mut key = start(&fit.model, &fit.shapes);
        let end = [fit.rss, fit.residual.sum()];
        key.numbers.extend(end.map(f64::to_bits));
        self.of_key(key, work)
    }

    /// Drops all of them.
    pub(crate) fn clear(&self) {
        self.computed.borrow_mut().clear();
    }

    /// The same for what is alike for all fits of one size.
    pub(crate) fn of_size(&self, size: usize, work: impl FnOnce() -> T) -> T {
        let key = Start {
            numbers: vec![size as u64],
            shapes: Vec::new(),
        };
        self.of_key(key, work)
    }

    fn of_key(&self, key: Start, work: impl FnOnce() -> T) -> T {
        let known = self.computed.borrow().iter().find(|k| k.0 == key).cloned();
        if let Some((_, answer)) = known {
            return answer;
        }
        let answer = work();
        let mut known = self.computed.borrow_mut();
        if known.len() >= self.most {
            known.remove(0);
        }
        known.push((key, answer.clone()));
        answer
    }
}

/// What tells one start of a fit from another.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Start {
    /// Every bit of the terms, and of what is known of the shapes.
    numbers: Vec<u64>,
    shapes: Vec<Shape>,
}

pub(crate) fn start(model: &Model, shapes: &[Placed]) -> Start {
    let mut all = Vec::new();
    for term in model.terms() {
        all.push((crate::effects::rank(term.effect) * 64 + term.joint) as u64);
        all.push(term.setting.to_bits());
        all.extend(term.coefficients.iter().map(|c| c.to_bits()));
        let held = |k: usize| u64::from(term.held.contains(k));
        all.extend((0..term.coefficients.len()).map(held));
        // What is kept holds its curve, so no other one lies there.
        let curve = term.curve.as_ref().map_or(0, |c| Arc::as_ptr(c) as usize);
        all.push(curve as u64);
        let rest = term.rest.as_ref().map_or(0, |r| Arc::as_ptr(r) as usize);
        all.push(rest as u64);
    }
    for shape in shapes {
        // No rank of an effect.
        all.push(u64::MAX);
        all.extend(shape.coefficients.iter().map(|c| c.to_bits()));
    }
    Start {
        numbers: all,
        shapes: shapes.iter().map(|placed| placed.shape).collect(),
    }
}
