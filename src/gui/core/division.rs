//! How the regions came about, and what the adaptive division decided and why.

use crate::effects::JointValues;
use crate::fit::regions_of;
use crate::language::spoken;
use crate::pipeline::{self, identify};
use crate::present::units::Units;
use crate::sessions::division::RegionChoice;
use crate::sessions::{Region, Session};

/// How the regions came about.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) enum Division {
    /// All of the same width.
    Even,
    /// The session's own, or changed by hand since.
    #[default]
    Given,
    /// Where the samples ask for them.
    Adaptive(Decision),
}

/// What the adaptive division decided.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Decision {
    /// How many regions.
    pub(crate) regions: usize,
    /// The gap that they leave, mm; `None` where nothing can be identified by region.
    pub(crate) left_mm: Option<f64>,
    /// The gap that as many even ones leave, mm.
    pub(crate) even_mm: Option<f64>,
}

impl Decision {
    /// What was decided and why, in one line.
    pub(crate) fn describe(&self, units: Units) -> String {
        if self.regions == 1 {
            return say!("One region: nowhere does the deviation change by more than the noise")
                .to_owned();
        }
        let n = self.regions;
        match (self.left_mm, self.even_mm) {
            (Some(left), Some(even)) => say!(
                "{n} regions: a boundary where the deviation changes by more than the noise. They leave {left}, {n} even ones {even}",
                n,
                left = units.length(left),
                even = units.length(even)
            ),
            _ => say!(
                "{n} regions: a boundary where the deviation changes by more than the noise",
                n
            ),
        }
    }
}

/// Divides where the samples ask for it. Takes its time with many samples.
pub(crate) fn adapt(session: &Session) -> Result<(Vec<Region>, Decision), String> {
    let regions = regions_of(&RegionChoice::Adaptive, session).map_err(|e| spoken(e.describe()))?;
    let left = |choice| {
        let method = pipeline::Method::Regional(choice);
        let (found, _) = identify(session, &method, JointValues::Commanded).ok()?;
        Some(found.gap.after.rms_mm)
    };
    let decision = Decision {
        regions: regions.len(),
        left_mm: left(RegionChoice::Given(regions.clone())),
        even_mm: left(RegionChoice::Uniform(regions.len())),
    };
    Ok((regions, decision))
}
