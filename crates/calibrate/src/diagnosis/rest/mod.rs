//! What has no name: the smooth rest of a model, over one joint or of an arm.
//!
//! A base and names, and beside them groups of columns whose sizes a restricted likelihood chooses, and which are handed
//! out where they predict what they have not seen.
//!
//! - `groups`, `products`: how likely groups of columns are, and how strong; `held_out`: what they predict.
//! - `kernels`, `columns`, `folds`, `joint`: a curve over one joint.
//! - `families`, `orders`, `design`, `arm`: everything that may repeat on an arm.

pub(crate) mod arm;
mod columns;
mod design;
mod families;
mod folds;
mod groups;
mod held_out;
pub(crate) mod joint;
mod kernels;
mod orders;
mod products;
