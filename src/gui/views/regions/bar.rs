//! The range as a strip: which part belongs to which region, and where the samples are.

use egui::{Align2, FontId, Rect, Role, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};

use crate::gui::core::by_angle::Count;
use crate::gui::style::tokens::{Palette, size, strong};
use crate::gui::widgets;
use crate::gui::workbench::Workbench;
use crate::numeric::single;
use crate::present::numbers::grouped;

const HEIGHT: f32 = 40.0;
const SAMPLES: f32 = 14.0;
/// Columns of samples.
const BINS: u16 = 68;

pub(super) fn show(ui: &mut Ui, workbench: &Workbench, counts: &[Count]) {
    let loaded_session = workbench.loaded_session();
    let (from, to) = loaded_session.travel();
    let regions = &workbench.document().regions;
    let ends = regions.iter().flat_map(|r| [r.from_rad, r.to_rad]);
    let (low, high) = ends.fold((from, to), |(a, b), end| (a.min(end), b.max(end)));
    if low >= high {
        return;
    }
    let palette = Palette::of(ui);
    let (rect, response) =
        ui.allocate_exact_size(vec2(ui.available_width(), HEIGHT + 16.0), Sense::hover());
    let band = Rect::from_min_size(rect.min, vec2(rect.width(), HEIGHT));
    let x = |rad: f64| band.left() + band.width() * single((rad - low) / (high - low));
    let painter = ui.painter_at(rect);
    painter.rect_filled(band, 4.0, palette.inset);
    for (k, region) in regions.iter().enumerate() {
        let part = Rect::from_x_y_ranges(x(region.from_rad)..=x(region.to_rad), band.y_range());
        painter.rect_filled(part, 0.0, palette.sectors[k % 2]);
        painter.rect_filled(
            Rect::from_min_size(part.min, vec2(part.width(), 2.0)),
            0.0,
            palette.accent,
        );
        let empty = counts.get(k).is_some_and(|c| c.fitted == 0);
        if part.width() > 14.0 {
            let color = if empty { palette.warning } else { palette.text };
            let at = pos2(part.center().x, band.top() + 13.0);
            let name = if empty {
                format!("{} –", region.name)
            } else {
                region.name.clone()
            };
            let font = strong(size::SMALL);
            let galley = widgets::cut(ui, &name, font, color, part.width() - 4.0);
            let place = Align2::CENTER_CENTER.anchor_size(at, galley.size());
            painter.galley(place.min, galley, color);
        }
    }
    let width = (high - low) / f64::from(BINS);
    let bins = (0..BINS).map(|bin| {
        let start = low + f64::from(bin) * width;
        // The last one has its end in it.
        let end = if bin + 1 == BINS {
            high + 1e-9
        } else {
            start + width
        };
        loaded_session.angles().between(start, end).all
    });
    let bins: Vec<usize> = bins.collect();
    let most = bins.iter().copied().max().unwrap_or(0).max(1);
    let column = band.width() / f32::from(BINS);
    for (bin, n) in bins.iter().enumerate().filter(|(_, n)| **n > 0) {
        let height = (SAMPLES * (*n as f32 / most as f32)).max(2.0);
        let left = band.left() + column * bin as f32;
        let bar = Rect::from_min_max(
            pos2(left + 0.5, band.bottom() - 1.0 - height),
            pos2(left + column - 0.5, band.bottom() - 1.0),
        );
        painter.rect_filled(bar, 0.0, palette.nominal);
    }
    for region in regions.iter() {
        for end in [region.from_rad, region.to_rad] {
            painter.vline(x(end), band.y_range(), Stroke::new(1.0, palette.accent));
        }
    }
    let units = workbench.units();
    let font = FontId::proportional(size::SMALL);
    let label = |at: f32, align: Align2, rad: f64| {
        let place = pos2(at, band.bottom() + 9.0);
        painter.text(place, align, units.angle(rad), font.clone(), palette.muted);
    };
    label(band.left(), Align2::LEFT_CENTER, low);
    label(band.right(), Align2::RIGHT_CENTER, high);
    let says = say!(
        "{regions} from {low} to {high}, and where the samples are",
        regions = say!(one "{count} region", "{count} regions", count = grouped(regions.len())),
        low = units.angle(low),
        high = units.angle(high)
    );
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, says.clone()));
    response.on_hover_ui_at_pointer(|ui| {
        let Some(pointer) = ui.ctx().pointer_hover_pos() else {
            return;
        };
        let at = low + f64::from((pointer.x - band.left()) / band.width()) * (high - low);
        let inside = regions
            .iter()
            .position(|r| (r.from_rad..=r.to_rad).contains(&at));
        ui.label(match inside {
            Some(k) => say!(
                "region {name}, {from} … {to}: {samples}",
                name = regions[k].name,
                from = units.angle(regions[k].from_rad),
                to = units.angle(regions[k].to_rad),
                samples =
                    say!(one "{count} sample", "{count} samples", count = grouped(counts[k].all))
            ),
            None => say!("in no region").to_owned(),
        });
    });
}
