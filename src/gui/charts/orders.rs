//! How large the deviation is at each whole number of cycles per turn.

use super::{Bar, ChartChoice, ChartKind, ChartPlaceholder, Scene, Shown, of_noise};
use crate::gui::core::quantity::{Over, Variable};
use crate::gui::core::search::terms;
use crate::gui::help;
use crate::language;
use crate::numeric::whole;
use crate::present::chart::{
    Axis, Chart, ChartText, ColourRole, Item, LEAST_SPAN, LegendSymbol, Ticks,
};
use crate::present::drawing::Anchor;
use crate::present::numbers::trimmed;
use crate::present::spectrum::{Amplitude, Order, Spectrum};
use crate::present::table::{Cell, Table};
use crate::present::units::{Units, in_unit};
use crate::text::angle;

/// Part of the height that is left for names.
const ROOM: f64 = 0.30;
/// Rows of names.
const ROWS: usize = 3;

pub(crate) static ORDERS: ChartKind = ChartKind::new(
    "order spectrum",
    help::ORDERS,
    ChartChoice::Joint,
    show,
    numbers,
);

fn show(scene: &Scene) -> Result<Shown, ChartPlaceholder> {
    let spectrum = spectrum(scene)?;
    let component = scene.component.name();
    let name = say!("order spectrum, {component}", component);
    let mut shown = Shown::new(drawn(scene, &spectrum), name);
    let bars = spectrum.orders.iter().enumerate();
    let bars = bars.map(|(slot, order)| bar(scene.units, &spectrum, slot, order));
    shown.bars = bars.collect();
    Ok(shown)
}

/// Every order.
fn numbers(scene: &Scene) -> Table {
    let mut table = Table::headed(
        "order | before, mm | noise before, mm | after, mm | noise after, mm | usual cause",
    );
    let spectrum = spectrum(scene);
    for order in spectrum.iter().flat_map(|spectrum| &spectrum.orders) {
        let cause = spectrum.as_ref().ok().and_then(|s| cause(s, order.order));
        table.row([
            order.order.into(),
            order.before.mm.into(),
            order.before.line_mm.into(),
            order.after.map(|a| a.mm).into(),
            order.after.and_then(|a| a.line_mm).into(),
            Cell::from(cause),
        ]);
    }
    table
}

/// Orders of gears of the charts' joint, as far as a search or the model knows them.
fn gears(scene: &Scene) -> Vec<usize> {
    let found = scene.diagnosis().map(terms).unwrap_or_default();
    let added = scene.document.added.iter().map(|a| &a.term);
    let gears = added.chain(found.iter().flatten()).filter(|term| {
        term.joint == scene.joint() && term.effect.about().setting.takes_fractions()
    });
    let mut orders: Vec<usize> = gears.map(|term| whole(term.setting)).collect();
    orders.sort_unstable();
    orders.dedup();
    orders
}

/// The spectrum, or why there is none.
fn spectrum(scene: &Scene) -> Result<Spectrum, ChartPlaceholder> {
    let joint = scene.joint();
    if !scene.loaded_session.joint_turns(joint) {
        let name = &scene.loaded_session.session.robot.joints[joint].name;
        let why = say!("Orders are cycles per turn. Choose a joint that turns");
        return Err(ChartPlaceholder::new(say!("{name} slides", name), why));
    }
    let over = Over {
        variable: Variable::Joint,
        joint,
    };
    let angle = |i: &usize| over.of(&scene.loaded_session, *i);
    let samples: Vec<usize> = scene.usable().filter(|i| angle(i).is_finite()).collect();
    let angles: Vec<f64> = samples.iter().map(angle).collect();
    let (before, after) = scene.values(&samples);
    let spectrum = Spectrum::new(&angles, &before, after.as_deref(), &gears(scene));
    if spectrum.orders.is_empty() {
        return Err(ChartPlaceholder::new(
            say!("Too few different angles"),
            say!(
                "An order shows where a wave comes back with every turn: measure thirty angles or more, spread over the whole range of the joint"
            ),
        ));
    }
    Ok(spectrum)
}

