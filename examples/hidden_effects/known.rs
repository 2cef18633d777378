//! Effects of the catalogue: named exactly, intervals that hold, and no harm on samples that no
//! fit has seen. Each session has as many held-out samples as fitted ones, from the same rig.

use truepose::diagnosis::Diagnosis;
use truepose::fit::Estimate;

use crate::absorbed::{left_beside_the_others, left_by_neighbours};
use crate::asked::{base_of, in_the_set};
use crate::cells::{count, details, in_parallel, row};
use crate::rig::{Design, Hidden, Random, Rig};
use crate::{design, diagnosed, hidden, names, single_names};

/// A canonical correlation of .95 leaves a tenth.
const NOT_ALIASED: f64 = 0.1;
/// A vector of so little strength is named alone in hardly three of four sessions.
const FAINT: f64 = 100.0;

/// What one session showed.
#[allow(
    clippy::struct_excessive_bools,
    reason = "each is a column of the table"
)]
struct Seen {
    /// One or two other names leave less than [`NOT_ALIASED`] of the effect, or the other hidden ones less
    /// than [`FAINT`].
    aliased: bool,
    exact: bool,
    in_the_set: bool,
    /// Intervals that cover, and how many there are: of the base and of the effect's own.
    base: (usize, usize),
    own: (usize, usize),
    /// Steps that lie between the times that are said, and how many there are.
    within: (usize, usize),
    /// (Held-out gap / true noise)².
    ratio: f64,
    named: bool,
    worse: bool,
}

fn seen(rig: &Rig, answer: &Diagnosis, truth: &[&str]) -> Seen {
    let exact = names(answer) == truth && !answer.unexplained.present;
    let in_the_set = exact || in_the_set(answer, truth);
    let of_base = base_of(rig);
    let (mut base, mut own, mut within) = ((0, 0), (0, 0), (0, 0));
    if exact {
        base = covered(&answer.identified, &of_base);
        for found in &answer.found {
            for hidden in rig.hidden.iter().filter(|h| h.id() == found.effect) {
                let (good, of) = covered(&found.parameters, &hidden.parameters());
                own = (own.0 + good, own.1 + of);
                if let (Hidden::Shift(time, _), Some([from, to])) = (hidden, found.within_s) {
                    let inside = from <= *time && *time <= to;
                    within = (within.0 + usize::from(inside), within.1 + 1);
                }
            }
        }
    }
    let gaps = answer.held_out.gaps;
    let floor = rig.design.sigma_mm * 3.0_f64.sqrt();
    Seen {
        aliased: false,
        exact,
        in_the_set,
        base,
        own,
        within,
        ratio: gaps.map_or(0.0, |g| (g.end_mm / floor).powi(2)),
        named: !answer.found.is_empty(),
        worse: gaps.is_some_and(|g| g.end_mm > g.identified_mm),
    }
}

/// Intervals that cover the truth; of a phase, going round.
pub fn covered(estimates: &[Estimate], truth: &[(&str, f64)]) -> (usize, usize) {
    let (mut good, mut of) = (0, 0);
    for estimate in estimates {
        // That of a step's time is not of 95 %; see `within`.
        let counts = estimate.name != "time_s";
        let value = truth.iter().find(|t| counts && t.0 == estimate.name);
        if let (Some((_, value)), Some([low, high])) = (value, estimate.ci95) {
            let turns = if estimate.name == "phase_deg" { 2 } else { 0 };
            of += 1;
            good += usize::from((-turns..=turns).any(|turn| {
                let value = value + 360.0 * f64::from(turn);
                low <= value && value <= high
            }));
        }
    }
    (good, of)
}

