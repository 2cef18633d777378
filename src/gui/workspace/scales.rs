//! The legend of colours. What colour says is said a second time: a deviation by the vector's
//! length, a direction by its direction, a condition by its width.

use egui::{Align2, FontId, Rect, Role, Sense, Ui, WidgetInfo, pos2, vec2};

use crate::gui::cache::cloud::Cloud;
use crate::gui::layers::WEDGE;
use crate::gui::scene::{ColourToken, Item, Label, LegendEntry, Place, Stroke, Tint};
use crate::gui::style::{Palette, size};
use crate::gui::view::Colouring;
use crate::gui::widgets;
use crate::gui::workbench::Workbench;
use crate::present::numbers::{significant, trimmed};

use super::model::Shown;

/// Length of a scale, points; and in a low plot.
const LONG: f32 = 96.0;
const SHORT: f32 = 64.0;
/// Length of a row of directions, points.
const DIRECTIONS: f32 = 136.0;
/// Thickness of a scale that says nothing by it, points.
const THICK: f32 = 7.0;
/// How much thicker than the vectors a wedge is drawn.
const WEDGE_BY: f32 = 3.0;
/// Pieces of a scale.
const PIECES: u16 = 48;

/// A scale: what it is of, its ends in words, and what colour it has.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Scale {
    pub(crate) name: String,
    /// Its ends; none for directions.
    pub(crate) ends: Option<[String; 2]>,
    /// What its colour says.
    pub(crate) colouring: Colouring,
}

/// The scales that are in use.
fn scales(workbench: &Workbench, shown: &Shown) -> Vec<Scale> {
    let units = workbench.units();
    let colouring = shown.look.colouring;
    let heat = workbench.heat().is_some();
    let long = significant(units.length_value(shown.look.long_mm), 2);
    let lengths = |name: &str| Scale {
        name: format!("{name}, {}", units.length_name()),
        ends: Some(["0".to_owned(), format!("≥ {long}")]),
        colouring: Colouring::Deviation,
    };
    let mut scales = Vec::new();
    match colouring {
        Colouring::State => {}
        Colouring::Deviation => scales.push(lengths(say!("deviation"))),
        Colouring::Direction => scales.push(Scale {
            name: say!("direction").to_owned(),
            ends: None,
            colouring,
        }),
        Colouring::Uncertainty => {
            let most = workbench.uncertain().map_or(0.0, |u| u.most_mm);
            let most = significant(units.length_value(most), 2);
            scales.push(Scale {
                name: format!("{}, {}", colouring.name(), units.length_name()),
                ends: Some(["0".to_owned(), most]),
                colouring,
            });
        }
        Colouring::Load | Colouring::Temperature | Colouring::Time => {
            let unit = match colouring {
                Colouring::Load => "kg",
                Colouring::Temperature => "°C",
                _ => "s",
            };
            let conditions = Cloud::of(workbench.loaded_session()).conditions;
            let range = colouring.condition().and_then(|k| conditions[k]);
            scales.push(Scale {
                name: format!("{}, {unit}", colouring.name()),
                ends: range.map(|ends| ends.map(|end| trimmed(end, 2))),
                colouring,
            });
        }
    }
    if heat && colouring != Colouring::Deviation {
        scales.push(lengths(say!("heat map")));
    }
    scales
}

/// The scales as entries of a legend: from little to much, a wedge where the width of vectors says the
/// same; every direction in its colour.
pub(super) fn entries(
    ui: &Ui,
    workbench: &Workbench,
    shown: &Shown,
    low: bool,
) -> Vec<LegendEntry> {
    let long = if low { SHORT } else { LONG };
    let all = scales(workbench, shown).into_iter();
    all.map(|scale| colour_bar(ui, scale, long)).collect()
}

