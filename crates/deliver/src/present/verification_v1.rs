//! `truepose-verification/1`: what a model does on a session, as JSON. Samples count from 1.

use super::json::{Json, object};
use super::parts::problems;
use crate::compensation::Verification;

/// The document of a verification.
pub fn document(v: &Verification) -> Json {
    let outliers: Vec<usize> = v.outliers.iter().map(|sample| sample + 1).collect();
    object! {
        "format": "truepose-verification/1",
        "session": &v.session,
        "samples": v.samples,
        "gap": object! {
            "nominal_mm": v.nominal.rms_mm,
            "model_mm": v.model.rms_mm,
            "max_nominal_mm": v.nominal.max_mm,
            "max_model_mm": v.model.max_mm,
        },
        "trimmed": v.trimmed.map(|t| object! {
            "model_mm": t.model_mm,
            "set_aside": t.set_aside,
        }),
        "held_out": v.held_out.map(|h| object! {
            "samples": h.samples,
            "nominal_mm": h.nominal_mm,
            "model_mm": h.model_mm,
        }),
        "data_problems": problems(&v.data_problems),
        "within_tolerance": v.within_tolerance.map(|w| {
            object! { "before": w.before, "after": w.after, "of": w.of }
        }),
        "compensated": v.compensated.map(|c| object! {
            "rms_mm": c.gap.rms_mm,
            "max_mm": c.gap.max_mm,
            "cannot_be_removed_by_joints_mm": c.cannot_be_removed_by_joints_mm,
        }),
        "outliers": outliers,
        "notes": &v.notes,
    }
}
