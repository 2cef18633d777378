//! Unknowns that a sum of names can imitate: a kink, levels by sector, a chirp. And gear orders
//! that are not whole, which have a name and a number.

use truepose::diagnosis::{Diagnosis, Options};

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
            if named || !flagged {
                details(|| format!("{id} {k}: {}", in_short(&rig, &answer)));
            }
            (flagged, named)
        });
        rows(&format!("unknown {id}, λ = 400"), &own);
        all.extend(own);
    }
    rows("strange unknowns, all, λ = 400", &all);
    broken_orders(n);
}

fn rows(name: &str, own: &[(bool, bool)]) {
    row(
        &format!("{name}: flagged"),
        count(own, |a| a.0),
        own.len(),
        "≥ 95 %",
    );
    row("  named", count(own, |a| a.1), own.len(), "≤ 5 %");
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
