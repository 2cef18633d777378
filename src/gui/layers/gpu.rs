//! The layers as egui calls them back: before a frame they upload what changed and one uniform, in it
//! they draw.

use std::sync::Arc;

use egui::{PaintCallbackInfo, Rect, Shape};
use egui_wgpu::wgpu::{self, Device, Queue};
use egui_wgpu::{Callback, CallbackResources, CallbackTrait, RenderState, ScreenDescriptor};

use crate::gui::view::Canvas;

use super::drawer::Drawer;
use super::frame::Frame;
use crate::gui::cache::cloud::{Cloud, Remainder};
use crate::gui::cache::heat::Heat;

/// What a renderer without a graphics processor draws at once: about a tenth of a second.
const MOST_IN_SOFTWARE: usize = 50_000;

/// Puts the pipelines beside egui's own, and says what can be drawn with them.
pub(crate) fn register(state: &RenderState) -> Canvas {
    let drawer = Drawer::new(&state.device, state.target_format);
    let mut renderer = state.renderer.write();
    renderer.callback_resources.insert(drawer);
    if state.adapter.get_info().device_type == wgpu::DeviceType::Cpu {
        Canvas::Layers(MOST_IN_SOFTWARE)
    } else {
        Canvas::Layers(usize::MAX)
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

impl CloudLayer {
    /// The layer as a shape in this frame of a plot.
    pub(crate) fn shape(self, rect: Rect) -> Shape {
        Shape::Callback(Callback::new_paint_callback(rect, self))
    }
}

pub(crate) struct HeatLayer {
    pub(crate) heat: Arc<Heat>,
    /// Where it goes.
    pub(crate) frame: Frame,
}

impl HeatLayer {
    /// The layer as a shape in this frame of a plot.
    pub(crate) fn shape(self, rect: Rect) -> Shape {
        Shape::Callback(Callback::new_paint_callback(rect, self))
    }
}

impl CallbackTrait for CloudLayer {
    fn prepare(
        &self,
        device: &Device,
        queue: &Queue,
        _: &ScreenDescriptor,
        _: &mut wgpu::CommandEncoder,
        resources: &mut CallbackResources,
    ) -> Vec<wgpu::CommandBuffer> {
        if let Some(drawer) = resources.get_mut::<Drawer>() {
            drawer.upload_cloud(device, &self.cloud);
            drawer.upload_remainder(device, &self.cloud, self.remainder.as_ref());
            drawer
                .cloud_uniform
                .write(queue, &self.frame, drawer.linear);
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
            pass.set_bind_group(0, &drawer.cloud_uniform.group, &[]);
            let [points, vectors] = self.counts;
            drawer.draw(pass, &drawer.marks, points);
            if self.ghosts {
                drawer.draw(pass, &drawer.ghosts, vectors);
            }
            drawer.draw(pass, &drawer.arrows, vectors);
        }
    }
}

impl CallbackTrait for HeatLayer {
    fn prepare(
        &self,
        device: &Device,
        queue: &Queue,
        _: &ScreenDescriptor,
        _: &mut wgpu::CommandEncoder,
        resources: &mut CallbackResources,
    ) -> Vec<wgpu::CommandBuffer> {
        if let Some(drawer) = resources.get_mut::<Drawer>() {
            drawer.upload_heat(device, queue, &self.heat);
            drawer.heat_uniform.write(queue, &self.frame, drawer.linear);
        }
        Vec::new()
    }

    fn paint(
        &self,
        _: PaintCallbackInfo,
        pass: &mut wgpu::RenderPass<'static>,
        resources: &CallbackResources,
    ) {
        let Some(drawer) = resources.get::<Drawer>() else {
            return;
        };
        if let Some((_, cells)) = &drawer.heat {
            pass.set_pipeline(&drawer.heat_map);
            pass.set_bind_group(0, &drawer.heat_uniform.group, &[]);
            pass.set_bind_group(1, cells, &[]);
            pass.draw(0..3, 0..1);
        }
    }
}