fn colour_bar(ui: &Ui, scale: Scale, long: f32) -> LegendEntry {
    let width = |text: &str| widgets::width_of(ui, text, FontId::proportional(size::SMALL));
    let Some([low, high]) = scale.ends else {
        return LegendEntry {
            name: scale.name,
            sign: arrows(),
            wide: DIRECTIONS,
        };
    };
    let before = width(&low) + 4.0;
    let wide = before + long + 4.0 + width(&high);
    let left = before - 0.5 * wide;
    let wedge = scale.colouring.by_width();
    let half = |part: f32| {
        let wide = WEDGE_BY * (WEDGE[0] + part * (WEDGE[1] - WEDGE[0]));
        0.5 * if wedge { wide } else { THICK }
    };
    let place = |x: f32, y: f32| Place::from([f64::from(x), f64::from(y), 0.0]);
    let corners = (0..=PIECES).flat_map(|k| {
        let part = f32::from(k) / f32::from(PIECES);
        let ink = Tint::from(ColourToken::Scale(scale.colouring, part));
        [1.0, -1.0].map(|up| (place(left + part * long, up * half(part)), ink))
    });
    let end = |x: f32, says: String| {
        Item::Label(Label {
            anchor: Align2::LEFT_CENTER,
            ..Label::new(place(x, 0.0), says, ColourToken::Muted)
        })
    };
    let sign = vec![
        end(-0.5 * wide, low),
        end(left + long + 4.0, high),
        Item::Net(corners.collect(), 2),
    ];
    LegendEntry {
        name: scale.name,
        sign,
        wide,
    }
}

/// From the right around over up.
fn arrows() -> Vec<Item> {
    const NUMBER: u8 = 8;
    let step = f64::from(DIRECTIONS) / f64::from(NUMBER);
    let arrow = |k: u8| {
        let part = f32::from(k) / f32::from(NUMBER);
        let (sin, cos) = (f64::from(part) * std::f64::consts::TAU).sin_cos();
        let middle = step * (f64::from(k) + 0.5) - 0.5 * f64::from(DIRECTIONS);
        let at = |way: f64| Place::from([middle + 6.5 * way * cos, 6.5 * way * sin, 0.0]);
        let stroke = Stroke::new(2.0, ColourToken::Scale(Colouring::Direction, part));
        Item::Vector([at(-1.0), at(1.0)], stroke)
    };
    (0..NUMBER).map(arrow).collect()
}

/// Height of a row, points.
pub(super) const HIGH: f32 = 18.0;

