//! The error between the samples: a map of the root mean square deviation over the plane.
//!
//! Samples are averaged by cell, so that a place measured a thousand times counts as much as one
//! measured once, and the cells smoothed by a normalised Gaussian (Knutsson & Westin 1993):
//!
//! ```text
//! m(p) = Σ w(p − c) m(c) / Σ w(p − c),   w(r) = exp(−r² / 2σ²),   opacity = 1 − exp(−2.5 max w)
//! ```
//!
//! over the cells c that hold a sample; the nearest of them decides how far the map reaches, however
//! many there are. A cell keeps three mean products, |b|², b·a and |a|² of the deviations before and after: the map at any blend t between them is exactly
//! √((1−t)² |b|² + 2t(1−t) b·a + t² |a|²), so that blending needs no new map. Cells follow the
//! nominal robot's extent: a sample that was measured far away cannot stretch the map.

use crate::gui::core::answer::Answer;
use crate::gui::core::loaded_session::LoadedSession;
use crate::gui::view::Plane;
use crate::lanes::dot;
use crate::numeric::{single, whole};

/// Cells along the longer side of what the robot reached.
const CELLS: f64 = 144.0;
/// The Gaussian's σ, cells: places less than 2σ apart run into one another, on the circle of an axis (π·144 cells) 35 and
/// more.
pub(crate) const SIGMA: f64 = 0.045 * CELLS;
/// The Gaussian ends at so many σ.
const END: f64 = 4.5;

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Heat {
    /// The middle of the first cell, mm.
    pub(crate) first_mm: [f64; 2],
    /// Width of a cell, mm.
    pub(crate) cell_mm: f64,
    /// Number of cells to the right and up.
    pub(crate) size: [usize; 2],
    /// |b|², b·a, |a|², mm², and the opacity, row by row from below.
    pub(crate) cells: Vec<[f32; 4]>,
}

impl Heat {
    /// The map of a session, and of an answer; `None` where no sample can be used.
    pub(crate) fn of(
        loaded_session: &LoadedSession,
        answer: Option<&Answer>,
        plane: Plane,
    ) -> Option<Self> {
        let [right, up] = plane.axes();
        let usable = &loaded_session.overview.usable;
        let [low, high] = loaded_session.overview.nominal_mm;
        let extent = [right, up].map(|k| high[k] - low[k]);
        let side = extent[0].max(extent[1]).max(1.0);
        if usable.is_empty() || !side.is_finite() {
            return None;
        }
        let cell_mm = side / CELLS;
        let margin = (END * SIGMA).ceil();
        let size = extent.map(|e| whole((e / cell_mm).ceil() + 2.0 * margin) + 1);
        let first_mm = [low[right] - margin * cell_mm, low[up] - margin * cell_mm];
        let mut sums = vec![[0.0_f64; 5]; size[0] * size[1]];
        for sample in usable.iter().map(|sample| *sample as usize) {
            let at = loaded_session.measured(sample);
            let cell = |k: usize, axis: usize| ((at[axis] - first_mm[k]) / cell_mm).round();
            let (x, y) = (cell(0, right), cell(1, up));
            if !(x >= 0.0 && y >= 0.0 && x < size[0] as f64 && y < size[1] as f64) {
                continue;
            }
            let before = loaded_session.deviation_before(sample);
            let after = answer.map_or([0.0; 3], |a| a.deviation_after(sample));
            let products = [dot(before, before), dot(before, after), dot(after, after)];
            if products.iter().all(|p| p.is_finite()) {
                let cell = whole(x) + size[0] * whole(y);
                for k in 0..3 {
                    sums[cell][k] += products[k];
                }
                sums[cell][3] += 1.0;
            }
        }
        for sum in &mut sums {
            if sum[3] > 0.0 {
                let [bb, ba, aa] = [0, 1, 2].map(|k| sum[k] / sum[3]);
                *sum = [bb, ba, aa, 1.0, 1.0];
            }
        }
        Some(Self {
            first_mm,
            cell_mm,
            size,
            cells: smoothed(&sums, size),
        })
    }
}

/// Sums, each with its weight and the largest weight in the last places, smoothed along x and then
/// along y: the Gaussian is the product of both.
fn smoothed(sums: &[[f64; 5]], size: [usize; 2]) -> Vec<[f32; 4]> {
    let reach = whole((END * SIGMA).ceil());
    let weight = |k: usize| (-0.5 * (k as f64 / SIGMA).powi(2)).exp();
    let weights: Vec<f64> = (0..=reach).map(weight).collect();
    let along = |cells: &[[f64; 5]], step: usize, length: usize, other: usize| {
        let mut out = vec![[0.0; 5]; cells.len()];
        for line in 0..cells.len() / length {
            let first = line * other;
            for from in 0..length {
                let cell = cells[first + from * step];
                // Most cells are empty.
                if cell[3] == 0.0 {
                    continue;
                }
                for to in from.saturating_sub(reach)..=(from + reach).min(length - 1) {
                    let w = weights[to.abs_diff(from)];
                    let sum = &mut out[first + to * step];
                    for k in 0..4 {
                        sum[k] += w * cell[k];
                    }
                    sum[4] = sum[4].max(w * cell[4]);
                }
            }
        }
        out
    };
    let across = along(sums, 1, size[0], size[0]);
    let both = along(&across, size[0], size[1], 1);
    both.into_iter().map(normalised).collect()
}

