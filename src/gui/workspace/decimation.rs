//! Many vectors, one to 14 points of the screen, so that each can be read: where egui draws them the
//! longest of each cell of a grid; where the graphics processor does, as many as there are cells, in the
//! order of the cloud, which is spread evenly.

use std::collections::BTreeMap;

use egui_plot::PlotTransform;

use crate::gui::core::scale::FEW;

use super::model::Shown;

/// One vector to so many points.
const ROOM: f64 = 14.0;

/// The side of a cell, mm.
pub(super) fn side_mm(transform: &PlotTransform) -> f64 {
    ROOM / transform.dpos_dvalue_x().abs()
}

/// The vectors that are drawn of many: in each cell the longest. `None`: they are few, and all are.
pub(super) fn longest_of_cells(shown: &Shown, transform: &PlotTransform) -> Option<Vec<usize>> {
    if shown.samples <= FEW {
        return None;
    }
    // Cells lie still while the plot is moved.
    let side_mm = side_mm(transform);
    let flat = |p: [f64; 3]| shown.look.facing.flat(p);
    let mut cells: BTreeMap<[i64; 2], (f64, usize)> = BTreeMap::new();
    for (k, one) in shown.each.iter().enumerate() {
        #[allow(clippy::cast_possible_truncation, reason = "a place on a grid")]
        let cell = flat(one.simulated_mm(one.vector_mm)).map(|v| (v / side_mm).floor() as i64);
        let [right, up] = flat(one.vector_mm);
        let length = right.hypot(up);
        let best = cells.entry(cell).or_insert((length, k));
        if length > best.0 {
            *best = (length, k);
        }
    }
    let mut kept: Vec<usize> = cells.into_values().map(|(_, k)| k).collect();
    kept.sort_unstable();
    Some(kept)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::core::simulate::Form;
    use crate::gui::testing::workbench;
    use crate::gui::view::Canvas;
    use crate::gui::workbench::{Command, ViewChange};
    use egui_plot::PlotBounds;

    fn transform(scale: f64) -> PlotTransform {
        let frame = egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(500.0, 400.0));
        let (x, y) = (300.0 * scale, 240.0 * scale);
        PlotTransform::new(frame, PlotBounds::from_min_max([-x, -y], [x, y]), false)
    }

    #[test]
    fn of_many_vectors_the_longest_of_every_cell_are_drawn_and_few_are_all_drawn() {
        let mut workbench = workbench();
        let few = Shown::of(&workbench);
        assert_eq!(longest_of_cells(&few, &transform(1.0)), None);
        workbench.execute(Command::Simulate(Form {
            step_deg: 0.05,
            ..Form::default()
        }));
        workbench.receive();
        let shown = Shown::of(&workbench);
        let kept = longest_of_cells(&shown, &transform(1.0)).expect("they are many");
        let closer = longest_of_cells(&shown, &transform(0.1)).expect("they are many");
        assert!((30..250).contains(&kept.len()), "{}", kept.len());
        assert!(closer.len() > 3 * kept.len(), "{}", closer.len());
        let length = |k: &usize| shown.each[*k].vector_mm[0].hypot(shown.each[*k].vector_mm[1]);
        let longest =
            |kept: &mut dyn Iterator<Item = usize>| kept.map(|k| length(&k)).fold(0.0, f64::max);
        let all = longest(&mut (0..shown.each.len()));
        assert_eq!(longest(&mut kept.iter().copied()), all);
        // What draws them all does the same in number.
        workbench.execute(Command::View(ViewChange::Canvas(Canvas::Layers(
            usize::MAX,
        ))));
        let shown = Shown::of(&workbench);
        let [points, vectors] = super::super::layout::counts(&shown, &transform(1.0));
        assert!(
            points > 2_000 && (30..250).contains(&vectors),
            "{points} {vectors}"
        );
    }
}
