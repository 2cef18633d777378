//! A name of an arm that few poses show has to predict poses by which its joint and its setting were not chosen. There
//! the geometry takes most of the information, and what chance leaves looks like some joint's gear.

use super::found::SearchResult;
use super::prepare::PreparedSearch;
use crate::diagnosis::evidence::chosen_again;
use crate::fewest;
use crate::fit::base_model;
use crate::sessions::poses::ByPose;

/// The gain has to be so many times its own standard deviation. (Of a normal distribution one in six is farther off on one
/// side.)
const SURE: f64 = 1.0;

/// Withdraws the names that predict nothing where they are chosen again, the worst first.
pub(super) fn withdraw(prepared: &PreparedSearch, found: &mut SearchResult) {
    let regression = &prepared.regression;
    let rows = &regression.rows;
    let places = ByPose::of_places(&rows.inputs.q, rows.samples.len());
    if !base_model::is_arm(prepared.problem.session) || places.first.len() >= fewest::TO_SCAN {
        return;
    }
    loop {
        let names = regression.added(&found.fit).into_iter().map(|term| {
            let reduced = regression.without_term(&found.fit, term);
            let gains = chosen_again(regression, &found.fit, &reduced, term);
            (gains.sigmas, reduced)
        });
        let worst = names.min_by(|a, b| a.0.total_cmp(&b.0));
        let Some((_, reduced)) = worst.filter(|worst| worst.0 < SURE) else {
            return;
        };
        found.fit = reduced;
    }
}