/// What the pointer finds.
fn bar(units: Units, spectrum: &Spectrum, slot: usize, order: &Order) -> Bar {
    let mut lines = Vec::new();
    let cause = cause(spectrum, order.order);
    lines.extend(cause.map(|cause| (say!("usual cause").to_owned(), cause.to_owned())));
    let before = (say!("before"), order.before);
    let after = order.after.map(|amplitude| (say!("after"), amplitude));
    for (name, amplitude) in std::iter::once(before).chain(after) {
        lines.push((name.to_owned(), units.length(amplitude.mm)));
        let line = amplitude.line_mm.map(|line| units.length(line));
        lines.extend(line.map(|line| (say!("noise, {name}", name), line)));
    }
    Bar {
        x: [-0.5, 0.5].map(|end| slot as f64 + end),
        title: say!("order {order}", order = order.order),
        lines,
        samples: Vec::new(),
    }
}

/// The amplitudes of an order that are shown: before, after.
fn shown(order: &Order, only_after: bool) -> [Option<Amplitude>; 2] {
    [Some(order.before).filter(|_| !only_after), order.after]
}

/// The spectrum as bars.
fn drawn(scene: &Scene, spectrum: &Spectrum) -> Chart {
    let units = scene.units;
    let only_after = scene.only_after;
    let value = |mm: f64| units.length_value(mm);
    // The line belongs to what is shown last.
    let line_of = |order: &Order| {
        let last = shown(order, only_after).into_iter().flatten().last();
        last.and_then(|amplitude| amplitude.line_mm)
    };
    let of_order = |order: &Order| {
        let bars = shown(order, only_after).into_iter().flatten();
        bars.map(|a| a.mm).fold(0.0, f64::max)
    };
    let orders = &spectrum.orders;
    let bars = orders.iter().map(of_order);
    let lines = orders.iter().filter_map(line_of);
    let largest = bars.chain(lines).fold(LEAST_SPAN, f64::max);
    let top = largest / (1.0 - ROOM);
    let mut items = Vec::new();
    for (k, (stands, filled)) in [(ColourRole::Before, false), (ColourRole::After, true)]
        .into_iter()
        .enumerate()
    {
        let bar = |(slot, order): (usize, &Order)| {
            let both = shown(order, only_after);
            let alone = both.iter().flatten().count() == 1;
            let [from, to] = match (alone, k) {
                (true, _) => [-0.3, 0.3],
                (false, 0) => [-0.38, -0.02],
                (false, _) => [0.02, 0.38],
            };
            let at = slot as f64;
            Some([[at + from, 0.0], [at + to, value(both[k]?.mm)]])
        };
        let bars = orders.iter().enumerate().filter_map(bar).collect();
        items.push(Item::Bars(bars, stands, filled));
    }
    let step = |(slot, order): (usize, &Order)| {
        let height = value(line_of(order)?);
        Some([[slot as f64 - 0.5, height], [slot as f64 + 0.5, height]])
    };
    let line = orders.iter().enumerate().filter_map(step);
    let line: Vec<[f64; 2]> = line.flatten().collect();
    if !line.is_empty() {
        items.push(Item::Line(line, ColourRole::Noise, 1.6, true));
    }
    let height = |order: &Order| value(of_order(order));
    let room = [value(largest), value(top)];
    items.extend(names(spectrum, only_after, room, &height));
    let ticks = orders.iter().enumerate();
    let ticks = ticks.map(|(k, o)| (k as f64, o.order.to_string()));
    let last = orders.len() as f64 - 0.4;
    let name = scene.component.name();
    let joint = &scene.loaded_session.session.robot.joints[scene.joint()].name;
    let mut legend = scene.legend(LegendSymbol::Bar);
    legend.push(of_noise(say!("noise")));
    Chart {
        title: say!("{name} deviation by order over {joint}", name, joint),
        across: Axis {
            label: say!("cycles per turn of {joint}", joint),
            ticks: Ticks::Words(ticks.collect()),
        },
        upwards: Axis::numbers(in_unit(say!("amplitude"), units.length_name())),
        bounds: [[-0.6, 0.0], [last, value(top)]],
        items,
        legend,
        note: note(spectrum),
    }
}

