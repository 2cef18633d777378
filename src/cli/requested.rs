//! The options of `truepose simulate --robot`: a scenario from few words.

use clap::Args;
use clap::builder::PossibleValuesParser;

use crate::effects::find;
use crate::kinematics::Robot;
use crate::simulation::{
    HiddenEffect, MOST_REFLECTORS, NoiseKind, RequestedPoses, RequestedTemperature,
    SimulationRequest,
};

use crate::text::{Template, Text};

use super::failure::Failure;

/// See the module. Without `--robot` none of them may be given.
#[derive(Debug, Args)]
#[command(next_help_heading = "With --robot")]
pub(crate) struct Requested {
    /// Number of poses, every joint anywhere in its range [default: 200]
    #[arg(long, value_name = "N", requires = "robot")]
    poses: Option<usize>,
    /// Move this joint alone, from 1, over its range in --poses stops, there and back
    #[arg(long, value_name = "JOINT", requires = "robot")]
    sweep: Option<usize>,
    /// Hide an effect, as `truepose effects` names it and its parameters; may be repeated
    #[arg(
        long = "effect",
        value_name = "ID[:JOINT]:NAME=VALUE,…",
        requires = "robot"
    )]
    effects: Vec<String>,
    /// Noise of the instrument on each axis, mm [default: 0.03]
    #[arg(
        long,
        value_name = "MM",
        requires = "robot",
        allow_negative_numbers = true
    )]
    noise: Option<f64>,
    /// How the noise is distributed [default: gauss]
    #[arg(long, value_name = "KIND", requires = "robot", value_parser = PossibleValuesParser::new(NoiseKind::ALL.map(NoiseKind::name)))]
    noise_kind: Option<String>,
    /// Part of the measurements that go wrong, and by how much
    #[arg(long, value_name = "SHARE:MM", requires = "robot")]
    outliers: Option<String>,
    /// Reflectors at the tool, from 1 to 4 [default: 3]
    #[arg(long, value_name = "N", requires = "robot")]
    reflectors: Option<usize>,
    /// What the instrument is called
    #[arg(long, value_name = "NAME", requires = "robot")]
    instrument: Option<String>,
    /// Speeds at the moment of measuring, °/s, or none [default: 0,10,30]
    #[arg(long, value_name = "DEG/S,…", requires = "robot")]
    speeds: Option<String>,
    /// Loads, kg, or none [default: nothing, half and all of the robot's payload]
    #[arg(long, value_name = "KG,…", requires = "robot")]
    loads: Option<String>,
    /// Temperatures, °C; FROM..TO warms up; or none [default: 20..26]
    #[arg(
        long,
        value_name = "C,…",
        requires = "robot",
        allow_negative_numbers = true
    )]
    temperature: Option<String>,
}

impl Requested {
    /// What is to be simulated of this robot.
    pub(crate) fn of(
        &self,
        robot: Robot,
        payload_kg: Option<f64>,
        seed: Option<u64>,
    ) -> Result<SimulationRequest, Failure> {
        let poses = self.poses.unwrap_or(200);
        let mut request = SimulationRequest::of(robot, payload_kg, poses);
        if let Some(joint) = self.sweep {
            request.poses = RequestedPoses::Sweep {
                joint,
                stops: poses,
            };
        }
        let joints = request.robot.joints.len();
        let effects = self.effects.iter().map(|text| effect(text, joints));
        request.effects = effects.collect::<Result<_, _>>()?;
        if let Some(noise_mm) = self.noise {
            if !(noise_mm.is_finite() && noise_mm >= 0.0) {
                return Err(wrong(
                    "--noise",
                    &noise_mm.to_string(),
                    text!("a length from 0 mm on"),
                ));
            }
            request.noise_mm = noise_mm;
        }
        let named = |kind: &NoiseKind| self.noise_kind.as_deref() == Some(kind.name());
        let kind = NoiseKind::ALL.into_iter().find(named);
        request.noise_kind = kind.unwrap_or(request.noise_kind);
        if let Some(text) = &self.outliers {
            let both = text.split_once(':');
            let both = both.and_then(|(share, mm)| Some([number(share)?, number(mm)?]));
            request.outliers = Some(both.ok_or_else(|| {
                wrong(
                    "--outliers",
                    text,
                    text!("a share and a length such as 0.02:0.5"),
                )
            })?);
        }
        if let Some(count) = self.reflectors {
            if !(1..=MOST_REFLECTORS).contains(&count) {
                let expected = text!("from 1 to {most}", most = MOST_REFLECTORS);
                return Err(wrong("--reflectors", &count.to_string(), expected));
            }
            request.reflectors = count;
        }
        if let Some(name) = &self.instrument {
            request.instrument.clone_from(name);
        }
        if let Some(text) = &self.speeds {
            request.speeds_deg_s = numbers("--speeds", text)?;
        }
        if let Some(text) = &self.loads {
            request.loads_kg = numbers("--loads", text)?;
        }
        if let Some(text) = &self.temperature {
            request.temperature = temperature(text)?;
        }
        request.seed = seed.unwrap_or(request.seed);
        Ok(request)
    }
}

