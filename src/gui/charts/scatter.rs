//! Any two quantities of the samples over each other, before and after where one of them is a deviation.

use crate::gui::cache::Work;
use crate::gui::charts::{
    About, ChartChoice, ChartKind, ChartPlaceholder, HoverTarget, Scene, Seen, Shown,
};
use crate::gui::charts::{When, at};
use crate::gui::core::loaded_session::Component;
use crate::gui::core::quantity::Quantity;
use crate::gui::help::Word;
use crate::present::chart::{Chart, ColourRole, Entry, Form, Item, LegendSymbol};
use crate::present::numbers::trimmed;
use crate::present::table::{Cell, Table};

/// Space around the marks, as a part of their extent.
const MARGIN: f64 = 0.04;

pub(crate) struct Scatter;

/// What stands across and upwards: as chosen, else the deviation as it is seen from above.
pub(crate) fn axes(scene: &Scene) -> [Quantity; 2] {
    let first = [Component::X, Component::Y].map(Quantity::Deviation);
    let joints = scene.loaded_session.session.robot.joints.len();
    scene.axes.unwrap_or(first).map(|axis| axis.within(joints))
}

/// What can be chosen, and how it is called.
pub(crate) fn named(scene: &Scene) -> Vec<(Quantity, String)> {
    let offered = Quantity::offered(&scene.loaded_session).into_iter();
    offered
        .map(|q| (q, q.name(&scene.loaded_session)))
        .collect()
}

/// The names of what stands across and upwards.
fn names(seen: &Seen<'_>) -> [String; 2] {
    let session = &seen.scene.loaded_session;
    seen.axes.map(|axis| axis.name(session))
}

fn chart(seen: &Seen<'_>, extent: [[f64; 2]; 2]) -> Chart {
    let [x, y] = [0, 1].map(|k| {
        let [low, high] = extent[k].map(|v| seen.scales[k].shown(v));
        let span = high - low;
        let around = if span > 0.0 { MARGIN * span } else { 0.5 };
        [low - around, high + around]
    });
    let names = names(seen);
    let axis = |k: usize| seen.scales[k].axis(names[k].clone());
    // Where nothing deviates.
    let zero = |k: usize, ends: [f64; 2]| {
        let deviates = seen.axes[k].changes() && ends[0] < 0.0 && ends[1] > 0.0;
        let line = if k == 0 {
            [[0.0, y[0]], [0.0, y[1]]]
        } else {
            [[x[0], 0.0], [x[1], 0.0]]
        };
        deviates.then(|| Item::Line(line.to_vec(), ColourRole::Reference, 1.0, true))
    };
    let mut items: Vec<Item> = zero(0, x).into_iter().chain(zero(1, y)).collect();
    let sign = LegendSymbol::Mark(Form::Disc);
    let mut legend = seen.scene.legend(sign);
    if !seen.changes {
        legend = vec![Entry::new(say!("samples"), sign, ColourRole::Curve, true)];
    } else if seen.scene.answer().is_some() {
        // The marks themselves are those in sight.
        items.push(Item::Marks(Vec::new(), ColourRole::After, true));
    }
    Chart {
        title: say!(
            "{upwards} over {across}",
            upwards = names[1],
            across = names[0]
        ),
        across: axis(0),
        upwards: axis(1),
        bounds: [[x[0], y[0]], [x[1], y[1]]],
        items,
        legend,
        note: note(seen),
    }
}

fn note(seen: &Seen<'_>) -> String {
    let last = seen.whens().last().unwrap_or(0);
    let r = seen.points(last).correlation;
    let r = r.map(|r| say!("correlation r = {r}", r = trimmed(r, 2)));
    let notes: Vec<String> = r.into_iter().chain(seen.notes()).collect();
    notes.join(" · ")
}

fn describe(seen: &Seen<'_>, extent: [[f64; 2]; 2]) -> String {
    let names = names(seen);
    let [x, y] = [0, 1].map(|k| extent[k].map(|v| seen.scales[k].describe(v)));
    say!(
        "{samples} samples, {across} from {x0} to {x1}, {upwards} from {y0} to {y1}",
        samples = seen.points(0).samples.len(),
        across = names[0],
        upwards = names[1],
        x0 = x[0],
        x1 = x[1],
        y0 = y[0],
        y1 = y[1]
    )
}

impl ChartKind for Scatter {
    fn about(&self) -> About {
        let names = [phrase!("scatter"), phrase!("Scatter")];
        let word = Word {
            name: phrase!("Scatter"),
            means: phrase!(
                "Any two quantities of the samples over each other, one mark for each sample. A band or a curve says that one follows the other, and r how nearly along a line: near 1 or −1 they go together, near 0 they do not"
            ),
        };
        About::new("scatter", names, word, ChartChoice::Quantities)
    }

    fn work(&self, scene: &Scene) -> Option<Work> {
        Seen::work(scene, axes(scene))
    }

    fn show<'a>(&self, scene: &'a Scene) -> Result<Shown<'a>, ChartPlaceholder> {
        let seen = Seen::of(scene, axes(scene), None).ok_or_else(ChartPlaceholder::yet)?;
        let Some(extent) = seen.extent() else {
            return Err(ChartPlaceholder::new(
                say!("No sample has both quantities"),
                say!("Choose others across or upwards"),
            ));
        };
        let [across, upwards] = names(&seen);
        Ok(Shown {
            chart: chart(&seen, extent),
            name: say!("scatter, {upwards} over {across}", upwards, across),
            description: describe(&seen, extent),
            pointed: HoverTarget::Samples(Box::new(seen)),
        })
    }

    /// Every sample, in measuring order.
    fn numbers(&self, scene: &Scene) -> Table {
        let axes = axes(scene);
        let changes = axes.iter().any(|axis| axis.changes());
        let whens: &[When] = if changes { &[0, 1] } else { &[0] };
        let mut heads = vec!["sample".to_owned()];
        for when in whens {
            let name = ["before", "after"][*when];
            heads.extend(axes.map(|axis| {
                let heading = axis.heading(&scene.loaded_session);
                match (heading.split_once(", "), axis.changes()) {
                    (Some((what, unit)), true) => format!("{what} {name}, {unit}"),
                    _ => heading,
                }
            }));
        }
        // What does not change stands there once.
        let mut kept = Vec::new();
        for (k, head) in heads.iter().enumerate() {
            if heads.iter().position(|one| one == head) == Some(k) {
                kept.push(k);
            }
        }
        let mut table = Table::new(kept.iter().map(|k| heads[*k].clone()));
        for sample in scene.usable() {
            let mut cells = vec![Cell::from(sample + 1)];
            for when in whens {
                let here = at(&scene.loaded_session, scene.answer(), axes, *when, sample);
                let here = [0, 1].map(|k| axes[k].cell(&scene.loaded_session, here[k]));
                cells.extend(here.map(Cell::from));
            }
            table.row(kept.iter().map(|k| cells[*k].clone()));
        }
        table
    }
}
