//! How shaders are put together, and what they read.

use egui_wgpu::wgpu::{self, Device};

use crate::gui::cache::cloud::{Place, RemainderRow};

/// What arrows and marks are both drawn from.
pub(super) const SAMPLE: &str = include_str!("sample.wgsl");

pub(super) fn shader(device: &Device, own: &[&str]) -> wgpu::ShaderModule {
    let source = include_str!("frame.wgsl").to_owned() + &own.concat();
    device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("layer"),
        source: wgpu::ShaderSource::Wgsl(source.into()),
    })
}

pub(super) fn pipeline_layout(
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
pub(super) fn columns() -> [Option<wgpu::VertexBufferLayout<'static>>; 2] {
    const PLACE: [wgpu::VertexAttribute; 3] =
        wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x3];
    const REMAINS: [wgpu::VertexAttribute; 3] =
        wgpu::vertex_attr_array![3 => Float32x3, 4 => Float32, 5 => Float32];
    let layout = |stride: usize, attributes| wgpu::VertexBufferLayout {
        array_stride: stride as u64,
        step_mode: wgpu::VertexStepMode::Instance,
        attributes,
    };
    [
        Some(layout(size_of::<Place>(), &PLACE)),
        Some(layout(size_of::<RemainderRow>(), &REMAINS)),
    ]
}

/// How near what is drawn in space is.
pub(super) const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

fn nearest_first() -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        format: DEPTH,
        depth_write_enabled: Some(true),
        depth_compare: Some(wgpu::CompareFunction::LessEqual),
        stencil: wgpu::StencilState::default(),
        bias: wgpu::DepthBiasState::default(),
    }
}

/// A pipeline with this vertex function; where `depth` counts, what is near covers what is far.
pub(super) fn pipeline(
    device: &Device,
    layout: &wgpu::PipelineLayout,
    module: &wgpu::ShaderModule,
    vertex: &str,
    buffers: &[Option<wgpu::VertexBufferLayout<'_>>],
    format: wgpu::TextureFormat,
    depth: bool,
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
        depth_stencil: depth.then(nearest_first),
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

/// What draws once for each sample.
pub(super) struct BySample {
    pub(super) marks: wgpu::RenderPipeline,
    pub(super) ghosts: wgpu::RenderPipeline,
    pub(super) arrows: wgpu::RenderPipeline,
}

/// A group of one thing that a shader reads.
pub(super) fn group(
    device: &Device,
    layout: &wgpu::BindGroupLayout,
    resource: wgpu::BindingResource<'_>,
) -> wgpu::BindGroup {
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("what a layer reads"),
        layout,
        entries: &[wgpu::BindGroupEntry {
            binding: 0,
            resource,
        }],
    })
}
