//! Orthonormal columns that are added one by one, and exchanged.

use nalgebra::DVector;

/// Orthonormal columns, added one by one.
pub struct Kept {
    rows: usize,
    q: Vec<DVector<f64>>,
    /// For each: which it is, and its parts along those before it and itself.
    kept: Vec<(usize, Vec<f64>)>,
}

impl Kept {
    pub fn new(rows: usize) -> Self {
        Self {
            rows,
            q: Vec::new(),
            kept: Vec::new(),
        }
    }

    /// The projection of a column orthogonal to them.
    pub fn reject(&self, column: &DVector<f64>) -> DVector<f64> {
        let mut projected = column.clone();
        if self.q.len() >= self.rows {
            projected.fill(0.0);
        }

        for _ in 0..2 {
            for q in &self.q {
                projected.axpy(-q.dot(&projected), q, 1.0);
            }
        }
        projected
    }

    pub fn push(&mut self, index: usize, column: &DVector<f64>, free: &DVector<f64>) {
        let q = free / free.norm();
        let mut along = self.along(column);
        along.push(q.dot(column));
        self.q.push(q);
        self.kept.push((index, along));
    }

    fn along(&self, column: &DVector<f64>) -> Vec<f64> {
        let one = |q: &DVector<f64>| q.dot(column);
        self.q.iter().map(one).collect()
    }

    /// How much of each kept column a dependent one is made of.
    pub fn parts(&self, column: &DVector<f64>) -> Vec<(usize, f64)> {
        let mut parts = self.along(column);
        for k in (0..parts.len()).rev() {
            let (earlier, along) = self.kept[k].1.split_at(k);
            parts[k] /= along[0];
            let value = parts[k];
            for (part, r) in parts.iter_mut().zip(earlier) {
                *part -= r * value;
            }
        }
        let kept = self.kept.iter().map(|k| k.0);
        kept.zip(parts).collect()
    }

    /// Takes a column in the place of another that was kept.
    pub fn exchange(
        &mut self,
        out: usize,
        new: usize,
        column: &DVector<f64>,
        of: impl Fn(usize) -> DVector<f64>,
    ) {
        // What comes before it stays as it is.
        let at = self.kept.iter().position(|k| k.0 == out);
        let at = at.unwrap_or(self.kept.len());
        let behind = self.kept.iter().skip(at + 1);
        let mut all: Vec<(usize, DVector<f64>)> = behind.map(|k| (k.0, of(k.0))).collect();
        all.push((new, column.clone()));
        self.q.truncate(at);
        self.kept.truncate(at);
        for (index, column) in all {
            let free = self.reject(&column);
            self.push(index, &column, &free);
        }
    }
}
