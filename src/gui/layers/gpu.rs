//! The layers as egui calls them back: before a frame they upload what changed and one uniform, in it
//! they draw.
//!
//! In space what is near covers what is far, and the pass in which egui draws has no depth. So the
//! samples are drawn into a picture of their own, with a buffer of depths beside it, before that pass,
//! and in it the picture is copied; in a plane all are equally deep. It is drawn again only when samples, camera or colours change: while
//! the pointer moves over a million vectors a frame copies one picture.

use std::sync::{Arc, Weak};

use egui::{PaintCallbackInfo, Rect, Shape};
use egui_wgpu::{Callback, CallbackResources, CallbackTrait, RenderState, ScreenDescriptor};
use wgpu::util::{BufferInitDescriptor, DeviceExt as _};
use wgpu::{Buffer, BufferUsages, Device, Queue};

use crate::gui::core::loaded_session::{Cloud, Place, Remainder, RemainderRow};
use crate::gui::layers::{DEPTH, Frame, SAMPLE, columns, group, pipeline, pipeline_layout, shader};

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

impl CallbackTrait for CloudLayer {
    fn prepare(
        &self,
        device: &Device,
        queue: &Queue,
        _: &ScreenDescriptor,
        encoder: &mut wgpu::CommandEncoder,
        resources: &mut CallbackResources,
    ) -> Vec<wgpu::CommandBuffer> {
        if let Some(drawer) = resources.get_mut::<Drawer>() {
            self.upload_and_draw(drawer, device, queue, encoder);
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
        if let Some(target) = &drawer.target {
            pass.set_pipeline(&drawer.copy);
            pass.set_bind_group(0, &drawer.frame, &[]);
            pass.set_bind_group(1, &target.group, &[]);
            pass.draw(0..3, 0..1);
        }
    }
}

impl CloudLayer {
    /// The layer as a shape in this frame of a plot.
    pub(crate) fn shape(self, rect: Rect) -> Shape {
        Shape::Callback(Callback::new_paint_callback(rect, self))
    }

    fn upload_and_draw(
        &self,
        drawer: &mut Drawer,
        device: &Device,
        queue: &Queue,
        encoder: &mut wgpu::CommandEncoder,
    ) {
        drawer.upload_cloud(device, &self.cloud);
        drawer.upload_remainder(device, &self.cloud, self.remainder.as_ref());
        let mut rows = self.frame.rows;
        rows[3][3] = if drawer.format.is_srgb() { 1.0 } else { 0.0 };
        queue.write_buffer(&drawer.uniform, 0, bytemuck::cast_slice(&rows));
        let most = device.limits().max_texture_dimension_2d;
        let size = self.frame.size(most);
        if drawer.target.as_ref().is_none_or(|t| t.size != size) {
            let target = Target::new(device, &drawer.picture_layout, size, drawer.format);
            drawer.target = Some(target);
            drawer.drawn = None;
        }
        let now = (self.frame, self.counts, self.ghosts, drawer.uploads);
        if drawer.drawn == Some(now) {
            return;
        }
        drawer.drawn = Some(now);
        if let Some(target) = &drawer.target {
            self.draw(drawer, &mut target.begin(encoder));
        }
    }

