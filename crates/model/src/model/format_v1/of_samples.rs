//! The corrections of the samples of a model's own session: a name and numbers. Rows, joints, targets and sockets
//! count from 1.

use crate::sessions::{Group, SessionCorrection};

/// Whole numbers up to here are exact.
const MOST: f64 = 1.0 / f64::EPSILON;

/// A correction as its name and its numbers; `None` where it is a convention of every session.
pub(super) fn numbers_of(correction: &SessionCorrection) -> Option<(&'static str, Vec<f64>)> {
    let place = |index: usize| index as f64 + 1.0;
    Some(match correction {
        SessionCorrection::Remove(rows) => {
            ("leave-out", rows.iter().map(|row| place(*row)).collect())
        }
        SessionCorrection::PairRows(shifts) => {
            let pairs = shifts
                .iter()
                .flat_map(|(row, by)| [place(*row), *by as f64]);
            ("pair-rows", pairs.collect())
        }
        SessionCorrection::ScaleSpeed { joint, factor } => {
            ("scale-speed", vec![place(*joint), *factor])
        }
        SessionCorrection::ScaleLoad(factor) => ("scale-load", vec![*factor]),
        SessionCorrection::ConvertTemperature { factor, offset } => {
            ("convert-temperature", vec![*factor, *offset])
        }
        SessionCorrection::ContinueClock(days) => (
            "continue-clock",
            days.iter().map(|sample| place(*sample)).collect(),
        ),
        SessionCorrection::Settle {
            by_mm,
            from_s,
            tau_s,
        } => ("settle", vec![*by_mm, *from_s, *tau_s]),
        SessionCorrection::StraightenSight(by) => ("straighten-sight", by.to_vec()),
        SessionCorrection::TurnGravity(m_s2) => ("turn-gravity", m_s2.to_vec()),
        SessionCorrection::WidenNoise(by_mm) => ("widen-noise", by_mm.to_vec()),
        SessionCorrection::MoveTarget { target, by_mm } => {
            let numbers = [place(*target)].into_iter().chain(*by_mm);
            ("move-target", numbers.collect())
        }
        SessionCorrection::FreeTargets => ("free-targets", Vec::new()),
        SessionCorrection::TargetsFromBase => ("targets-from-base", Vec::new()),
        SessionCorrection::LeaveOutOrientations => ("leave-out-orientations", Vec::new()),
        SessionCorrection::ExchangeDirections { first, second } => {
            ("exchange-directions", vec![place(*first), place(*second)])
        }
        SessionCorrection::TurnDirections => ("turn-directions", Vec::new()),
        SessionCorrection::TargetsWithin(sigma) => ("targets-within", vec![*sigma]),
        SessionCorrection::RenameTargets(rows) => {
            let pairs = rows
                .iter()
                .flat_map(|(row, target)| [place(*row), f64::from(*target) + 1.0]);
            ("rename-targets", pairs.collect())
        }
        SessionCorrection::Split { group, index, from } => {
            (split_of(*group), vec![place(*index), place(*from)])
        }
        SessionCorrection::Free { group, index } => (free_of(*group), vec![place(*index)]),
        _ => return None,
    })
}

/// The correction of this name with these numbers; `None` where there is none.
pub(super) fn of_numbers(name: &str, numbers: &[f64]) -> Option<SessionCorrection> {
    Some(match (name, numbers) {
        ("leave-out", rows) => {
            SessionCorrection::Remove(rows.iter().map(|row| index(*row)).collect::<Option<_>>()?)
        }
        ("pair-rows", pairs) if pairs.len() % 2 == 0 => {
            let pair = |pair: &[f64]| Some((index(pair[0])?, shift(pair[1])?));
            SessionCorrection::PairRows(pairs.chunks_exact(2).map(pair).collect::<Option<_>>()?)
        }
        ("scale-speed", [joint, factor]) => SessionCorrection::ScaleSpeed {
            joint: index(*joint)?,
            factor: *factor,
        },
        ("scale-load", [factor]) => SessionCorrection::ScaleLoad(*factor),
        ("convert-temperature", [factor, offset]) => SessionCorrection::ConvertTemperature {
            factor: *factor,
            offset: *offset,
        },
        ("continue-clock", days) => {
            let days = days.iter().map(|sample| index(*sample));
            SessionCorrection::ContinueClock(days.collect::<Option<_>>()?)
        }
        ("settle", [by_mm, from_s, tau_s]) if *tau_s > 0.0 => SessionCorrection::Settle {
            by_mm: *by_mm,
            from_s: *from_s,
            tau_s: *tau_s,
        },
        ("straighten-sight", [x, y, z]) => SessionCorrection::StraightenSight([*x, *y, *z]),
        ("turn-gravity", [x, y, z]) => SessionCorrection::TurnGravity([*x, *y, *z]),
        ("widen-noise", [x, y, z]) => SessionCorrection::WidenNoise([*x, *y, *z]),
        ("move-target", [target, x, y, z]) => SessionCorrection::MoveTarget {
            target: index(*target)?,
            by_mm: [*x, *y, *z],
        },
        ("free-targets", []) => SessionCorrection::FreeTargets,
        ("targets-from-base", []) => SessionCorrection::TargetsFromBase,
        ("leave-out-orientations", []) => SessionCorrection::LeaveOutOrientations,
        ("exchange-directions", [first, second]) => SessionCorrection::ExchangeDirections {
            first: index(*first)?,
            second: index(*second)?,
        },
        ("turn-directions", []) => SessionCorrection::TurnDirections,
        ("targets-within", [sigma]) => SessionCorrection::TargetsWithin(*sigma),
        ("rename-targets", pairs) if pairs.len() % 2 == 0 => {
            let pair = |pair: &[f64]| Some((index(pair[0])?, u32::try_from(index(pair[1])?).ok()?));
            SessionCorrection::RenameTargets(
                pairs.chunks_exact(2).map(pair).collect::<Option<_>>()?,
            )
        }
        (name, [group, from]) if name.starts_with("split-") => SessionCorrection::Split {
            group: Group::of_name(name.strip_prefix("split-")?)?,
            index: index(*group)?,
            from: index(*from)?,
        },
        (name, [group]) if name.starts_with("free-") => SessionCorrection::Free {
            group: Group::of_name(name.strip_prefix("free-")?)?,
            index: index(*group)?,
        },
        _ => return None,
    })
}

