//! How many samples deviate by how much.

mod paint;

use crate::gui::help;
use crate::gui::view::Chart;

use super::view::{View, is_measured};

pub(super) const VIEW: View = View {
    chart: Chart::Histogram,
    short: "histogram",
    name: "Histogram",
    word: help::HISTOGRAM,
    of_component: true,
    of_joint: false,
    show: paint::show,
    sketch: |workbench, _| paint::sketch(workbench),
    numbers: paint::numbers,
    has_picture: is_measured,
};
