//! What a found effect does: the residual of the model without it, and its own curve through it.

mod curve;

use crate::gui::charts::{
    ChartChoice, ChartKind, ChartPlaceholder, Scene, Series, Shown, not_drawn,
};
use crate::gui::core::search::terms;
use crate::gui::help;
use crate::gui::view::Step;
use crate::present::chart::{self, ColourRole, Deviation, Entry, Form, Item, LegendSymbol, Mark};
use crate::present::numbers::significant;
use crate::present::table::{Cell, Table};
use crate::text::{spoken, within};

use curve::{EffectCurve, EffectSample};

pub(crate) use curve::strongest;

/// The name of this chart: what was found is shown in it.
pub(crate) const ID: &str = "effect's curve";

pub(crate) static EFFECT: ChartKind = ChartKind {
    is_offered: |scene| {
        let found = scene.diagnosis().map(terms).unwrap_or_default();
        let chosen = found.get(scene.effect).is_some_and(Option::is_some);
        scene.step == Step::Gap && chosen
    },
    ..ChartKind::new(
        ID,
        help::EFFECT_CURVE,
        ChartChoice::Component,
        show,
        numbers,
    )
};

/// So many samples are looked at for the curves of all effects; of more each is drawn when it is asked for.
const FOR_SKETCHES: usize = 20_000;

/// The curves of all effects that were found, each in the component that it has most of: small, on their cards.
pub(crate) type Sketches = Vec<Option<Shown>>;

pub(crate) fn sketches(scene: &Scene) -> Sketches {
    let found = scene.diagnosis();
    let Some(found) = found.filter(|_| scene.usable().len() <= FOR_SKETCHES) else {
        return Vec::new();
    };
    let sketch = |effect| {
        let component = strongest(&scene.loaded_session, found, effect)?;
        let scene = Scene {
            effect,
            component,
            ..scene.clone()
        };
        show(&scene).ok()
    };
    (0..found.found.len()).map(sketch).collect()
}

/// Every sample, along the chart.
fn numbers(scene: &Scene) -> Table {
    let Ok(curve) = curve(scene) else {
        return Table::default();
    };
    let (loaded_session, component) = (&scene.loaded_session, scene.component.name());
    let (along, what) = (curve.over.heading(loaded_session), name(&curve));
    let [without, of] = ["without", "of"].map(|which| format!("{component} {which} {what}, mm"));
    let mut table = Table::new(["sample", &along, "side", &without, &of]);
    for spot in &curve.spots {
        let x = curve.over.cell(loaded_session, spot.x);
        let numbers = [x, spot.side, spot.residual_mm, spot.effect_mm];
        let sample = Cell::from(spot.sample + 1);
        table.row([sample].into_iter().chain(numbers.map(Cell::from)));
    }
    table
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

/// The effect's name as it stands within a sentence.
fn name(curve: &EffectCurve) -> String {
    let effect = crate::effects::find(curve.effect);
    effect.map_or_else(
        || curve.effect.to_owned(),
        |e| within(spoken(e.about().title)).into_owned(),
    )
}

fn show(scene: &Scene) -> Result<Shown, ChartPlaceholder> {
    let curve = curve(scene)?;
    let (session, units) = (&scene.loaded_session, scene.units);
    let [from, to] = curve.ends();
    let scale = curve.over.scale(session, units, to - from);
    let place = |[x, mm]: [f64; 2]| [scale.shown(x), units.length_value(mm)];
    let stage = |role, mm: fn(&EffectSample) -> f64| {
        let mark = |spot: &EffectSample| Mark {
            at: [spot.x, mm(spot)],
            form: Form::of_side(spot.side),
        };
        let marks = curve.spots.iter().map(|spot| (spot.sample, mark(spot)));
        (role, marks.collect())
    };
    let mut stages = vec![stage(ColourRole::Before, |spot| spot.residual_mm)];
    let mut items = Vec::new();
    for line in &curve.lines {
        let points = line.points.iter().map(|at| place(*at)).collect();
        let dashed = line.side < 0.0;
        items.push(Item::Line(points, ColourRole::Curve, 2.4, dashed));
    }
    if curve.lines.is_empty() {
        items.push(Item::Marks(Vec::new(), ColourRole::Curve, true));
        stages.insert(0, stage(ColourRole::Curve, |spot| spot.effect_mm));
    }
    let what = name(&curve);
    let component = scene.component.name();
    let entry = |name, sign, whole| Entry::new(name, sign, ColourRole::Curve, whole);
    let (dot, line) = (LegendSymbol::Mark(Form::Disc), LegendSymbol::Line);
    let entry_of_residual = Entry::new(say!("without it"), dot, ColourRole::Before, false)
        .on_paper(say!("without {effect}", effect = what));
    let number = |mm: f64| significant(units.length_value(mm), 3);
    let made = Deviation {
        component,
        is_length: false,
        across: scale.axis(&curve.over.label(session)),
        lengths: scene.lengths(&number),
        x: [from, to].map(|x| scale.shown(x)),
        mm: curve.extent_mm,
        sides: false,
        tolerance_mm: None,
        floor_mm: None,
        boundaries: Vec::new(),
        series: vec![chart::Series {
            entry: entry_of_residual,
            samples: Vec::new(),
        }],
    };
    let title = say!(
        "{component} residual without {effect}, and what it does",
        component,
        effect = what
    );
    let mut chart = made.chart(title, String::new());
    chart.items.extend(items);
    chart.legend.extend(match &curve.lines[..] {
        [] => vec![entry(say!("what it does"), dot, true).on_paper(&*what)],
        [_] => vec![entry(say!("what it does"), line, true).on_paper(&*what)],
        _ => vec![
            entry(say!("approach +"), line, true),
            entry(say!("approach −"), line, false),
        ],
    });
    let name = say!("curve of {curve}, {component}", curve = what, component);
    let mut shown = Shown::of(chart, name, &stages, place);
    shown.chart.note = note(scene, &curve, &shown.series);
    Ok(shown)
}

fn note(scene: &Scene, curve: &EffectCurve, series: &[Series]) -> String {
    let mut notes = vec![say!(
        "what is left without {curve}; all else as fitted",
        curve = name(curve)
    )];
    if curve.lines.is_empty() {
        notes.push(say!("it depends on the pose too: its value at each sample").to_owned());
    }
    notes.extend(not_drawn(series, curve.spots.len()));
    let problems = scene.diagnosis().map(|d| &d.data_problems);
    if problems.is_some_and(|p| p.iter().any(|p| p.mend.is_some())) {
        notes.push(say!("a set-up error is not corrected yet and shows here too").to_owned());
    }
    notes.join(" · ")
}
