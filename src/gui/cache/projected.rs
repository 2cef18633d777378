//! Samples as they lie on the plane that is looked at, however many there are: which is under the pointer, and over
//! how much of it they are spread.

/// Which sample is under the pointer: a k-d tree over the projected points.
///
/// The tree is the sorted array itself: the middle of a range divides it by x, the middles of its
/// halves by y, and so on (Bentley 1975). It is built in the background in n log n; a question
/// costs about log n wherever the samples are, also where one of them is far away from all others,
/// which would ruin a grid.
#[derive(Debug, Clone, Default)]
pub(crate) struct Nearest {
    points: Vec<([f64; 2], u32)>,
}

impl Nearest {
    /// The index of these points and their samples; points that are not finite are left out.
    pub(crate) fn new(points: impl Iterator<Item = ([f64; 2], u32)>) -> Self {
        let finite = |p: &([f64; 2], u32)| p.0.iter().all(|v| v.is_finite());
        let mut points: Vec<_> = points.filter(finite).collect();
        divide(&mut points, 0);
        Self { points }
    }

    /// The sample nearest to `to`, of those within `reach` of it.
    pub(crate) fn find(&self, to: [f64; 2], reach: f64) -> Option<usize> {
        let mut best = (reach * reach, None);
        search(&self.points, 0, to, &mut best);
        best.1.map(|sample: u32| sample as usize)
    }
}

fn divide(points: &mut [([f64; 2], u32)], axis: usize) {
    if points.len() < 2 {
        return;
    }
    let middle = points.len() / 2;
    // The sample's number decides among equals: the same tree every time.
    points.select_nth_unstable_by(middle, |a, b| {
        a.0[axis].total_cmp(&b.0[axis]).then(a.1.cmp(&b.1))
    });
    let (low, high) = points.split_at_mut(middle);
    divide(low, 1 - axis);
    divide(&mut high[1..], 1 - axis);
}

fn search(points: &[([f64; 2], u32)], axis: usize, to: [f64; 2], best: &mut (f64, Option<u32>)) {
    if points.is_empty() {
        return;
    }
    let middle = points.len() / 2;
    let (at, sample) = points[middle];
    let squared = (at[0] - to[0]).powi(2) + (at[1] - to[1]).powi(2);
    if squared < best.0 || (squared == best.0 && best.1.is_none_or(|other| sample < other)) {
        *best = (squared, Some(sample));
    }
    let off = to[axis] - at[axis];
    let (low, high) = (&points[..middle], &points[middle + 1..]);
    let (near, far) = if off < 0.0 { (low, high) } else { (high, low) };
    search(near, 1 - axis, to, best);
    if off * off < best.0 {
        search(far, 1 - axis, to, best);
    }
}

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

    /// Points that no rule arranged, with many doubles.
    fn scattered(count: u32) -> Vec<([f64; 2], u32)> {
        let mut state = 7_u32;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 22) - 512.0
        };
        (0..count).map(|k| ([next(), next()], k)).collect()
    }

    #[test]
    fn it_finds_what_a_look_at_every_point_finds() {
        let points = scattered(5_000);
        let index = Nearest::new(points.iter().copied());
        for (to, _) in scattered(300) {
            let to = [to[0] + 0.3, 1.1 * to[1] - 0.2];
            let distance = |sample: usize| {
                let at = points[sample].0;
                (at[0] - to[0]).hypot(at[1] - to[1])
            };
            let nearest = (0..points.len())
                .map(distance)
                .fold(f64::INFINITY, f64::min);
            let found = index.find(to, 1e6).expect("there are points");
            assert!((distance(found) - nearest).abs() < 1e-9);
        }
    }

    #[test]
    fn out_of_reach_nothing_is_found() {
        let index = Nearest::new([([0.0, 0.0], 3), ([f64::NAN, 0.0], 4)].into_iter());
        assert_eq!(index.find([3.0, 4.0], 4.9), None);
        assert_eq!(index.find([3.0, 4.0], 5.1), Some(3));
        assert_eq!(Nearest::default().find([0.0, 0.0], 1.0), None);
    }

    #[test]
    fn a_million_points_in_one_place_do_not_hold_it_up() {
        let index = Nearest::new((0..1_000_000).map(|k| ([1.0, 1.0], k)));
        assert!(index.find([2.0, 1.0], 5.0).is_some());
    }

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
