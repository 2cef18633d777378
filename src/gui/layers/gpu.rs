//! The layers on the graphics processor: pipelines that are made once, buffers that are made when
//! samples or answers change, and one uniform for each frame.
//!
//! There is one workspace plot, and so one set of buffers. What is in them is known by the address
//! of what was uploaded, which a weak pointer keeps from being used again.

use std::sync::{Arc, Weak};

use egui::{PaintCallbackInfo, Rect, Shape};
use egui_wgpu::wgpu::util::{BufferInitDescriptor, DeviceExt as _};
use egui_wgpu::wgpu::{self, Buffer, BufferUsages, Device, Queue};
use egui_wgpu::{Callback, CallbackResources, CallbackTrait, RenderState, ScreenDescriptor};

use crate::gui::view::Canvas;

use super::cloud::{Cloud, Place, Remainder};
use super::frame::Frame;
use super::heat::Heat;

/// Samples in one buffer: far below the 256 MiB that every device offers.
const CHUNK: usize = 1 << 20;
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
    /// The samples.
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

/// The heat map.
pub(crate) struct HeatLayer {
    /// The map.
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

/// A frame as the shaders see it.
struct Uniform {
    buffer: Buffer,
    group: wgpu::BindGroup,
}

impl Uniform {
    fn new(device: &Device, layout: &wgpu::BindGroupLayout) -> Self {
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("frame of a layer"),
            size: size_of::<Frame>() as u64,
            usage: BufferUsages::UNIFORM | BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("frame of a layer"),
            layout,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: buffer.as_entire_binding(),
            }],
        });
        Self { buffer, group }
    }

    fn write(&self, queue: &Queue, frame: &Frame, linear: bool) {
        let mut rows = frame.rows;
        rows[3][3] = if linear { 1.0 } else { 0.0 };
        queue.write_buffer(&self.buffer, 0, bytemuck::cast_slice(&rows));
    }
}

/// Everything that stays from frame to frame.
struct Drawer {
    linear: bool,
    marks: wgpu::RenderPipeline,
    ghosts: wgpu::RenderPipeline,
    arrows: wgpu::RenderPipeline,
    heat_map: wgpu::RenderPipeline,
    cells_layout: wgpu::BindGroupLayout,
    cloud_uniform: Uniform,
    heat_uniform: Uniform,
    places: (Weak<Cloud>, Vec<Buffer>),
    /// Whose remainder, what remains, and where it is.
    remains: (Weak<Cloud>, Option<Weak<Remainder>>, Vec<Buffer>),
    heat: Option<(Weak<Heat>, wgpu::BindGroup)>,
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
        let uniform = layout(
            "frame",
            wgpu::ShaderStages::VERTEX_FRAGMENT,
            wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Uniform,
                has_dynamic_offset: false,
                min_binding_size: None,
            },
        );
        let cells_layout = layout(
            "cells of the heat map",
            wgpu::ShaderStages::FRAGMENT,
            wgpu::BindingType::Texture {
                sample_type: wgpu::TextureSampleType::Float { filterable: false },
                view_dimension: wgpu::TextureViewDimension::D2,
                multisampled: false,
            },
        );
        let samples = pipeline_layout(device, &[Some(&uniform)]);
        let map = pipeline_layout(device, &[Some(&uniform), Some(&cells_layout)]);
        let arrows = shader(device, &[SAMPLE, include_str!("arrows.wgsl")]);
        let marks = shader(device, &[SAMPLE, include_str!("marks.wgsl")]);
        let heat = shader(device, &[include_str!("heat.wgsl")]);
        Self {
            linear: format.is_srgb(),
            marks: pipeline(device, &samples, &marks, "mark", &columns(), format),
            ghosts: pipeline(device, &samples, &arrows, "ghost", &columns(), format),
            arrows: pipeline(device, &samples, &arrows, "arrow", &columns(), format),
            heat_map: pipeline(device, &map, &heat, "everywhere", &[], format),
            cloud_uniform: Uniform::new(device, &uniform),
            heat_uniform: Uniform::new(device, &uniform),
            cells_layout,
            places: (Weak::new(), Vec::new()),
            remains: (Weak::new(), None, Vec::new()),
            heat: None,
        }
    }

    fn upload_cloud(&mut self, device: &Device, cloud: &Arc<Cloud>) {
        if !std::ptr::eq(self.places.0.as_ptr(), Arc::as_ptr(cloud)) {
            let chunks = cloud.places.chunks(CHUNK);
            let buffers = chunks.map(|chunk| vertices(device, bytemuck::cast_slice(chunk)));
            self.places = (Arc::downgrade(cloud), buffers.collect());
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
            let chunks = remainder.rows.chunks(CHUNK);
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
    }

    fn upload_heat(&mut self, device: &Device, queue: &Queue, heat: &Arc<Heat>) {
        let there = self.heat.as_ref();
        if there.is_some_and(|(h, _)| std::ptr::eq(h.as_ptr(), Arc::as_ptr(heat))) {
            return;
        }
        let side = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
        let descriptor = wgpu::TextureDescriptor {
            label: Some("cells of the heat map"),
            size: wgpu::Extent3d {
                width: side(heat.size[0]),
                height: side(heat.size[1]),
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba32Float,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        };
        let texture = device.create_texture_with_data(
            queue,
            &descriptor,
            wgpu::util::TextureDataOrder::LayerMajor,
            bytemuck::cast_slice(&heat.cells),
        );
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("cells of the heat map"),
            layout: &self.cells_layout,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: wgpu::BindingResource::TextureView(&view),
            }],
        });
        self.heat = Some((Arc::downgrade(heat), group));
    }

    /// Draws the first `count` samples with this pipeline.
    fn draw(
        &self,
        pass: &mut wgpu::RenderPass<'static>,
        pipeline: &wgpu::RenderPipeline,
        count: usize,
    ) {
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
        size: (rows * size_of::<[f32; 4]>()) as u64,
        usage: BufferUsages::VERTEX,
        mapped_at_creation: false,
    })
}

