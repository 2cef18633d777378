//! A component of the deviation over the value of a joint, time, load or temperature, before and
//! after.

mod columns;
mod layout;
mod model;
mod paint;
mod svg;

use crate::gui::help::{self, Word};
use crate::gui::view::Chart;

use super::view::{View, is_measured};

pub(super) const ANGLE: View = over(Chart::Angle, help::DEVIATION);
pub(super) const TIME: View = over(Chart::Time, help::OVER_TIME);
pub(super) const LOAD: View = over(Chart::Load, help::OVER_LOAD);
pub(super) const TEMPERATURE: View = over(Chart::Temperature, help::OVER_TEMPERATURE);

const fn over(chart: Chart, word: Word) -> View {
    let [short, name] = model::names(chart);
    View {
        chart,
        short,
        name,
        word,
        of_component: true,
        of_joint: true,
        show: |ui, workbench, commands| {
            if let Some(over) = workbench.over() {
                paint::show(ui, workbench, over, commands);
            }
        },
        sketch: |workbench, chart| svg::sketch(workbench, workbench.over_in(chart)?),
        numbers: |workbench| {
            let over = workbench.over();
            over.map_or_else(String::new, |over| svg::numbers(workbench, over))
        },
        has_picture: is_measured,
    }
}
