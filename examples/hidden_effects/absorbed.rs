//! How much of an effect its neighbours of the catalogue can absorb, by brute force on the rig:
//!
//! ```text
//! λ_left = min ‖d − B β‖² / σ²,   B the base and the columns of up to four other names
//! ```
//!
//! Two names are chosen together from the best settings of all, more one by one while a search
//! would take them. For example a base offset at one radius is exactly second-order runout and
//! eccentricity.

use crate::rig::{Hidden, NAMES, Rig};

/// A name with a setting and its columns, projected off the base, orthonormal.
struct Neighbour {
    id: &'static str,
    columns: Vec<Vec<f64>>,
    gain: f64,
}

/// Settings of one name that pairs are made from.
const SETTINGS: usize = 4;
/// A third and a fourth name are taken while they explain so much.
const WORTHWHILE: f64 = 25.0;

/// Strength that is left of a hidden effect beside the base and the others that are hidden, each with its own
/// columns: two that nearly cancel each other, such as a step of the frame and a base that stands elsewhere,
/// leave little of each.
pub fn left_beside_the_others(rig: &Rig, hidden: &Hidden) -> f64 {
    let mut columns = of_the_base(rig);
    for other in rig.hidden.iter().filter(|h| *h != hidden) {
        for column in own_columns(other) {
            add(&mut columns, difference(rig, rig, &[], &[column]));
        }
    }
    let mut left = difference(rig, rig, &[], std::slice::from_ref(hidden));
    project(&columns, &mut left);
    dot(&left, &left) / rig.design.sigma_mm.powi(2)
}

/// Effects of a small size at the setting of this one, one for each of its columns.
fn own_columns(hidden: &Hidden) -> Vec<Hidden> {
    let quarter = std::f64::consts::FRAC_PI_2;
    let phases = |make: &dyn Fn(f64) -> Hidden| vec![make(0.0), make(quarter)];
    match *hidden {
        Hidden::Eccentricity(a, _) => phases(&|p| Hidden::Eccentricity(a, p)),
        Hidden::TwoCycle(a, _) => phases(&|p| Hidden::TwoCycle(a, p)),
        Hidden::Gear(k, a, _) => phases(&|p| Hidden::Gear(k, a, p)),
        Hidden::Runout(k, a, _) => phases(&|p| Hidden::Runout(k, a, p)),
        Hidden::Wobble(k, a, _) => phases(&|p| Hidden::Wobble(k, a, p)),
        Hidden::Tilt(..) => vec![Hidden::Tilt(1e-5, 0.0), Hidden::Tilt(0.0, 1e-5)],
        Hidden::BaseOffset(_) => along(&Hidden::BaseOffset),
        Hidden::Shift(t, _) => along(&|v| Hidden::Shift(t, v)),
        Hidden::Drift(_) => along(&|v| Hidden::Drift(v.map(|x| x * 1e-3))),
        ref one => vec![one.clone()],
    }
}

fn along(make: &dyn Fn([f64; 3]) -> Hidden) -> Vec<Hidden> {
    vec![
        make([1e-3, 0.0, 0.0]),
        make([0.0, 1e-3, 0.0]),
        make([0.0, 0.0, 1e-3]),
    ]
}

/// What zero offset and link length do.
fn of_the_base(rig: &Rig) -> Vec<Vec<f64>> {
    let mut base = Vec::new();
    for (offset, length) in [(1e-5, 0.0), (0.0, 1e-3)] {
        let mut moved = rig.clone();
        moved.offset += offset;
        moved.length += length;
        add(&mut base, difference(rig, &moved, &[], &[]));
    }
    base
}

