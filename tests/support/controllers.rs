//! Controllers on paper: each reads its file and does with it what its maker says, written from the
//! description of the format and sharing no code with the exporters. What they have in common is
//! the question: told to go to `command`, moving in `direction`, where do they send the axis?

#![allow(dead_code, reason = "each test uses a part")]
#![allow(unreachable_pub, reason = "included in tests")]

/// A controller with its table; degrees or mm.
pub trait Controller {
    fn sends(&self, command: f64, direction: f64) -> f64;
    /// The entries: place and what is added there moving up and down.
    fn entries(&self) -> Vec<[f64; 3]>;
}

/// The controller for a format, with this file loaded.
pub fn load(format: &str, text: &str) -> Box<dyn Controller> {
    match format {
        "csv" => Box::new(csv(text)),
        "linuxcnc" => Box::new(linuxcnc(text)),
        "twincat-nc" => Box::new(twincat_nc(text)),
        "twincat-cnc" => Box::new(isg(text)),
        "sinumerik" => Box::new(Sinumerik::load(text)),
        other => panic!("no controller for {other}"),
    }
}

/// Straight lines between points; beyond them the ends.
fn line(points: &[[f64; 3]], column: usize, at: f64) -> f64 {
    let (first, last) = (points[0], points[points.len() - 1]);
    if at <= first[0] {
        return first[column];
    }
    if at >= last[0] {
        return last[column];
    }
    let mut k = 0;
    while points[k + 1][0] < at {
        k += 1;
    }
    let (a, b) = (points[k], points[k + 1]);
    a[column] + (b[column] - a[column]) * ((at - a[0]) / (b[0] - a[0]))
}

fn real(text: &str) -> f64 {
    assert!(
        text.bytes()
            .all(|b| b.is_ascii_digit() || b"+-.".contains(&b)),
        "'{text}' is more than a plain decimal"
    );
    text.parse().expect("a number")
}

/// What is added is looked up at the command, in the column of the direction of travel; at a change
/// of direction without a column for it, the same.
struct Added {
    points: Vec<[f64; 3]>,
    turn: Option<f64>,
}

impl Controller for Added {
    fn sends(&self, command: f64, direction: f64) -> f64 {
        let mut at = command;
        if let Some(turn) = self.turn {
            let first = self.points[0][0];
            at -= ((at - first) / turn).floor() * turn;
        }
        command + line(&self.points, if direction < 0.0 { 2 } else { 1 }, at)
    }

    fn entries(&self) -> Vec<[f64; 3]> {
        self.points.clone()
    }
}

fn csv(text: &str) -> Added {
    let rows = text.lines().skip(1).map(|row| {
        let cells: Vec<f64> = row.split(',').map(real).collect();
        [cells[0], cells[1], cells[2]]
    });
    Added {
        points: rows.collect(),
        turn: None,
    }
}

/// Lines of three numbers up to the first that is not; at most 256, ascending, else LinuxCNC
/// complains and does not start.
fn linuxcnc(text: &str) -> Added {
    let mut points: Vec<[f64; 3]> = Vec::new();
    for row in text.split('\n') {
        let cells: Vec<&str> = row.split([' ', '\t']).filter(|c| !c.is_empty()).collect();
        if cells.len() < 3 {
            assert!(row.is_empty(), "everything behind '{row}' is lost");
            break;
        }
        let row = [real(cells[0]), real(cells[1]), real(cells[2])];
        assert!(
            points.last().is_none_or(|p| p[0] < row[0]),
            "compensation values must increase"
        );
        points.push(row);
    }
    assert!(points.len() <= 256, "too many compensation entries");
    Added { points, turn: None }
}

/// Elements at equal distances, one compensation for both directions, added to the position.
fn twincat_nc(text: &str) -> Added {
    let code: String = text
        .lines()
        .map(|l| l.split("//").next().unwrap_or(""))
        .collect::<Vec<_>>()
        .join("\n");
    let after = |text: &str, key: &str| -> String {
        let (_, rest) = text.split_once(key).expect("the key is there");
        let rest = rest.trim_start().trim_start_matches(":=").trim_start();
        rest.split([',', ')', '\n', ';'])
            .next()
            .expect("a value")
            .trim()
            .to_owned()
    };
    let (head, rest) = code.split_once("ARRAY[0..").expect("an array from 0");
    assert!(head.contains("VAR_GLOBAL") && head.trim_end().ends_with(':'));
    let (last, rest) = rest.split_once(']').expect("an upper bound");
    assert!(rest.starts_with(" OF ST_PositionCompensationTableElement := ["));
    let (body, tail) = rest.split_once("];").expect("the end of the array");
    let mut points = Vec::new();
    for element in body.split("(Position").skip(1) {
        let position = real(&after(&format!("Position{element}"), "Position"));
        let added = real(&after(element, "Compensation"));
        points.push([position, added, added]);
    }
    assert_eq!(last.parse::<usize>().expect("a bound") + 1, points.len());
    assert_eq!(after(tail, "NoOfTableElements"), points.len().to_string());
    assert_eq!(real(&after(tail, "MinPosition")), points[0][0]);
    assert_eq!(
        real(&after(tail, "MaxPosition")),
        points[points.len() - 1][0]
    );
    let step = points[1][0] - points[0][0];
    for pair in points.windows(2) {
        assert!(
            (pair[1][0] - pair[0][0] - step).abs() < 1e-8 && step > 0.0,
            "not equidistant"
        );
    }
    let turn = points[points.len() - 1][0] - points[0][0];
    let turn = (after(tail, "Modulo") == "TRUE").then_some(turn);
    Added { points, turn }
}

