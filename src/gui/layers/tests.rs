//! The layers drawn by wgpu beside a reference that shares no code with the shaders: arrows by
//! counting points of a fine grid inside their outline, the heat map by the definition of its mean.
//!
//! They need an adapter; without one they say so and pass, except where CI promises one.

use std::sync::Arc;

use egui::{Color32, Rect, Vec2};
use egui_kittest::Harness;
use egui_kittest::wgpu::{WgpuTestRenderer, create_render_state, default_wgpu_setup};
use egui_plot::{PlotBounds, PlotTransform};
use egui_wgpu::RendererOptions;

use crate::gui::style::{DARK, LIGHT, Palette};
use crate::gui::view::Plane;

use super::gpu::{CloudLayer, Drawer};
use super::{Frame, HEAT, LayerOptions, WIDTH, heat_map, map_in_plot, scale_at};
use crate::gui::cache::heat::{Heat, SIGMA};
use crate::gui::core::loaded_session::{Cloud, Place, Remainder};

const SIZE: Vec2 = egui::vec2(240.0, 160.0);

pub(super) fn can_draw() -> bool {
    let instance = wgpu::Instance::default();
    let adapters = instance.enumerate_adapters(wgpu::Backends::all());
    let found = !pollster::block_on(adapters).is_empty();
    let in_ci = std::env::var("CI").is_ok_and(|ci| ci == "true");
    assert!(found || !in_ci, "CI has to have an adapter to draw with");
    if !found {
        eprintln!("skipped: no adapter to draw with");
    }
    found
}

/// A picture of what is drawn on a surface, red, green and blue from 0 to 1.
pub(super) struct Picture {
    width: usize,
    pixels: Vec<[f64; 3]>,
}

impl Picture {
    pub(super) fn at(&self, x: usize, y: usize) -> [f64; 3] {
        self.pixels[y * self.width + x]
    }
}

pub(super) fn drawn(
    pixels: f32,
    surface: Color32,
    shape: impl Fn(&egui::Context) -> egui::Shape + 'static,
) -> Picture {
    let state = create_render_state(default_wgpu_setup(), RendererOptions::PREDICTABLE);
    Drawer::register(&state);
    let mut harness = Harness::builder()
        .with_size(SIZE)
        .with_pixels_per_point(pixels)
        .renderer(WgpuTestRenderer::from_render_state(state))
        .build_ui(move |ui| {
            let all = ui.ctx().content_rect();
            let painter = ui.ctx().layer_painter(egui::LayerId::debug());
            painter.rect_filled(all, 0.0, surface);
            painter.add(shape(ui.ctx()));
        });
    harness.run_steps(2);
    let image = harness.render().expect("there is an adapter");
    let rgb = |p: &[u8]| [0, 1, 2].map(|k| f64::from(p[k]) / 255.0);
    Picture {
        width: image.width() as usize,
        pixels: image.as_raw().chunks(4).map(rgb).collect(),
    }
}

/// The frame of the plot: a part of the picture, so that clipping can be seen.
pub(super) fn frame() -> Rect {
    Rect::from_min_max(egui::pos2(20.0, 16.0), egui::pos2(220.0, 144.0))
}

/// Two points to the millimetre, the origin in the middle.
pub(super) fn transform() -> PlotTransform {
    let bounds = PlotBounds::from_min_max([-50.0, -32.0], [50.0, 32.0]);
    PlotTransform::new(frame(), bounds, false)
}

pub(super) fn look(blend: f32) -> LayerOptions {
    LayerOptions {
        facing: Plane::Xy.facing(),
        deep_mm: None,
        framed: false,
        centre_mm: [0.0; 3],
        blend,
        answered: true,
        magnification: 10.0,
        long_mm: 2.0,
        tolerance_mm: None,
        mark: 0.0,
    }
}

/// Arrows apart from each other: where they are measured, and the deviations before and after.
const ARROWS: [([f32; 2], [f32; 2], [f32; 2]); 5] = [
    ([-30.0, 10.0], [2.0, 0.0], [1.0, 0.4]),
    ([-5.0, -15.0], [-0.5, 1.5], [0.0, 1.9]),
    ([20.0, 12.0], [1.2, 1.2], [-1.0, 0.3]),
    ([12.0, -20.0], [0.1, -0.05], [0.7, -0.1]),
    // Reaches out of the plot.
    ([45.0, -5.0], [2.0, 0.5], [2.0, 0.5]),
];

