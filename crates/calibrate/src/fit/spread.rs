//! Samples spread evenly over a session.

const GOLDEN_RATIO: f64 = 0.618_033_988_749_894_9;

/// At most so many of those that count, in order: a step of the golden ratio inside each stretch, so
/// that no rhythm of the poses is hit.
pub(crate) fn spread(used: &[bool], most: usize) -> Vec<usize> {
    let used: Vec<usize> = (0..used.len()).filter(|i| used[*i]).collect();
    if used.len() <= most {
        return used;
    }
    let stretch = used.len() as f64 / most as f64;
    let at = |k: usize| ((k as f64 + (k as f64 * GOLDEN_RATIO).fract()) * stretch).floor();
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a place among the samples"
    )]
    let index = |k: usize| (at(k) as usize).min(used.len() - 1);
    (0..most).map(|k| used[index(k)]).collect()
}
