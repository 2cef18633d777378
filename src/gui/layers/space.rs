//! Samples in three dimensions: what is near covers what is far.
//!
//! The pass in which egui draws has no depth. So the samples are drawn into a picture of their own,
//! with a buffer of depths beside it, before that pass, and in it the picture is copied. It is drawn
//! again only when samples, camera or colours change: while the pointer moves over a million vectors
//! a frame copies one picture.

use egui_wgpu::wgpu;

use super::drawer::Drawer;
use super::gpu::{CloudLayer, Layer, PrepareContext};
use super::target::{Drawn, Target};

/// Error vectors and measured points by their depth.
pub(crate) struct SpaceLayer(pub(crate) CloudLayer);

impl Layer for SpaceLayer {
    fn prepare(&self, drawer: &mut Drawer, on: &mut PrepareContext<'_>) {
        let layer = &self.0;
        layer.prepare(drawer, on);
        let most = on.device.limits().max_texture_dimension_2d;
        let size = layer.frame.size(most);
        if drawer.space.target.as_ref().is_none_or(|t| t.size != size) {
            let format = drawer.space.format;
            let target = Target::new(on.device, &drawer.cells_layout, size, format);
            drawer.space.target = Some(target);
            drawer.space.drawn = None;
        }
        let now = Drawn {
            frame: layer.frame,
            counts: layer.counts,
            ghosts: layer.ghosts,
            uploads: drawer.uploads,
        };
        if drawer.space.drawn == Some(now) {
            return;
        }
        drawer.space.drawn = Some(now);
        if let Some(target) = &drawer.space.target {
            let mut pass = target.begin(on.encoder);
            layer.draw(drawer, &drawer.space.by_sample, &mut pass);
        }
    }

    fn paint(&self, drawer: &Drawer, pass: &mut wgpu::RenderPass<'static>) {
        if let Some(target) = &drawer.space.target {
            let (copy, uniform) = (&drawer.space.copy, &drawer.cloud_uniform);
            Drawer::draw_everywhere(pass, copy, uniform, &target.group);
        }
    }
}

#[cfg(all(test, feature = "window-tests"))]
mod tests {
    use std::sync::Arc;

    use super::super::frame::{Frame, LayerOptions, scale_at};
    use super::super::tests::{as_parts, can_draw, drawn, frame, look, transform};
    use super::*;
    use crate::gui::cache::cloud::{Cloud, Place};
    use crate::gui::style::tokens::LIGHT;
    use crate::gui::view::Colouring;

    /// Two vectors along x at one place of the screen: where each is along the line of sight, mm, and
    /// its load, which is its colour.
    fn middle(rows: [(f32, f32); 2], deep_mm: Option<f64>) -> [f64; 3] {
        let place =
            |(z, load): (f32, f32)| -> Place { [3.0, 0.0, z, 3.0, 0.0, 0.0, load, -1.0, -1.0] };
        let cloud = Arc::new(Cloud {
            places: rows.map(place).to_vec(),
            samples: vec![0, 1],
            ..Cloud::default()
        });
        let look = LayerOptions {
            deep_mm,
            ..look(Colouring::Load, 0.0)
        };
        let picture = drawn(2.0, LIGHT.surface, move || {
            let layer = CloudLayer {
                cloud: Arc::clone(&cloud),
                remainder: None,
                frame: Frame::new(&look, &LIGHT, &transform(), None, 2.0),
                counts: [2; 2],
                ghosts: false,
            };
            SpaceLayer(layer).shape(frame())
        });
        // 10 of the 30 mm along the vectors, which begin in the middle of 240 × 160 points.
        picture.at(2 * (120 + 20), 2 * 80)
    }

    #[test]
    fn what_is_near_covers_what_is_far_in_any_order() {
        if !can_draw() {
            return;
        }
        let color = |load: f32| as_parts(scale_at(Colouring::Load, &LIGHT, load));
        let like = |seen: [f64; 3], load: f32| {
            let expected = color(load);
            assert!(
                (0..3).all(|k| (seen[k] - expected[k]).abs() < 0.02),
                "{seen:?} {expected:?}"
            );
        };
        let (near, far) = ((10.0, 0.9), (-10.0, 0.2));
        like(middle([near, far], Some(50.0)), 0.9);
        like(middle([far, near], Some(50.0)), 0.9);
        // Without depth the last one covers the others.
        like(middle([near, far], None), 0.2);
    }
}
