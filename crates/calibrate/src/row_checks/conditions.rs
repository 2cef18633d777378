//! Loads and temperatures in another unit: no robot of that size carries a tonne, and no workshop is at
//! 295 °C.

use super::missing_values::TEMPERATURES_C;
use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::numeric::extent;
use crate::sessions::{Session, SessionCorrection};

/// The largest payload of a robot, kg: so much …
const LEAST_PAYLOAD_KG: f64 = 60.0;
/// … and so much for the square of its reach in metres (the strongest arms: 2300 kg at 3.7 m).
const PAYLOAD_KG_PER_M2: f64 = 300.0;
/// A load of less is none, kg.
const LEAST_LOAD_KG: f64 = 0.005;
/// Temperatures of a machine in degrees Fahrenheit, where no air is as hot in degrees Celsius …
const FAHRENHEIT: std::ops::Range<f64> = 58.0..120.0;
/// … and where it is that of a workshop: 15 to 32 °C.
const WORKSHOP_FAHRENHEIT: std::ops::Range<f64> = 59.0..90.0;
/// 0 °C in kelvin.
const ZERO_KELVIN: f64 = 273.15;

pub(super) fn in_other_units(session: &Session, _: JointValues) -> Vec<DataProblem> {
    let mut problems = Vec::new();
    problems.extend(load(session));
    problems.extend(temperature(session));
    problems
}

fn load(session: &Session) -> Option<DataProblem> {
    let loads = session.samples.load_kg.as_deref()?.iter();
    let [least, most] = extent(loads.filter(|kg| kg.abs() > 0.0));
    let reach_m = session.robot.length_along_links_mm() / 1000.0;
    let payload = LEAST_PAYLOAD_KG + PAYLOAD_KG_PER_M2 * reach_m * reach_m;
    if most <= payload || least * 0.001 < LEAST_LOAD_KG || most * 0.001 > payload {
        return None;
    }
    Some(DataProblem::of_all(
        text!(
            "load in grams: load_kg holds values up to {most}",
            most = format!("{most:.0}")
        ),
        text!(
            "no robot that reaches {reach} m carries {most} kg; in grams the largest load is {load} kg",
            reach = format!("{reach_m:.2}"),
            most = format!("{most:.0}"),
            load = format!("{:.3}", most / 1000.0)
        ),
        text!("the loads are read as grams; divide the column load_kg by 1000"),
        SessionCorrection::ScaleLoad(0.001),
    ))
}

fn temperature(session: &Session) -> Option<DataProblem> {
    let column = session.samples.temperature_c.as_deref()?;
    let [least, most] = extent(column);
    let is_kelvin =
        |v: f64| !TEMPERATURES_C.contains(&v) && TEMPERATURES_C.contains(&(v - ZERO_KELVIN));
    if is_kelvin(least) && is_kelvin(most) {
        return Some(DataProblem::of_all(
            text!(
                "temperature in kelvin: temperature_c runs from {least} to {most}",
                least = format!("{least:.2}"),
                most = format!("{most:.2}")
            ),
            text!(
                "no machine is as hot; in kelvin it is {least} to {most} °C",
                least = format!("{:.1}", least - ZERO_KELVIN),
                most = format!("{:.1}", most - ZERO_KELVIN)
            ),
            text!("the temperatures are read as kelvin; subtract 273.15"),
            SessionCorrection::ConvertTemperature {
                factor: 1.0,
                offset: -ZERO_KELVIN,
            },
        ));
    }
    let celsius = |f: f64| (f - 32.0) / 1.8;
    let within = |range: &std::ops::Range<f64>| range.contains(&least) && range.contains(&most);
    if !within(&FAHRENHEIT) {
        return None;
    }
    let evidence = text!(
        "as degrees Fahrenheit it is {least} to {most} °C",
        least = format!("{:.1}", celsius(least)),
        most = format!("{:.1}", celsius(most))
    );
    // The correction is of all columns of temperature.
    let mut joints = session.samples.joint_temperature_c.iter().flatten();
    let alike = joints.all(|column| {
        let known = column.iter().filter(|v| v.is_finite());
        known.into_iter().all(|v| FAHRENHEIT.contains(v))
    });
    if !alike || !within(&WORKSHOP_FAHRENHEIT) {
        // A warm gear is as hot: it is asked, not changed.
        return Some(DataProblem::of_all(
            text!(
                "temperature may be in degrees Fahrenheit: {least} to {most}",
                least = format!("{least:.1}"),
                most = format!("{most:.1}")
            ),
            evidence,
            text!(
                "check the unit of temperature_c; everything that depends on temperature refers to 20 °C"
            ),
            None,
        ));
    }
    Some(DataProblem::of_all(
        text!(
            "temperature in degrees Fahrenheit: temperature_c runs from {least} to {most}",
            least = format!("{least:.1}"),
            most = format!("{most:.1}")
        ),
        evidence,
        text!(
            "the temperatures are read as degrees Fahrenheit: what depends on temperature refers to 20 °C, far from where anything was measured otherwise"
        ),
        SessionCorrection::ConvertTemperature {
            factor: 1.0 / 1.8,
            offset: -32.0 / 1.8,
        },
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::row_checks::tests::axis;

    #[test]
    fn loads_in_grams_are_said_and_read_as_such() {
        let mut session = axis(40);
        let loads = |most: f64| Some((0..40).map(|k| most * f64::from(k % 3) / 2.0).collect());
        session.samples.load_kg = loads(6.0);
        assert!(in_other_units(&session, JointValues::Commanded).is_empty());
        session.samples.load_kg = loads(6000.0);
        let problems = in_other_units(&session, JointValues::Commanded);
        assert_eq!(problems.len(), 1);
        assert!(problems[0].what.contains("load in grams"));
        problems[0]
            .mend
            .as_ref()
            .expect("known")
            .apply(&mut session);
        assert!((session.samples.load_kg.as_ref().expect("there")[2] - 6.0).abs() < 1e-12);
    }

    #[test]
    fn temperatures_in_other_units_are_converted_or_asked() {
        let mut session = axis(40);
        let warm = |from: f64| Some((0..40).map(|k| from + 0.1 * f64::from(k)).collect());
        session.samples.temperature_c = warm(35.0);
        assert!(in_other_units(&session, JointValues::Commanded).is_empty());
        session.samples.temperature_c = warm(95.0);
        let asked = in_other_units(&session, JointValues::Commanded);
        assert!(asked[0].what.contains("Fahrenheit") && asked[0].mend.is_none());
        session.samples.temperature_c = warm(68.0);
        session.samples.joint_temperature_c = vec![warm(40.0)];
        let with_a_gear = in_other_units(&session, JointValues::Commanded);
        assert!(
            with_a_gear[0].mend.is_none(),
            "the gear's are no Fahrenheit"
        );
        session.samples.joint_temperature_c = vec![None];
        let workshop = in_other_units(&session, JointValues::Commanded);
        workshop[0]
            .mend
            .as_ref()
            .expect("known")
            .apply(&mut session);
        assert!((session.samples.temperature_c.as_ref().expect("there")[0] - 20.0).abs() < 1e-9);
        session.samples.temperature_c = warm(293.15);
        let kelvin = in_other_units(&session, JointValues::Commanded);
        assert!(kelvin[0].what.contains("kelvin"));
        kelvin[0].mend.as_ref().expect("known").apply(&mut session);
        assert!((session.samples.temperature_c.as_ref().expect("there")[0] - 20.0).abs() < 1e-9);
    }
}