/// Whole numbers of a ten-thousandth, actual − setpoint for each direction, taken away from the
/// setpoint.
fn isg(text: &str) -> Added {
    let value = |key: &str| -> Option<i64> {
        let mut lines = text
            .lines()
            .map(|l| l.split_whitespace().collect::<Vec<_>>());
        let found = lines.find(|words| words.len() == 2 && words[0] == key)?;
        Some(found[1].parse().expect("a whole number"))
    };
    assert_eq!(value("kw.ssfk.unit"), Some(1));
    assert_eq!(value("kw.ssfk.interval"), Some(0));
    assert_eq!(value("kw.ssfk.bilateral"), Some(1));
    assert!(value("kopf.achs_nr").is_some());
    assert!(text.contains("kopf.log_achs_name "));
    let count = value("kw.ssfk.kw_nr_max").expect("a number of entries");
    assert!((2..=1500).contains(&count));
    let entry = |k: i64, what: &str| -> f64 {
        let found = value(&format!("kw.ssfk.table[{k}].{what}")).expect("the entry is there");
        i32::try_from(found).expect("32 bits").into()
    };
    let point = |k| [entry(k, "setpoint"), -entry(k, "pos"), -entry(k, "neg")].map(|v| v / 1e4);
    let points: Vec<[f64; 3]> = (0..count).map(point).collect();
    assert!(points.windows(2).all(|p| p[0][0] < p[1][0]));
    let turn = (value("kw.ssfk.modulo") == Some(1)).then_some(360.0);
    if turn.is_some() {
        let (first, last) = (points[0], points[points.len() - 1]);
        assert_eq!(
            [last[0] - 360.0, last[1], last[2]],
            first,
            "a jump at the turn"
        );
    }
    Added { points, turn }
}

/// An archive: a value of N moves the axis by as much to smaller values at MIN + N · STEP.
struct Sinumerik {
    values: Vec<f64>,
    step: f64,
    min: f64,
    modulo: bool,
}

impl Sinumerik {
    fn load(text: &str) -> Self {
        let lines: Vec<&str> = text.split('\n').collect();
        assert_eq!(&lines[..2], ["%_N_AX_EEC_INI", "CHANDATA(1)"]);
        assert_eq!(&lines[lines.len() - 2..], ["M17", ""]);
        let mut values = Vec::new();
        let (mut step, mut min, mut max, mut modulo) = (None, None, None, None);
        for row in &lines[2..lines.len() - 2] {
            let (left, value) = row.split_once('=').expect("an assignment");
            let (name, place) = left.split_once('[').expect("an index");
            let place: Vec<&str> = place.trim_end_matches(']').split(',').collect();
            assert_eq!(place[0], "0", "the first measuring system");
            assert!(
                place[place.len() - 1]
                    .chars()
                    .all(|c| c.is_ascii_alphanumeric())
            );
            match name {
                "$AA_ENC_COMP" => {
                    assert_eq!(place[1], values.len().to_string());
                    values.push(real(value));
                }
                "$AA_ENC_COMP_STEP" => step = Some(real(value)),
                "$AA_ENC_COMP_MIN" => min = Some(real(value)),
                "$AA_ENC_COMP_MAX" => max = Some(real(value)),
                "$AA_ENC_COMP_IS_MODULO" => modulo = Some(value == "1"),
                other => panic!("{other}"),
            }
        }
        let own = Self {
            values,
            step: step.expect("STEP"),
            min: min.expect("MIN"),
            modulo: modulo.expect("IS_MODULO"),
        };
        assert!(own.values.len() <= 5000);
        let end = own.min + own.step * (own.values.len() - 1) as f64;
        assert!(
            (end - max.expect("MAX")).abs() < 1e-6,
            "MAX is not MIN + N STEP"
        );
        own
    }
}

impl Controller for Sinumerik {
    fn sends(&self, command: f64, _: f64) -> f64 {
        let last = (self.values.len() - 1) as f64;
        let mut n = (command - self.min) / self.step;
        if self.modulo {
            n = n.rem_euclid(last);
        }
        let n = n.clamp(0.0, last);
        let below = n.floor().min(last - 1.0);
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "between 0 and the last"
        )]
        let k = below as usize;
        let value = self.values[k] + (self.values[k + 1] - self.values[k]) * (n - below);
        command - value
    }

    fn entries(&self) -> Vec<[f64; 3]> {
        let at = |(n, e): (usize, &f64)| [self.min + n as f64 * self.step, -e, -e];
        self.values.iter().enumerate().map(at).collect()
    }
}
