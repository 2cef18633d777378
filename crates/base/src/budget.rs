//! Budgets of computation: the bounds of a search, an iteration or a list.

/// Samples for a statistic of a long session: they give its root mean square to 1/√(2·1500), a fiftieth.
pub const SAMPLES: usize = 1500;
/// Samples of a trial, of which there are hundreds: a root mean square to 1/√(2·400), a thirtieth.
pub const OF_A_TRIAL: usize = 400;
/// Samples by which one of thousands of choices is judged before the likeliest are tried on more.
pub const OF_A_CHOICE: usize = 60;
/// Steps of Newton's method and its like: those that converge take some ten, those that do not never end.
pub const STEPS: usize = 60;
/// Rounds of two estimates that wait for one another, each a fit: each gains a digit, or they oscillate.
pub const ROUNDS: usize = 8;
/// Of what a first-order estimate ranks so many are fitted, or tried, before one is chosen or the next believed.
pub const LIKELIEST: usize = 3;
/// An estimate of a noise that changes by no more than this, as a logarithm, has converged: [`SAMPLES`] give it to as
/// much.
pub const SETTLED: f64 = 0.02;
/// Draws of noise that give a chance near a half to 3 %, and one of one in fifty to a half of itself.
pub const DRAWS: usize = 250;
/// Columns, rows or poses that go through a computation at once: enough to fill vectors and blocks, little enough to stay
/// in the cache.
pub const AT_ONCE: usize = 512;
/// Numbers of a result that are kept for when it comes again (16 MiB).
pub const NUMBERS_KEPT: usize = 1 << 21;
/// So many of a kind are listed for a reader, or compared with the answer.
pub const LISTED: usize = 6;
/// Parts into which samples are dealt to be held out in turn.
pub const FOLDS: usize = 5;
/// Stretches of a session, or cells of a workspace, of which the folds are made.
pub const CELLS: usize = 4 * FOLDS;
