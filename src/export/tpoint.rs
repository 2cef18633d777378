//! A mount's pointing model as TPOINT's terms, for the software that drives a telescope.
//!
//! ```text
//! encoder = star + (ΔA, ΔE)                                A from north through east
//! IA    ΔA = −IA                     IE    ΔE = IE
//! CA    ΔA = −CA / cos E             NPAE  ΔA = −NPAE tan E
//! AN    ΔA = −AN sin A tan E         ΔE = −AN cos A
//! AW    ΔA = −AW cos A tan E         ΔE = AW sin A
//! ```
//!
//! in arcseconds: index errors, collimation, axes that are not square, an azimuth axis that leans to the
//! north or to the west. They are the least squares over the measured range of what the model says; what
//! they leave is stated. Only an altazimuth mount can be said so: two joints that turn, the first about
//! ±z of the base frame, the second across it, home level. Azimuth and elevation of the mount are its joint values
//! (an axis that points up counts against the azimuth).
//!
//! Sources: the terms as observers' software applies them (astronomy.stackexchange.com/questions/23270), a file
//! that TPOINT wrote (rotse.net, "A Simple Tpoint Model").

use std::fmt::Write as _;

use nalgebra::{DMatrix, DVector, UnitQuaternion, Vector3};
use serde::Serialize;
use sha2::{Digest, Sha256};

use super::chain::Chain;
use super::{Document, Export, ExportError, Exporter, Format, Job, Zeros};
use crate::document::number::hexadecimal;
use crate::document::text_of;
use crate::effects::PlaceKind;
use crate::kinematics::{JointKind, Robot};
use crate::model::format_v1::model_hash;
use crate::text::{Template, Text};

pub(super) const FORMAT: Format = Format {
    id: "tpoint",
    title: phrase!("TPOINT terms of an altazimuth mount"),
    extension: "mod",
    rules: None,
    suits: |robot| Mount::of(robot).is_some(),
    exporter: &Tpoint,
};

struct Tpoint;

/// Terms in the order of the file.
const TERMS: [&str; 6] = ["IA", "IE", "CA", "NPAE", "AN", "AW"];
const ARCSEC_PER_RAD: f64 = 3600.0 * 180.0 / std::f64::consts::PI;
/// Elevations nearer to horizon and zenith show nothing but what refraction and tan E make of them, rad.
const LOWEST: f64 = 0.09;
const HIGHEST: f64 = 1.48;
/// Points of the grid in azimuth and in elevation.
const GRID: [u32; 2] = [36, 12];
/// Enough for the singular values of so small a matrix.
const MOST_ROTATIONS: usize = 1000;
/// An axis that is farther from where a mount has it is none.
const SQUARE: f64 = 1e-6;

/// An altazimuth mount as it is drawn.
struct Mount {
    /// −1 where the azimuth axis points up.
    sense: f64,
    /// Where it looks at home, in the tool frame.
    looks: Vector3<f64>,
}

impl Mount {
    fn of(robot: &Robot) -> Option<Self> {
        let [azimuth, elevation] = &robot.joints[..] else {
            return None;
        };
        let turn = |joint: &crate::kinematics::Joint| joint.kind == JointKind::Revolute;
        let (up, axis) = (
            azimuth.axis.direction.z,
            elevation.axis.direction.into_inner(),
        );
        let upright = up.abs() > 1.0 - SQUARE && axis.z.abs() < SQUARE;
        if !(turn(azimuth) && turn(elevation) && upright) {
            return None;
        }
        // What elevation lifts towards the zenith.
        let ahead = Vector3::z().cross(&axis);
        Some(Self {
            sense: -up.signum(),
            looks: robot.base_from_tool.rotation.inverse() * ahead,
        })
    }
}

/// Azimuth through east and elevation of a direction in axes north, west, up; rad.
fn horizon(d: &Vector3<f64>) -> [f64; 2] {
    [(-d.y).atan2(d.x), d.z.atan2(d.x.hypot(d.y))]
}

#[derive(Serialize)]
struct PointingSidecar<'a> {
    format: &'static str,
    table: &'a str,
    table_format: &'static str,
    table_sha256: String,
    program_version: &'static str,
    session: &'a str,
    samples_hash: &'a str,
    model_hash: String,
    units: &'static str,
    sign: Template,
    terms: Vec<TermJson>,
    leaves_arcsec: f64,
    nominal_arcsec: f64,
    notes: Vec<Text>,
}

#[derive(Serialize)]
struct TermJson {
    name: &'static str,
    arcsec: f64,
}

