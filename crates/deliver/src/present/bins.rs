//! How many samples deviate by how much.
//!
//! Bins are as wide as Freedman & Diaconis (1981) say, between 6 and 60 of them:
//!
//! ```text
//! h = 2 (Q₃ − Q₁) / ∛n
//! ```
//!
//! for the narrower of before and after. A sample that is many quartiles off must not leave all
//! others in one bin: the bins end ten quartile ranges beyond the quartiles, and what lies further
//! out is counted in the first or the last one.

use statrs::function::erf::erf;

use crate::numeric::Ascending;
use crate::numeric::whole;
use crate::present::chart::LEAST_SPAN;

const FEWEST: f64 = 6.0;
const MOST: f64 = 60.0;
/// Bins end so many quartile ranges beyond the quartiles.
const FAR: f64 = 10.0;

/// Equal bins side by side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bins {
    /// Where the first begins, mm.
    pub(crate) from_mm: f64,
    pub width_mm: f64,
    /// How many.
    pub count: usize,
}

impl Bins {
    /// The bin that a value is in; those beyond the ends are in the first or the last.
    pub fn of(&self, mm: f64) -> Option<usize> {
        if !mm.is_finite() {
            return None;
        }
        let place = ((mm - self.from_mm) / self.width_mm).floor();
        Some(whole(place).min(self.count - 1))
    }

    /// Where a bin begins and ends, mm.
    pub fn ends(&self, bin: usize) -> [f64; 2] {
        [0, 1].map(|k| self.from_mm + self.width_mm * (bin + k) as f64)
    }

    /// Where the first begins and the last ends, mm.
    pub fn span(&self) -> [f64; 2] {
        [self.ends(0)[0], self.ends(self.count - 1)[1]]
    }

    fn counts(&self, values_mm: &[f64]) -> Vec<usize> {
        let mut counts = vec![0; self.count];
        for bin in values_mm.iter().filter_map(|mm| self.of(*mm)) {
            counts[bin] += 1;
        }
        counts
    }
}

/// One picture: bins that suit it, and how many samples are in each.
#[derive(Debug, Clone, PartialEq)]
pub struct Counted {
    pub bins: Bins,
    /// Of the nominal robot's deviations; `None` where they are left out.
    pub before: Option<Vec<usize>>,
    /// Of what is left.
    pub after: Option<Vec<usize>>,
    /// How many values lie beyond the ends.
    pub beyond: usize,
}

#[derive(Debug, Clone, PartialEq)]
pub struct Distribution {
    /// Before and after, as far as there is one.
    pub(crate) both: Counted,
    /// What is left alone.
    pub(crate) only_after: Option<Counted>,
    /// Sizes before, in ascending order.
    pub sizes_before: Ascending,
    pub sizes_after: Option<Ascending>,
}

impl Distribution {
    /// Of values before, and after where they are known; `None` where there is none. A length
    /// begins at zero.
    pub fn new(before: &[f64], after: Option<&[f64]>, length: bool) -> Option<Self> {
        let sizes = |values: &[f64]| {
            let sizes: Vec<f64> = values.iter().map(|v| v.abs()).collect();
            Ascending::new(&sizes)
        };
        Some(Self {
            both: counted(Some(before), after, length)?,
            only_after: after.and_then(|after| counted(None, Some(after), length)),
            sizes_before: sizes(before),
            sizes_after: after.map(sizes),
        })
    }

    /// The picture that is looked at.
    pub fn shown(&self, only_after: bool) -> &Counted {
        let alone = self.only_after.as_ref().filter(|_| only_after);
        alone.unwrap_or(&self.both)
    }
}

/// What is known of the spread of some values.
struct Spread {
    n: f64,
    low: f64,
    high: f64,
    quartiles: [f64; 2],
}

impl Spread {
    fn of(values_mm: &[f64]) -> Option<Self> {
        let finite = values_mm.iter().copied().filter(|v| v.is_finite());
        let mut sorted: Vec<f64> = finite.collect();
        sorted.sort_unstable_by(f64::total_cmp);
        let last = sorted.len().checked_sub(1)?;
        let at = |part: f64| sorted[whole(part * last as f64)];
        Some(Self {
            n: sorted.len() as f64,
            low: sorted[0],
            high: sorted[last],
            quartiles: [at(0.25), at(0.75)],
        })
    }

    fn range(&self) -> f64 {
        self.quartiles[1] - self.quartiles[0]
    }

    /// Where the bins end.
    fn ends(&self) -> [f64; 2] {
        let far = FAR * self.range();
        if far <= 0.0 {
            return [self.low, self.high];
        }
        [
            self.low.max(self.quartiles[0] - far),
            self.high.min(self.quartiles[1] + far),
        ]
    }
}

fn counted(before: Option<&[f64]>, after: Option<&[f64]>, length: bool) -> Option<Counted> {
    let series = || [before, after].into_iter().flatten();
    let spreads: Vec<Spread> = series().filter_map(Spread::of).collect();
    let ends = spreads.iter().map(Spread::ends);
    let [mut low, mut high] = ends.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])?;
    if length {
        low = 0.0;
    }
    let least = (LEAST_SPAN - (high - low)).max(0.0);
    high += 0.5 * least;
    low -= if length { 0.0 } else { 0.5 * least };
    let widths = spreads.iter().map(|s| 2.0 * s.range() / s.n.cbrt());
    let width = widths.filter(|w| *w > 0.0).fold(f64::INFINITY, f64::min);
    let count = ((high - low) / width).ceil();
    let count = if count.is_finite() { count } else { FEWEST };
    let count = count.clamp(FEWEST, MOST);
    let bins = Bins {
        from_mm: low,
        width_mm: (high - low) / count,
        count: whole(count),
    };
    let [low, high] = bins.span();
    let slack = 1e-9 * (high - low);
    let outside = |v: &&f64| **v < low - slack || **v > high + slack;
    Some(Counted {
        bins,
        before: before.map(|values| bins.counts(values)),
        after: after.map(|values| bins.counts(values)),
        beyond: series().flatten().filter(outside).count(),
    })
}

