//! Over how much of the plane that is looked at samples are spread, however many there are.

/// Cells along the longer side of where samples lie, in which they are counted.
const COUNTED: usize = 32;
/// The last of them lie on the edge of one cell more.
const SIDE: usize = COUNTED + 1;
/// So many samples show where all of them lie.
pub(crate) const SOME: usize = 2_048;

/// How many cells of a grid the samples lie in, whatever the size of the cells:
///
/// ```text
/// N(cell) = N(side) · (side / cell)^d,   d = log₂( N(side) / N(2 side) )
/// ```
///
/// the box dimension of where they lie: 1 along a path, 2 over an area.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Extent {
    side_mm: f64,
    cells: f64,
    dimension: f64,
}

impl Extent {
    /// Of some points that show the whole, mm; `None` where they are one.
    pub(crate) fn of(points_mm: &[[f64; 2]]) -> Option<Self> {
        let end = |axis: usize, pick: fn(f64, f64) -> f64, start: f64| {
            points_mm.iter().map(|p| p[axis]).fold(start, pick)
        };
        let low = [0, 1].map(|k| end(k, f64::min, f64::INFINITY));
        let high = [0, 1].map(|k| end(k, f64::max, f64::NEG_INFINITY));
        let long_mm = f64::max(high[0] - low[0], high[1] - low[1]);
        if !(long_mm.is_finite() && long_mm > 0.0) {
            return None;
        }
        let side_mm = long_mm / COUNTED as f64;
        let count = |side_mm: f64| {
            let mut seen = [false; SIDE * SIDE];
            for p in points_mm {
                #[allow(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "a place on a grid that begins at the lowest of them"
                )]
                let [across, up] = [0, 1].map(|k| ((p[k] - low[k]) / side_mm) as usize);
                seen[up.min(COUNTED) * SIDE + across.min(COUNTED)] = true;
            }
            seen.iter().filter(|seen| **seen).count() as f64
        };
        let cells = count(side_mm);
        let dimension = (cells / count(2.0 * side_mm)).log2().clamp(0.0, 2.0);
        Some(Self {
            side_mm,
            cells,
            dimension,
        })
    }

    /// How many cells of this size there are; at least one.
    pub(crate) fn cells(&self, side_mm: f64) -> f64 {
        let cells = self.cells * (self.side_mm / side_mm.max(1e-9)).powf(self.dimension);
        cells.max(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_counted_along_a_path_and_over_an_area() {
        let turn = |k: usize| (k as f64 * 0.618_034 * std::f64::consts::TAU).sin_cos();
        let ring: Vec<[f64; 2]> = (0..SOME)
            .map(turn)
            .map(|(x, y): (f64, f64)| [250.0 * x, 250.0 * y])
            .collect();
        let ring = Extent::of(&ring).expect("they are many");
        // A circle of 1571 mm crosses 4/π cells to its length in cells.
        for side_mm in [2.0, 15.0, 40.0] {
            let expected = 8.0 * 250.0 / side_mm;
            let found = ring.cells(side_mm);
            assert!((found / expected - 1.0).abs() < 0.25, "{found} {expected}");
        }
        let area: Vec<[f64; 2]> = (0..SOME)
            .map(|k| [1.0, 0.618_034, 0.754_877_7].map(|step| (k as f64 * step).fract() * 320.0))
            .map(|[_, x, y]| [x, y])
            .collect();
        let area = Extent::of(&area).expect("they are many");
        for side_mm in [5.0_f64, 10.0, 20.0] {
            let expected = (320.0 / side_mm).powi(2);
            let found = area.cells(side_mm);
            assert!((found / expected - 1.0).abs() < 0.35, "{found} {expected}");
        }
        assert_eq!(Extent::of(&[[1.0, 2.0]; 5]), None);
        assert_eq!(Extent::of(&[]), None);
    }
}
