//! The picture that samples in space are drawn into, with how near each of its pixels is.

use egui_wgpu::wgpu::{self, Device};

use super::frame::Frame;
use super::pipelines::{BySample, DEPTH, group};

/// What stays from frame to frame for the view in space.
pub(super) struct Space {
    pub(super) by_sample: BySample,
    pub(super) copy: wgpu::RenderPipeline,
    pub(super) format: wgpu::TextureFormat,
    pub(super) target: Option<Target>,
    /// What was drawn last.
    pub(super) drawn: Option<Drawn>,
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
                label: Some("samples in space"),
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
            label: Some("samples in space"),
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
