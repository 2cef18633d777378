//! Names in place of what the description of a robot with several joints lacks. Where several are
//! needed and much is left all the same, it is the base model that does not fit; where they predict
//! unseen places no better than the geometry alone, they only follow the samples. Neither is said.

use crate::fit::base_model;

use super::aliases::{self, Rival};
use super::final_set;
use super::floor::floor;
use super::prepare::Prepared;
use super::regression::Fit;
use super::search::{Found, mean_sigma_mm};
use crate::answers::diagnosis::FloorFrom;

/// So many names are several.
const SEVERAL: usize = 2;
/// Names that are right leave less than this many times the floor.
const MOST_OVER_THE_FLOOR: f64 = 1.5;

/// Withdraws the names of a robot with several joints whose base model does not fit.
pub(crate) fn withdraw(prepared: &Prepared, found: &mut Found) {
    let regression = &prepared.regression;
    found.fit = without_less_likely(prepared, found.fit.clone());
    let names = regression.added(&found.fit).len();
    if names == 0 || !base_model::is_arm(prepared.problem.session) {
        return;
    }
    // Names alone are what a model keeps.
    let alone = regression.fit(&found.fit.model, Vec::new());
    let base = regression.fit(&regression.base, Vec::new());
    let unseen = |fit: &Fit| prepared.folds.rms(regression, fit);
    if prepared.folds.say_something() && unseen(&alone) >= unseen(&base) {
        let shapes = found.fit.shapes.clone();
        found.names_only = alone;
        found.fit = regression.fit(&regression.base, shapes);
        return;
    }
    if names < SEVERAL {
        return;
    }
    let floor = floor(prepared, &found.fit);
    let more = left_mm(prepared, &found.fit) > MOST_OVER_THE_FLOOR * floor.mm;
    if floor.from != FloorFrom::Estimated && more {
        found.names_only = std::mem::replace(&mut found.fit, base);
        found.base_misfit = true;
    }
}

/// A fit of a robot with several joints without the names in whose place others are likelier.
fn without_less_likely(prepared: &Prepared, mut fit: Fit) -> Fit {
    let regression = &prepared.regression;
    if !base_model::is_arm(prepared.problem.session) {
        return fit;
    }
    loop {
        let likelier =
            |r: &Rival| r.other_names() && final_set::stands_above(prepared, &r.fit, &fit);
        let rival = aliases::rivals(regression, &fit).into_iter().find(likelier);
        let Some(rival) = rival else {
            return fit;
        };
        for term in &rival.removed {
            fit = regression.without_term(&fit, term);
        }
    }
}

/// Root mean square length of what a fit leaves, mm.
pub(crate) fn left_mm(prepared: &Prepared, fit: &Fit) -> f64 {
    let regression = &prepared.regression;
    if let Some(noise_mm) = regression.rows.noise_mm(&regression.noise) {
        return regression.scale(fit) * noise_mm;
    }
    let axes = regression.rows.axes.len() as f64;
    regression.scale(fit) * mean_sigma_mm(regression) * axes.sqrt()
}
