//! What each level of correction would bring, and how sure the model is where the robot works, as
//! `identify` states them.

use crate::fit::Identification;
use crate::language::of_core;
use crate::present::identification_v1::worst_pose;
use crate::present::table::Table;

use super::words::line;

/// Both in words; empty where there is nothing to say.
pub(super) fn in_words(answer: &Identification) -> String {
    let mut text = String::new();
    if !answer.levels.is_empty() {
        let mut table = Table::headed(say!(
            "level of correction | >parameters | >RMS, mm | >cross-validated: mean | >RMS | >95 % | >largest"
        ));
        for level in &answer.levels {
            let unseen = level.cross_validated;
            let unseen = unseen.map(|e| [e.mean_mm, e.rms_mm, e.p95_mm, e.max_mm]);
            let errors = [level.rms_mm]
                .into_iter()
                .chain(unseen.into_iter().flatten());
            let mut cells = vec![
                of_core(level.what).into_owned(),
                level.parameters.to_string(),
            ];
            cells.extend(errors.map(|mm| format!("{mm:.4}")));
            table.row(cells);
        }
        text += &format!("\n{}", table.aligned(0));
    }
    text + &expected_in_words(answer)
}

/// The error that the model is expected to make over the joint ranges, where that is known; and where the
/// measured poses show little.
pub(super) fn expected_in_words(answer: &Identification) -> String {
    let mut text = String::new();
    if let Some(e) = &answer.expected {
        let expected = say!(
            "expected error of the model over the joint ranges: RMS {rms} mm, largest {largest} mm; at the measured poses {measured} mm",
            rms = format!("{:.4}", e.rms_mm),
            largest = format!("{:.4}", e.max_mm),
            measured = format!("{:.4}", e.measured_rms_mm)
        );
        line(&mut text, expected);
        if e.extrapolates() {
            let q = worst_pose(e, &answer.model.robot);
            let q: Vec<String> = q.iter().map(|v| format!("{v:.0}")).collect();
            let poorly = say!(
                "poorly observed: the measured poses show little of the joint ranges; measure near {q} as well (`truepose plan` proposes poses)",
                q = q.join(", ")
            );
            line(&mut text, poorly);
        }
    }
    text
}
