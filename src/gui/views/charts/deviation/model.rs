//! What the deviation chart shows, in inner units.

use crate::gui::cache::charts::over::{Over, Variable};
use crate::gui::core::scale::{FEW, stride};
use crate::gui::view::Chart;
use crate::gui::workbench::Workbench;

/// The chart's name where there is little room, and its name.
pub(super) const fn names(chart: Chart) -> [&'static str; 2] {
    match chart {
        Chart::Time => ["time", "Deviation over time"],
        Chart::Load => ["load", "Deviation over load"],
        Chart::Temperature => ["temperature", "Deviation over temperature"],
        _ => ["angle", "Deviation over angle"],
    }
}

/// One sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Dot {
    pub(crate) sample: usize,
    /// Where it stands along the chart, inner units; NaN where that is not known.
    pub(crate) x: f64,
    /// The component of the nominal robot's deviation, mm.
    pub(crate) before_mm: f64,
    /// The component of what is left, mm.
    pub(crate) after_mm: Option<f64>,
    /// Side from which the joint came; 0 where it is not known.
    pub(crate) side: f64,
}

impl Dot {
    pub(crate) fn of(workbench: &Workbench, over: Over, sample: usize) -> Self {
        let subject = &**workbench.subject();
        let component = workbench.view().component;
        let of = |e: [f64; 3]| subject.component(e, sample, component);
        Self {
            sample,
            x: over.of(subject, sample),
            before_mm: of(subject.deviation_before(sample)),
            after_mm: workbench.answer().map(|a| of(a.deviation_after(sample))),
            side: over.side(subject, sample),
        }
    }
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Series {
    /// Samples in measuring order, perhaps thinned; none where their extremes are shown instead.
    pub(crate) dots: Vec<Dot>,
    /// One dot for so many samples.
    pub(crate) stride: usize,
    /// What the chart stands over.
    pub(crate) over: Over,
    /// How many samples have no place along it.
    pub(crate) unplaced: usize,
    /// Region boundaries, rad.
    pub(crate) boundaries_rad: Vec<f64>,
    pub(crate) tolerance_mm: Option<f64>,
}

impl Series {
    /// The chart as the workbench has it.
    pub(crate) fn of(workbench: &Workbench, over: Over) -> Self {
        let subject = &**workbench.subject();
        let document = workbench.document();
        let usable = &subject.overview.usable;
        // Of many a few, until their extremes are known.
        let stride = stride(usable.len(), FEW);
        let shown: &[u32] = if workbench.envelope().is_some() {
            &[]
        } else {
            usable
        };
        let samples = shown.iter().step_by(stride);
        let dots = samples.map(|sample| Dot::of(workbench, over, *sample as usize));
        let (dots, unplaced): (Vec<Dot>, Vec<Dot>) = dots.partition(|dot| dot.x.is_finite());
        let boundaries = crate::gui::core::boundaries::boundaries(&document.regions);
        // Regions divide the angle of joint 1.
        let divided = over.variable == Variable::Joint && over.joint == 0;
        let boundaries = boundaries.iter().filter(|_| divided);
        let of_many = workbench.envelope().map(|e| usable.len() - e.placed());
        Self {
            dots,
            stride,
            over,
            unplaced: of_many.unwrap_or(stride * unplaced.len()),
            boundaries_rad: boundaries.map(|b| b.at_rad).collect(),
            tolerance_mm: document.tolerance_mm,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::core::edit::Edit;
    use crate::gui::core::loaded_session::Component;
    use crate::gui::testing::workbench;
    use crate::gui::workbench::Command;

    fn series(workbench: &Workbench) -> Series {
        Series::of(workbench, workbench.over().expect("over the angle"))
    }

    #[test]
    fn the_components_of_a_deviation_have_its_length() {
        let mut workbench = workbench();
        let mut of = |component: Component| {
            workbench.execute(Command::Component(component));
            series(&workbench).dots[5].before_mm
        };
        let length = of(Component::Length);
        let polar = [Component::Tangential, Component::Radial, Component::Axial].map(&mut of);
        let cartesian = [Component::X, Component::Y, Component::Z].map(&mut of);
        for e in [polar, cartesian] {
            let found = e.iter().map(|v| v * v).sum::<f64>().sqrt();
            assert!((found - length).abs() < 1e-12);
        }
    }

    #[test]
    fn a_zero_offset_of_minus_three_degrees_is_tangential_and_negative() {
        let workbench = workbench();
        let dots = series(&workbench).dots;
        let mean = dots.iter().map(|d| d.before_mm).sum::<f64>() / dots.len() as f64;
        let expected = -245.0 * 3.0_f64.to_radians().sin();
        assert!((mean - expected).abs() < 0.2, "{mean} {expected}");
    }

    #[test]
    fn what_is_left_is_there_once_it_is_identified() {
        let mut workbench = workbench();
        let left = |workbench: &Workbench| {
            let dots = series(workbench).dots;
            dots.iter().filter(|d| d.after_mm.is_some()).count()
        };
        assert_eq!(left(&workbench), 0);
        workbench.execute(Command::Edit(Edit::Identify));
        workbench.receive();
        assert_eq!(left(&workbench), workbench.subject().len());
    }
}
