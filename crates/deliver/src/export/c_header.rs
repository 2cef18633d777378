//! A C99 header: the table as constants, and an inline function that looks a correction up.
//!
//! One multiplication finds the interval; the arithmetic is that of
//! [`UniformTable`](crate::compensation::interpolation::UniformTable), so that both give the same number.

use crate::text::Text;
use std::fmt::Write;

use super::csv;
use super::rules::Rules;
use super::sheet::Sheet;
use super::table_file::{Columns, TableFile, in_a_comment, number};
use super::{ExportError, Format, Job};

const RULES: Rules = Rules {
    format: "c-header",
    interpolation: "linear between two entries",
    outside: "the first or the last entry is held",
    direction: "a direction above 0 takes the forward entries, one below 0 the reverse ones, 0 the \
                mean of both",
    ..csv::RULES
};

pub(super) const FORMAT: Format = TableFile::format(
    phrase!("C99 header with a lookup function"),
    "h",
    &TableFile {
        rules: &RULES,
        write,
        read,
        enter: |_, _| Vec::new(),
    },
);

/// Numbers in a row of the arrays.
const PER_ROW: usize = 4;

/// `truepose_pan` for a joint called "Pan".
fn prefix(table: &Sheet) -> String {
    let name = table.word();
    let name = name.unwrap_or_else(|| format!("joint_{}", table.joint + 1));
    format!("truepose_{name}")
}

fn write(job: &Job, table: &Sheet, notes: &[Text]) -> String {
    let (name, unit) = (prefix(table), table.unit());
    let guard = format!("{}_H", name.to_ascii_uppercase());
    let last = table.places.len() - 1;
    let mut text = String::new();
    // A comment must not end early, and not go on after its line.
    let comment = |line: &str| {
        let plain = line
            .replace(['\n', '\r'], " ")
            .replace("*/", "* /")
            .replace('\\', "/");
        format!(" * {}\n", plain.replace("/*", "/ *"))
    };
    text.push_str("/*\n");
    text.push_str(&comment(&in_a_comment(&text!(
        "Correction of joint {joint} ({name}) in {unit}: add it to the command",
        joint = table.joint + 1,
        name = &table.name,
        unit
    ))));
    text.push_str(" *\n");
    for note in notes {
        text.push_str(&comment(&in_a_comment(note)));
    }
    text.push_str(" *\n");
    text.push_str(&comment(&in_a_comment(&text!(
        "Made by truepose {version} from '{session}', samples {hash}",
        version = env!("CARGO_PKG_VERSION"),
        session = &job.calibration.session,
        hash = &job.calibration.samples_hash
    ))));
    text.push_str(" */\n");
    let [from, to] = table.ends();
    let step = table.step.unwrap_or((to - from) / last as f64);
    let _ = write!(
        text,
        "#ifndef {guard}\n#define {guard}\n\n\
         #define {macro_name}_ENTRIES {entries}\n\n",
        macro_name = name.to_ascii_uppercase(),
        entries = last + 1,
    );
    array(&mut text, &format!("{name}_forward_{unit}"), &table.forward);
    array(&mut text, &format!("{name}_reverse_{unit}"), &table.reverse);
    let _ = write!(
        text,
        "/* {at_entries} */\n\
         static inline double {name}_at(const double *entries, double commanded_{unit})\n\
         {{\n\
         \x20   double place = (commanded_{unit} - ({from})) * {per_step};\n\
         \x20   int index;\n\
         \x20   if (!(place > 0.0)) {{\n\
         \x20       return entries[0];\n\
         \x20   }}\n\
         \x20   if (place >= {last}.0) {{\n\
         \x20       return entries[{last}];\n\
         \x20   }}\n\
         \x20   index = (int)place;\n\
         \x20   return entries[index] + (entries[index + 1] - entries[index]) * (place - (double)index);\n\
         }}\n\n\
         /* {to_add} */\n\
         static inline double {name}_correction_{unit}(double commanded_{unit}, int direction)\n\
         {{\n\
         \x20   if (direction > 0) {{\n\
         \x20       return {name}_at({name}_forward_{unit}, commanded_{unit});\n\
         \x20   }}\n\
         \x20   if (direction < 0) {{\n\
         \x20       return {name}_at({name}_reverse_{unit}, commanded_{unit});\n\
         \x20   }}\n\
         \x20   return 0.5 * ({name}_at({name}_forward_{unit}, commanded_{unit})\n\
         \x20       + {name}_at({name}_reverse_{unit}, commanded_{unit}));\n\
         }}\n\n\
         #endif /* {guard} */\n",
        at_entries = in_a_comment(&text!("Correction at the entries of one side")),
        to_add = in_a_comment(&text!(
            "What to add to the command; direction: above 0 moving to larger values, below 0 to smaller ones, 0 unknown"
        )),
        from = literal(from),
        per_step = literal(1.0 / step),
    );
    text
}

/// A number that C reads as the same double.
fn literal(value: f64) -> String {
    format!("{value:?}")
}

fn array(text: &mut String, name: &str, values: &[f64]) {
    let _ = writeln!(text, "static const double {name}[{}] = {{", values.len());
    for row in values.chunks(PER_ROW) {
        let row: Vec<String> = row.iter().map(|v| literal(*v)).collect();
        let _ = writeln!(text, "    {},", row.join(", "));
    }
    text.push_str("};\n\n");
}

/// Reads the arrays back, and where their entries stand from the line that looks them up.
fn read(table: &Sheet, text: &str) -> Result<Columns, ExportError> {
    let wrong = |what: &str| ExportError::ReadBack(what.to_owned());
    let values = |side: &str| -> Result<Vec<f64>, ExportError> {
        let wrong = || ExportError::ReadBack(format!("the {side} entries"));
        let start = format!("{}_{side}_{}[", prefix(table), table.unit());
        let after = text.split_once(&start).ok_or_else(wrong)?.1;
        let inside = after
            .split_once('{')
            .and_then(|(_, rest)| rest.split_once('}'));
        let cells = inside.ok_or_else(wrong)?.0.split(',').map(str::trim);
        let cells = cells.filter(|cell| !cell.is_empty());
        let values: Option<Vec<f64>> = cells.map(number).collect();
        values.ok_or_else(wrong)
    };
    let place = format!("double place = (commanded_{} - (", table.unit());
    let grid = text.split_once(&place).and_then(|(_, rest)| {
        let (from, rest) = rest.split_once(")) * ")?;
        let (per_step, _) = rest.split_once(';')?;
        Some((number(from)?, number(per_step)?))
    });
    let (from, per_step) = grid.ok_or_else(|| wrong("the line of the lookup"))?;
    let forward = values("forward")?;
    Ok(Columns {
        places: (0..forward.len())
            .map(|k| from + k as f64 / per_step)
            .collect(),
        reverse: values("reverse")?,
        forward,
        repeats: false,
    })
}
