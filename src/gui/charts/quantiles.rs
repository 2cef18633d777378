//! Whether what is left is spread like noise: each sample's residual over the residual's rank, as a
//! quantile of the normal distribution (Wilk & Gnanadesikan 1968).
//!
//! ```text
//! z_i = Φ⁻¹((i − ½) / n),      the line through both quartiles has the slope σ
//! ```

use statrs::function::erf::erf_inv;

use super::{
    About, ChartChoice, ChartKind, ChartPlaceholder, HoverTarget, Samples, Scene, Shown, of_noise,
};
use crate::gui::cache::{Work, WorkKey};
use crate::gui::core::loaded_session::Component;
use crate::gui::help::Word;
use crate::present::chart::{
    Axis, Chart, ColourRole, Entry, Form, Item, LEAST_SPAN, LegendSymbol, Mark,
};
use crate::present::table::{Cell, Table};

/// Marks in the middle of the chart, and at each of its ends.
const MOST: usize = 400;
const ENDS: usize = 40;
/// Standard deviations from the lower to the upper quartile.
const QUARTILES: f64 = 1.348_979_500_392_163_5;

pub(crate) struct Quantiles;

/// Samples in ascending order of what is left: which, its normal quantile, and how much, mm.
struct Ranked(Vec<(usize, f64, f64)>);

impl ChartKind for Quantiles {
    fn about(&self) -> About {
        let names = [phrase!("quantiles"), phrase!("Normal quantiles")];
        let word = Word {
            name: phrase!("Normal quantiles"),
            means: phrase!(
                "Each sample's residual over the place that noise would give it. On the line there is nothing but noise; ends that turn away from it are outliers, a bend or a step in the middle is an error that the model lacks"
            ),
        };
        About::new("normal quantiles", names, word, ChartChoice::Component)
    }

    fn is_offered(&self, scene: &Scene) -> bool {
        scene.answer().is_some() && !scene.loaded_session.is_empty()
    }

    fn work(&self, scene: &Scene) -> Option<Work> {
        let component = scene.component;
        let key = WorkKey::Chart(self.about().id, component, Vec::new());
        Some(Work::new(key, move |given| {
            let usable = given.usable();
            let left = given.values(&usable, component).1.unwrap_or_default();
            Ranked::of(usable.into_iter().zip(left))
        }))
    }

    fn show<'a>(&self, scene: &'a Scene) -> Result<Shown<'a>, ChartPlaceholder> {
        let ranked: &Ranked = scene.found().ok_or_else(ChartPlaceholder::yet)?;
        if scene.component == Component::Length || ranked.0.len() < 4 {
            return Err(ChartPlaceholder::new(
                say!("Nothing to compare with the normal distribution"),
                say!("Choose a component that has a sign, of four samples or more"),
            ));
        }
        let name = scene.component.name();
        let sigma = scene.units.length(ranked.line().1);
        Ok(Shown {
            chart: ranked.drawn(scene),
            name: say!("normal quantiles, {name}", name),
            description: say!(
                "{name} residuals of {samples} samples over normal quantiles; the middle half is spread like noise of {sigma}",
                name,
                samples = scene.usable().len(),
                sigma
            ),
            pointed: HoverTarget::Samples(Box::new((scene, ranked))),
        })
    }

    fn numbers(&self, scene: &Scene) -> Table {
        let component = scene.component.name();
        let mut table = Table::headed(format!("sample | normal quantile | {component} after, mm"));
        let ranked: Option<&Ranked> = scene.found();
        for (sample, z, mm) in ranked.iter().flat_map(|ranked| &ranked.0) {
            table.row([Cell::from(sample + 1), (*z).into(), (*mm).into()]);
        }
        table
    }
}

