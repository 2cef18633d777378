//! What stays on the graphics processor from frame to frame: pipelines, buffers that are made when
//! samples or answers change, and the picture that samples are drawn into.
//!
//! There is one workspace plot, and so one set of buffers. What is in them is known by the address of
//! what was uploaded, which a weak pointer keeps from being used again.

use std::sync::{Arc, Weak};

use wgpu::util::{BufferInitDescriptor, DeviceExt as _};
use wgpu::{Buffer, BufferUsages, Device, Queue};

use crate::gui::cache::cloud::{Cloud, Place, Remainder, RemainderRow};
use crate::gui::cache::heat::Heat;

use super::Frame;
use super::{BySample, DEPTH, SAMPLE, columns, group, pipeline, pipeline_layout, shader};

/// Samples in one buffer: far below the 256 MiB that every device offers.
const CHUNK: usize = 1 << 20;

/// A frame as the shaders see it.
pub(super) struct Uniform {
    buffer: Buffer,
    pub(super) group: wgpu::BindGroup,
}

impl Uniform {
    pub(super) fn new(device: &Device, layout: &wgpu::BindGroupLayout) -> Self {
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("frame of a layer"),
            size: size_of::<Frame>() as u64,
            usage: BufferUsages::UNIFORM | BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let group = group(device, layout, buffer.as_entire_binding());
        Self { buffer, group }
    }

    pub(super) fn write(&self, queue: &Queue, frame: &Frame, linear: bool) {
        let mut rows = frame.rows;
        rows[3][3] = if linear { 1.0 } else { 0.0 };
        queue.write_buffer(&self.buffer, 0, bytemuck::cast_slice(&rows));
    }
}

/// Everything that stays from frame to frame.
pub(crate) struct Drawer {
    pub(super) linear: bool,
    pub(super) by_sample: BySample,
    pub(super) copy: wgpu::RenderPipeline,
    pub(super) format: wgpu::TextureFormat,
    pub(super) target: Option<Target>,
    /// What was drawn last.
    pub(super) drawn: Option<Drawn>,
    pub(super) heat_map: wgpu::RenderPipeline,
    /// Of a texture that is read cell by cell.
    pub(super) cells_layout: wgpu::BindGroupLayout,
    pub(super) cloud_uniform: Uniform,
    pub(super) heat_uniform: Uniform,
    places: (Weak<Cloud>, Vec<Buffer>),
    /// Whose remainder, what remains, and where it is.
    remains: (Weak<Cloud>, Option<Weak<Remainder>>, Vec<Buffer>),
    pub(super) heat: Option<(Weak<Heat>, wgpu::BindGroup)>,
    /// How often samples or what remains of them were uploaded.
    pub(super) uploads: u64,
}

impl Drawer {
    pub(super) fn new(device: &Device, format: wgpu::TextureFormat) -> Self {
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
        let copy = shader(device, &[include_str!("copy.wgsl")]);
        let of_samples =
            |module, vertex| pipeline(device, &samples, module, vertex, &columns(), format, true);
        Self {
            linear: format.is_srgb(),
            by_sample: BySample {
                marks: of_samples(&marks, "mark"),
                ghosts: of_samples(&arrows, "ghost"),
                arrows: of_samples(&arrows, "arrow"),
            },
            copy: pipeline(device, &map, &copy, "everywhere", &[], format, false),
            format,
            target: None,
            drawn: None,
            heat_map: pipeline(device, &map, &heat, "everywhere", &[], format, false),
            uploads: 0,
            cloud_uniform: Uniform::new(device, &uniform),
            heat_uniform: Uniform::new(device, &uniform),
            cells_layout,
            places: (Weak::new(), Vec::new()),
            remains: (Weak::new(), None, Vec::new()),
            heat: None,
        }
    }

    pub(super) fn upload_cloud(&mut self, device: &Device, cloud: &Arc<Cloud>) {
        if !std::ptr::eq(self.places.0.as_ptr(), Arc::as_ptr(cloud)) {
            let chunks = cloud.places.chunks(CHUNK);
            let buffers = chunks.map(|chunk| vertices(device, bytemuck::cast_slice(chunk)));
            self.places = (Arc::downgrade(cloud), buffers.collect());
            self.uploads += 1;
        }
    }

    pub(super) fn upload_remainder(
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
        self.uploads += 1;
    }

    pub(super) fn upload_heat(&mut self, device: &Device, queue: &Queue, heat: &Arc<Heat>) {
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
        let cells = wgpu::BindingResource::TextureView(&view);
        let group = group(device, &self.cells_layout, cells);
        self.heat = Some((Arc::downgrade(heat), group));
    }

    /// Draws cells of a texture all over a plot.
    pub(super) fn draw_everywhere(
        pass: &mut wgpu::RenderPass<'_>,
        pipeline: &wgpu::RenderPipeline,
        uniform: &Uniform,
        cells: &wgpu::BindGroup,
    ) {
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &uniform.group, &[]);
        pass.set_bind_group(1, cells, &[]);
        pass.draw(0..3, 0..1);
    }

    /// Draws the first `count` samples with this pipeline.
    pub(super) fn draw(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
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
        size: (rows * size_of::<RemainderRow>()) as u64,
        usage: BufferUsages::VERTEX,
        mapped_at_creation: false,
    })
}

/// What a picture follows from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Drawn {
    pub(super) frame: Frame,
    pub(super) counts: [usize; 2],
    pub(super) ghosts: bool,
    pub(super) uploads: u64,
}

/// The picture, and how near each pixel of it is.
pub(super) struct Target {
    pub(super) size: [u32; 2],
    picture: wgpu::TextureView,
    depth: wgpu::TextureView,
    pub(super) group: wgpu::BindGroup,
}

impl Target {
    pub(super) fn new(
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
    pub(super) fn begin<'e>(&self, encoder: &'e mut wgpu::CommandEncoder) -> wgpu::RenderPass<'e> {
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
