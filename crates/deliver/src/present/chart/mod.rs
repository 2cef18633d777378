//! A chart in its own coordinates: axes, lines, bars and marks, and what colour stands for what by
//! name. The window draws it on the screen, [`Chart::on_paper`] as a drawing for SVG and PDF: what
//! is saved, and what the report holds, is what is seen.
//!
//! - [`Deviation`]: samples over the value of a joint, time, load or temperature.
//! - [`AxisDeviation`]: one axis over its position, run by run, and what a table corrects.
//! - [`gap`](fn@gap): the RMS error step by step.

mod axis_test;
mod deviation;
mod drawing;
mod gap;
#[doc(hidden)]
pub mod panel;
mod spec;
mod ticks;

pub use axis_test::{AxisDeviation, AxisStage, axis_figures};
pub use deviation::{Deviation, LEAST_SPAN, Series};
pub use gap::{gap, in_words};
pub use ticks::among;
pub use ticks::decade;
pub use ticks::ticks;

pub use panel::FULL_WIDTH;
pub use spec::{
    Axis, Bar, Chart, ChartText, ColourRole, Entry, Form, Item, LegendSymbol, Lengths, Mark, Ticks,
};
pub use spec::{is_wide, shortened};
