//! How many samples deviate by how much.

use std::sync::Arc;

use super::{
    About, Bars, ChartChoice, ChartKind, ChartPlaceholder, Facts, HoverTarget, Scene, Shown,
    of_noise,
};
use crate::gui::core::loaded_session::Component;
use crate::gui::help;
use crate::present::bins::{Bins, Counted, Distribution, NoiseCurve};
use crate::present::chart::{Axis, Chart, ChartText, ColourRole, Item, LegendSymbol};
use crate::present::drawing::Anchor;
use crate::present::numbers::grouped;
use crate::present::table::{Cell, Table};
use crate::sessions::Sigma;
use crate::text::capital;

/// A noise curve is drawn where a bin is at most so many standard deviations wide.
const SHARP: f64 = 3.0;
/// The noise curve is shown up to so many times the tallest bar.
const MOST_PEAK: f64 = 2.0;
/// Points of the noise curve.
const FINE: usize = 240;

pub(crate) struct Histogram;

impl ChartKind for Histogram {
    fn about(&self) -> About {
        let name = help::HISTOGRAM.name;
        About::new("histogram", name, help::HISTOGRAM, ChartChoice::Component)
    }

    fn show(&self, scene: &Arc<Scene>) -> Result<Shown, ChartPlaceholder> {
        let found = distribution(scene)?;
        Ok(Shown {
            chart: drawn(scene, &found),
            name: say!("histogram, {component}", component = scene.component.name()),
            description: describe(scene, &found),
            pointed: HoverTarget::Bars(Box::new(DrawnBars {
                scene: Arc::clone(scene),
                counted: found.shown(scene.only_after).clone(),
            })),
        })
    }

    fn numbers(&self, scene: &Scene) -> Table {
        let mut table = Table::headed("from, mm | to, mm | before | after | noise alone");
        let Ok(found) = distribution(scene) else {
            return table;
        };
        let counted = found.shown(scene.only_after);
        let noise = noise(scene);
        let samples = found.sizes_before.within(0.0).1;
        for bin in 0..counted.bins.count {
            let [from, to] = counted.bins.ends(bin);
            let of = |counts: &Option<Vec<usize>>| counts.as_ref().map(|c| c[bin]).into();
            let alone = noise.map(|n| (n.below(to) - n.below(from)) * samples as f64);
            let [before, after] = [&counted.before, &counted.after].map(of);
            table.row([Cell::from(from), to.into(), before, after, alone.into()]);
        }
        table
    }
}

fn distribution(scene: &Scene) -> Result<Distribution, ChartPlaceholder> {
    let samples: Vec<usize> = scene.usable().collect();
    let (before, after) = scene.values(&samples);
    let length = scene.component == Component::Length;
    let found = Distribution::new(&before, after.as_deref(), length);
    found.ok_or(ChartPlaceholder::new(
        capital(say!("no sample to show")),
        say!("Every sample lacks a joint value or a coordinate"),
    ))
}

/// What the pointer finds.
struct DrawnBars {
    scene: Arc<Scene>,
    counted: Counted,
}

impl DrawnBars {
    /// The component of a sample that is counted: what is left if anything is, else before.
    fn value(&self, sample: usize, after: bool) -> f64 {
        let after = after && self.scene.answer().is_some();
        self.scene.value(usize::from(after), sample)
    }
}

impl Bars for DrawnBars {
    fn at(&self, x: f64) -> Option<Facts> {
        let (units, bins) = (self.scene.units, self.counted.bins);
        let mm = x / units.length_value(1.0);
        let [low, high] = bins.span();
        let bin = (mm >= low && mm <= high).then(|| bins.of(mm)).flatten()?;
        let of = |counts: &Option<Vec<usize>>| counts.as_ref().map(|counts| counts[bin]);
        let (before, after) = (of(&self.counted.before), of(&self.counted.after));
        // What is left, unless only what was before is in this bar.
        let take_after =
            self.scene.answer().is_some() && (after != Some(0) || before.is_none_or(|n| n == 0));
        let here = |sample: &usize| bins.of(self.value(*sample, take_after)) == Some(bin);
        let [from, to] = bins.ends(bin).map(|mm| units.length_number(mm));
        let line = |name: &str, n: Option<usize>| Some((name.to_owned(), n?.to_string()));
        let lines = [line(say!("before"), before), line(say!("after"), after)];
        Some(Facts {
            title: format!("{from} … {to} {}", units.length_name()),
            lines: lines.into_iter().flatten().collect(),
            samples: self.scene.usable().filter(here).collect(),
        })
    }

    fn of(&self, sample: usize) -> Option<[f64; 2]> {
        let bin = self.counted.bins.of(self.value(sample, true))?;
        let ends = self.counted.bins.ends(bin);
        Some(ends.map(|mm| self.scene.units.length_value(mm)))
    }
}

/// How noise alone is spread in the component that is shown, where the noise is known: as the
/// instrument says, else as the residuals show it.
fn noise(scene: &Scene) -> Option<NoiseCurve> {
    let loaded_session = &scene.loaded_session;
    let planar = loaded_session.session.samples.z_mm.is_none();
    let count = if planar { 2 } else { 3 };
    let mean = |axes: [f64; 3]| {
        let squares = axes[..count].iter().map(|s| s * s).sum::<f64>();
        (squares / count as f64).sqrt()
    };
    let along = |axes: [f64; 3]| match scene.component {
        Component::X => axes[0],
        Component::Y => axes[1],
        Component::Z => axes[2],
        _ => mean(axes),
    };
    let found = || scene.answer().and_then(|a| a.identification.noise_mm);
    let sigma_mm = match loaded_session.session.instrument.sigma_mm {
        Some(Sigma::Overall(sigma)) => sigma,
        Some(Sigma::PerAxis(axes)) => along(axes),
        None => along(found()?),
    };
    let length = scene.component == Component::Length;
    (sigma_mm.is_finite() && sigma_mm > 0.0).then_some(NoiseCurve {
        sigma_mm,
        axes: if length { count } else { 1 },
    })
}