/// How noise alone is spread.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NoiseCurve {
    /// One standard deviation of a coordinate, mm.
    pub sigma_mm: f64,
    /// Of how many coordinates the length is; 1: of a component.
    pub axes: usize,
}

impl NoiseCurve {
    /// The part of all samples that noise alone brings below `mm`: normal for a component,
    /// Rayleigh or Maxwell for a length in two or three coordinates.
    pub fn below(self, mm: f64) -> f64 {
        let z = mm / self.sigma_mm;
        match self.axes {
            1 => 0.5 * (1.0 + erf(z / std::f64::consts::SQRT_2)),
            _ if z <= 0.0 => 0.0,
            2 => 1.0 - (-0.5 * z * z).exp(),
            _ => {
                let tail = (2.0 / std::f64::consts::PI).sqrt() * z * (-0.5 * z * z).exp();
                erf(z / std::f64::consts::SQRT_2) - tail
            }
        }
    }

    /// How many of `samples` a bin of this width about `mm` would hold.
    pub fn count(self, mm: f64, width_mm: f64, samples: usize) -> f64 {
        let part = self.below(mm + 0.5 * width_mm) - self.below(mm - 0.5 * width_mm);
        part * samples as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn some(n: u32, scale: f64) -> Vec<f64> {
        let value = |i: u32| f64::from(i.wrapping_mul(2_654_435_761) % 1000) / 1000.0 - 0.5;
        (0..n).map(|i| scale * value(i)).collect()
    }

    #[test]
    fn every_sample_is_counted_once() {
        let (mut before, after) = (some(500, 10.0), some(500, 0.2));
        before[3] = f64::NAN;
        before[4] = 5000.0;
        let histogram = Distribution::new(&before, Some(&after), false).expect("there are samples");
        let total = |counts: &Option<Vec<usize>>| counts.iter().flatten().sum::<usize>();
        assert_eq!(total(&histogram.both.before), 499);
        assert_eq!(total(&histogram.both.after), 500);
        assert_eq!(histogram.both.beyond, 1, "one is far off");
        let alone = histogram.shown(true);
        assert_eq!((total(&alone.before), total(&alone.after)), (0, 500));
        assert_eq!(alone.beyond, 0);
        for counted in [&histogram.both, alone] {
            assert!((6..=60).contains(&counted.bins.count));
            for (bin, ends) in (0..counted.bins.count).map(|b| (b, counted.bins.ends(b))) {
                let middle = 0.5 * (ends[0] + ends[1]);
                assert_eq!(counted.bins.of(middle), Some(bin));
            }
        }
        assert_eq!(histogram.sizes_before.within(1e9), (499, 499));
    }

    #[test]
    fn the_width_of_a_bin_is_that_of_the_rule() {
        let values = some(1000, 1.0);
        let histogram = Distribution::new(&values, None, false).expect("there are samples");
        // Evenly spread: the quartile range is a half, ∛1000 is ten.
        let width = histogram.both.bins.width_mm;
        assert!((width - 0.1).abs() < 0.01, "{width}");
    }

    #[test]
    fn equal_values_and_a_single_one_have_bins_too() {
        assert_eq!(Distribution::new(&[], None, true), None);
        assert_eq!(Distribution::new(&[f64::NAN], None, false), None);
        for values in [&[0.25][..], &[0.25; 40], &[0.0; 3]] {
            for length in [false, true] {
                let made = Distribution::new(values, None, length).expect("there are samples");
                let counts = made.both.before.expect("they are counted");
                assert_eq!(counts.iter().sum::<usize>(), values.len());
                assert_eq!(counts.iter().filter(|c| **c > 0).count(), 1);
            }
        }
    }

    #[test]
    fn the_noise_curve_holds_all_samples() {
        for axes in 1..=3 {
            let curve = NoiseCurve {
                sigma_mm: 0.03,
                axes,
            };
            let width = 0.004;
            let low = if axes == 1 { -0.2 } else { 0.0 };
            let middles = (0..200).map(|k| low + width * (f64::from(k) + 0.5));
            let sum: f64 = middles.map(|mm| curve.count(mm, width, 120)).sum();
            assert!((sum - 120.0).abs() < 1e-3, "{axes}: {sum}");
        }
        let one = NoiseCurve {
            sigma_mm: 1.0,
            axes: 1,
        };
        assert!((one.below(1.0) - one.below(-1.0) - 0.6827).abs() < 1e-4);
        // Maxwell: half of all lengths are below 1.538 σ; Rayleigh: below 1.177 σ.
        let half = |axes, z| NoiseCurve { axes, ..one }.below(z);
        assert!((half(3, 1.5382) - 0.5).abs() < 1e-4 && (half(2, 1.1774) - 0.5).abs() < 1e-4);
    }
}
