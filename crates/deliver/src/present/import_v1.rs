//! `truepose-import/1`: how a file of an instrument was read, as JSON.

use super::json::{Json, list, object};
use super::parts::pose;
use crate::importers::{Alignment, Imported};

/// The document of an import.
pub fn document(imported: &Imported) -> Json {
    let found = &imported.inspection;
    object! {
        "format": "truepose-import/1",
        "session": &imported.session.name,
        "samples": imported.session.samples.len(),
        "read_as": found.kind.map_or("", |importer| importer.id),
        "encoding": found.encoding.name(),
        "separator": found.separator.map(|separator| separator.to_string()),
        "decimal": found.decimal.map(|decimal| decimal.to_string()),
        "unit": found.unit.to_string(),
        "matched": imported.matched.as_ref().map(|matched| object! {
            "by": matched.by.id(),
            "samples": matched.samples,
            "without_command": list(&matched.lonely_measurements, |row| row.to_string().into()),
            "without_measurement": list(&matched.lonely_commands, |row| row.to_string().into()),
            "clock": matched.clock.map(|clock| object! {
                "offset_s": clock.offset_s,
                "sigma_s": clock.sigma_s,
                "ci95_s": clock.ci95_s(),
                "rms_mm": clock.rms_mm,
            }),
        }),
        "reference": imported.alignment.as_ref().map(reference),
        "notes": list(&imported.findings, |finding| finding.to_string().into()),
    }
}

fn reference(alignment: &Alignment) -> Json {
    object! {
        "rms_mm": alignment.rms_mm,
        "scale": alignment.scale,
        "best_scale": alignment.best_scale,
    }
    .with(pose(&alignment.base_from_instrument))
    .with(object! {
        "points": list(&alignment.residuals, |residual| {
            let vector_mm: [f64; 3] = residual.vector_mm.into();
            object! {
                "name": &residual.name,
                "residual_mm": vector_mm,
                "distance_mm": residual.vector_mm.norm(),
                "left_out": residual.is_outlier,
            }
        }),
    })
}
