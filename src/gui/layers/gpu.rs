//! The layers as egui calls them back: before a frame they upload what changed and one uniform, in it
//! they draw.

use std::sync::Arc;

use egui::{PaintCallbackInfo, Rect, Shape};
use egui_wgpu::wgpu::{self, Device, Queue};
use egui_wgpu::{Callback, CallbackResources, CallbackTrait, RenderState, ScreenDescriptor};

use crate::gui::view::Canvas;

use super::drawer::Drawer;
use super::frame::Frame;
use super::pipelines::BySample;
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
    pub(super) fn draw(&self, drawer: &Drawer, by: &BySample, pass: &mut wgpu::RenderPass<'_>) {
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
    }

    fn paint(&self, drawer: &Drawer, pass: &mut wgpu::RenderPass<'static>) {
        self.draw(drawer, &drawer.flat, pass);
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
