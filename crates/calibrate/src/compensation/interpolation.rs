//! Interpolation of corrections: linear between the entries, the end values held outside.
//!
//! [`UniformTable`] finds the interval by one multiplication; [`SortedTable`] takes any ascending entries and finds it
//! by bisection, for tables that were read from a file.

/// Entries at equal steps.
#[derive(Debug, Clone, PartialEq)]
pub struct UniformTable {
    from: f64,
    per_step: f64,
    last: f64,
    /// Value at each entry and the rise to the next one; the last has none.
    entries: Vec<[f64; 2]>,
}

impl UniformTable {
    /// Values at `from`, `from + step`, …
    ///
    /// # Panics
    /// Without a value, or with a step that is not positive: a bug of the caller.
    pub fn new(from: f64, step: f64, values: &[f64]) -> Self {
        assert!(!values.is_empty(), "a table has an entry");
        assert!(step > 0.0, "a table ascends");
        let next = values[1..].iter().chain(values.last());
        let entries = values
            .iter()
            .zip(next)
            .map(|(here, next)| [*here, next - here]);
        Self {
            from,
            per_step: 1.0 / step,
            last: (values.len() - 1) as f64,
            entries: entries.collect(),
        }
    }

    /// The value at `q`; of NaN it is the first entry's.
    #[inline]
    pub fn at(&self, q: f64) -> f64 {
        // max and min in this order turn NaN into 0.
        let place = ((q - self.from) * self.per_step).max(0.0).min(self.last);
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "the place is between 0 and the last entry"
        )]
        let index = place as usize;
        let [value, rise] = self.entries[index];
        value + rise * (place - index as f64)
    }
}

/// Entries at any ascending places.
#[derive(Debug, Clone, PartialEq)]
#[doc(hidden)]
pub struct SortedTable {
    places: Vec<f64>,
    values: Vec<f64>,
}

impl SortedTable {
    /// Values at `places`; `None` unless there is an entry, as many values as places, and the
    /// places ascend.
    pub fn new(places: Vec<f64>, values: Vec<f64>) -> Option<Self> {
        let ascending = places.windows(2).all(|pair| pair[0] < pair[1]);
        let usable = !places.is_empty() && places.len() == values.len() && ascending;
        usable.then_some(Self { places, values })
    }

    /// The places of the entries.
    pub fn places(&self) -> &[f64] {
        &self.places
    }

    /// Their values.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The value at `q`; of NaN it is the first entry's.
    #[inline]
    pub fn at(&self, q: f64) -> f64 {
        let above = self.places.partition_point(|place| *place <= q);
        if above == 0 {
            return self.values[0];
        }
        let below = above - 1;
        let Some(next) = self.places.get(above) else {
            return self.values[below];
        };
        let share = (q - self.places[below]) / (next - self.places[below]);
        self.values[below] + (self.values[above] - self.values[below]) * share
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn ends_are_held_and_nan_does_no_harm() {
        let table = UniformTable::new(-1.0, 0.5, &[3.0, 4.0, 2.0]);
        assert_eq!(
            [-9.0, -1.0, -0.75, -0.5, 0.0, 9.0].map(|q| table.at(q)),
            [3.0, 3.0, 3.5, 4.0, 2.0, 2.0]
        );
        assert_eq!(table.at(f64::NAN), 3.0);
        assert_eq!(UniformTable::new(0.0, 1.0, &[7.0]).at(5.0), 7.0);
        assert_eq!(SortedTable::new(vec![0.0, 0.0], vec![1.0, 2.0]), None);
    }

    proptest! {
        #[test]
        fn both_kinds_of_table_agree(
            values in prop::collection::vec(-1.0..1.0f64, 1..50),
            q in -20.0..20.0f64,
        ) {
            let step = 0.25;
            let places = (0..values.len()).map(|k| -3.0 + step * k as f64).collect();
            let uniform = UniformTable::new(-3.0, step, &values);
            let sorted = SortedTable::new(places, values).unwrap();
            prop_assert!((uniform.at(q) - sorted.at(q)).abs() < 1e-13);
        }
    }
}