fn rows(all: &[Seen], name: &str, aliased: &str, bar: &str) {
    row(
        &format!("{name}: exact"),
        count(all, |s| s.exact && !s.aliased),
        count(all, |s| !s.aliased),
        bar,
    );
    row(
        &format!("  {aliased}: exact"),
        count(all, |s| s.exact && s.aliased),
        count(all, |s| s.aliased),
        "",
    );
    row(
        "  all: found, or in a set that cannot be ruled out",
        count(all, |s| s.in_the_set),
        all.len(),
        "",
    );
    let sum = |of: fn(&Seen) -> (usize, usize)| {
        let all = all.iter().map(of);
        all.fold((0, 0), |a, b| (a.0 + b.0, a.1 + b.1))
    };
    let (base, own, within) = (sum(|s| s.base), sum(|s| s.own), sum(|s| s.within));
    row(
        "  95 % intervals of zero offset and link length cover",
        base.0,
        base.1,
        "93–97 %",
    );
    row(
        "  95 % intervals of what was found cover",
        own.0,
        own.1,
        "93–97 %",
    );
    row(
        "  a step of the frame lies between the times that are said with 95 %",
        within.0,
        within.1,
        "93–97 %",
    );
    let square: f64 = all.iter().map(|s| s.ratio).sum::<f64>() / all.len().max(1) as f64;
    println!(
        "|   held-out gap over the noise, root mean square of all sessions | {:.3} | ≤ 1.03 |",
        square.sqrt()
    );
    row(
        "  held-out gap made worse by the names",
        count(all, |s| s.worse && s.named),
        count(all, |s| s.named),
        "≤ 0.5 %",
    );
}

pub fn one_effect(n: usize) {
    let ids: Vec<&str> = single_names().collect();
    for (lambda, bar) in [(200_u32, "≥ 99 %"), (100, "≥ 97 %"), (40, "≥ 75 %")] {
        let all = in_parallel(ids.len() * n, |cell| {
            let (id, k) = (ids[cell / n], cell % n);
            let mut random = Random(77 + 104_729 * cell as u64 + 15_486_277 * u64::from(lambda));
            let lambda = f64::from(lambda);
            let design = design(&mut random, id);
            let mut rig = hidden(&design, &[id], lambda, &mut random);
            rig.measure_unseen(&mut random);
            let answer = diagnosed(&rig, &[]);
            let (left, _) = left_by_neighbours(&rig, &rig.hidden[0], 2);
            let mut seen = seen(&rig, &answer, &[id]);
            seen.aliased = left < NOT_ALIASED * lambda;
            told(&rig, &answer, &seen, lambda, k);
            seen
        });
        let aliased = "aliased, as two other names leave less than a tenth";
        rows(&all, &format!("one effect, λ = {lambda}"), aliased, bar);
    }
}

pub fn three_effects(n: usize) {
    let pool: Vec<&str> = single_names()
        .filter(|id| *id != "joint-compliance")
        .collect();
    let all = in_parallel(n, |k| {
        let mut random = Random(5 + 15_485_863 * k as u64);
        let design = Design {
            samples: 200,
            reflectors: 2,
            span_deg: 170.0,
            ..design(&mut random, "")
        };
        let mut ids: Vec<&str> = Vec::new();
        while ids.len() < 3 {
            let id = pool[random.below(pool.len())];
            if !ids.contains(&id) {
                ids.push(id);
            }
        }
        let mut rig = hidden(&design, &ids, 200.0, &mut random);
        rig.measure_unseen(&mut random);
        ids.sort_unstable();
        let answer = diagnosed(&rig, &[]);
        let mut seen = seen(&rig, &answer, &ids);
        let left = rig.hidden.iter().map(|h| left_beside_the_others(&rig, h));
        seen.aliased = left.fold(f64::INFINITY, f64::min) < FAINT;
        told(&rig, &answer, &seen, 200.0, k);
        seen
    });
    let aliased = format!("of one less than λ = {FAINT} is left beside the other two");
    let name = "three effects, λ = 200, two reflectors";
    rows(&all, name, &aliased, "≥ 95 %");
}

fn told(rig: &Rig, answer: &Diagnosis, seen: &Seen, lambda: f64, k: usize) {
    if seen.exact && !seen.worse {
        return;
    }
    details(|| {
        let rivals: Vec<_> = answer
            .equivalent
            .iter()
            .map(|e| (&e.explanation, &e.instead, e.odds))
            .collect();
        format!(
            "λ {lambda} {k}: span {} shuffled {} hidden {:?}\n    found {:?} {} {} set {} worse {} {rivals:?} slow {:?}",
            rig.design.span_deg,
            rig.design.shuffled,
            rig.hidden,
            names(answer),
            answer.unexplained.description,
            answer.unexplained.resembles.join(" "),
            seen.in_the_set,
            seen.worse,
            answer.noise.slow,
        )
    });
}
