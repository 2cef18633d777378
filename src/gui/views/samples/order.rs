//! The order of the rows: as measured, or by a column. Sorted once, not in every frame.

use std::sync::Arc;

use egui::{Id, Ui};

use crate::gui::workbench::Workbench;

/// What the rows can be sorted by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum By {
    /// The sample's number: the order of measuring.
    #[default]
    Number,
    Angle,
    Before,
    After,
    /// How far outside the tolerance, those excluded last.
    Mark,
}

impl By {
    /// In the order of the columns.
    pub(super) const ALL: [Self; 5] = [
        Self::Number,
        Self::Angle,
        Self::Before,
        Self::After,
        Self::Mark,
    ];

    fn value(self, workbench: &Workbench, sample: usize) -> f64 {
        let loaded_session = workbench.loaded_session();
        let before = loaded_session.before.length_mm[sample];
        let after = workbench.answer().map(|a| a.lengths_mm[sample]);
        match self {
            Self::Number => sample as f64,
            Self::Angle => loaded_session.q(sample),
            Self::Before => before,
            Self::After => after.unwrap_or(f64::NAN),
            Self::Mark => after.unwrap_or(before),
        }
    }
}

/// How the rows are sorted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Sorting {
    pub(super) by: By,
    pub(super) descending: bool,
}

impl Sorting {
    /// After a click on the head of this column: the largest first, then the smallest, then the
    /// order of measuring.
    pub(super) fn after_click(self, by: By) -> Self {
        let first = by != By::Number;
        match (self.by == by, self.descending == first) {
            (false, _) => Self {
                by,
                descending: first,
            },
            (true, true) => Self {
                by,
                descending: !first,
            },
            (true, false) => Self::default(),
        }
    }
}

/// What an order depends on.
#[derive(Clone, Copy, PartialEq, Default)]
struct Of {
    loaded_session: usize,
    identified: usize,
    sorting: Sorting,
}

/// The samples in the order of their rows.
#[derive(Clone, Default)]
pub(super) struct Rows {
    of: Of,
    /// `None`: as they were measured.
    order: Option<Arc<Vec<u32>>>,
}

impl Rows {
    /// The present order, sorted anew only where something that it depends on has changed.
    pub(super) fn of(ui: &Ui, id: Id, workbench: &Workbench, sorting: Sorting) -> Self {
        let outcome = workbench
            .last_outcome()
            .filter(|_| workbench.answer().is_some());
        let of = Of {
            loaded_session: Arc::as_ptr(workbench.loaded_session()) as usize,
            identified: outcome.map_or(0, |outcome| Arc::as_ptr(outcome) as usize),
            sorting,
        };
        let kept: Option<Self> = ui.data(|data| data.get_temp(id));
        if let Some(kept) = kept.filter(|kept| kept.of == of) {
            return kept;
        }
        let order = (sorting != Sorting::default()).then(|| {
            let n = u32::try_from(workbench.loaded_session().len()).unwrap_or(u32::MAX);
            let keyed = (0..n).map(|i| (sorting.by.value(workbench, i as usize), i));
            let mut keyed: Vec<(f64, u32)> = keyed.collect();
            // What has no value stands last either way.
            keyed.sort_by(|a, b| {
                let (a, b) = (a.0, b.0);
                let values = if sorting.descending {
                    b.total_cmp(&a)
                } else {
                    a.total_cmp(&b)
                };
                a.is_nan().cmp(&b.is_nan()).then(values)
            });
            Arc::new(keyed.into_iter().map(|(_, i)| i).collect())
        });
        let rows = Self { of, order };
        ui.data_mut(|data| data.insert_temp(id, rows.clone()));
        rows
    }

    /// The sample of a row.
    pub(super) fn sample(&self, row: usize) -> usize {
        let order = self.order.as_ref().and_then(|order| order.get(row));
        order.map_or(row, |sample| *sample as usize)
    }

    /// The row of a sample.
    pub(super) fn row(&self, sample: usize) -> usize {
        let order = self.order.as_ref();
        let row = order.and_then(|order| order.iter().position(|s| *s as usize == sample));
        row.unwrap_or(sample)
    }
}