/// Strength that the best neighbours, at most so many, leave of a hidden effect, and who they are.
pub fn left_by_neighbours(rig: &Rig, hidden: &Hidden, most: usize) -> (f64, Vec<&'static str>) {
    let base = of_the_base(rig);
    let mut left = difference(rig, rig, &[], std::slice::from_ref(hidden));
    project(&base, &mut left);
    let mut short: Vec<Neighbour> = Vec::new();
    for id in NAMES.into_iter().filter(|id| !twins(id, hidden.id())) {
        let mut own: Vec<Neighbour> = variants(rig, id)
            .into_iter()
            .map(|columns| neighbour(rig, &base, &left, id, &columns))
            .collect();
        own.sort_by(|a, b| b.gain.total_cmp(&a.gain));
        own.truncate(SETTINGS);
        short.extend(own);
    }
    let single = short.iter().max_by(|a, b| a.gain.total_cmp(&b.gain));
    // The best pair, its columns made orthonormal together.
    let mut best: (f64, Vec<Vec<f64>>, Vec<&'static str>) = single
        .map(|s| (s.gain, s.columns.clone(), vec![s.id]))
        .unwrap_or_default();
    for (i, a) in short.iter().enumerate().filter(|_| most > 1) {
        for b in &short[i + 1..] {
            let mut both = a.columns.clone();
            for column in &b.columns {
                add(&mut both, column.clone());
            }
            let gain: f64 = both.iter().map(|c| dot(c, &left).powi(2)).sum();
            if gain > best.0 {
                best = (gain, both, vec![a.id, b.id]);
            }
        }
    }
    let (_, mut together, mut names) = best;
    project(&together, &mut left);
    while names.len() < most {
        let gains = short.iter().map(|s| {
            let mut new = together.clone();
            let had = new.len();
            s.columns.iter().for_each(|c| add(&mut new, c.clone()));
            let gain: f64 = new[had..].iter().map(|c| dot(c, &left).powi(2)).sum();
            (gain, new, s.id)
        });
        let Some((gain, new, id)) = gains.max_by(|a, b| a.0.total_cmp(&b.0)) else {
            break;
        };
        if gain / rig.design.sigma_mm.powi(2) < WORTHWHILE {
            break;
        }
        project(&new, &mut left);
        together = new;
        names.push(id);
    }
    (dot(&left, &left) / rig.design.sigma_mm.powi(2), names)
}

/// The effect itself, and one that becomes the other as a setting goes to its end.
fn twins(id: &str, of: &str) -> bool {
    id == of
        || matches!(
            (id, of),
            ("lost-motion", "backlash") | ("backlash", "lost-motion")
        )
}

/// Every setting of a name as effects of a small size, one for each column.
fn variants(rig: &Rig, id: &str) -> Vec<Vec<Hidden>> {
    let quarter = std::f64::consts::FRAC_PI_2;
    let waves = |orders: std::ops::RangeInclusive<u32>, make: &dyn Fn(f64, f64) -> Hidden| {
        let of = |k: u32| vec![make(f64::from(k), 0.0), make(f64::from(k), quarter)];
        orders.map(of).collect::<Vec<_>>()
    };
    let end = rig.shots.iter().map(|s| s.time).fold(0.0, f64::max);
    let one = |h: Hidden| vec![vec![h]];
    match id {
        "joint-scale" => one(Hidden::Scale(1e-5)),
        "encoder-eccentricity" => waves(1..=1, &|_, p| Hidden::Eccentricity(1e-5, p)),
        "encoder-two-cycle" => waves(2..=2, &|_, p| Hidden::TwoCycle(1e-5, p)),
        "gear-transmission-error" => waves(3..=360, &|k, p| Hidden::Gear(k, 1e-5, p)),
        "backlash" => one(Hidden::Backlash(1e-5)),
        "lost-motion" => (1..=10)
            .map(|k| vec![Hidden::LostMotion(1e-5, 0.03 * 1.6_f64.powi(k))])
            .collect(),
        "tracking-lag" => one(Hidden::Lag(1e-4)),
        "thermal-zero-drift" => one(Hidden::ThermalZero(1e-5)),
        "joint-compliance" => one(Hidden::Compliance(1e-6)),
        "thermal-growth" => one(Hidden::ThermalGrowth(1e-6)),
        "bearing-runout" => waves(2..=6, &|k, p| Hidden::Runout(k, 1e-3, p)),
        "axis-wobble" => waves(2..=6, &|k, p| Hidden::Wobble(k, 1e-5, p)),
        "link-droop" => one(Hidden::Droop(1e-3)),
        "axis-tilt" => vec![vec![Hidden::Tilt(1e-5, 0.0), Hidden::Tilt(0.0, 1e-5)]],
        "base-offset" => vec![along(&Hidden::BaseOffset)],
        "instrument-scale" => one(Hidden::InstrumentScale(1e-5)),
        "frame-shift" => (1..50)
            .map(|k| along(&|v| Hidden::Shift(end * f64::from(k) / 50.0, v)))
            .collect(),
        "frame-drift" => vec![along(&|v| Hidden::Drift(v.map(|x| x / end)))],
        other => panic!("no effect {other}"),
    }
}

fn neighbour(
    rig: &Rig,
    base: &[Vec<f64>],
    left: &[f64],
    id: &'static str,
    effects: &[Hidden],
) -> Neighbour {
    let mut columns = Vec::new();
    for effect in effects {
        let mut column = difference(rig, rig, &[], std::slice::from_ref(effect));
        project(base, &mut column);
        add(&mut columns, column);
    }
    Neighbour {
        id,
        gain: columns.iter().map(|c| dot(c, left).powi(2)).sum(),
        columns,
    }
}

/// How the points move from one rig with some effects to another with others, mm.
fn difference(from: &Rig, to: &Rig, without: &[Hidden], with: &[Hidden]) -> Vec<f64> {
    let mut all = Vec::new();
    let fitted = |i: &usize| !from.held_out.get(*i).is_some_and(|h| *h);
    for shot in (0..from.shots.len()).filter(fitted).map(|i| &from.shots[i]) {
        let (a, b) = (from.point(shot, without), to.point(shot, with));
        all.extend((0..3).map(|k| b[k] - a[k]));
    }
    all
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Takes what the orthonormal columns explain out of a vector.
fn project(basis: &[Vec<f64>], v: &mut [f64]) {
    for column in basis {
        let along = dot(column, v);
        v.iter_mut().zip(column).for_each(|(v, c)| *v -= along * c);
    }
}

/// Adds a column to an orthonormal basis, unless nothing of it is new.
fn add(basis: &mut Vec<Vec<f64>>, mut column: Vec<f64>) {
    let before = dot(&column, &column).sqrt();
    project(basis, &mut column);
    project(basis, &mut column);
    let norm = dot(&column, &column).sqrt();
    if norm > 1e-6 * before && norm > 0.0 {
        for v in &mut column {
            *v /= norm;
        }
        basis.push(column);
    }
}
