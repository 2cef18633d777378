//! The document as serde writes it.
//!
//! Twins of the domain types, in degrees and mm. Robots from Denavit–Hartenberg rows, a URDF or an
//! MJCF file are written as joints and tool: that is what the program computed with. How they were
//! given stands beside it as `source`. Keys that were not understood on reading are not written.

use serde::ser::{SerializeMap, Serializer};
use serde::{Deserialize, Serialize};

use super::FORMAT;
use super::degrees::degrees;
use super::read::default_targets;
use super::references::ReferencesTwin;
use super::robot_source::SourceTwin;
use crate::kinematics::{Joint, JointKind, Robot};
use crate::sessions::domain::{Instrument, Region, Session, Sigma, TARGETS_SIGMA_MM, Target};

#[derive(Debug, Serialize)]
pub(crate) struct SessionTwin<'a, S> {
    format: &'static str,
    name: &'a str,
    #[serde(skip_serializing_if = "str::is_empty")]
    note: &'a str,
    robot: RobotTwin,
    #[serde(skip_serializing_if = "Option::is_none")]
    targets: Option<TargetsTwin<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    instrument: Option<InstrumentTwin<'a>>,
    #[serde(flatten)]
    references: ReferencesTwin,
    #[serde(skip_serializing_if = "Option::is_none")]
    tolerance_mm: Option<f64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    regions: Vec<RegionTwin<'a>>,
    compensated_by: Option<&'a str>,
    samples: S,
}

/// The `robot` object, as any document of this program writes it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct RobotTwin {
    name: String,
    joints: Vec<JointTwin>,
    tool: ToolTwin,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    gravity_m_s2: Option<[f64; 3]>,
    /// How it was described.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    source: Option<SourceTwin>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct JointTwin {
    name: String,
    kind: KindTwin,
    axis: [f64; 3],
    point_mm: [f64; 3],
    /// Degrees or mm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    limits: Option<[f64; 2]>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    mass_kg: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    centre_mm: Option<[f64; 3]>,
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum KindTwin {
    Revolute,
    Prismatic,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct ToolTwin {
    position_mm: [f64; 3],
    quaternion_wxyz: [f64; 4],
}

#[derive(Debug)]
pub(crate) struct TargetsTwin<'a>(pub(crate) &'a [Target]);

impl Serialize for TargetsTwin<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for target in self.0 {
            let position: [f64; 3] = target.position_mm.coords.into();
            map.serialize_entry(&target.name, &position)?;
        }
        map.end()
    }
}

#[derive(Debug, Serialize)]
struct InstrumentTwin<'a> {
    name: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    sigma_mm: Option<SigmaTwin>,
    /// Only where it is not the usual one; null where the places are not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    targets_sigma_mm: Option<TargetsSigmaTwin>,
    #[serde(skip_serializing_if = "Option::is_none")]
    sigma_range_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    sigma_angle_urad: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    position_mm: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    sigma_mrad: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    sigma_distance_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    sigma_direction_urad: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    sigma_touch_mm: Option<f64>,
}

#[derive(Debug, Serialize)]
#[serde(untagged)]
enum SigmaTwin {
    Overall(f64),
    PerAxis([f64; 3]),
}

/// How well the places of the targets are known; null where they are not.
#[derive(Debug, Serialize)]
#[serde(transparent)]
struct TargetsSigmaTwin(Option<f64>);

#[derive(Debug, Serialize)]
struct RegionTwin<'a> {
    name: &'a str,
    from_deg: f64,
    to_deg: f64,
}

/// Samples in a file.
#[derive(Debug, Serialize)]
pub(crate) struct FileTwin<'a> {
    pub(crate) file: &'a str,
}

