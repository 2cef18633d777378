//! A problem with an evenly spread part of its samples.

use crate::fit::problem::Problem;

/// A session of more samples than this is long …
const LONG: usize = 600;

/// The same problem with at most so many samples that count, spread evenly.
pub(crate) fn thinned<'a>(problem: &Problem<'a>, most: usize) -> Problem<'a> {
    let mut thinned = problem.clone();
    let counted = problem.counted();
    let used: Vec<usize> = (0..counted.len()).filter(|i| counted[*i]).collect();
    if used.len() <= LONG {
        return thinned;
    }
    let mut kept = vec![false; counted.len()];
    // A step of the golden ratio inside each stretch, so that no rhythm of the poses is hit.
    for k in 0..most {
        let (from, to) = (k * used.len() / most, (k + 1) * used.len() / most);
        let inside = (k as f64 * 0.618_033_988_749_894_9).fract();
        let at = from + ((to - from) as f64 * inside) as usize;
        kept[used[at.min(to - 1)]] = true;
    }
    thinned.set_counted(kept);
    thinned
}
