//! A cache of computed results: a search comes to the same fits again on several ways.

use std::cell::RefCell;
use std::sync::Arc;

use super::fit::Fit;
use crate::diagnosis::candidates::Placed;
use crate::model::Model;
use crate::model::shapes::Shape;

/// The last answers, each with the fit that it is for.
pub(crate) struct Memo<T> {
    most: usize,
    computed: RefCell<Vec<(Key, T)>>,
}

impl<T: Clone> Memo<T> {
    /// For so many answers, the last one at least.
    pub(crate) fn new(most: usize) -> Self {
        Self {
            most: most.max(1),
            computed: RefCell::new(Vec::new()),
        }
    }

    /// The answer for a fit, computed unless it is known.
    pub(crate) fn of(&self, fit: &Fit, work: impl FnOnce() -> T) -> T {
        self.of_key(Key::of(fit), work)
    }

    /// Drops all of them.
    pub(crate) fn clear(&self) {
        self.computed.borrow_mut().clear();
    }

    /// The result of a key.
    pub(crate) fn of_key(&self, key: Key, work: impl FnOnce() -> T) -> T {
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

/// What distinguishes one fit from another.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Key {
    /// Every bit of the terms and of the shapes.
    numbers: Vec<u64>,
    shapes: Vec<Shape>,
}

impl Key {
    /// Of where a fit ended.
    pub(crate) fn of(fit: &Fit) -> Self {
        let mut key = Self::of_start(&fit.model, &fit.shapes);
        let end = [fit.rss, fit.residual.sum()];
        key.numbers.extend(end.map(f64::to_bits));
        key
    }

    /// The same, with this number as a part of the key.
    pub(crate) fn with(mut self, number: usize) -> Self {
        self.numbers.push(number as u64);
        self
    }

    /// Of where a fit begins.
    pub(crate) fn of_start(model: &Model, shapes: &[Placed]) -> Self {
        let mut all = Vec::new();
        for term in model.terms() {
            all.push((crate::effects::rank(term.effect) * 64 + term.joint) as u64);
            all.push(term.setting.to_bits());
            all.extend(term.coefficients.iter().map(|c| c.to_bits()));
            let held = |k: usize| u64::from(term.held.contains(k));
            all.extend((0..term.coefficients.len()).map(held));
            // The kept entry holds its curve, so that no other one has its address.
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
        Self {
            numbers: all,
            shapes: shapes.iter().map(|placed| placed.shape).collect(),
        }
    }
}
