//! New by simulation: a small form, and the session that comes out of it.

use nalgebra::{Point3, Vector3};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Normal};

use crate::effects::term::parameter_names;
use crate::effects::{CATALOGUE, Inputs, JointValues, Setting, Term};
use crate::kinematics::{Axis, Joint, JointKind, LinkMass, Pose, Range, Robot};
use crate::model::Model;
use crate::sessions::{Instrument, Samples, Session, Sigma, Target};
use crate::units::rad_from_deg;

/// More samples than this are for the terminal.
const MOST_SAMPLES: f64 = 1e6;
/// Seconds from one pose to the next.
const SECONDS_PER_POSE: f64 = 6.0;

/// An effect with the values that are filled in.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Chosen {
    /// The effect's name.
    pub(crate) id: &'static str,
    /// Its parameters.
    pub(crate) parameters: Vec<(&'static str, f64)>,
}

impl Chosen {
    /// An effect at values that can be seen.
    pub(crate) fn new(id: &'static str) -> Option<Self> {
        let effect = crate::effects::find(id)?;
        let setting = effect.about().setting;
        let value = |name: &str| match (name, setting) {
            ("order", Setting::Order { from, .. }) => f64::from(from),
            ("scale_ppm" | "ppm_per_degc" | "compliance_urad_per_nm", _) => 50.0,
            ("phase_deg", _) => 30.0,
            ("time_s", _) => 120.0,
            ("fade_deg", _) => 5.0,
            ("delay_s", _) => 0.01,
            ("deg_per_degc", _) => 0.002,
            ("ratio", _) => 0.001,
            (name, _) if name.ends_with("_deg") => 0.05,
            (name, _) if name.ends_with("_mrad") => 1.0,
            _ => 0.2,
        };
        let names = parameter_names(effect).into_iter();
        Some(Self {
            id,
            parameters: names.map(|name| (name, value(name))).collect(),
        })
    }
}

/// See the module.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Form {
    /// Nominal radius of the tool, mm.
    pub(crate) radius_mm: f64,
    /// The sweep begins here, deg.
    pub(crate) from_deg: f64,
    /// And ends here, deg.
    pub(crate) to_deg: f64,
    /// From pose to pose, deg.
    pub(crate) step_deg: f64,
    /// Whether it comes back the same way.
    pub(crate) both_ways: bool,
    /// Zero offset of the joint, deg.
    pub(crate) offset_deg: f64,
    /// How much longer the link is, mm.
    pub(crate) length_error_mm: f64,
    /// What else the robot does.
    pub(crate) effects: Vec<Chosen>,
    /// Noise of the instrument, mm.
    pub(crate) noise_mm: f64,
    /// How far a position may be off, mm.
    pub(crate) tolerance_mm: f64,
    /// Where the noise begins.
    pub(crate) seed: u64,
}

impl Default for Form {
    fn default() -> Self {
        Self {
            radius_mm: 250.0,
            from_deg: -90.0,
            to_deg: 90.0,
            step_deg: 3.0,
            both_ways: true,
            offset_deg: -3.0,
            length_error_mm: -5.0,
            effects: Vec::new(),
            noise_mm: 0.03,
            tolerance_mm: 0.2,
            seed: 1,
        }
    }
}

impl Form {
    /// Effects that can be chosen: all but the two that have fields of their own.
    pub(crate) fn offered() -> impl Iterator<Item = (&'static str, &'static str)> {
        let all = CATALOGUE.iter().map(|effect| effect.about());
        all.filter(|about| about.id != "joint-zero-offset" && about.id != "link-length")
            .map(|about| (about.id, about.title))
    }

    /// What is wrong with the numbers; `None` where they can be simulated.
    pub(crate) fn problem(&self) -> Option<String> {
        let numbers = [
            self.radius_mm,
            self.from_deg,
            self.to_deg,
            self.step_deg,
            self.offset_deg,
            self.length_error_mm,
            self.noise_mm,
            self.tolerance_mm,
        ];
        if !numbers.iter().all(|v| v.is_finite()) {
            return Some("every field needs a number".to_owned());
        }
        if self.radius_mm <= 0.0 {
            return Some("the radius has to be above 0 mm".to_owned());
        }
        if self.from_deg >= self.to_deg {
            return Some("the sweep has to run from the smaller to the larger angle".to_owned());
        }
        if self.step_deg <= 0.0 {
            return Some("the step has to be above 0°".to_owned());
        }
        if (self.to_deg - self.from_deg) / self.step_deg > MOST_SAMPLES {
            return Some("that is more than a million poses; take a larger step".to_owned());
        }
        if self.noise_mm < 0.0 || self.tolerance_mm < 0.0 {
            return Some("noise and tolerance cannot be below 0".to_owned());
        }
        self.terms().err()
    }