    /// Draws the points, the deviations before, and the error vectors.
    fn draw(&self, drawer: &Drawer, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_bind_group(0, &drawer.frame, &[]);
        let [points, vectors] = self.counts;
        drawer.draw(pass, &drawer.marks, points);
        if self.ghosts {
            drawer.draw(pass, &drawer.ghosts, vectors);
        }
        drawer.draw(pass, &drawer.arrows, vectors);
    }
}

/// Samples in one buffer: far below the 256 MiB that every device offers.
const CHUNK: usize = 1 << 20;

/// Everything that stays from frame to frame.
pub(crate) struct Drawer {
    marks: wgpu::RenderPipeline,
    ghosts: wgpu::RenderPipeline,
    arrows: wgpu::RenderPipeline,
    copy: wgpu::RenderPipeline,
    format: wgpu::TextureFormat,
    target: Option<Target>,
    /// What the picture follows from that was drawn last: where it goes, how many points and vectors, whether those
    /// before, and how often was uploaded.
    drawn: Option<(Frame, [usize; 2], bool, u64)>,
    /// Of a picture that is read pixel by pixel.
    picture_layout: wgpu::BindGroupLayout,
    /// A frame as the shaders see it, and how they read it.
    uniform: Buffer,
    frame: wgpu::BindGroup,
    places: (Weak<Cloud>, Vec<Buffer>),
    /// Whose remainder, what remains, and where it is.
    remains: (Weak<Cloud>, Option<Weak<Remainder>>, Vec<Buffer>),
    /// How often samples or what remains of them were uploaded.
    uploads: u64,
}

impl Drawer {
    fn new(device: &Device, format: wgpu::TextureFormat) -> Self {
        let layout = |label, visibility, ty| {
            device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some(label),
                entries: &[wgpu::BindGroupLayoutEntry {
                    binding: 0,
                    visibility,
                    ty,
                    count: None,
                }],
            })
        };
        let frame_layout = layout(
            "frame",
            wgpu::ShaderStages::VERTEX_FRAGMENT,
            wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Uniform,
                has_dynamic_offset: false,
                min_binding_size: None,
            },
        );
        let picture_layout = layout(
            "picture of a layer",
            wgpu::ShaderStages::FRAGMENT,
            wgpu::BindingType::Texture {
                sample_type: wgpu::TextureSampleType::Float { filterable: false },
                view_dimension: wgpu::TextureViewDimension::D2,
                multisampled: false,
            },
        );
        let samples = pipeline_layout(device, &[Some(&frame_layout)]);
        let both = pipeline_layout(device, &[Some(&frame_layout), Some(&picture_layout)]);
        let arrows = shader(device, &[SAMPLE, include_str!("arrows.wgsl")]);
        let marks = shader(device, &[SAMPLE, include_str!("marks.wgsl")]);
        let copy = shader(device, &[include_str!("copy.wgsl")]);
        let of_samples =
            |module, vertex| pipeline(device, &samples, module, vertex, &columns(), format, true);
        let uniform = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("frame of a layer"),
            size: size_of::<Frame>() as u64,
            usage: BufferUsages::UNIFORM | BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self {
            marks: of_samples(&marks, "mark"),
            ghosts: of_samples(&arrows, "ghost"),
            arrows: of_samples(&arrows, "arrow"),
            copy: pipeline(device, &both, &copy, "everywhere", &[], format, false),
            format,
            target: None,
            drawn: None,
            uploads: 0,
            frame: group(device, &frame_layout, uniform.as_entire_binding()),
            uniform,
            picture_layout,
            places: (Weak::new(), Vec::new()),
            remains: (Weak::new(), None, Vec::new()),
        }
    }

    fn upload_cloud(&mut self, device: &Device, cloud: &Arc<Cloud>) {
        if !std::ptr::eq(self.places.0.as_ptr(), Arc::as_ptr(cloud)) {
            let chunks = cloud.places.chunks(CHUNK);
            let buffers = chunks.map(|chunk| vertices(device, bytemuck::cast_slice(chunk)));
            self.places = (Arc::downgrade(cloud), buffers.collect());
            self.uploads += 1;
        }
    }

    fn upload_remainder(
        &mut self,
        device: &Device,
        cloud: &Arc<Cloud>,
        remainder: Option<&Arc<Remainder>>,
    ) {
        let (of, there, _) = &self.remains;
        let same = match (there, remainder) {
            (None, None) => true,
            (Some(there), Some(remainder)) => std::ptr::eq(there.as_ptr(), Arc::as_ptr(remainder)),
            _ => false,
        };
        if same && std::ptr::eq(of.as_ptr(), Arc::as_ptr(cloud)) {
            return;
        }
        let buffers = if let Some(remainder) = remainder {
            let chunks = remainder.chunks(CHUNK);
            let buffer = |chunk| vertices(device, bytemuck::cast_slice(chunk));
            chunks.map(buffer).collect()
        } else {
            // Nothing is left of nothing: a new buffer holds zeros.
            let chunks = cloud.places.chunks(CHUNK);
            chunks.map(|chunk| zeros(device, chunk.len())).collect()
        };
        self.remains = (
            Arc::downgrade(cloud),
            remainder.map(Arc::downgrade),
            buffers,
        );
        self.uploads += 1;
    }

    /// Draws the first `count` samples with this pipeline.
    fn draw(&self, pass: &mut wgpu::RenderPass<'_>, pipeline: &wgpu::RenderPipeline, count: usize) {
        pass.set_pipeline(pipeline);
        let mut left = count;
        for (places, remains) in self.places.1.iter().zip(&self.remains.2) {
            let size = places.size() / size_of::<Place>() as u64;
            let now = left.min(usize::try_from(size).unwrap_or(usize::MAX));
            if now == 0 {
                return;
            }
            pass.set_vertex_buffer(0, places.slice(..));
            pass.set_vertex_buffer(1, remains.slice(..));
            pass.draw(0..6, 0..u32::try_from(now).unwrap_or(u32::MAX));
            left -= now;
        }
    }
}