/// Stretches of rows as the first and the last of each.
pub(super) fn numbers_of_rows(rows: &[(usize, usize)]) -> Vec<f64> {
    let ends = |(first, end): &(usize, usize)| [*first as f64 + 1.0, *end as f64];
    rows.iter().flat_map(ends).collect()
}

/// The stretches of rows that these are; `None` where they are none.
pub(super) fn rows_of(numbers: &[f64]) -> Option<Vec<(usize, usize)>> {
    let stretch = |ends: &[f64]| {
        let (first, last) = (index(ends[0])?, index(ends[1])?);
        (first <= last).then_some((first, last + 1))
    };
    let stretches = numbers.chunks_exact(2).map(stretch);
    let even = numbers.len().is_multiple_of(2);
    even.then(|| stretches.collect()).flatten()
}

fn split_of(group: Group) -> &'static str {
    match group {
        Group::Target => "split-target",
        Group::Socket => "split-socket",
        Group::Setup => "split-setup",
        Group::Station => "split-station",
        Group::Plane => "split-plane",
        Group::Anchor => "split-anchor",
    }
}

fn free_of(group: Group) -> &'static str {
    match group {
        Group::Target => "free-target",
        Group::Socket => "free-socket",
        Group::Setup => "free-setup",
        Group::Station => "free-station",
        Group::Plane => "free-plane",
        Group::Anchor => "free-anchor",
    }
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a whole number from 1 to MOST"
)]
fn index(place: f64) -> Option<usize> {
    let sound = place.fract() == 0.0 && (1.0..=MOST).contains(&place);
    sound.then(|| place as usize - 1)
}

#[allow(
    clippy::cast_possible_truncation,
    reason = "a whole number within ±MOST"
)]
fn shift(by: f64) -> Option<isize> {
    (by.fract() == 0.0 && by.abs() <= MOST).then_some(by as isize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_correction_of_samples_is_read_back() {
        let all = [
            SessionCorrection::Remove(vec![0, 7]),
            SessionCorrection::PairRows(vec![(3, 1), (9, -2)]),
            SessionCorrection::ScaleSpeed {
                joint: 1,
                factor: -1.0,
            },
            SessionCorrection::ScaleLoad(0.001),
            SessionCorrection::TurnGravity([9.81, 0.0, 0.0]),
            SessionCorrection::StraightenSight([0.0, 1e-9, 2e-8]),
            SessionCorrection::Settle {
                by_mm: 0.2,
                from_s: 30.0,
                tau_s: 600.0,
            },
            SessionCorrection::ConvertTemperature {
                factor: 1.0,
                offset: -273.15,
            },
            SessionCorrection::ContinueClock(vec![14, 300]),
            SessionCorrection::WidenNoise([0.01, 0.02, 0.0]),
            SessionCorrection::MoveTarget {
                target: 2,
                by_mm: [1.0, -2.0, 0.5],
            },
            SessionCorrection::FreeTargets,
            SessionCorrection::TargetsFromBase,
            SessionCorrection::LeaveOutOrientations,
            SessionCorrection::ExchangeDirections {
                first: 0,
                second: 2,
            },
            SessionCorrection::TurnDirections,
            SessionCorrection::TargetsWithin(1.5),
            SessionCorrection::RenameTargets(vec![(3, 1), (8, 0)]),
            SessionCorrection::Split {
                group: Group::Socket,
                index: 1,
                from: 40,
            },
            SessionCorrection::Free {
                group: Group::Anchor,
                index: 2,
            },
        ];
        for correction in all {
            let (name, numbers) = numbers_of(&correction).unwrap();
            assert_eq!(of_numbers(name, &numbers), Some(correction));
        }
        assert_eq!(numbers_of(&SessionCorrection::FreeFrame), None);
        let rows = vec![(0, 3), (7, 8)];
        assert_eq!(rows_of(&numbers_of_rows(&rows)), Some(rows));
        assert_eq!(rows_of(&[4.0, 3.0]), None);
        assert_eq!(rows_of(&[4.0]), None);
        assert_eq!(of_numbers("leave-out", &[0.0]), None);
        assert_eq!(of_numbers("pair-rows", &[1.0]), None);
        assert_eq!(of_numbers("scale-load", &[]), None);
    }
}
