//! What each level of correction would bring, and how sure the model is where the robot works, as
//! `identify` states them.

use crate::explain::{Detail, expected};
use crate::fit::Identification;
use crate::language::spoken;
use crate::present::table::Table;

use super::blocks;

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
            let mut cells = vec![spoken(level.what), level.parameters.to_string()];
            cells.extend(errors.map(|mm| format!("{mm:.4}")));
            table.row(cells);
        }
        text += &format!("\n{}", table.aligned(0));
    }
    text + &blocks::blocks(&expected(answer, Detail::TERMINAL), 0)
}