impl Exporter for Tpoint {
    fn export(&self, job: &Job) -> Result<Export, ExportError> {
        job.calibration.may_correct()?;
        let nominal = &job.calibration.model.robot;
        let mount = Mount::of(nominal).ok_or_else(|| {
            ExportError::Refused(text!(
                "no altazimuth mount: two joints that turn are needed, the first about ±z of the base frame, the second across it"
            ))
        })?;
        let chain = Chain::new(job, Zeros::Origins)?;
        let fitted = fitted(job, &chain, &mount);
        let mut text = format!("{}\n", job.calibration.session.replace(['\n', '\r'], " "));
        // The directions that the terms were fitted to stand for the observations of a run.
        let count = GRID[0] * GRID[1];
        let _ = writeln!(
            text,
            "S {count:4} {:10.4}    0.000   0.0000",
            fitted.left_arcsec
        );
        for (name, value) in TERMS.iter().zip(&fitted.arcsec) {
            let _ = writeln!(text, "  {name:<8} {value:+14.4}");
        }
        text.push_str("END\n");
        let mut notes = vec![
            text!(
                "the terms leave {left}″ of the model over the measured range (root mean square on the sky), no correction {nominal}″",
                left = format!("{:.2}", fitted.left_arcsec),
                nominal = format!("{:.2}", fitted.nominal_arcsec)
            ),
            text!(
                "encoder = star + correction, arcseconds: star at the horizon in the east, IE +10 and no other term: the mount is sent to +10″"
            ),
        ];
        let left_out = chain.corrected.left_out.iter();
        notes.extend(left_out.map(|term| {
            let title = term.effect.about().title;
            text!(
                "{effect} is in none of these terms",
                effect = Text::named(title.english().to_lowercase(), title)
            )
        }));
        let sidecar = PointingSidecar {
            format: "truepose-table/1",
            table: job.file_name,
            table_format: FORMAT.id,
            table_sha256: hexadecimal(&Sha256::digest(&text)),
            program_version: env!("CARGO_PKG_VERSION"),
            session: &job.calibration.session,
            samples_hash: &job.calibration.samples_hash,
            model_hash: model_hash(job.calibration),
            units: "arcseconds",
            sign: phrase!(
                "what is added to the place of the star to get the place of the encoder, by the terms' own formulas"
            ),
            terms: TERMS
                .iter()
                .zip(&fitted.arcsec)
                .map(|(name, arcsec)| TermJson {
                    name,
                    arcsec: *arcsec,
                })
                .collect(),
            leaves_arcsec: fitted.left_arcsec,
            nominal_arcsec: fitted.nominal_arcsec,
            notes: notes.clone(),
        };
        let mut meaning = vec![sidecar.sign.into()];
        meaning.extend(notes.iter().cloned());
        let json = text_of(&sidecar).into_bytes();
        Ok(Export {
            documents: Document::with_sidecar(job.file_name, text.into_bytes(), json),
            reads_as: None,
            robot: None,
            left: None,
            meaning,
            notes,
            stays: Vec::new(),
        })
    }
}

struct Fitted {
    /// In the order of [`TERMS`].
    arcsec: Vec<f64>,
    left_arcsec: f64,
    nominal_arcsec: f64,
}

/// The terms that come nearest to the model over the measured range.
fn fitted(job: &Job, chain: &Chain, mount: &Mount) -> Fitted {
    let station = station(job);
    let range = |joint: usize, from: f64, to: f64| {
        let measured = job.calibration.measured.get(joint);
        measured.map_or([from, to], |range| [range.from.max(from), range.to.min(to)])
    };
    let turn = std::f64::consts::PI;
    let (azimuths, elevations) = (range(0, -turn, turn), range(1, LOWEST, HIGHEST));
    let mut rows: Vec<[f64; 6]> = Vec::new();
    let mut wanted: Vec<f64> = Vec::new();
    for i in 0..GRID[0] {
        for k in 0..GRID[1] {
            let at = |[from, to]: [f64; 2], k: u32, n: u32| {
                from + (to - from) * (f64::from(k) + 0.5) / f64::from(n)
            };
            let q = [at(azimuths, i, GRID[0]), at(elevations, k, GRID[1])];
            let looks = chain.robot.base_from_tool(&q).rotation * mount.looks;
            let [azimuth, elevation] = horizon(&(station.inverse() * looks));
            let far = mount.sense * q[0] - azimuth;
            let by = [
                far - (far / (2.0 * turn)).round() * 2.0 * turn,
                q[1] - elevation,
            ];
            let ((sa, ca), (se, ce)) = (azimuth.sin_cos(), elevation.sin_cos());
            // As far as it is seen on the sky.
            rows.push([-ce, 0.0, -1.0, -se, -sa * se, -ca * se]);
            wanted.push(by[0] * ce);
            rows.push([0.0, 1.0, 0.0, 0.0, -ca, sa]);
            wanted.push(by[1]);
        }
    }
    let matrix = DMatrix::from_fn(rows.len(), 6, |row, column| rows[row][column]);
    let wanted = DVector::from_vec(wanted);
    let svd = matrix
        .clone()
        .try_svd(true, true, f64::EPSILON, MOST_ROTATIONS);
    let solution = svd.and_then(|svd| svd.solve(&wanted, 1e-9 * svd.singular_values.max()).ok());
    let solution = solution.unwrap_or_else(|| DVector::zeros(TERMS.len()));
    let rms = |v: &DVector<f64>| {
        // Two rows a direction.
        let points = 0.5 * v.len() as f64;
        (v.norm_squared() / points.max(1.0)).sqrt() * ARCSEC_PER_RAD
    };
    Fitted {
        left_arcsec: rms(&(&wanted - &matrix * &solution)),
        nominal_arcsec: rms(&wanted),
        arcsec: solution.iter().map(|v| v * ARCSEC_PER_RAD).collect(),
    }
}

/// How the axes in which stars are measured stand in the base frame, as the model has it.
fn station(job: &Job) -> UnitQuaternion<f64> {
    let own = PlaceKind::Station.effect().about().id;
    let terms = job.calibration.model.terms().iter();
    let mut stations = terms.filter(|term| term.effect.about().id == own);
    match (stations.next(), stations.next()) {
        (Some(term), None) => {
            let omega = &term.coefficients;
            UnitQuaternion::from_scaled_axis(Vector3::new(omega[0], omega[1], omega[2]))
        }
        _ => UnitQuaternion::identity(),
    }
}
