//! What a found effect does: the residual of the model without it, and its own curve through it.

mod paint;

use crate::gui::help;
use crate::gui::view::Chart;

use super::view::{View, is_measured};

pub(super) const VIEW: View = View {
    chart: Chart::Effect,
    short: "effect",
    name: "Effect's own curve",
    word: help::EFFECT_CURVE,
    of_component: true,
    of_joint: false,
    show: paint::show,
    sketch: |workbench, _| paint::sketch(workbench),
    numbers: paint::numbers,
    has_picture: is_measured,
};
