//! The answer of `truepose diagnose` in words.

use crate::diagnosis::Diagnosis;
use crate::explain::{self, Detail, Section, Topic};
use crate::language::spoken;
use crate::paper::RegionalStart;
use crate::present::table::Table;

use super::blocks;
use super::words::headed;

/// The regional model that a diagnosis was begun with.
pub(super) fn start_in_words(start: &RegionalStart) -> String {
    let mut table = Table::headed(say!(
        "region | >Δθ rad | >Δl1 mm | >of one error: Δθ rad | >Δl1 mm | >after mm"
    ));
    for (region, (theta, l1)) in start.regional.regions.iter().zip(&start.of_one_error) {
        let c = &region.correction;
        let seven = |value: f64| format!("{value:.7}");
        table.row([
            c.name.clone(),
            seven(c.theta_rad),
            seven(c.l1_mm),
            seven(*theta),
            seven(*l1),
            format!("{:.4}", region.rms_after_mm),
        ]);
    }
    let start = say!("start: {start}", start = spoken(&start.summary));
    format!("{start}\n\n{}\n", table.aligned(0))
}

/// The answer: its sections, and behind the verdict what was identified.
pub(super) fn in_words(d: &Diagnosis) -> String {
    let mut text = headed(&d.session, d.samples);
    for section in explain::diagnosis(d, Detail::TERMINAL) {
        text += &blocks::section(&section);
        if section.topic == Topic::Answer {
            let values = explain::values(&d.identified, &d.model.robot, Detail::TERMINAL);
            let title = say!("Parameters of the real robot");
            text += &blocks::section(&Section::new(title, values));
        }
    }
    text
}