/// What arrows and marks are both drawn from.
const SAMPLE: &str = include_str!("sample.wgsl");

fn shader(device: &Device, own: &[&str]) -> wgpu::ShaderModule {
    let source = include_str!("frame.wgsl").to_owned() + &own.concat();
    device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("layer"),
        source: wgpu::ShaderSource::Wgsl(source.into()),
    })
}

fn pipeline_layout(
    device: &Device,
    groups: &[Option<&wgpu::BindGroupLayout>],
) -> wgpu::PipelineLayout {
    device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("layer"),
        bind_group_layouts: groups,
        immediate_size: 0,
    })
}

/// A [`Place`] and a row of a [`Remainder`], one of each for each instance.
fn columns() -> [Option<wgpu::VertexBufferLayout<'static>>; 2] {
    const PLACE: [wgpu::VertexAttribute; 3] =
        wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x3];
    const REMAINS: [wgpu::VertexAttribute; 2] =
        wgpu::vertex_attr_array![3 => Float32x3, 4 => Float32];
    let layout = |stride: usize, attributes| wgpu::VertexBufferLayout {
        array_stride: stride as u64,
        step_mode: wgpu::VertexStepMode::Instance,
        attributes,
    };
    [
        Some(layout(size_of::<Place>(), &PLACE)),
        Some(layout(size_of::<[f32; 4]>(), &REMAINS)),
    ]
}

fn pipeline(
    device: &Device,
    layout: &wgpu::PipelineLayout,
    module: &wgpu::ShaderModule,
    vertex: &str,
    buffers: &[Option<wgpu::VertexBufferLayout<'_>>],
    format: wgpu::TextureFormat,
) -> wgpu::RenderPipeline {
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(vertex),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some(vertex),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers,
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some("covered"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(wgpu::ColorTargetState {
                format,
                blend: Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING),
                write_mask: wgpu::ColorWrites::ALL,
            })],
        }),
        multiview_mask: None,
        cache: None,
    })
}
