//! The rest: the smooth discrepancy of a model that has no name, over one joint or of an arm.
//!
//! In addition to a base and names there are groups of columns whose sizes are chosen by restricted likelihood. They
//! are handed out where they predict unseen samples.
//!
//! - `groups`, `products`: evidence and variances of groups of columns; `held_out`: their cross-validation.
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