fn normalised([bb, ba, aa, weight, largest]: [f64; 5]) -> [f32; 4] {
    if weight < 1e-9 {
        return [0.0; 4];
    }
    let opacity = 1.0 - (-2.5 * largest).exp();
    [bb / weight, ba / weight, aa / weight, opacity].map(single)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::testing::{lamp, workbench, workbench_on};

    impl Heat {
        /// The mean products and the opacity at a point of the plane, mm, between the middles of the
        /// cells linearly; nothing outside.
        fn at(&self, p_mm: [f64; 2]) -> [f64; 4] {
            let place = |k: usize| (p_mm[k] - self.first_mm[k]) / self.cell_mm;
            let (x, y) = (place(0), place(1));
            let corner = [x.floor(), y.floor()];
            let inside = |k: usize| corner[k] >= 0.0 && corner[k] + 1.0 < self.size[k] as f64;
            if !inside(0) || !inside(1) {
                return [0.0; 4];
            }
            let first = whole(corner[0]) + self.size[0] * whole(corner[1]);
            let (u, v) = (x - corner[0], y - corner[1]);
            let cell = |k: usize| self.cells[k].map(f64::from);
            let (a, b) = (cell(first), cell(first + 1));
            let (c, d) = (cell(first + self.size[0]), cell(first + self.size[0] + 1));
            std::array::from_fn(|k| {
                (1.0 - v) * ((1.0 - u) * a[k] + u * b[k]) + v * ((1.0 - u) * c[k] + u * d[k])
            })
        }
    }

    /// The root mean square deviation, mm, that these products give at a blend from before to after.
    fn blended([bb, ba, aa, _]: [f64; 4], t: f64) -> f64 {
        let squared = (1.0 - t).powi(2) * bb + 2.0 * t * (1.0 - t) * ba + t * t * aa;
        squared.max(0.0).sqrt()
    }

    #[test]
    fn a_constant_error_is_the_same_everywhere_it_can_be_seen() {
        // Only a zero offset: the same length at every sample.
        let workbench = workbench();
        let heat =
            Heat::of(workbench.loaded_session(), None, Plane::Xy).expect("there are samples");
        let expected = workbench.loaded_session().gap_before.expect("a gap").rms_mm;
        let seen = heat.cells.iter().filter(|c| c[3] > 0.05);
        for cell in seen {
            let rms = blended(cell.map(f64::from), 0.0);
            assert!((rms - expected).abs() < 0.05 * expected, "{rms} {expected}");
        }
    }

    #[test]
    fn it_fades_away_from_the_samples() {
        let workbench = workbench();
        let loaded_session = workbench.loaded_session();
        let heat = Heat::of(loaded_session, None, Plane::Xy).expect("there are samples");
        for sample in 0..loaded_session.len() {
            let [x, y, _] = loaded_session.measured(sample);
            assert!(heat.at([x, y])[3] > 0.85);
            assert!(heat.at([0.5 * x, 0.5 * y])[3] < 0.01);
        }
        assert_eq!(heat.at([1e9, f64::NAN]), [0.0; 4]);
    }

    #[test]
    fn places_some_way_apart_run_into_one_another() {
        let workbench = workbench_on(lamp(12.0, &[]));
        let loaded_session = workbench.loaded_session();
        let heat = Heat::of(loaded_session, None, Plane::Xy).expect("there are samples");
        let [a, b] = [4, 5].map(|sample| loaded_session.measured(sample));
        let apart = (a[0] - b[0]).hypot(a[1] - b[1]);
        assert!(apart > 0.08 * 2.0 * loaded_session.arm_mm, "{apart}");
        let between = heat.at([0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])]);
        assert!(between[3] > 0.6, "{between:?}");
    }

    #[test]
    fn a_place_measured_often_counts_as_one_measured_once() {
        let workbench = workbench();
        let once =
            Heat::of(workbench.loaded_session(), None, Plane::Xy).expect("there are samples");
        let workbench = workbench_on(lamp(0.05, &[]));
        let often =
            Heat::of(workbench.loaded_session(), None, Plane::Xy).expect("there are samples");
        let at = workbench.loaded_session().measured(40);
        let [a, b] = [&once, &often].map(|h| blended(h.at([at[0], at[1]]), 0.0));
        assert!((a - b).abs() < 0.1 * a, "{a} {b}");
    }

    #[test]
    fn blending_is_exact_between_before_and_after() {
        let mut workbench = workbench();
        workbench.execute(|bench| bench.identify(None));
        workbench.receive();
        let answer = workbench.answer().expect("identified");
        let heat = Heat::of(workbench.loaded_session(), Some(answer), Plane::Xy).expect("samples");
        let (before, after) = ([3.0, -1.0, 0.5], [0.2, 0.4, -0.1]);
        let products = [
            dot(before, before),
            dot(before, after),
            dot(after, after),
            1.0,
        ];
        let t = 0.3;
        let mixed: [f64; 3] = std::array::from_fn(|k| (1.0 - t) * before[k] + t * after[k]);
        assert!((blended(products, t) - dot(mixed, mixed).sqrt()).abs() < 1e-12);
        let at = workbench.loaded_session().measured(7);
        let cell = heat.at([at[0], at[1]]);
        assert!(blended(cell, 0.0) > 10.0 && blended(cell, 1.0) < 0.2);
    }
}