fn wrong(option: &str, found: &str, expected: Text) -> Failure {
    Failure::WrongInput(text!(
        "{option} {given}: expected {expected}",
        option,
        given = found,
        expected
    ))
}

fn number(text: &str) -> Option<f64> {
    let value: f64 = text.trim().parse().ok()?;
    value.is_finite().then_some(value)
}

/// Numbers between commas; `none` is none.
fn numbers(option: &str, text: &str) -> Result<Vec<f64>, Failure> {
    if text == "none" {
        return Ok(Vec::new());
    }
    let all: Option<Vec<f64>> = text.split(',').map(number).collect();
    all.ok_or_else(|| wrong(option, text, text!("numbers between commas, or none")))
}

fn temperature(text: &str) -> Result<RequestedTemperature, Failure> {
    if let Some((from, to)) = text.split_once("..") {
        let ends = number(from).zip(number(to));
        let expected = || text!("two temperatures such as 20..26");
        let (from, to) = ends.ok_or_else(|| wrong("--temperature", text, expected()))?;
        return Ok(RequestedTemperature::WarmUp(from, to));
    }
    let values = numbers("--temperature", text)?;
    Ok(if values.is_empty() {
        RequestedTemperature::Unknown
    } else {
        RequestedTemperature::Values(values)
    })
}

/// `ID[:JOINT]:NAME=VALUE[,NAME=VALUE…]`, on a robot with so many joints.
fn effect(text: &str, joints: usize) -> Result<HiddenEffect, Failure> {
    const EXPECTED: Template =
        phrase!("a name, a joint and parameters such as backlash:2:width_deg=0.04");
    let mut parts = text.split(':');
    let mut hidden = HiddenEffect {
        effect: parts.next().unwrap_or_default().trim().to_owned(),
        joint: None,
        parameters: Vec::new(),
    };
    for part in parts {
        if let Ok(joint) = part.trim().parse() {
            hidden.joint = Some(joint);
            continue;
        }
        for parameter in part.split(',') {
            let pair = parameter.split_once('=');
            let pair =
                pair.and_then(|(name, value)| Some((name.trim().to_owned(), number(value)?)));
            hidden
                .parameters
                .push(pair.ok_or_else(|| wrong("--effect", text, EXPECTED.into()))?);
        }
    }
    if hidden.parameters.is_empty() {
        return Err(wrong("--effect", text, EXPECTED.into()));
    }
    let of_a_joint = find(&hidden.effect).is_some_and(|effect| effect.about().per_joint);
    if of_a_joint && hidden.joint.is_none() && joints > 1 {
        let expected = text!(
            "its joint, from 1 to {joints}, behind the name of the effect",
            joints
        );
        return Err(wrong("--effect", text, expected));
    }
    Ok(hidden)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_effect_is_a_name_a_joint_and_parameters() {
        let hidden = effect("encoder-eccentricity:3:amplitude_deg=0.03,phase_deg=-40", 6).unwrap();
        assert_eq!(
            (hidden.effect.as_str(), hidden.joint),
            ("encoder-eccentricity", Some(3))
        );
        let expected = [
            ("amplitude_deg".to_owned(), 0.03),
            ("phase_deg".to_owned(), -40.0),
        ];
        assert_eq!(hidden.parameters, expected);
        assert_eq!(effect("base-offset:x_mm=0.4", 6).unwrap().joint, None);
        for text in [
            "backlash",
            "backlash:2",
            "backlash:2:width_deg",
            "backlash:2:width_deg=x",
            "backlash:width_deg=0.1",
        ] {
            assert!(effect(text, 6).is_err(), "{text}");
        }
        assert_eq!(effect("backlash:width_deg=0.1", 1).unwrap().joint, None);
    }

    #[test]
    fn temperatures_are_values_or_a_warm_up() {
        let warm = temperature("20..26.5").unwrap();
        assert_eq!(warm, RequestedTemperature::WarmUp(20.0, 26.5));
        let values = temperature("-5,22").unwrap();
        assert_eq!(values, RequestedTemperature::Values(vec![-5.0, 22.0]));
        assert_eq!(temperature("none").unwrap(), RequestedTemperature::Unknown);
        assert!(temperature("20..").is_err() && temperature("warm").is_err());
    }
}