/// The noise curve, where bins are narrow enough to show it.
fn curve(scene: &Scene, bins: &Bins) -> Option<NoiseCurve> {
    noise(scene).filter(|noise| bins.width_mm <= SHARP * noise.sigma_mm)
}

fn drawn(scene: &Scene, found: &Distribution) -> Chart {
    let units = scene.units;
    let value = |mm: f64| units.length_value(mm);
    let counted = found.shown(scene.only_after);
    let bins = counted.bins;
    let series = [
        (&counted.before, ColourRole::Before, false),
        (&counted.after, ColourRole::After, true),
    ];
    let counts = series.iter().filter_map(|s| s.0.as_ref()).flatten();
    let most = counts.copied().max().unwrap_or(0).max(1) as f64;
    let mut items = Vec::new();
    // What is filled stands behind what is outlined.
    for (counts, stands, filled) in series.into_iter().rev() {
        let bar = |(bin, count): (usize, &usize)| {
            let [from, to] = bins.ends(bin).map(value);
            let gap = 0.04 * (to - from);
            (*count > 0).then_some([[from + gap, 0.0], [to - gap, *count as f64]])
        };
        let bars = counts.iter().flatten().enumerate().filter_map(bar);
        items.push(Item::Bars(bars.collect(), stands, filled));
    }
    let [low, high] = bins.span();
    let component = scene.component;
    let mut tallest = most;
    let noise = curve(scene, &bins);
    if let Some(noise) = noise {
        let samples = found.sizes_before.within(0.0).1;
        let at = |k: usize| low + (high - low) * k as f64 / FINE as f64;
        let point = |k: usize| [value(at(k)), noise.count(at(k), bins.width_mm, samples)];
        let points: Vec<[f64; 2]> = (0..=FINE).map(point).collect();
        // A curve far above all bars must not flatten them.
        let peak = points.iter().map(|p| p[1]).fold(0.0, f64::max);
        tallest = most.max(peak.min(MOST_PEAK * most));
        items.push(Item::Line(points, ColourRole::Noise, 1.8, true));
    }
    let top = 1.2 * tallest;
    if let Some(tolerance) = scene.document.tolerance_mm {
        let both = [-tolerance, tolerance];
        let ends = if component == Component::Length {
            &both[1..]
        } else {
            &both[..]
        };
        for end in ends.iter().filter(|end| **end > low && **end < high) {
            let line = vec![[value(*end), 0.0], [value(*end), top]];
            items.push(Item::Line(line, ColourRole::Tolerance, 1.6, false));
            items.push(Item::Word(ChartText {
                at: [value(*end), 0.995 * top],
                text: format!(" {} ", say!("tolerance")),
                anchor: if *end < 0.0 {
                    Anchor::End
                } else {
                    Anchor::Start
                },
                below: true,
            }));
        }
    }
    let margin = 0.02 * (high - low);
    let mut legend = scene.legend(LegendSymbol::Bar);
    if noise.is_some() {
        legend.push(of_noise(say!("noise alone")));
    }
    let name = component.name();
    Chart {
        title: title(scene),
        across: Axis::numbers(say!(
            "{name} deviation, {units}",
            name,
            units = units.length_name()
        )),
        upwards: Axis::numbers(say!("samples")),
        bounds: [[value(low - margin), 0.0], [value(high + margin), top]],
        items,
        legend,
        note: note(scene, found, counted),
    }
}

fn title(scene: &Scene) -> String {
    say!("samples by {name} deviation", name = scene.component.name())
}

fn note(scene: &Scene, found: &Distribution, counted: &Counted) -> String {
    let units = scene.units;
    let mut notes = Vec::new();
    if let Some(tolerance) = scene.document.tolerance_mm {
        let sign = match scene.component {
            Component::Length => "",
            _ => "±",
        };
        let (before, all) = found.sizes_before.within(tolerance);
        let mut counts = grouped(before);
        if let Some(sizes) = &found.sizes_after {
            counts += &format!(" → {}", grouped(sizes.within(tolerance).0));
        }
        let tolerance = units.length(tolerance);
        notes.push(say!(
            "within {sign}{tolerance}: {counts} of {all}",
            sign,
            tolerance,
            counts,
            all = grouped(all)
        ));
    }
    if counted.beyond > 0 {
        notes.push(say!(
            one "{count} lies beyond the ends",
            "{count} lie beyond the ends",
            count = counted.beyond
        ));
    }
    notes.join(" · ")
}

/// What is seen, in words.
fn describe(scene: &Scene, found: &Distribution) -> String {
    let units = scene.units;
    let counted = found.shown(scene.only_after);
    let tallest = |counts: &Option<Vec<usize>>| {
        let counts = counts.as_ref()?;
        let bin = (0..counts.len()).max_by_key(|bin| counts[*bin])?;
        let [from, to] = counted.bins.ends(bin).map(|mm| units.length(mm));
        Some(say!(
            "most, {bin}, from {from} to {to}",
            bin = counts[bin],
            from,
            to
        ))
    };
    let mut says = title(scene);
    for (name, counts) in [
        (say!("before"), &counted.before),
        (say!("after"), &counted.after),
    ] {
        if let Some(tallest) = tallest(counts) {
            says += &format!("; {name}: {tallest}");
        }
    }
    format!("{says}; {}", note(scene, found, counted))
}
