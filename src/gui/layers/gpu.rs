//! The layers as egui calls them back: before a frame they upload what changed and one uniform, in it
//! they draw.
//!
//! In space what is near covers what is far, and the pass in which egui draws has no depth. So the
//! samples are drawn into a picture of their own, with a buffer of depths beside it, before that pass,
//! and in it the picture is copied; in a plane all are equally deep. It is drawn again only when samples, camera or colours change: while
//! the pointer moves over a million vectors a frame copies one picture.

use std::sync::Arc;

use egui::{PaintCallbackInfo, Rect, Shape};
use egui_wgpu::{Callback, CallbackResources, CallbackTrait, RenderState, ScreenDescriptor};
use wgpu::{Device, Queue};

use crate::gui::cache::cloud::{Cloud, Remainder};
use crate::gui::cache::heat::Heat;

use super::Frame;
use super::drawer::{Drawer, Drawn, Target};

/// What a renderer without a graphics processor draws at once: about a tenth of a second.
const MOST_IN_SOFTWARE: usize = 50_000;

/// Puts the pipelines beside egui's own, and says how many samples can be drawn at once.
pub(crate) fn register(state: &RenderState) -> usize {
    let drawer = Drawer::new(&state.device, state.target_format);
    let mut renderer = state.renderer.write();
    renderer.callback_resources.insert(drawer);
    if state.adapter.get_info().device_type == wgpu::DeviceType::Cpu {
        MOST_IN_SOFTWARE
    } else {
        usize::MAX
    }
}

/// Error vectors and measured points.
pub(crate) struct CloudLayer {
    pub(crate) cloud: Arc<Cloud>,
    /// What an answer leaves.
    pub(crate) remainder: Option<Arc<Remainder>>,
    /// Where they go.
    pub(crate) frame: Frame,
    /// So many of their points, and so many of their vectors.
    pub(crate) counts: [usize; 2],
    /// Whether the deviations before are drawn as well.
    pub(crate) ghosts: bool,
}

pub(crate) struct HeatLayer {
    pub(crate) heat: Arc<Heat>,
    /// Where it goes.
    pub(crate) frame: Frame,
}

/// A layer of a plot: what it uploads before a frame, and how it is drawn in it.
pub(crate) trait Layer: Sized + Send + Sync + 'static {
    fn prepare(&self, drawer: &mut Drawer, on: &mut PrepareContext<'_>);

    fn paint(&self, drawer: &Drawer, pass: &mut wgpu::RenderPass<'static>);

    /// The layer as a shape in this frame of a plot.
    fn shape(self, rect: Rect) -> Shape {
        Shape::Callback(Callback::new_paint_callback(rect, CalledBack(self)))
    }
}

/// What a layer prepares itself with.
pub(crate) struct PrepareContext<'a> {
    pub(super) device: &'a Device,
    pub(super) queue: &'a Queue,
    pub(super) encoder: &'a mut wgpu::CommandEncoder,
}

/// A layer as egui calls it back.
struct CalledBack<L>(L);

impl<L: Layer> CallbackTrait for CalledBack<L> {
    fn prepare(
        &self,
        device: &Device,
        queue: &Queue,
        _: &ScreenDescriptor,
        encoder: &mut wgpu::CommandEncoder,
        resources: &mut CallbackResources,
    ) -> Vec<wgpu::CommandBuffer> {
        if let Some(drawer) = resources.get_mut::<Drawer>() {
            let mut on = PrepareContext {
                device,
                queue,
                encoder,
            };
            self.0.prepare(drawer, &mut on);
        }
        Vec::new()
    }

    fn paint(
        &self,
        _: PaintCallbackInfo,
        pass: &mut wgpu::RenderPass<'static>,
        resources: &CallbackResources,
    ) {
        if let Some(drawer) = resources.get::<Drawer>() {
            self.0.paint(drawer, pass);
        }
    }
}

impl CloudLayer {
    /// Draws the points, the deviations before, and the error vectors.
    fn draw(&self, drawer: &Drawer, pass: &mut wgpu::RenderPass<'_>) {
        let by = &drawer.by_sample;
        pass.set_bind_group(0, &drawer.cloud_uniform.group, &[]);
        let [points, vectors] = self.counts;
        drawer.draw(pass, &by.marks, points);
        if self.ghosts {
            drawer.draw(pass, &by.ghosts, vectors);
        }
        drawer.draw(pass, &by.arrows, vectors);
    }
}

impl Layer for CloudLayer {
    fn prepare(&self, drawer: &mut Drawer, on: &mut PrepareContext<'_>) {
        drawer.upload_cloud(on.device, &self.cloud);
        drawer.upload_remainder(on.device, &self.cloud, self.remainder.as_ref());
        drawer
            .cloud_uniform
            .write(on.queue, &self.frame, drawer.linear);
        let most = on.device.limits().max_texture_dimension_2d;
        let size = self.frame.size(most);
        if drawer.target.as_ref().is_none_or(|t| t.size != size) {
            let target = Target::new(on.device, &drawer.cells_layout, size, drawer.format);
            drawer.target = Some(target);
            drawer.drawn = None;
        }
        let now = Drawn {
            frame: self.frame,
            counts: self.counts,
            ghosts: self.ghosts,
            uploads: drawer.uploads,
        };
        if drawer.drawn == Some(now) {
            return;
        }
        drawer.drawn = Some(now);
        if let Some(target) = &drawer.target {
            self.draw(drawer, &mut target.begin(on.encoder));
        }
    }

    fn paint(&self, drawer: &Drawer, pass: &mut wgpu::RenderPass<'static>) {
        if let Some(target) = &drawer.target {
            let (copy, uniform) = (&drawer.copy, &drawer.cloud_uniform);
            Drawer::draw_everywhere(pass, copy, uniform, &target.group);
        }
    }
}

impl Layer for HeatLayer {
    fn prepare(&self, drawer: &mut Drawer, on: &mut PrepareContext<'_>) {
        drawer.upload_heat(on.device, on.queue, &self.heat);
        drawer
            .heat_uniform
            .write(on.queue, &self.frame, drawer.linear);
    }

    fn paint(&self, drawer: &Drawer, pass: &mut wgpu::RenderPass<'static>) {
        if let Some((_, cells)) = &drawer.heat {
            Drawer::draw_everywhere(pass, &drawer.heat_map, &drawer.heat_uniform, cells);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use crate::gui::cache::cloud::{Cloud, Place};
    use crate::gui::layers::tests::{as_parts, can_draw, drawn, frame, look, transform};
    use crate::gui::layers::{Frame, LayerOptions, scale_at};
    use crate::gui::style::LIGHT;
    use crate::gui::view::Colouring;

    use super::*;

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
            layer.shape(frame())
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