impl<'a, S> SessionTwin<'a, S> {
    pub(crate) fn of(session: &'a Session, samples: S) -> Self {
        let instrument = &session.instrument;
        let targets_sigma_mm = instrument.targets_sigma_mm;
        let unusual = (targets_sigma_mm != Some(TARGETS_SIGMA_MM)).then_some(targets_sigma_mm);
        let plain = Instrument {
            references: instrument.references.clone(),
            ..Instrument::default()
        };
        let has_instrument = *instrument != plain;
        let tracker = instrument.tracker;
        Self {
            format: FORMAT,
            name: &session.name,
            note: &session.note,
            robot: RobotTwin::of(&session.robot),
            targets: (session.targets != default_targets())
                .then_some(TargetsTwin(&session.targets)),
            instrument: has_instrument.then(|| InstrumentTwin {
                name: &instrument.name,
                sigma_mm: instrument.sigma_mm.map(|sigma| match sigma {
                    Sigma::Overall(sigma) => SigmaTwin::Overall(sigma),
                    Sigma::PerAxis(sigma) => SigmaTwin::PerAxis(sigma),
                }),
                targets_sigma_mm: unusual.map(TargetsSigmaTwin),
                sigma_range_mm: tracker.map(|t| t.sigma_range_mm),
                sigma_angle_urad: tracker.map(|t| micro(t.sigma_angle)),
                position_mm: tracker.map(|t| t.position_mm.coords.into()),
                sigma_mrad: instrument.sigma_orientation.map(milli),
                sigma_distance_mm: instrument.sigma_distance_mm,
                sigma_direction_urad: instrument.sigma_direction.map(micro),
                sigma_touch_mm: instrument.sigma_touch_mm,
            }),
            references: ReferencesTwin::of(&instrument.references),
            tolerance_mm: session.tolerance_mm,
            regions: session.regions.iter().map(RegionTwin::of).collect(),
            compensated_by: session.compensated_by.as_deref(),
            samples,
        }
    }
}

/// Thousandths, as many of them as read back as the same number where there are such.
fn milli(value: f64) -> f64 {
    as_written(value, 1e3, 1e-3)
}

/// Millionths, likewise.
fn micro(value: f64) -> f64 {
    as_written(value, 1e6, 1e-6)
}

/// The outer number that the reader, who multiplies by `inner`, makes this value of.
fn as_written(value: f64, outer: f64, inner: f64) -> f64 {
    let near = value * outer;
    let candidates = [near, near.next_down(), near.next_up(), value / inner];
    let same = candidates.into_iter().find(|c| c * inner == value);
    same.unwrap_or(near)
}

impl RobotTwin {
    pub(crate) fn of(robot: &Robot) -> Self {
        let tool = &robot.base_from_tool;
        let turn = tool.rotation.quaternion();
        Self {
            name: robot.name.clone(),
            joints: robot.joints.iter().map(JointTwin::of).collect(),
            tool: ToolTwin {
                position_mm: tool.translation.vector.into(),
                quaternion_wxyz: [turn.w, turn.i, turn.j, turn.k],
            },
            gravity_m_s2: robot.gravity_m_s2.map(Into::into),
            source: SourceTwin::of(&robot.source),
        }
    }
}

impl JointTwin {
    fn of(joint: &Joint) -> Self {
        let (kind, outside): (_, fn(f64) -> f64) = match joint.kind {
            JointKind::Revolute => (KindTwin::Revolute, degrees),
            JointKind::Prismatic => (KindTwin::Prismatic, |mm| mm),
        };
        Self {
            name: joint.name.clone(),
            kind,
            axis: joint.axis.direction.into_inner().into(),
            point_mm: joint.axis.point_mm.coords.into(),
            limits: joint
                .limits
                .map(|limits| [outside(limits.from), outside(limits.to)]),
            mass_kg: joint.link.map(|link| link.mass_kg),
            centre_mm: joint.link.map(|link| link.centre_mm.coords.into()),
        }
    }
}

impl<'a> RegionTwin<'a> {
    fn of(region: &'a Region) -> Self {
        Self {
            name: &region.name,
            from_deg: degrees(region.from_rad),
            to_deg: degrees(region.to_rad),
        }
    }
}
