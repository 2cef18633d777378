//! Unknowns that a sum of names can imitate: a kink, levels by sector, a chirp. And gear orders
//! that are not whole, which have a name and a number.
//!
//! Some of these shapes *are* a sum of two names to within the noise (a kink over half a turn is an
//! eccentricity with a scale), and no test can tell. Beside each row stands what one could do that
//! knows the shape, its size and the noise, and allows one false flag in a hundred where two names
//! are the truth (Neyman & Pearson), simulated: with what the names leave, `√λ + z`, z normal, has to
//! be above 2.33.

use truepose::diagnosis::{Diagnosis, Options};

use crate::absorbed::left_by_neighbours;
use crate::asked::{diagnosed_with, in_short};
use crate::cells::{count, details, in_parallel, row};
use crate::rig::shapes::{STRANGE, Shape};
use crate::rig::{Design, Hidden, Random, Rig};
use crate::{design, names};

const LAMBDA: f64 = 400.0;

pub fn strange(n: usize) {
    let mut all = Vec::new();
    for id in STRANGE {
        let own = in_parallel(n, |k| {
            let (rig, answer) = session(k, |random, span| {
                Hidden::Shape(Shape::random(id, random, span))
            });
            let (flagged, named) = (answer.unexplained.present, !answer.found.is_empty());
            let (left, names) = left_by_neighbours(&rig, &rig.hidden[0], NAMES_TOGETHER);
            if named || !flagged {
                let short = || in_short(&rig, &answer);
                details(|| format!("{id} {k}: λ {left:.1} left by {names:?}; {}", short()));
            }
            Seen {
                flagged,
                named,
                left,
                seen_by_the_ideal: left.sqrt() + Random(811 + k as u64).normal() > ONE_IN_A_HUNDRED,
            }
        });
        rows(&format!("unknown {id}, λ = 400"), &own);
        all.extend(own);
    }
    rows("strange unknowns, all, λ = 400", &all);
    broken_orders(n);
}

/// So many names make up a shape.
const NAMES_TOGETHER: usize = 2;
/// What the names leave is plain to see above this.
const PLAIN: f64 = 50.0;
/// Point of the normal distribution that one false flag in a hundred leaves beyond it.
const ONE_IN_A_HUNDRED: f64 = 2.326;

/// What one session showed.
struct Seen {
    flagged: bool,
    named: bool,
    /// λ that the best two names leave.
    left: f64,
    seen_by_the_ideal: bool,
}

fn rows(name: &str, own: &[Seen]) {
    let both = |name: &str, own: &[&Seen], bars: [&str; 2]| {
        let count = |what: fn(&Seen) -> bool| own.iter().filter(|s| what(s)).count();
        row(
            &format!("{name}: flagged"),
            count(|s| s.flagged),
            own.len(),
            bars[0],
        );
        row("  named", count(|s| s.named), own.len(), bars[1]);
    };
    let all: Vec<&Seen> = own.iter().collect();
    both(name, &all, ["≥ 95 %", "≤ 5 %"]);
    let ideal = own.iter().filter(|s| s.seen_by_the_ideal).count();
    row("  the ideal test flags", ideal, own.len(), "");
    let plain: Vec<&Seen> = own.iter().filter(|s| s.left >= PLAIN).collect();
    both(
        "  where two names leave λ ≥ 50",
        &plain,
        ["≥ 95 %", "≤ 5 %"],
    );
}

fn session(k: usize, of: impl Fn(&mut Random, f64) -> Hidden) -> (Rig, Diagnosis) {
    let mut random = Random(809 + 236_887_691 * k as u64);
    let design = Design {
        samples: 200 + 20 * (k % 3),
        ..design(&mut random, "")
    };
    let mut rig = Rig::new(&design, &mut random);
    let effect = of(&mut random, design.span_deg.to_radians());
    rig.hidden = vec![rig.sized(&effect, LAMBDA)];
    rig.measure(&mut random);
    let answer = diagnosed_with(&rig, &Options::default());
    (rig, answer)
}

/// Orders that gears have: 43.7 of a harmonic drive behind a belt, and any others.
const ORDERS: [f64; 3] = [43.7, 12.4, 7.3];
/// An order is right within this, or inside its interval.
const NEAR: f64 = 0.1;

fn broken_orders(n: usize) {
    let all = in_parallel(2 * n, |k| {
        let (rig, answer) = session(k, |random, _| {
            let any = 5.0 + random.below(75) as f64 + random.between(0.15, 0.85);
            let order = if k % 2 == 0 { ORDERS[k / 2 % 3] } else { any };
            Hidden::Gear(order, 1e-4, random.between(0.0, std::f64::consts::TAU))
        });
        let alone = names(&answer) == ["gear-transmission-error"];
        let right = alone && !answer.unexplained.present && order_is_right(&rig, &answer);
        if !right {
            details(|| {
                let parameters = answer.found.iter().flat_map(|f| &f.parameters);
                let orders: Vec<_> = parameters.filter(|p| p.name == "order").collect();
                let orders: Vec<_> = orders.iter().map(|p| (p.value, p.ci95)).collect();
                format!("order {k}: {orders:?} {}", in_short(&rig, &answer))
            });
        }
        (right, alone)
    });
    row(
        "a gear order that is not whole, λ = 400: named alone, its order right",
        count(&all, |a| a.0),
        all.len(),
        "≥ 95 %",
    );
    row(
        "  named alone, whatever the order",
        count(&all, |a| a.1),
        all.len(),
        "",
    );
}

fn order_is_right(rig: &Rig, answer: &Diagnosis) -> bool {
    let Hidden::Gear(truth, ..) = &rig.hidden[0] else {
        return false;
    };
    let mut parameters = answer.found.iter().flat_map(|f| &f.parameters);
    parameters.any(|p| {
        let inside = p
            .ci95
            .is_some_and(|[low, high]| low <= *truth && *truth <= high);
        p.name == "order" && (inside || (p.value - truth).abs() <= NEAR)
    })
}