fn vertices(device: &Device, contents: &[u8]) -> Buffer {
    device.create_buffer_init(&BufferInitDescriptor {
        label: Some("samples"),
        contents,
        usage: BufferUsages::VERTEX,
    })
}

fn zeros(device: &Device, rows: usize) -> Buffer {
    device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("nothing left"),
        size: (rows * size_of::<RemainderRow>()) as u64,
        usage: BufferUsages::VERTEX,
        mapped_at_creation: false,
    })
}

/// The picture, and how near each pixel of it is.
struct Target {
    size: [u32; 2],
    picture: wgpu::TextureView,
    depth: wgpu::TextureView,
    group: wgpu::BindGroup,
}

impl Target {
    fn new(
        device: &Device,
        layout: &wgpu::BindGroupLayout,
        size: [u32; 2],
        format: wgpu::TextureFormat,
    ) -> Self {
        let texture = |format, usage| {
            let texture = device.create_texture(&wgpu::TextureDescriptor {
                label: Some("samples"),
                size: wgpu::Extent3d {
                    width: size[0],
                    height: size[1],
                    depth_or_array_layers: 1,
                },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT | usage,
                view_formats: &[],
            });
            texture.create_view(&wgpu::TextureViewDescriptor::default())
        };
        let picture = texture(format, wgpu::TextureUsages::TEXTURE_BINDING);
        let read = wgpu::BindingResource::TextureView(&picture);
        let group = group(device, layout, read);
        Self {
            size,
            depth: texture(DEPTH, wgpu::TextureUsages::empty()),
            picture,
            group,
        }
    }

    /// A pass that begins with an empty picture.
    fn begin<'e>(&self, encoder: &'e mut wgpu::CommandEncoder) -> wgpu::RenderPass<'e> {
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("samples"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.picture,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                    store: wgpu::StoreOp::Store,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.depth,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Discard,
                }),
                stencil_ops: None,
            }),
            ..Default::default()
        })
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use crate::gui::core::loaded_session::{Cloud, Place};
    use crate::gui::layers::tests::{as_parts, can_draw, drawn, frame, look, transform};
    use crate::gui::layers::{Frame, LayerOptions};
    use crate::gui::style::LIGHT;

    use super::*;

    /// Half of the depth of what is drawn, mm.
    const HALF: f32 = 50.0;

    /// Two vectors along x at one place of the screen, so near to the viewer, mm.
    fn middle(nearness_mm: [f32; 2]) -> [f64; 3] {
        let place = |z: f32| -> Place { [3.0, 0.0, z, 3.0, 0.0, 0.0] };
        let remainder = Arc::new(vec![[3.0, 0.0, 0.0, 0.0]; 2]);
        let cloud = Arc::new(Cloud {
            places: nearness_mm.map(place).to_vec(),
            samples: vec![0, 1],
            ..Cloud::default()
        });
        let look = LayerOptions {
            deep_mm: Some(f64::from(HALF)),
            ..look(0.0)
        };
        let picture = drawn(2.0, LIGHT.surface, move |_| {
            let layer = CloudLayer {
                cloud: Arc::clone(&cloud),
                remainder: Some(Arc::clone(&remainder)),
                frame: Frame::new(&look, &LIGHT, &transform(), 2.0),
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
        let (near, far) = (10.0, -10.0);
        // What is farther is paler.
        let depth = 0.5 - 0.5 * near / HALF;
        let part = f64::from(0.6 * (2.0 * depth - 0.5));
        let [color, surface] = [LIGHT.after, LIGHT.surface].map(as_parts);
        for order in [[near, far], [far, near]] {
            let seen = middle(order);
            for k in 0..3 {
                let expected = color[k] + part * (surface[k] - color[k]);
                assert!(
                    (seen[k] - expected).abs() < 0.02,
                    "{order:?} {seen:?} {expected}"
                );
            }
        }
    }
}
