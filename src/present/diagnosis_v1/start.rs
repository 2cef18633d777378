//! What the paper's regional model misses, as JSON.

use serde::Serialize;

use super::Document;
use crate::document::degrees;
use crate::paper::RegionalStart;

/// The paper's regional model, held against the answer.
#[derive(Debug, Serialize)]
pub(super) struct Start {
    method: &'static str,
    gap_before_mm: f64,
    gap_mm: f64,
    largest_mm: f64,
    turn_deg_per_deg: Option<f64>,
    one_correction: Pair,
    regions: Vec<StartRegion>,
    apart_mm: f64,
    says: String,
}

#[derive(Debug, Serialize)]
struct Pair {
    theta_rad: f64,
    l1_mm: f64,
}

#[derive(Debug, Serialize)]
struct StartRegion {
    name: String,
    from_deg: f64,
    to_deg: f64,
    samples: usize,
    correction: Pair,
    of_one_error: Pair,
    rms_before_mm: f64,
    rms_after_mm: f64,
}

impl Document {
    /// The same with the regional model that it started from.
    #[must_use]
    pub fn with_start(self, start: &RegionalStart) -> Self {
        let pair = |(theta_rad, l1_mm): (f64, f64)| Pair { theta_rad, l1_mm };
        let regions = start.regional.regions.iter().zip(&start.of_one_error);
        let regions = regions.map(|(region, one)| {
            let c = &region.correction;
            StartRegion {
                name: c.name.clone(),
                from_deg: degrees(c.from_rad),
                to_deg: degrees(c.to_rad),
                samples: c.samples,
                correction: pair((c.theta_rad, c.l1_mm)),
                of_one_error: pair(*one),
                rms_before_mm: region.rms_before_mm,
                rms_after_mm: region.rms_after_mm,
            }
        });
        let regional = Start {
            method: start.regional.method,
            gap_before_mm: start.regional.gap.before.rms_mm,
            gap_mm: start.regional.gap.after.rms_mm,
            largest_mm: start.regional.gap.after.max_mm,
            turn_deg_per_deg: start.turn,
            one_correction: pair(start.one_correction),
            regions: regions.collect(),
            apart_mm: start.apart_mm,
            says: start.says.clone(),
        };
        Self {
            start: Some(regional),
            ..self
        }
    }
}
