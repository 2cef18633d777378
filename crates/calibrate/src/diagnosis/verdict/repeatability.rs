//! The repeatability of the robot: a pose's own error, which is drawn anew when a pose is reached again and which all
//! that is measured in one pose shares.

use crate::sessions::Sigma;

use super::excess::excess_of;
use super::values::Values;
use crate::diagnosis::search::prepare::PreparedSearch;
use crate::diagnosis::search::pure_error;

/// RMS length of a pose's own error, mm: the spread of returns after other poses beyond that of the instrument, where
/// there are any, else the common residual of the rows of a pose. `None` where the samples do not determine it.
pub(crate) fn robot_mm(prepared: &PreparedSearch, values: &Values) -> Option<f64> {
    let rows = &prepared.regression.rows;
    if rows.observed().is_some() {
        return None;
    }
    let Some((returned_mm, freedom)) = pure_error(prepared).and_then(|p| Some((p.mm?, p.freedom)))
    else {
        return rows.unrepeated_mm(values.problem.noise.as_ref()?);
    };
    let sigma = match prepared.problem.session.instrument.sigma_mm {
        // Rows of one pose show the noise of the instrument.
        _ if rows.inputs.pose.is_some() => values.sigma_mm(),
        Some(Sigma::Overall(sigma)) => [sigma; 3],
        Some(Sigma::PerAxis(sigma)) => sigma,
        None => return None,
    };
    let instrument: f64 = rows.axes.iter().map(|axis| sigma[*axis].powi(2)).sum();
    let square = returned_mm * returned_mm;
    let excess = excess_of(square / instrument, freedom, f64::INFINITY, 3.0);
    excess
        .is_more_than_noise()
        .then(|| (square - instrument).max(0.0).sqrt())
}
