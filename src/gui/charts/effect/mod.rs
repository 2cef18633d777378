//! What a found effect does: the residual of the model without it, and its own curve through it.

mod curve;

use std::sync::Arc;

use crate::gui::charts::{
    About, ChartChoice, ChartKind, ChartPlaceholder, HoverTarget, Samples, Scene, Shown,
};
use crate::gui::core::overview::{FEW, stride, thinned};
use crate::gui::core::quantity::Scale;
use crate::gui::core::search::{Search, terms};
use crate::gui::help;
use crate::gui::view::Step;
use crate::present::chart::{
    Axis, Chart, ColourRole, Entry, Form, Item, LEAST_SPAN, LegendSymbol, Mark,
};
use crate::present::table::{Cell, Table};
use crate::present::units::Units;
use crate::text::{spoken, within};

pub(crate) use curve::{EffectCurve, EffectSample, strongest};

pub(crate) struct Effect;

/// The name of this chart: what was found is shown in it.
pub(crate) const ID: &str = "effect's curve";

/// So many samples are looked at for the curves of all effects; of more each is drawn when it is asked for.
const FOR_SKETCHES: usize = 20_000;

/// The curves of all effects that were found, each in the component that it has most of: small, on their cards.
pub(crate) type Sketches = Vec<Option<EffectCurve>>;

pub(crate) fn sketches(search: &Search) -> Sketches {
    let session = &*search.loaded_session;
    let found = search.answer.as_ref().ok();
    let found = found.filter(|_| session.overview.usable.len() <= FOR_SKETCHES);
    let curve = |d, index| {
        let component = strongest(session, d, index)?;
        EffectCurve::of(session, search, index, component)
    };
    let curves = found.map(|d| (0..d.found.len()).map(|index| curve(d, index)).collect());
    curves.unwrap_or_default()
}

impl ChartKind for Effect {
    fn about(&self) -> About {
        let name = help::EFFECT_CURVE.name;
        About::new(ID, name, help::EFFECT_CURVE, ChartChoice::Component)
    }

    fn is_offered(&self, scene: &Scene) -> bool {
        let found = scene.diagnosis().map(terms).unwrap_or_default();
        let chosen = found.get(scene.effect).is_some_and(Option::is_some);
        scene.step == Step::Gap && chosen
    }

    fn show(&self, scene: &Arc<Scene>) -> Result<Shown, ChartPlaceholder> {
        let curve = curve(scene)?;
        Ok(Shown {
            chart: drawn(scene, &curve),
            name: say!(
                "curve of {curve}, {component}",
                curve = name(&curve),
                component = scene.component.name()
            ),
            description: describe(scene, &curve),
            pointed: HoverTarget::Samples(Box::new(Drawn {
                scale: scale(scene, &curve),
                units: scene.units,
                curve,
            })),
        })
    }

    /// Every sample, along the chart.
    fn numbers(&self, scene: &Scene) -> Table {
        let Ok(curve) = curve(scene) else {
            return Table::default();
        };
        let (loaded_session, component) = (&scene.loaded_session, scene.component.name());
        let (along, what) = (curve.over.heading(loaded_session), name(&curve));
        let [without, of] =
            ["without", "of"].map(|which| format!("{component} {which} {what}, mm"));
        let mut table = Table::new(["sample", &along, "side", &without, &of]);
        for spot in &curve.spots {
            let x = curve.over.cell(loaded_session, spot.x);
            let numbers = [x, spot.side, spot.residual_mm, spot.effect_mm];
            let sample = Cell::from(spot.sample + 1);
            table.row([sample].into_iter().chain(numbers.map(Cell::from)));
        }
        table
    }
}

fn curve(scene: &Scene) -> Result<EffectCurve, ChartPlaceholder> {
    let (session, search) = (&scene.loaded_session, scene.search.as_ref());
    let found = search.and_then(|s| EffectCurve::of(session, s, scene.effect, scene.component));
    let there = found.filter(|curve| !curve.spots.is_empty());
    there.ok_or(ChartPlaceholder::new(
        say!("There is no curve to show"),
        say!("Run the diagnosis again: what was found belongs to other samples"),
    ))
}

/// What the pointer finds.
struct Drawn {
    units: Units,
    curve: EffectCurve,
    scale: Scale,
}

impl Samples for Drawn {
    fn marks(&self, sample: usize) -> Vec<[f64; 2]> {
        let units = self.units;
        let at = |spot: &EffectSample| {
            [
                self.scale.shown(spot.x),
                units.length_value(spot.residual_mm),
            ]
        };
        self.curve.spot(sample).map(at).into_iter().collect()
    }

    fn near(&self, _: [f64; 2], _: [f64; 2]) -> Vec<usize> {
        some(&self.curve).map(|spot| spot.sample).collect()
    }
}

