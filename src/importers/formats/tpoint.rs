//! A pointing run in the format of TPOINT, the program that observatories fit mounts with: a caption,
//! options behind colons, a line of run parameters (latitude first), one line a star, `END`.
//!
//! ```text
//! Nasmyth run
//! : ALTAZ
//! -29 00 26.8  2019 07 15
//! ! desired az, el   mount az, el   rotator      degrees
//!  82.1150 43.2102  82.0871 43.2290  10.0
//! END
//! ```
//!
//! An altazimuth run in degrees is read: where the star was (as seen, refraction included) is what was
//! measured, where the mount was is what was commanded. Azimuths count from north through east. Equatorial
//! runs state catalogue places, which would have to be reduced to the night first (precession, aberration,
//! refraction): they are refused.
//!
//! Sources: the headers that the 3.5 m telescope at Apache Point and the SDSS telescopes write for it.

use crate::text::Text;
use nalgebra::Vector3;

use crate::diagnostic::Diagnostic;
use crate::document::number::quoted;
use crate::importers::columns::{Column, Columns, Directions};
use crate::importers::formats::{Importer, KnownBy, Meanings, OwnOption, Questions};
use crate::importers::reader::others_like_these;
use crate::importers::role::Role;
use crate::importers::settings::{ColumnGuess, Known, ReadContext};
use crate::sessions::columns::{Quantity, Unit};
use crate::sessions::{Azimuth, Lines};
use crate::tables::{Cells, Complaints};

/// Option: which axis of the tool looks at the sky.
const POINTING_AXIS: &str = "pointing-axis";

pub(crate) static IMPORTER: Importer = Importer {
    id: "tpoint",
    title: phrase!("a pointing run for TPOINT: where the mount was and where the star was"),
    asks: Questions {
        table: false,
        columns: Meanings::Fixed,
        ..Questions::TABLE
    },
    options: &[OwnOption {
        name: POINTING_AXIS,
        title: phrase!("Axis of the tool that points"),
        value: "AXIS",
        help: phrase!("the axis of the tool frame that looks at the sky [default: x]"),
        values: &["x", "y", "z"],
    }],
    known_by: KnownBy::Text(is),
    read,
};

/// The options of mounts and of how places are given.
const OPTIONS: [&str; 7] = [
    "ALTAZ", "AZALT", "EQUAT", "GIMBAL", "NODA", "ALLSKY", "J2000",
];

/// A line without its comment.
fn plain(line: &str) -> &str {
    line.split('!').next().unwrap_or_default().trim()
}

fn is(text: &str) -> bool {
    let lines = text.lines().map(plain).filter(|line| !line.is_empty());
    // The caption comes first.
    let mut options = lines.skip(1).take_while(|line| line.starts_with(':'));
    options.any(|line| {
        options_of(line)
            .iter()
            .any(|word| OPTIONS.contains(&word.as_str()))
    })
}

fn options_of(line: &str) -> Vec<String> {
    let words = line.split([':', ' ', '\t', ',']);
    words
        .filter(|word| !word.is_empty())
        .map(str::to_uppercase)
        .collect()
}

/// Numbers of a line; `None` where one is no number.
fn numbers(line: &str) -> Option<Vec<f64>> {
    line.split_whitespace()
        .map(|word| word.parse::<f64>().ok().filter(|value| value.is_finite()))
        .collect()
}

