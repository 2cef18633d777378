//! The loop of [`Block::transform`](super::Block::transform).

use crate::lanes::{LANES, Lanes3, times};
use crate::wide::Loop;

/// The loop of [`Block::transform`]: the columns go through the derivative of every sample.
pub(super) struct Carrying<'b> {
    pub(super) columns: &'b mut [Lanes3],
    pub(super) live: &'b [bool],
    pub(super) by: &'b [Lanes3; 3],
}

impl Loop for Carrying<'_> {
    type Output = ();

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "see Loop")]
    fn run(self) {
        let [mx, my, mz] = self.by;
        for (column, _) in self.columns.iter_mut().zip(self.live).filter(|c| *c.1) {
            let [cx, cy, cz] = column;
            for i in 0..LANES {
                let rows = [mx, my, mz].map(|row| [row[0][i], row[1][i], row[2][i]]);
                [cx[i], cy[i], cz[i]] = times(rows, [cx[i], cy[i], cz[i]]);
            }
        }
    }
}
