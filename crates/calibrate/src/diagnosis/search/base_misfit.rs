//! Names in place of what the description of a robot with several joints lacks. None is reported where several are
//! needed and the residual is large nevertheless (the base model does not fit), where they do not predict unseen
//! places better than the geometry alone (they only follow the samples), or where one has a size that no machine has
//! and the residual is large (it imitates something else).

use crate::budget;
use crate::fit::base_model;

use super::floor::floor;
use super::forward::mean_sigma_mm;
use super::found::SearchResult;
use super::prepare::PreparedSearch;
use super::{aliases, final_set};
use crate::answers::diagnosis::FloorFrom;
use crate::diagnosis::evidence::Fit;
use crate::diagnosis::evidence::is_beyond;
use crate::diagnosis::evidence::rival::Rival;
use crate::effects::Term;

/// The residual of a correct set of names is less than this many times the floor.
const MOST_OVER_THE_FLOOR: f64 = 1.5;

/// A size so many times as large as an implausible one is not that of its effect: where the residual is large, the
/// name imitates something else.
const IMPOSSIBLE: f64 = 3.0;
/// One of a joint, so many times as large, imitates something else whatever the residual: a joint whose values are in
/// another unit passes for an encoder that errs by half a turn.
const ABSURD: f64 = 20.0;

/// Withdraws the names of a robot with several joints whose base model does not fit.
pub(crate) fn withdraw(prepared: &PreparedSearch, found: &mut SearchResult) {
    let regression = &prepared.regression;
    found.fit = likeliest(prepared, found.fit.clone());
    let model = &found.fit.model;
    let absurd =
        |term: &Term| term.effect.about().per_joint && is_beyond(&model.robot, term, ABSURD);
    if model.terms().iter().any(absurd) {
        let base = regression.fit(&regression.base, &[]);
        found.named_effects_only = std::mem::replace(&mut found.fit, base);
        found.base_misfit = true;
        found.other_ends.clear();
        return;
    }
    let names = regression.added(&found.fit).len();
    if names == 0 || !base_model::is_arm(prepared.problem.session) {
        return;
    }
    // Names alone are what a model keeps.
    let alone = regression.fit(&found.fit.model, &[]);
    let base = regression.fit(&regression.base, &[]);
    let unseen = |fit: &Fit| prepared.folds.rms(regression, fit);
    if prepared.folds.are_enough() && unseen(&alone) >= unseen(&base) {
        let shapes = found.fit.shapes.clone();
        found.named_effects_only = alone;
        found.fit = regression.fit(&regression.base, &shapes);
        return;
    }
    let model = &found.fit.model;
    let impossible = |term: &Term| is_beyond(&model.robot, term, IMPOSSIBLE);
    let several = names >= 2 || model.terms().iter().any(impossible);
    // A search that ended early leaves effects that it had no time for: that is no evidence against the base.
    if !several || regression.work.ended().is_some() {
        return;
    }
    let floor = floor(prepared, &found.fit);
    let more = residual_mm(prepared, &found.fit) > MOST_OVER_THE_FLOOR * floor.mm;
    if floor.from != FloorFrom::Estimated && more {
        found.named_effects_only = std::mem::replace(&mut found.fit, base);
        found.base_misfit = true;
    }
}

/// The likeliest set of names that can be reported of a robot with several joints: others replace those of the fit
/// where they are likelier and remain likelier after the final tests. A rival that fails these itself is ignored.
fn likeliest(prepared: &PreparedSearch, mut fit: Fit) -> Fit {
    let regression = &prepared.regression;
    if !base_model::is_arm(prepared.problem.session) {
        return fit;
    }
    // The evidence rises with each exchange, so that it ends.
    loop {
        if regression.work.is_spent() {
            return fit;
        }
        let above = |r: &Rival| r.other_names() && final_set::is_likelier(&r.fit, &fit);
        let still_likelier = |r: &Rival| {
            let reported = final_set::reportable(prepared, r.fit.clone())?;
            let fits = regression.added(&reported).len() <= prepared.cap();
            (fits && final_set::is_likelier(&reported, &fit)).then_some(reported)
        };
        let rivals = aliases::rivals(regression, &fit).into_iter();
        let goes_on = |_: &Rival| !regression.work.is_spent();
        let mut rivals = rivals
            .filter(above)
            .take(budget::LISTED)
            .take_while(goes_on);
        let Some(likelier) = rivals.find_map(|r| still_likelier(&r)) else {
            return fit;
        };
        fit = likelier;
    }
}

/// RMS residual of a fit, mm.
pub(crate) fn residual_mm(prepared: &PreparedSearch, fit: &Fit) -> f64 {
    let regression = &prepared.regression;
    if let Some(noise_mm) = regression.rows.noise_mm(&regression.noise) {
        return regression.scale(fit) * noise_mm;
    }
    let axes = regression.rows.axes.len() as f64;
    regression.scale(fit) * mean_sigma_mm(regression) * axes.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinematics::JointKind;
    use crate::sessions::load;

    #[test]
    fn a_size_of_no_machine_is_impossible_on_a_joint_that_turns() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../sessions/arm/arm.json");
        let mut robot = load(std::path::Path::new(path)).unwrap().session.robot;
        robot.joints[2].kind = JointKind::Prismatic;
        let impossible = |id: &str, joint, name: &str, value: f64| {
            let term = Term::from_parameters(id, joint, &[(name, value)], 6).unwrap();
            is_beyond(&robot, &term, IMPOSSIBLE)
        };
        assert!(impossible("thermal-growth", 6, "ppm_per_degc", 17_728.0));
        assert!(!impossible("thermal-growth", 6, "ppm_per_degc", 60.0));
        assert!(impossible("backlash", 2, "width_deg", 4.0));
        assert!(!impossible("backlash", 3, "width_mm", 0.4));
    }
}