    fn terms(&self) -> Result<Vec<Term>, String> {
        let own = [
            ("joint-zero-offset", vec![("offset_deg", self.offset_deg)]),
            ("link-length", vec![("delta_mm", self.length_error_mm)]),
        ];
        let chosen = self.effects.iter().map(|c| (c.id, c.parameters.clone()));
        let all = own.into_iter().chain(chosen);
        all.map(|(id, parameters)| {
            Term::from_parameters(id, 1, &parameters, 1).map_err(|e| e.to_string())
        })
        .collect()
    }

    /// The poses: angle in deg, and the side that the joint comes from.
    fn poses(&self) -> Vec<(f64, f64)> {
        let steps = ((self.to_deg - self.from_deg) / self.step_deg + 1e-9).floor() as usize;
        let angle = |k: usize| self.from_deg + self.step_deg * k as f64;
        let there = (0..=steps).map(|k| (angle(k), 1.0));
        let back = (0..=steps).rev().map(|k| (angle(k), -1.0));
        if self.both_ways {
            there.chain(back).collect()
        } else {
            there.collect()
        }
    }

    /// The session.
    ///
    /// # Errors
    /// What [`Form::problem`] says.
    pub(crate) fn session(&self) -> Result<Session, String> {
        if let Some(problem) = self.problem() {
            return Err(problem);
        }
        let mut session = self.unmeasured()?;
        let model = Model::new(session.robot.clone(), self.terms()?);
        let positions = model.predict(&Inputs::new(&session, JointValues::Commanded));
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        // `sigma_mm` is the root mean square over the axes: the same on each.
        let noise = Normal::new(0.0, self.noise_mm).map_err(|e| e.to_string())?;
        let mut noisy = |column: Vec<f64>| -> Vec<f64> {
            column
                .into_iter()
                .map(|v| v + noise.sample(&mut random))
                .collect()
        };
        session.samples.x_mm = noisy(positions.x_mm);
        session.samples.y_mm = noisy(positions.y_mm);
        session.samples.z_mm = Some(noisy(positions.z_mm));
        Ok(session)
    }

    fn unmeasured(&self) -> Result<Session, String> {
        let poses = self.poses();
        let axis =
            Axis::through(Vector3::z(), Point3::origin()).map_err(|e| e.to_string())?;
        let mut joint = Joint::new("pan", JointKind::Revolute, axis);
        joint.limits = Some(Range {
            from: rad_from_deg(self.from_deg),
            to: rad_from_deg(self.to_deg),
        });
        joint.link = Some(LinkMass {
            mass_kg: 4.0,
            centre_mm: Point3::new(0.5 * self.radius_mm, 0.0, 0.0),
        });
        let n = poses.len();
        Ok(Session {
            name: format!("simulated-{}", self.seed),
            note: String::new(),
            robot: Robot {
                name: "simulated lamp".to_owned(),
                joints: vec![joint],
                base_from_tool: Pose::translation(self.radius_mm, 0.0, 300.0),
                gravity_m_s2: Some(Vector3::new(0.0, 0.0, -9.81)),
            },
            targets: vec![Target {
                name: "tool".to_owned(),
                position_mm: Point3::origin(),
            }],
            instrument: Instrument {
                name: "simulated tracker".to_owned(),
                sigma_mm: (self.noise_mm > 0.0).then_some(Sigma::Overall(self.noise_mm)),
            },
            tolerance_mm: (self.tolerance_mm > 0.0).then_some(self.tolerance_mm),
            regions: Vec::new(),
            compensated_by: None,
            samples: Samples {
                q: vec![poses.iter().map(|p| rad_from_deg(p.0)).collect()],
                q_read: vec![None],
                x_mm: vec![0.0; n],
                y_mm: vec![0.0; n],
                z_mm: Some(vec![0.0; n]),
                dir: vec![Some(poses.iter().map(|p| p.1).collect())],
                speed: vec![None],
                time_s: Some((0..n).map(|k| k as f64 * SECONDS_PER_POSE).collect()),
                ..Samples::default()
            },
            path: None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_form_as_it_opens_can_be_simulated() {
        let session = Form::default().session().expect("the default is valid");
        assert_eq!(session.samples.len(), 122);
        let x = session.samples.x_mm[30];
        assert!((x - 245.0 * (-3.0_f64).to_radians().cos()).abs() < 0.2, "{x}");
    }

    #[test]
    fn every_effect_on_offer_can_be_simulated_as_it_is_proposed() {
        for (id, _) in Form::offered() {
            let form = Form {
                effects: vec![Chosen::new(id).expect("it is in the catalogue")],
                ..Form::default()
            };
            assert_eq!(form.problem(), None, "{id}");
        }
    }

    #[test]
    fn what_cannot_be_simulated_is_said() {
        let form = Form {
            step_deg: 0.0,
            ..Form::default()
        };
        assert!(form.problem().expect("no step").contains("step"));
    }
}