/// An entry of the legend: so much room for what is drawn, and its name behind it. Where the room
/// is.
pub(super) fn entry(ui: &mut Ui, room: f32, name: &str, palette: &Palette) -> Rect {
    let font = FontId::proportional(size::SMALL);
    let galley = ui
        .painter()
        .layout_no_wrap(name.to_owned(), font, palette.muted);
    let between = if name.is_empty() { 0.0 } else { 5.0 };
    let wide = room + between + galley.size().x;
    let (rect, response) = ui.allocate_exact_size(vec2(wide, HIGH), Sense::hover());
    let label = say!("legend: {name}", name);
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, label.clone()));
    let at = pos2(rect.right(), rect.center().y);
    let place = Align2::RIGHT_CENTER.anchor_size(at, galley.size());
    ui.painter().galley(place.min, galley, palette.muted);
    rect.with_max_x(rect.left() + room)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::layers::scale_at;
    use crate::gui::style::testing::{ColourVision, colour_distance, lightness};
    use crate::gui::style::{DARK, LIGHT, STOPS};
    use crate::gui::testing::workbench;

    #[test]
    fn every_colour_that_says_something_has_a_scale() {
        let mut workbench = workbench();
        let named = |workbench: &Workbench| {
            let shown = Shown::of(workbench);
            let names = scales(workbench, &shown).into_iter().map(|s| s.name);
            names.collect::<Vec<_>>()
        };
        assert!(named(&workbench).is_empty());
        workbench.execute(|bench| bench.view.colouring = Colouring::Deviation);
        assert_eq!(named(&workbench), ["deviation, mm"]);
        workbench.execute(|bench| bench.view.heat = true);
        workbench.receive();
        // The same scale for both.
        assert_eq!(named(&workbench), ["deviation, mm"]);
        workbench.execute(|bench| bench.view.colouring = Colouring::Direction);
        assert_eq!(named(&workbench), ["direction", "heat map, mm"]);
    }

    #[test]
    fn the_scale_of_the_heat_map_follows_from_before_to_after() {
        let mut workbench = workbench();
        workbench.execute(|bench| bench.identify(None));
        workbench.execute(|bench| bench.view.heat = true);
        workbench.receive();
        let mut end_mm = |blend: f32| {
            workbench.execute(|bench| bench.view.blend = blend);
            let scale = scales(&workbench, &Shown::of(&workbench)).pop();
            let [_, end] = scale.and_then(|s| s.ends).expect("the heat map's");
            end.trim_start_matches("≥ ")
                .parse::<f64>()
                .expect("a number")
        };
        let [before, between, after] = [0.0, 0.5, 1.0].map(&mut end_mm);
        assert!(before > 2.0 * after, "{before} {after}");
        assert!(
            before > between && between > after,
            "{before} {between} {after}"
        );
    }

    #[test]
    fn the_uncertainty_of_a_model_is_offered_once_there_is_one() {
        let mut workbench = workbench();
        workbench.execute(|bench| bench.view.colouring = Colouring::Uncertainty);
        workbench.receive();
        assert!(scales(&workbench, &Shown::of(&workbench)).is_empty());
        workbench.execute(|bench| bench.identify(None));
        workbench.receive();
        let shown = Shown::of(&workbench);
        let scale = scales(&workbench, &shown).pop().expect("a scale");
        assert_eq!(scale.name, "uncertainty (1σ), mm");
        let most = workbench.uncertain().expect("it is known").most_mm;
        let [low, high] = scale.ends.expect("its ends");
        assert_eq!([low, high], ["0".to_owned(), significant(most, 2)]);
        let drawn = workbench.remainder().expect("it is known");
        let parts: Vec<f32> = drawn.rows.iter().map(|row| row[4]).collect();
        assert_eq!(parts.len(), workbench.loaded_session().len());
        assert!(parts.iter().all(|p| (0.0..=1.0).contains(p)) && parts.contains(&1.0));
    }

    #[test]
    fn a_condition_that_was_not_recorded_is_not_offered() {
        let mut workbench = workbench();
        workbench.execute(|bench| bench.view.colouring = Colouring::Temperature);
        let shown = Shown::of(&workbench);
        assert_eq!(shown.look.colouring, Colouring::State);
        assert!(scales(&workbench, &shown).is_empty());
    }

    const THEMES: [(&str, Palette); 2] = [("light", LIGHT), ("dark", DARK)];

    #[test]
    fn a_sequential_scale_gets_steadily_darker_or_lighter_for_everybody() {
        for (theme, palette) in THEMES {
            for sight in ColourVision::ALL {
                let lightness: Vec<f64> = (0..=20_u8)
                    .map(|k| scale_at(Colouring::Deviation, &palette, f32::from(k) / 20.0))
                    .map(|color| lightness(color, sight))
                    .collect();
                let way = (lightness[20] - lightness[0]).signum();
                for pair in lightness.windows(2) {
                    let step = way * (pair[1] - pair[0]);
                    assert!(step > 0.4, "{theme}, {sight:?}: {lightness:?}");
                }
                let all = (lightness[20] - lightness[0]).abs();
                assert!(all > 35.0, "{theme}, {sight:?}: {all}");
            }
        }
    }

    #[test]
    fn neighbouring_steps_of_every_scale_can_be_told_apart_by_everybody() {
        // About 2.3 is just noticeable (Mahy et al. 1994).
        const NOTICEABLE: f64 = 4.6;
        for (theme, palette) in THEMES {
            for sight in ColourVision::ALL {
                for (colouring, around) in
                    [(Colouring::Deviation, false), (Colouring::Direction, true)]
                {
                    let steps = if around { STOPS } else { STOPS - 1 };
                    for k in 0..steps {
                        let at = |k: usize| {
                            let part = k as f32 / steps as f32;
                            scale_at(colouring, &palette, part)
                        };
                        let found = colour_distance(at(k), at(k + 1), sight);
                        assert!(
                            found > NOTICEABLE,
                            "{theme}, {sight:?}, {colouring:?} {k}: {found}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn opposite_directions_can_be_told_apart_by_everybody() {
        for (theme, palette) in THEMES {
            for sight in ColourVision::ALL {
                for k in 0..STOPS / 2 {
                    let at = |k: usize| {
                        let part = k as f32 / STOPS as f32;
                        scale_at(Colouring::Direction, &palette, part)
                    };
                    let found = colour_distance(at(k), at(k + STOPS / 2), sight);
                    assert!(found > 20.0, "{theme}, {sight:?}, {k}: {found}");
                }
            }
        }
    }

    #[test]
    fn a_circle_of_directions_closes() {
        for (_, palette) in THEMES {
            let at = |part: f32| scale_at(Colouring::Direction, &palette, part);
            assert_eq!(at(0.0), at(1.0));
        }
    }
}