/// Names of orders that have a usual cause, in the room above all bars, with a line down to theirs.
fn names(
    spectrum: &Spectrum,
    only_after: bool,
    [largest, top]: [f64; 2],
    of_order: &dyn Fn(&Order) -> f64,
) -> Vec<Item> {
    let mut items = Vec::new();
    for (slot, order) in spectrum.orders.iter().enumerate() {
        let Some(cause) = cause(spectrum, order.order) else {
            continue;
        };
        let mut bars = shown(order, only_after).into_iter().flatten();
        if !bars.any(Amplitude::stands_out) {
            continue;
        }
        // A line and a word of each before it.
        let part = (items.len() / 2 % ROWS) as f64 + 0.6;
        let height = top - (top - largest) * part / ROWS as f64;
        let at = slot as f64;
        let line = vec![[at, of_order(order)], [at, height]];
        items.push(Item::Line(line, ColourRole::Reference, 0.8, false));
        items.push(Item::Word(ChartText {
            at: [at, height],
            text: format!(" {cause}"),
            anchor: Anchor::Start,
            below: false,
        }));
    }
    items
}

fn note(spectrum: &Spectrum) -> String {
    let has_line = spectrum.orders.iter().any(|o| o.before.line_mm.is_some());
    let line = if has_line {
        say!("noise stays below the line in 99 of 100 sessions").to_owned()
    } else {
        say!("too few samples to say what is noise").to_owned()
    };
    let mut notes = vec![line];
    notes.extend(limits(spectrum));
    notes.join(" · ")
}

/// A range of less than this part of a turn is said to be less than a turn.
const A_TURN: f64 = 0.97;

/// What has to be said about the range; nothing where it is a whole turn.
fn limits(spectrum: &Spectrum) -> Option<String> {
    if spectrum.turns >= A_TURN || spectrum.orders.is_empty() {
        return None;
    }
    let range = language::spoken(angle(std::f64::consts::TAU * spectrum.turns, 0));
    let apart = trimmed((1.0 / spectrum.turns).ceil(), 0);
    Some(match spectrum.unseen {
        0 => say!(
            "range {range}: orders nearer than {apart} cannot be told apart",
            range,
            apart
        ),
        n => say!(
            "range {range}: orders nearer than {apart} cannot be told apart, and orders up to {n} cannot be seen",
            range,
            apart,
            n
        ),
    })
}

/// What usually causes an order.
fn cause(spectrum: &Spectrum, order: usize) -> Option<&'static str> {
    match order {
        1 => Some(say!("eccentricity")),
        2 => Some(say!("two-cycle")),
        _ if spectrum.gears.contains(&order) => Some(say!("gear")),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_part_of_a_turn_cannot_show_is_said() {
        let of = |turns: f64, gears: &[usize]| {
            let angles: Vec<f64> = (0..200)
                .map(|k| turns * std::f64::consts::TAU * f64::from(k) / 199.0)
                .collect();
            Spectrum::new(&angles, &vec![1.0; 200], None, gears)
        };
        let most = of(0.83, &[37]);
        assert_eq!(cause(&most, 37), Some("gear"));
        let says = limits(&most).expect("it is less than a turn");
        assert!(says.contains("nearer than 2"), "{says}");
        let says = limits(&of(0.247, &[])).expect("it is less than a turn");
        assert!(
            says.contains("nearer than 5") && says.contains("orders up to 1 cannot"),
            "{says}"
        );
        assert_eq!(limits(&of(1.0, &[])), None);
    }
}