fn cloud() -> (Arc<Cloud>, Arc<Remainder>) {
    let place = |(at, before, _): &([f32; 2], [f32; 2], [f32; 2])| -> Place {
        [at[0], at[1], 3.0, before[0], before[1], 0.2]
    };
    let row = |(_, _, after): &([f32; 2], [f32; 2], [f32; 2])| [after[0], after[1], 0.1, 0.0];
    let cloud = Cloud {
        places: ARROWS.iter().map(place).collect(),
        samples: (0..5).collect(),
        ..Cloud::default()
    };
    let remainder: Remainder = ARROWS.iter().map(row).collect();
    (Arc::new(cloud), Arc::new(remainder))
}

/// How much of every pixel an arrow covers, by 8 × 8 points of it.
fn coverage(tail: [f64; 2], tip: [f64; 2], width: f64, point: f64, x: usize, y: usize) -> f64 {
    const FINE: usize = 8;
    let along = [tip[0] - tail[0], tip[1] - tail[1]];
    let length = along[0].hypot(along[1]);
    let unit = [along[0] / length, along[1] / length];
    let head = (0.35 * length).clamp(point, 6.0 * point + width);
    let inside = |px: f64, py: f64| {
        let d = [px - tail[0], py - tail[1]];
        let u = d[0] * unit[0] + d[1] * unit[1];
        let v = (d[1] * unit[0] - d[0] * unit[1]).abs();
        let shaft = (0.0..=length - head).contains(&u) && v <= 0.5 * width;
        let tip = (length - head..=length).contains(&u) && v <= 0.5 * (length - u);
        shaft || tip
    };
    let mut hits = 0;
    for k in 0..FINE * FINE {
        let part = |k: usize| (k as f64 + 0.5) / FINE as f64;
        let hit = inside(x as f64 + part(k % FINE), y as f64 + part(k / FINE));
        hits += usize::from(hit);
    }
    f64::from(u32::try_from(hits).expect("at most 64")) / (FINE * FINE) as f64
}

pub(super) fn as_parts(color: Color32) -> [f64; 3] {
    [color.r(), color.g(), color.b()].map(|c| f64::from(c) / 255.0)
}

/// The arrows that a reference draws, and the largest and the mean difference from the picture.
fn compare_arrows(pixels: f32, palette: Palette, blend: f32) {
    let (cloud, remainder) = cloud();
    let look = look(blend);
    let picture = drawn(pixels, palette.surface, move |_| {
        let layer = CloudLayer {
            cloud: Arc::clone(&cloud),
            remainder: Some(Arc::clone(&remainder)),
            frame: Frame::new(&look, &palette, &transform(), pixels),
            counts: [ARROWS.len(); 2],
            only: None,
            ghosts: false,
        };
        layer.shape(frame())
    });
    let point = f64::from(pixels);
    let surface = as_parts(palette.surface);
    let (mut area, mut drawn_area) = (0.0, 0.0);
    let (mut worst, mut sum) = (0.0_f64, 0.0);
    for (at, before, after) in ARROWS {
        let e: [f64; 2] = std::array::from_fn(|k| {
            f64::from(before[k]) + f64::from(blend) * f64::from(after[k] - before[k])
        });
        let screen = |x: f64, y: f64| [point * (120.0 + 2.0 * x), point * (80.0 - 2.0 * y)];
        let from = [f64::from(at[0]) - e[0], f64::from(at[1]) - e[1]];
        let tail = screen(from[0], from[1]);
        let tip = screen(from[0] + 10.0 * e[0], from[1] + 10.0 * e[1]);
        let color = as_parts(palette.after);
        let width = point * f64::from(WIDTH);
        let around = |a: f64, b: f64| {
            let low = crate::numeric::whole(a.min(b) - 6.0 * point);
            low..crate::numeric::whole(a.max(b) + 6.0 * point)
        };
        for y in around(tail[1], tip[1]) {
            for x in around(tail[0], tip[0]) {
                let clipped = x as f64 + 0.5 > 220.0 * point;
                if x >= picture.width || clipped {
                    let outside = x >= picture.width || picture.at(x, y) == surface;
                    assert!(outside, "drawn outside of the plot at {x}, {y}");
                    continue;
                }
                let covered = coverage(tail, tip, width, point, x, y);
                let found = picture.at(x, y);
                for k in 0..3 {
                    let wanted = surface[k] + covered * (color[k] - surface[k]);
                    let off = (found[k] - wanted).abs();
                    worst = worst.max(off);
                    sum += off;
                }
                area += covered;
                let contrast: f64 = (0..3).map(|k| (color[k] - surface[k]).powi(2)).sum();
                let along: f64 = (0..3)
                    .map(|k| (found[k] - surface[k]) * (color[k] - surface[k]))
                    .sum();
                drawn_area += along / contrast;
            }
        }
    }
    let says = format!("{pixels} px: {drawn_area:.1} of {area:.1} px, {worst:.3}");
    assert!(
        area > 100.0 && (drawn_area / area - 1.0).abs() < 0.04,
        "{says}"
    );
    assert!(
        worst < 0.35 && sum / area < 0.25,
        "{says}, {:.3}",
        sum / area
    );
}