impl Ranked {
    fn of(samples: impl Iterator<Item = (usize, f64)>) -> Self {
        let mut sorted: Vec<(usize, f64)> = samples.filter(|s| s.1.is_finite()).collect();
        sorted.sort_unstable_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
        let n = sorted.len();
        let z = |i: usize| {
            let part = (i as f64 + 0.5) / n as f64;
            std::f64::consts::SQRT_2 * erf_inv(2.0 * part - 1.0)
        };
        let step = n.div_ceil(MOST).max(1);
        let shown = |i: &usize| i.is_multiple_of(step) || *i < ENDS || i + ENDS >= n;
        let all = (0..n).filter(shown);
        Self(all.map(|i| (sorted[i].0, z(i), sorted[i].1)).collect())
    }

    /// Where the line through the quartiles is at the median, and its slope, mm.
    fn line(&self) -> (f64, f64) {
        let at = |z: f64| {
            let above = self.0.partition_point(|s| s.1 < z);
            let above = above.clamp(1, self.0.len() - 1);
            let [(_, from, a), (_, to, b)] = [self.0[above - 1], self.0[above]];
            a + (b - a) * (z - from) / (to - from)
        };
        let [low, high] = [-0.5, 0.5].map(|part| at(part * QUARTILES));
        (0.5 * (low + high), (high - low) / QUARTILES)
    }

    fn drawn(&self, scene: &Scene) -> Chart {
        let value = |mm: f64| scene.units.length_value(mm);
        let (middle, sigma) = self.line();
        let far = self.0.iter().map(|s| s.1.abs()).fold(0.5, f64::max) * 1.05;
        let largest = self.0.iter().map(|s| s.2.abs()).fold(LEAST_SPAN, f64::max);
        let high = value(1.08 * largest.max(middle.abs()));
        let line = [-far, far].map(|z| [z, value(middle + sigma * z)]);
        let mark = |(_, z, mm): &(usize, f64, f64)| Mark {
            at: [*z, value(*mm)],
            form: Form::Disc,
        };
        let name = scene.component.name();
        Chart {
            title: say!("{name} residuals over normal quantiles", name),
            across: Axis::numbers(say!("what noise alone would be, σ")),
            upwards: Axis::numbers(format!("{name}, {}", scene.units.length_name())),
            bounds: [[-far, -high], [far, high]],
            items: vec![
                Item::Line(line.to_vec(), ColourRole::Noise, 1.6, true),
                Item::Marks(self.0.iter().map(mark).collect(), ColourRole::After, true),
            ],
            legend: vec![
                Entry::after(LegendSymbol::Mark(Form::Disc)),
                of_noise(say!("noise alone")),
            ],
            note: say!(
                "the line has the slope of σ = {sigma}",
                sigma = scene.units.length(sigma)
            ),
        }
    }
}

impl Samples for (&Scene, &Ranked) {
    fn marks(&self, sample: usize) -> Vec<[f64; 2]> {
        let here = self.1.0.iter().filter(|s| s.0 == sample);
        here.map(|s| [s.1, self.0.units.length_value(s.2)])
            .collect()
    }

    fn near(&self, [from, to]: [f64; 2], _: [f64; 2]) -> Vec<usize> {
        let here = self.1.0.iter().filter(|s| from <= s.1 && s.1 <= to);
        here.map(|s| s.0).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_lies_on_a_line_with_the_slope_of_its_sigma_and_an_outlier_does_not() {
        let n = 999_u32;
        let z = |i: u32| 2.0 * (f64::from(i) + 0.5) / f64::from(n) - 1.0;
        let noise = |i: u32| 0.03 * std::f64::consts::SQRT_2 * erf_inv(z(i));
        // In no order, and one of them wrong.
        let value = |i: u32| if i == 7 { 0.9 } else { noise(i * 500 % n) };
        let ranked = Ranked::of((0..n).map(|i| (i as usize, value(i))));
        let (middle, sigma) = ranked.line();
        assert!(
            middle.abs() < 1e-4 && (sigma - 0.03).abs() < 2e-4,
            "{middle} {sigma}"
        );
        let off = |s: &&(usize, f64, f64)| (s.2 - middle - sigma * s.1).abs() > 0.1;
        let found: Vec<usize> = ranked.0.iter().filter(off).map(|s| s.0).collect();
        assert_eq!(found, [7]);
    }
}
