//! The search for the names that explain the samples. [`searched`] is the whole search: forward with swaps, drops and
//! pairs, again once outliers and noise are known given the names, then against slow noise and free curves, and a last
//! test of each name given the others.
//!
//! - `procedure`: the whole of it; `prepare`: from a session to the rows (`robust`, `classes`, `clusters`: which samples count).
//! - `forward`: one search; `settle`: swaps, drops and pairs; `orders`: several orders of one joint together; `found`: what it ends with.
//! - `aliases`, `other_settings`: rivals that the samples cannot rule out; `slowest`: of waves at equal steps the slowest.
//! - `free_curve`: a curve without a name as the rival of names.
//! - `final_set`, `worth`, `steps`, `own_evidence`: the final tests of the names, and the gain of each.
//! - `chosen_again`: names that few poses show; `floor`, `base_misfit`, `gross_error`: names that are withdrawn because it is
//!   the geometry that does not fit.

pub(crate) mod aliases;
mod base_misfit;
mod chosen_again;
mod classes;
mod clusters;
mod final_set;
mod floor;
mod forward;
mod found;
pub(crate) mod free_curve;
mod gross_error;
mod orders;
pub(crate) mod other_settings;
mod own_evidence;
pub(crate) mod prepare;
mod procedure;
mod robust;
mod settle;
mod slowest;
mod steps;
mod worth;

pub(crate) use base_misfit::residual_mm;
pub(crate) use final_set::{EQUALLY_LIKELY, exceeds_when_tested, is_likelier};
pub(crate) use floor::{PureError, floor, pure_error};
pub(crate) use forward::mean_sigma_mm;
pub(crate) use found::SearchResult;
pub(crate) use gross_error::{is_gross, size_mm};
pub(crate) use orders::OrderSpread;
pub(crate) use prepare::MANY_NAMES;
pub(crate) use procedure::{checked, prepared, searched, until_stopped};
pub(crate) use settle::NEEDED;
pub(crate) use steps::{Next, Step, steps};
pub(crate) use worth::{Worth, worth};
