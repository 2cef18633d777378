//! What was worked out for a fit before: a search comes to the same fits again on its several ways.

use std::cell::RefCell;

use super::regression::Fit;

/// The last answers, each with the fit that it is for.
pub(crate) struct Memo<T> {
    most: usize,
    known: RefCell<Vec<(Vec<u64>, T)>>,
}

impl<T: Clone> Memo<T> {
    /// For so many answers.
    pub(crate) fn new(most: usize) -> Self {
        Self {
            most,
            known: RefCell::new(Vec::new()),
        }
    }

    /// The answer for a fit, worked out unless it is known.
    pub(crate) fn of(&self, fit: &Fit, work: impl FnOnce() -> T) -> T {
        let key = key(fit);
        let known = self.known.borrow().iter().find(|k| k.0 == key).cloned();
        if let Some((_, answer)) = known {
            return answer;
        }
        let answer = work();
        let mut known = self.known.borrow_mut();
        if known.len() >= self.most {
            known.remove(0);
        }
        known.push((key, answer.clone()));
        answer
    }
}

/// Every bit that tells one fit of a regression from another.
fn key(fit: &Fit) -> Vec<u64> {
    let mut all = vec![fit.rss.to_bits(), fit.residual.sum().to_bits()];
    for term in fit.model.terms() {
        all.push((crate::effects::rank(term.effect) * 64 + term.joint) as u64);
        all.push(term.setting.to_bits());
        all.extend(term.coefficients.iter().map(|c| c.to_bits()));
    }
    for shape in &fit.shapes {
        // No rank of an effect.
        all.extend([u64::MAX, shape.white.column(0).norm().to_bits()]);
        all.extend(shape.coefficients.iter().map(|c| c.to_bits()));
    }
    all
}