/// The effect's name as it stands within a sentence.
fn name(curve: &EffectCurve) -> String {
    let effect = crate::effects::find(curve.effect);
    effect.map_or_else(
        || curve.effect.to_owned(),
        |e| within(spoken(e.about().title)).into_owned(),
    )
}

fn scale(scene: &Scene, curve: &EffectCurve) -> Scale {
    let [from, to] = curve.ends();
    curve
        .over
        .scale(&scene.loaded_session, scene.units, to - from)
}

/// Samples that are drawn.
fn some(curve: &EffectCurve) -> impl Iterator<Item = &EffectSample> {
    curve.spots.iter().step_by(stride(curve.spots.len(), FEW))
}

fn drawn(scene: &Scene, curve: &EffectCurve) -> Chart {
    let units = scene.units;
    let scale = scale(scene, curve);
    let value = |mm: f64| units.length_value(mm);
    let mark = |spot: &EffectSample, mm: f64| Mark {
        at: [scale.shown(spot.x), value(mm)],
        form: Form::of_side(spot.side),
    };
    let [low, high] = curve.extent_mm;
    let by = (0.08 * (high - low)).max(0.5 * LEAST_SPAN);
    let [from, to] = curve.ends();
    let least = 1e-3 + 1e-9 * from.abs().max(to.abs());
    let beside = (0.03 * (to - from)).max(least);
    let bounds = [
        [scale.shown(from - beside), value(low - by)],
        [scale.shown(to + beside), value(high + by)],
    ];
    let mut items = Vec::new();
    let zero = vec![[bounds[0][0], 0.0], [bounds[1][0], 0.0]];
    items.push(Item::Line(zero, ColourRole::Reference, 1.0, false));
    let residual = some(curve).map(|s| mark(s, s.residual_mm)).collect();
    items.push(Item::Marks(residual, ColourRole::Before, false));
    for line in &curve.lines {
        let points = line
            .points
            .iter()
            .map(|[x, mm]| [scale.shown(*x), value(*mm)]);
        let dashed = line.side < 0.0;
        items.push(Item::Line(points.collect(), ColourRole::Curve, 2.4, dashed));
    }
    if curve.lines.is_empty() {
        let alone = some(curve).map(|s| mark(s, s.effect_mm)).collect();
        items.push(Item::Marks(alone, ColourRole::Curve, true));
    }
    let what = name(curve);
    let component = scene.component.name();
    let line = |name, whole| Entry::new(name, LegendSymbol::Line, ColourRole::Curve, whole);
    let dot = LegendSymbol::Mark(Form::Disc);
    let residual = Entry::new(say!("without it"), dot, ColourRole::Before, false);
    let mut legend = vec![residual.on_paper(say!("without {effect}", effect = what))];
    match &curve.lines[..] {
        [] => {
            legend.push(
                Entry::new(say!("what it does"), dot, ColourRole::Curve, true).on_paper(&*what),
            );
        }
        [_] => legend.push(line(say!("what it does"), true).on_paper(&*what)),
        _ => legend.extend([
            line(say!("approach +"), true),
            line(say!("approach −"), false),
        ]),
    }
    Chart {
        title: say!(
            "{component} residual without {effect}, and what it does",
            component,
            effect = what
        ),
        across: scale.axis(&curve.over.label(&scene.loaded_session)),
        upwards: Axis::numbers(format!("{component}, {}", units.length_name())),
        bounds,
        items,
        legend,
        note: note(scene, curve),
    }
}

fn note(scene: &Scene, curve: &EffectCurve) -> String {
    let mut notes = vec![say!(
        "what is left without {curve}; all else as fitted",
        curve = name(curve)
    )];
    if curve.lines.is_empty() {
        notes.push(say!("it depends on the pose too: its value at each sample").to_owned());
    }
    notes.extend(thinned(
        stride(curve.spots.len(), FEW),
        phrase!("one point in {stride} shown"; stride),
    ));
    let problems = scene.diagnosis().map(|d| &d.data_problems);
    if problems.is_some_and(|p| p.iter().any(|p| p.mend.is_some())) {
        notes.push(say!("a set-up error is not corrected yet and shows here too").to_owned());
    }
    notes.join(" · ")
}

/// What is seen, in words.
fn describe(scene: &Scene, curve: &EffectCurve) -> String {
    let units = scene.units;
    let ends = curve.effect_mm.map(|mm| units.length(mm));
    let [before, after] = curve.rms_mm.map(|mm| units.length(mm));
    say!(
        "{curve} over {label}: it moves the {component} deviation from {from} to {to}; without it {before} root mean square are left, with it {after}",
        curve = name(curve),
        label = curve.over.label(&scene.loaded_session),
        component = scene.component.name(),
        from = ends[0],
        to = ends[1],
        before,
        after
    )
}
