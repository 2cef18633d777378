//! How many samples deviate by how much.

use super::{Bar, ChartChoice, ChartKind, ChartPlaceholder, Scene, Shown, of_noise};
use crate::gui::core::loaded_session::Component;
use crate::gui::help;
use crate::present::bins::{Counted, Distribution, NoiseCurve};
use crate::present::chart::{Axis, Chart, ColourRole, Entry, Item, LegendSymbol};
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

pub(crate) static HISTOGRAM: ChartKind = ChartKind::new(
    "histogram",
    help::HISTOGRAM,
    ChartChoice::Component,
    show,
    numbers,
);

fn show(scene: &Scene) -> Result<Shown, ChartPlaceholder> {
    let found = distribution(scene)?;
    let name = say!("histogram, {component}", component = scene.component.name());
    let mut shown = Shown::new(drawn(scene, &found), name);
    shown.bars = bars(scene, found.shown(scene.only_after));
    Ok(shown)
}

fn numbers(scene: &Scene) -> Table {
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

/// What the pointer finds: in each bar the samples that are there after, else those that were there before.
fn bars(scene: &Scene, counted: &Counted) -> Vec<Bar> {
    let (units, bins) = (scene.units, counted.bins);
    let mut samples = vec![[const { Vec::new() }; 2]; bins.count];
    for (sample, when) in scene.usable().flat_map(|s| [(s, 0), (s, 1)]) {
        if let Some(bin) = bins.of(scene.value(when, sample)) {
            samples[bin][when].push(sample);
        }
    }
    let bar = |(bin, [before, after]): (usize, [Vec<usize>; 2])| {
        let ends = bins.ends(bin);
        let [from, to] = ends.map(|mm| units.length_number(mm));
        let counts = [
            (say!("before"), &counted.before),
            (say!("after"), &counted.after),
        ];
        let line = |(name, counts): (&str, &Option<Vec<usize>>)| {
            Some((name.to_owned(), counts.as_ref()?[bin].to_string()))
        };
        Bar {
            x: ends.map(|mm| units.length_value(mm)),
            title: format!("{from} … {to} {}", units.length_name()),
            lines: counts.into_iter().filter_map(line).collect(),
            samples: if after.is_empty() { before } else { after },
        }
    };
    samples.into_iter().enumerate().map(bar).collect()
}

/// How noise alone is spread in the component that is shown, where the noise is known: as the
/// instrument says, else as the residuals show it.
fn noise(scene: &Scene) -> Option<NoiseCurve> {
    let session = &scene.loaded_session.session;
    let count = if session.samples.z_mm.is_none() { 2 } else { 3 };
    let axes = match session.instrument.sigma_mm {
        Some(Sigma::Overall(sigma)) => [sigma; 3],
        Some(Sigma::PerAxis(axes)) => axes,
        None => scene.answer()?.identification.noise_mm?,
    };
    let squares = axes[..count].iter().map(|s| s * s).sum::<f64>();
    let sigma_mm = match scene.component {
        Component::X => axes[0],
        Component::Y => axes[1],
        Component::Z => axes[2],
        _ => (squares / count as f64).sqrt(),
    };
    let length = scene.component == Component::Length;
    (sigma_mm.is_finite() && sigma_mm > 0.0).then_some(NoiseCurve {
        sigma_mm,
        axes: if length { count } else { 1 },
    })
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
    let mut tallest = most;
    let noise = noise(scene).filter(|noise| bins.width_mm <= SHARP * noise.sigma_mm);
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
    let mut legend = scene.legend(LegendSymbol::Bar);
    // A length has no other side: its bins begin at zero.
    let both = scene.document.tolerance_mm.map(|mm| [-mm, mm]);
    let ends = both.into_iter().flatten();
    let ends = ends.filter(|end| *end > low && *end < high);
    let line = |end: f64| vec![[value(end), 0.0], [value(end), top]];
    let lines = ends.map(|end| Item::Line(line(end), ColourRole::Tolerance, 1.6, false));
    let lines: Vec<Item> = lines.collect();
    if !lines.is_empty() {
        let (sign, role) = (LegendSymbol::Line, ColourRole::Tolerance);
        legend.push(Entry::new(say!("tolerance"), sign, role, true));
    }
    items.extend(lines);
    let margin = 0.02 * (high - low);
    if noise.is_some() {
        legend.push(of_noise(say!("noise alone")));
    }
    let name = scene.component.name();
    Chart {
        title: say!("samples by {name} deviation", name),
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
