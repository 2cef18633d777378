//! How large the deviation is at each whole number of cycles per turn of a joint.

mod paint;

use crate::gui::help;
use crate::gui::view::Chart;

use super::view::{View, is_measured};

pub(super) const VIEW: View = View {
    chart: Chart::Orders,
    short: "orders",
    name: "Order spectrum",
    word: help::ORDERS,
    of_component: true,
    of_joint: true,
    show: paint::show,
    sketch: |workbench, _| paint::sketch(workbench),
    numbers: paint::numbers,
    has_picture: is_measured,
};
