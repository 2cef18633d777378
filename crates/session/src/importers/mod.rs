//! Files that instruments write, made into sessions.
//!
//! ```text
//! bytes → text → rows → grid (separator, header, decimal sign) → one reader per format → columns
//! columns + commands (by order, name or time) + reference points → session
//! ```
//!
//! Nothing is guessed silently. [`inspect`] says what was found out about a file and what only a
//! person can answer; the answers go into [`Reading`], and [`import`] makes the session or refuses
//! with every reason and its place. The command line and the window ask the same questions.
//!
//! A new format is one file like `formats/tum.rs` and one line in the register, `formats/mod.rs`.

mod assembled;
mod averages;
mod base;
mod clock;
mod clock_text;
mod columns;
mod commanded;
mod companion_file;
mod decimal_sign;
mod declared;
mod directions;
mod euler;
mod families;
mod formats;
mod headings;
pub(crate) mod inspect;
mod job;
mod join;
mod joint_names;
mod matching;
mod numbered;
mod options;
mod path;
mod reader;
mod reference;
mod role;
mod session;
mod settings;
#[cfg(test)]
mod tests;
mod times;
mod turns;
#[doc(hidden)]
pub mod units;
mod upwards;

pub use clock::ClockOffset;
pub use formats::{IMPORTERS, Importer, Meanings, OwnOption, Questions, find};
pub use inspect::{inspect, inspect_watched};
pub use job::{Companion, Imported, Matched, Settings};
pub use matching::Matching;
pub use options::EULER;
pub use reference::{Alignment, Landmark, Residual, align};
pub use session::{import, import_watched};
pub use settings::{About, ColumnGuess, Inspection, Known, Question, Reading};
pub use units::{AngleUnit, LengthUnit, TimeUnit};

pub use crate::tables::Separator;
pub use crate::tables::decimals::Decimal;
pub use crate::tables::encoding::Encoding;
