//! A plot item that draws whatever it is told, in plot coordinates.

use std::ops::RangeInclusive;

use egui::{Color32, Shape, Ui};
use egui_plot::{PlotBounds, PlotGeometry, PlotItem, PlotItemBase, PlotTransform};

type Draw<'a> = Box<dyn Fn(&Ui, &PlotTransform, &mut Vec<Shape>) + 'a>;

/// A drawing as an item of an egui plot. It takes part in the plot's bounds and in nothing else: what can be hovered is
/// the plots' own affair.
pub(crate) struct Drawing<'a> {
    base: PlotItemBase,
    bounds: PlotBounds,
    draw: Draw<'a>,
}

impl<'a> Drawing<'a> {
    /// Something drawn within these bounds (smallest and largest corner).
    pub(crate) fn new(
        name: &str,
        [min, max]: [[f64; 2]; 2],
        draw: impl Fn(&Ui, &PlotTransform, &mut Vec<Shape>) + 'a,
    ) -> Self {
        Self {
            base: PlotItemBase::new(name.to_owned()),
            bounds: PlotBounds::from_min_max(min, max),
            draw: Box::new(draw),
        }
    }
}

impl PlotItem for Drawing<'_> {
    fn shapes(&self, ui: &Ui, transform: &PlotTransform, shapes: &mut Vec<Shape>) {
        (self.draw)(ui, transform, shapes);
    }

    fn initialize(&mut self, _: RangeInclusive<f64>) {}

    fn color(&self) -> Color32 {
        Color32::TRANSPARENT
    }

    fn allow_hover(&self) -> bool {
        false
    }

    fn geometry(&self) -> PlotGeometry<'_> {
        PlotGeometry::None
    }

    fn bounds(&self) -> PlotBounds {
        self.bounds
    }

    fn base(&self) -> &PlotItemBase {
        &self.base
    }

    fn base_mut(&mut self) -> &mut PlotItemBase {
        &mut self.base
    }
}
