//! What a certificate states besides its measurements: for whom, which machine, measured with what
//! and by whom, and by which rule it is decided whether the machine is within its tolerance.
//!
//! Everything is optional. There is no clock here: dates are typed, and printed as they are.

use crate::text::{Template, Text, spoken};
use std::path::Path as FilePath;

use super::logo::Logo;
use crate::compensation::decision::Rule;
use crate::diagnostic::{Diagnostic, Place, Rejected, Severity};
use crate::document::kinds::{TEXT, positive};
use crate::document::object::{Kind, Object, written};
use crate::document::{Fields, Value, text_of};
use crate::guard::{below, read_regular};

/// What a document of this kind begins with.
const FORMAT: &str = "truepose-details/1";
/// Longest document, bytes.
const MOST_BYTES: u64 = 1 << 20;

/// A line of text: its key in a document, what it is called, and where it is.
#[derive(Debug, Clone, Copy)]
pub struct Line {
    /// Key in a document.
    pub key: &'static str,
    /// What it is called.
    pub name: Template,
    /// The text.
    pub of: fn(&mut Details) -> &mut String,
}

macro_rules! details {
    ($($key:ident: $name:literal),* $(,)?) => {
        /// See the module. A text that is empty is a line to fill in by hand.
        #[derive(Debug, Clone, Default, PartialEq)]
        pub struct Details {
            $(#[doc = $name] pub $key: String,)*
            /// Logo in the head of the report.
            pub logo: Option<Logo>,
            /// How far a measured position may be off, mm, in place of what the session states.
            pub tolerance_mm: Option<f64>,
            /// By what it is decided whether that holds; `None`: it is not decided.
            pub rule: Option<Rule>,
        }

        impl Details {
            /// The lines of text in their order.
            pub const LINES: &'static [Line] = &[$(Line {
                key: stringify!($key),
                name: phrase!($name),
                of: |details| &mut details.$key,
            }),*];
        }
    };
}

details! {
    report_number: "Report number",
    date: "Date",
    customer: "Customer",
    machine: "Machine",
    machine_serial: "Serial number of the machine",
    instrument: "Instrument",
    instrument_serial: "Serial number of the instrument",
    instrument_calibrated: "Instrument calibrated on",
    operator: "Operator",
}

impl Details {
    /// Reads a document; a logo is looked for beside it.
    ///
    /// # Errors
    /// Everything that is wrong with it, each with its place.
    pub fn load(path: &FilePath) -> Result<Self, Rejected> {
        let place = Place::file(path);
        let expected = phrase!("a document with \"format\": \"truepose-details/1\"");
        let refused =
            |found: Text| Rejected::because(Diagnostic::error(Place::file(path), found, expected));
        let bytes = read_regular(path, MOST_BYTES).map_err(|(found, _)| refused(found))?;
        let text = String::from_utf8(bytes).map_err(|e| refused(Text::verbatim(e.to_string())))?;
        Self::parse(place, text.strip_prefix('\u{feff}').unwrap_or(&text))
    }

    /// Reads the text of a document.
    ///
    /// # Errors
    /// As [`Details::load`].
    pub fn parse(place: Place, text: &str) -> Result<Self, Rejected> {
        let (mut fields, root) = Fields::open(place, text)?;
        let expected = phrase!("report details: an object with the key \"format\"");
        let mut own = Self::default();
        if let Some(mut at) = fields.of_format(&root, FORMAT, expected) {
            at.fill(&mut own, declare);
        }
        // A misspelt key would leave a line of the certificate empty without a word.
        for note in &mut fields.findings {
            if note.severity != Severity::Error {
                let keys = Self::LINES.iter().map(|line| line.key);
                let keys: Vec<&str> = keys.chain(OTHER_KEYS).collect();
                *note = Diagnostic::error(
                    note.place.clone(),
                    Text::verbatim(note.found.to_string().replace(": ignored", "")),
                    text!("one of {names}", names = keys.join(", ")),
                );
            }
        }
        if fields.findings.is_empty() {
            Ok(own)
        } else {
            Err(Rejected {
                diagnostics: fields.findings,
            })
        }
    }

    /// The document.
    pub fn document(&self) -> String {
        text_of(&written(self.clone(), declare))
    }

    /// Lines of text with what they are called.
    pub(super) fn lines(&self) -> Vec<(&'static str, String)> {
        let mut own = self.clone();
        let lines = Self::LINES.iter();
        lines
            .map(|line| (spoken(line.name), std::mem::take((line.of)(&mut own))))
            .collect()
    }
}

fn declare(o: &mut Object<'_, '_>, own: &mut Details) {
    o.describe("format", FORMAT);
    for line in Details::LINES {
        let says = !(line.of)(own).is_empty();
        o.usual_if(says, line.key, (line.of)(own), &TEXT);
    }
    let [logo, tolerance, rule] = OTHER_KEYS;
    let above_0 = positive(phrase!("a number above 0"));
    o.optional(logo, &mut own.logo, &LOGO);
    o.optional(tolerance, &mut own.tolerance_mm, &above_0);
    o.optional(rule, &mut own.rule, &RULE);
}

/// Keys of what is no line of text.
const OTHER_KEYS: [&str; 3] = ["logo", "tolerance_mm", "decision_rule"];

const LOGO: Kind<Logo> = Kind {
    expected: phrase!("the name of a PNG file"),
    read: |at| {
        let Value::Text(name) = &at.node.value else {
            return at.wrong();
        };
        // Details in memory are the program's own; a file may come from anywhere.
        let path = match at.fields.folder() {
            Some(folder) => below(folder, name, phrase!("the folder of the details")),
            None => Ok(name.into()),
        };
        match path {
            Ok(path) => Logo::read(&path)
                .map_err(|wrong| at.error::<()>(wrong, Logo::EXPECTED))
                .ok(),
            Err((found, expected)) => at.error(found, expected),
        }
    },
    write: |logo| (&*logo.path.to_string_lossy()).into(),
};

const RULE: Kind<Rule> = Kind {
    expected: phrase!("\"iso-14253-1\" or \"simple-acceptance\""),
    read: |at| at.one_of(&Rule::ALL, Rule::id),
    write: |rule| rule.id().into(),
};