#[test]
fn arrows_cover_what_their_outline_covers() {
    if !can_draw() {
        return;
    }
    compare_arrows(1.0, LIGHT, 0.0);
    compare_arrows(1.0, DARK, 1.0);
    compare_arrows(2.0, LIGHT, 0.5);
    compare_arrows(1.5, DARK, 0.25);
}

/// How much of a pixel is covered, by 8 × 8 points of it from the middle of a mark.
fn covered(inside: impl Fn(f64, f64) -> bool, x: f64, y: f64) -> f64 {
    let part = |k: u8| (f64::from(k) + 0.5) / 8.0;
    let points = (0..64_u8).filter(|k| inside(x + part(k % 8), y + part(k / 8)));
    points.count() as f64 / 64.0
}

/// The marks that a reference draws: a disc within the tolerance, an open diamond outside.
fn compare_marks(pixels: f32, palette: Palette) {
    const SIZE: f32 = 3.0;
    const TOLERANCE_MM: f64 = 1.5;
    let (cloud, remainder) = cloud();
    let look = LayerOptions {
        magnification: 0.0,
        tolerance_mm: Some(TOLERANCE_MM),
        mark: SIZE,
        ..look(0.0)
    };
    let picture = drawn(pixels, palette.surface, move |_| {
        let layer = CloudLayer {
            cloud: Arc::clone(&cloud),
            remainder: Some(Arc::clone(&remainder)),
            frame: Frame::new(&look, &palette, &transform(), pixels),
            counts: [ARROWS.len(), 0],
            only: None,
            ghosts: false,
        };
        layer.shape(frame())
    });
    let point = f64::from(pixels);
    let size = point * f64::from(SIZE);
    let surface = as_parts(palette.surface);
    let mut kinds = [0, 0];
    // The last sticks out of the plot.
    for (at, before, _) in &ARROWS[..4] {
        let e = before.map(f64::from);
        let length = (e[0] * e[0] + e[1] * e[1] + 0.2 * 0.2).sqrt();
        let within = length <= TOLERANCE_MM;
        kinds[usize::from(within)] += 1;
        let (said, edge, half) = if within {
            (palette.within, palette.within, 0.0)
        } else {
            (palette.surface, palette.outside, 0.7 * point)
        };
        let [fill, edge] = [said, edge].map(as_parts);
        let beyond = |x: f64, y: f64| {
            if within {
                x.hypot(y) - 2.8 * size
            } else {
                (x.abs() + y.abs() - 4.2 * size) / 2.0_f64.sqrt()
            }
        };
        let middle = [
            point * (120.0 + 2.0 * f64::from(at[0])),
            point * (80.0 - 2.0 * f64::from(at[1])),
        ];
        let first = middle.map(|m| crate::numeric::whole(m - 6.0 * size));
        let number = crate::numeric::whole(12.0 * size);
        for (i, k) in (0..number).flat_map(|k| (0..number).map(move |i| (i, k))) {
            let pixel = [first[0] + i, first[1] + k];
            let [x, y] = [0, 1].map(|k| pixel[k] as f64 - middle[k]);
            let filled = covered(|x, y| beyond(x, y) <= 0.0, x, y);
            let stroked = covered(|x, y| beyond(x, y).abs() <= half, x, y);
            let found = picture.at(pixel[0], pixel[1]);
            for k in 0..3 {
                let beneath = surface[k] + filled * (fill[k] - surface[k]);
                let wanted = beneath + stroked * (edge[k] - beneath);
                let off = (found[k] - wanted).abs();
                let says = format!("{at:?} {x} {y}: {} {wanted}", found[k]);
                assert!(off < 0.25, "{says}");
                // Away from every edge the colour is exact.
                if beyond(x + 0.5, y + 0.5).abs() > half + 1.5 {
                    assert!(off < 0.01, "{says}");
                }
            }
        }
    }
    assert_eq!(kinds.map(|n| n > 0), [true, true], "{kinds:?}");
}

#[test]
fn the_shape_of_marks_says_whether_they_are_within() {
    if !can_draw() {
        return;
    }
    compare_marks(1.0, LIGHT);
    compare_marks(2.0, DARK);
    compare_marks(1.5, LIGHT);
}

