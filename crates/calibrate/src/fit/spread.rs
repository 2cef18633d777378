//! Some of many, spread evenly: the only way in which a long session is thinned.

use crate::numeric::GOLDEN_RATIO;

/// At most so many places among `count`, in order: one in each of as many stretches, at a step of the golden ratio inside
/// it, so that no rhythm of the poses is hit.
pub(crate) fn places(count: usize, most: usize) -> impl Iterator<Item = usize> {
    let stretches = most.min(count);
    (0..stretches).map(move |k| {
        let (from, to) = (k * count / stretches, (k + 1) * count / stretches);
        let inside = (k as f64 * GOLDEN_RATIO).fract();
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a place among the samples"
        )]
        let at = from + ((to - from) as f64 * inside) as usize;
        at.min(to - 1)
    })
}

/// At most so many of those that count, in order.
pub(crate) fn spread(used: &[bool], most: usize) -> Vec<usize> {
    let used: Vec<usize> = (0..used.len()).filter(|i| used[*i]).collect();
    places(used.len(), most).map(|k| used[k]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_different_ones_from_end_to_end() {
        for (count, most) in [(1495, 500), (601, 600), (7, 60), (1_000_003, 3000), (0, 5)] {
            let all: Vec<usize> = places(count, most).collect();
            assert_eq!(all.len(), count.min(most));
            assert!(
                all.windows(2).all(|pair| pair[0] < pair[1]),
                "{count} {most}"
            );
            assert!(all.last().is_none_or(|last| *last < count));
            let gaps = all.windows(2).map(|pair| pair[1] - pair[0]);
            assert!(gaps.max().unwrap_or(0) <= 2 * count.div_ceil(most));
        }
    }
}