/// Reads the run.
fn read(context: &mut ReadContext<'_>) -> Option<Columns> {
    let text = context.text;
    let mut lines = text
        .lines()
        .zip(1u64..)
        .map(|(line, number)| (plain(line), number))
        .filter(|(line, _)| !line.is_empty())
        .peekable();
    let caption = lines.next().map_or("", |(line, _)| line);
    let mut options: Vec<String> = Vec::new();
    while let Some((line, _)) = lines.next_if(|(line, _)| numbers(line).is_none()) {
        options.extend(options_of(line));
    }
    context.found.preamble = vec![caption.to_owned(), options.join(" ")];
    if !options
        .iter()
        .any(|option| option == "ALTAZ" || option == "AZALT")
    {
        context.refuse(
            text!("a run with the options {options}", options = options.join(", ")),
            text!("an altazimuth run (: ALTAZ) in degrees; an equatorial one states catalogue places, which have to be reduced to \
             azimuth and elevation as seen first: import those with --as csv (q1_deg, q2_deg, azimuth_deg, elevation_deg)"),
        );
        return None;
    }
    if !matches!(context.reading.joints.len(), 0 | 2) {
        let found = text!(
            "a pointing run for a robot of {joints} joints",
            joints = context.reading.joints.len()
        );
        context.refuse(found, text!("a mount of two joints: azimuth and elevation"));
        return None;
    }
    let latitude = lines.next();
    let Some(latitude) = latitude.and_then(|(line, _)| numbers(line)) else {
        context.refuse(
            text!("no line of run parameters"),
            text!("latitude in degrees, minutes and seconds behind the options"),
        );
        return None;
    };
    let mut values = [const { Vec::new() }; 5];
    let mut rows = Lines::default();
    let mut complaints = Complaints::default();
    for (line, number) in lines {
        if line.eq_ignore_ascii_case("END") {
            break;
        }
        match numbers(line) {
            Some(row) if row.len() == 4 || row.len() == 5 => {
                for (column, value) in values.iter_mut().zip(row.iter().copied().chain([f64::NAN])) {
                    column.push(value);
                }
                rows.add(number, 1);
            }
            _ => complaints.add(|| {
                let place = context.place.clone().at_line(number);
                Diagnostic::error(place, Text::verbatim(quoted(line)), text!("azimuth and elevation of the star, azimuth and elevation of the mount, in degrees, and perhaps the rotator"))
            }),
        }
    }
    let place = context.place.clone();
    complaints.into(&place, &mut context.found.findings, others_like_these);
    context.found.rows = values[0].len();
    if context.found.rows == 0 && !context.is_open() {
        context.refuse(text!("no row that can be read"), text!("at least one star"));
    }
    if let [degrees, rest @ ..] = &latitude[..] {
        let minutes = rest.first().copied().unwrap_or(0.0);
        context.note(text!(
            "{caption}; latitude {degrees}° {minutes}′: it plays no part in an altazimuth run",
            caption,
            degrees,
            minutes
        ));
    }
    Some(columns(context, values, rows))
}

fn columns(context: &mut ReadContext<'_>, values: [Vec<f64>; 5], lines: Lines) -> Columns {
    let degree = Unit::Angle(1.0_f64.to_radians());
    let [azimuth, elevation, mount_azimuth, mount_elevation, rotator] = values;
    let mut list = vec![
        Column::made(Quantity::Azimuth, degree, azimuth),
        Column::made(Quantity::Elevation, degree, elevation),
        Column::made(Quantity::Commanded(0), degree, mount_azimuth),
        Column::made(Quantity::Commanded(1), degree, mount_elevation),
    ];
    if rotator.iter().any(|value| value.is_finite()) {
        let cells = rotator.iter().map(|value| {
            if value.is_nan() {
                String::new()
            } else {
                value.to_string()
            }
        });
        list.push(Column {
            name: "rotator_deg".to_owned(),
            number: 5,
            role: Role::Kept,
            cells: Cells::Text(cells.collect()),
        });
    }
    for (column, number) in list.iter_mut().zip(1..) {
        column.number = number;
    }
    context.found.columns = list
        .iter()
        .map(|column| ColumnGuess {
            heading: String::new(),
            meaning: column.role.to_string(),
            confidence: Known::Certain,
        })
        .collect();
    let axis = match context
        .reading
        .options
        .get(POINTING_AXIS)
        .map(String::as_str)
    {
        Some("y") => Vector3::y_axis(),
        Some("z") => Vector3::z_axis(),
        _ => Vector3::x_axis(),
    };
    Columns {
        list,
        lines,
        commands: None,
        directions: Some(Directions {
            axis,
            azimuth: Azimuth::Clockwise,
        }),
    }
}
