//! Held-out samples that the model fails to predict: the median of their errors is larger than noise and the
//! uncertainty of the model explain. However well it follows the samples that it was fitted to, the residual is then
//! more than noise.
//!
//! ```text
//! u_i² = f² + tr J_i Σ J_iᵀ + Σ_d σ_d² |J_i d|²,   median_i |e_i| / (k u_i) > 3
//! ```
//!
//! with f the noise floor, d the combinations that the measured poses do not show (`fit/expected.rs`) and k the factor by
//! which Student's t of the freedom is wider than the normal. Half of the samples may be gross errors.

use crate::fewest;
use crate::fit::base_model;
use crate::fit::expected::{uncertainties_mm, unseen_mm};
use crate::fit::gap::lengths_mm;
use crate::fit::uncertainty::{half_width_factor, normal_95};
use crate::numeric::{median, whole};
use crate::text::{Text, length};

use super::values::Values;
use crate::answers::diagnosis::Floor;
use crate::diagnosis::search::prepare::PreparedSearch;

/// The factor of the standard uncertainty; half of all normal errors are within one.
const MOST_TIMES: f64 = 3.0;

/// The message where the samples that the session holds out are not predicted.
pub(crate) fn missed(prepared: &PreparedSearch, values: &Values, floor: &Floor) -> Option<Text> {
    // Samples that an option has locked away are fitted by now; a frame that drifts is elsewhere when they were
    // measured.
    if prepared.locked.contains(&true) || values.noise_is_slow() {
        return None;
    }
    let problem = &values.problem;
    let held_out = problem.session.samples.held_out.as_deref()?;
    let residual_mm = lengths_mm(problem, &values.model);
    let is_apart = |i: &usize| problem.usable[*i] && held_out[*i] && residual_mm[*i].is_finite();
    let apart: Vec<usize> = (0..residual_mm.len()).filter(is_apart).collect();
    if apart.len() < fewest::TO_JUDGE {
        return None;
    }
    let inputs = problem.inputs.select(&apart);
    let covariance = values.covariance.as_ref();
    let of_values = covariance.and_then(|c| uncertainties_mm(&values.model, &inputs, c));
    let of_values = of_values.unwrap_or_else(|| vec![0.0; apart.len()]);
    let unseen = if base_model::is_arm(problem.session) {
        unseen_mm(problem, &values.model, &inputs)
    } else {
        vec![0.0; apart.len()]
    };
    let wider = half_width_factor(whole(values.white().1)) / normal_95();
    let uncertain = of_values
        .iter()
        .zip(&unseen)
        .map(|(own, unseen)| own.hypot(*unseen));
    let times = apart.iter().zip(uncertain);
    let times = times.map(|(i, own)| residual_mm[*i] / (wider * own.hypot(floor.mm)));
    let (times, error) = (
        median(times)?,
        median(apart.iter().map(|i| residual_mm[*i]))?,
    );
    (times > MOST_TIMES).then(|| {
        text!(
            "half of the held-out samples are {error} off and more, {times} times what noise and all that is uncertain of the model explain",
            error = length(error, 3),
            times = format!("{times:.1}")
        )
    })
}