#[test]
fn the_heat_map_has_the_colour_of_the_error_at_every_sample() {
    if !can_draw() {
        return;
    }
    let workbench = crate::gui::testing::workbench();
    let loaded_session = Arc::clone(workbench.loaded_session());
    let heat = Arc::new(Heat::of(&loaded_session, None, Plane::Xy).expect("there are samples"));
    let side = 1.1 * loaded_session.arm_mm;
    let bounds = PlotBounds::from_min_max([-1.5625 * side, -side], [1.5625 * side, side]);
    let transform = PlotTransform::new(frame(), bounds, false);
    let look = LayerOptions {
        centre_mm: loaded_session.cloud().centre_mm,
        long_mm: 20.0,
        ..look(0.0)
    };
    for palette in [LIGHT, DARK] {
        let map = Arc::clone(&heat);
        let kept = std::cell::RefCell::<Vec<egui::TextureHandle>>::default();
        let picture = drawn(2.0, palette.surface, move |ctx| {
            let image = heat_map(&map, &look, &palette);
            let picture = ctx.load_texture("map", image, egui::TextureOptions::LINEAR);
            let shape = map_in_plot(&map, picture.id(), &transform);
            kept.borrow_mut().push(picture);
            shape
        });
        let sigma_mm = SIGMA * heat.cell_mm;
        for sample in (0..loaded_session.len()).step_by(7) {
            let at = loaded_session.measured(sample);
            // The definition, over the samples themselves.
            let (mut weights, mut squares) = (0.0, 0.0);
            for other in 0..loaded_session.len() {
                let there = loaded_session.measured(other);
                let r2 = (there[0] - at[0]).powi(2) + (there[1] - at[1]).powi(2);
                let w = (-0.5 * r2 / sigma_mm.powi(2)).exp();
                weights += w;
                squares += w * loaded_session.before.length_mm[other].powi(2);
            }
            #[allow(clippy::cast_possible_truncation, reason = "a part of a scale")]
            let part = ((squares / weights).sqrt() / 20.0) as f32;
            let color = as_parts(scale_at(&palette, part));
            let surface = as_parts(palette.surface);
            let screen = transform.position_from_point(&egui_plot::PlotPoint::new(at[0], at[1]));
            let pixel = |v: f32| crate::numeric::whole(f64::from(2.0 * v));
            let found = picture.at(pixel(screen.x), pixel(screen.y));
            for k in 0..3 {
                let opacity = f64::from(HEAT) * (1.0 - (-2.5_f64).exp());
                let wanted = surface[k] + opacity * (color[k] - surface[k]);
                let off = (found[k] - wanted).abs();
                assert!(off < 0.06, "sample {sample}: {found:?}, {wanted} of {k}");
            }
        }
        // Nothing far from the samples: on the axis, and outside of the plot.
        assert_eq!(picture.at(240, 160), as_parts(palette.surface));
        assert_eq!(picture.at(20, 160), as_parts(palette.surface));
    }
}

#[test]
fn a_cloud_that_has_changed_is_uploaded_again() {
    if !can_draw() {
        return;
    }
    let (first, remainder) = cloud();
    let second = Arc::new(Cloud {
        places: vec![[0.0, 0.0, 0.0, 3.0, 0.0, 0.0]],
        samples: vec![0],
        ..Cloud::default()
    });
    let shown = std::cell::Cell::new(0);
    let picture = drawn(1.0, LIGHT.surface, move |_| {
        let now = if shown.replace(shown.get() + 1) == 0 {
            (&first, Some(Arc::clone(&remainder)))
        } else {
            (&second, None)
        };
        let layer = CloudLayer {
            cloud: Arc::clone(now.0),
            remainder: now.1,
            frame: Frame::new(&look(0.0), &LIGHT, &transform(), 1.0),
            counts: [now.0.samples.len(); 2],
            only: None,
            ghosts: false,
        };
        layer.shape(frame())
    });
    // From −3 mm, six points left of the middle, sixty points to the right.
    // The line, 1.6 points wide, covers 0.8 of the pixels on both sides of it.
    let (line, surface) = (as_parts(LIGHT.after), as_parts(LIGHT.surface));
    for k in 0..3 {
        let wanted = surface[k] + 0.8 * (line[k] - surface[k]);
        assert!((picture.at(150, 79)[k] - wanted).abs() < 0.01);
    }
    // The first of the old arrows is gone.
    assert_eq!(picture.at(60, 60), as_parts(LIGHT.surface));
}
