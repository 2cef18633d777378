//! The layers as egui calls them back: before a frame they upload what changed and one uniform, in it
//! they draw.
//!
//! In space what is near covers what is far, and the pass in which egui draws has no depth. So the
//! samples are drawn into a picture of their own, with a buffer of depths beside it, before that pass,
//! and in it the picture is copied; in a plane all are equally deep. It is drawn again only when samples, camera or
//! colours change: while the pointer moves over a million vectors a frame copies one picture.

use std::sync::Arc;

use egui::{PaintCallbackInfo, Rect, Shape};
use egui_wgpu::{Callback, CallbackResources, CallbackTrait, RenderState, ScreenDescriptor};
use wgpu::util::{BufferInitDescriptor, DeviceExt as _};
use wgpu::{Buffer, BufferUsages, Device, Queue, TextureFormat};

use crate::gui::core::loaded_session::{Cloud, Place, Remainder, RemainderRow};
use crate::gui::layers::Frame;

/// So many samples stay on the graphics processor, in buffers far below the 256 MiB that every device offers: an even
/// part of more, and more than anybody tells apart.
pub(crate) const MOST: usize = 4 << 20;

/// How near what is drawn in space is.
const DEPTH: TextureFormat = TextureFormat::Depth32Float;

/// Error vectors and measured points.
pub(crate) struct CloudLayer {
    pub(crate) cloud: Arc<Cloud>,
    /// What an answer leaves.
    pub(crate) remainder: Option<Arc<Remainder>>,
    /// Where they go.
    pub(crate) frame: Frame,
    /// So many of their points, and so many of their vectors.
    pub(crate) counts: [usize; 2],
    /// The vectors of these places of the cloud instead.
    pub(crate) only: Option<Vec<u32>>,
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
        let Some(drawer) = resources.get_mut::<Drawer>() else {
            return Vec::new();
        };
        let mut rows = self.frame.rows;
        rows[3][3] = if drawer.format.is_srgb() { 1.0 } else { 0.0 };
        queue.write_buffer(&drawer.uniform, 0, bytemuck::cast_slice(&rows));
        let most = device.limits().max_texture_dimension_2d;
        let size = self.frame.size(most);
        let mut anew = upload(device, &mut drawer.places, Some(&self.cloud), |cloud| {
            &cloud.places
        });
        let remainder = self.remainder.as_ref();
        anew |= upload(device, &mut drawer.remains, remainder, |left| left);
        if drawer.target.as_ref().is_none_or(|t| t.size != size) {
            drawer.target = Some(Target::new(device, &drawer.copy, size, drawer.format));
            anew = true;
        }
        let now = (self.frame, self.counts, self.only.clone(), self.ghosts);
        if anew || drawer.drawn.as_ref() != Some(&now) {
            drawer.drawn = Some(now);
            if let Some(target) = &drawer.target {
                self.draw(drawer, &mut target.begin(encoder));
            }
        }
        Vec::new()
    }

    fn paint(
        &self,
        _: PaintCallbackInfo,
        pass: &mut wgpu::RenderPass<'static>,
        resources: &CallbackResources,
    ) {
        if let Some(drawer) = resources.get::<Drawer>()
            && let Some(target) = &drawer.target
        {
            drawer.copy.begin(pass);
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

    /// Draws the points, the deviations before, and the error vectors.
    fn draw(&self, drawer: &Drawer, pass: &mut wgpu::RenderPass<'_>) {
        let Some((_, places)) = &drawer.places else {
            return;
        };
        // Without an answer nothing is read of what it leaves.
        let remains = drawer.remains.as_ref().map_or(places, |(_, rows)| rows);
        pass.set_vertex_buffer(0, places.slice(..));
        pass.set_vertex_buffer(1, remains.slice(..));
        let [places, rows] = [
            (places, size_of::<Place>()),
            (remains, size_of::<RemainderRow>()),
        ]
        .map(|(buffer, row)| buffer.size() / row as u64);
        let all = u32::try_from(places.min(rows)).unwrap_or(u32::MAX);
        let [points, vectors] = self
            .counts
            .map(|n| u32::try_from(n).map_or(all, |n| n.min(all)));
        drawer.marks.begin(pass);
        pass.draw(0..6, 0..points);
        let kinds = [&drawer.ghosts, &drawer.arrows];
        for kind in &kinds[usize::from(!self.ghosts)..] {
            kind.begin(pass);
            match &self.only {
                None => pass.draw(0..6, 0..vectors),
                Some(only) => {
                    for place in only.iter().filter(|place| **place < all) {
                        pass.draw(0..6, *place..place + 1);
                    }
                }
            }
        }
    }
}

/// What was uploaded, of what.
type Uploaded<T> = Option<(Arc<T>, Buffer)>;

/// Uploads rows of this, unless they are there. Whether anything has changed.
fn upload<T, R: bytemuck::Pod>(
    device: &Device,
    there: &mut Uploaded<T>,
    of: Option<&Arc<T>>,
    rows: impl Fn(&T) -> &Vec<R>,
) -> bool {
    let of = of.filter(|of| !rows(of).is_empty());
    if there.as_ref().map(|(of, _)| Arc::as_ptr(of)) == of.map(Arc::as_ptr) {
        return false;
    }
    *there = of.map(|of| {
        let rows = rows(of);
        let contents = bytemuck::cast_slice(&rows[..rows.len().min(MOST)]);
        let buffer = device.create_buffer_init(&BufferInitDescriptor {
            label: Some("samples"),
            contents,
            usage: BufferUsages::VERTEX,
        });
        (Arc::clone(of), buffer)
    });
    true
}

/// Where a picture goes, how many points and vectors it has, or which, and whether those before.
type Drawn = (Frame, [usize; 2], Option<Vec<u32>>, bool);

/// Everything that stays from frame to frame.
pub(crate) struct Drawer {
    marks: Brush,
    ghosts: Brush,
    arrows: Brush,
    copy: Brush,
    format: TextureFormat,
    target: Option<Target>,
    /// What the picture follows from that was drawn last.
    drawn: Option<Drawn>,
    /// A frame as the shaders see it.
    uniform: Buffer,
    places: Uploaded<Cloud>,
    remains: Uploaded<Remainder>,
}

impl Drawer {
    /// Puts the pipelines beside egui's own.
    pub(crate) fn register(state: &RenderState) {
        let (device, format) = (&state.device, state.target_format);
        let uniform = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("frame of a layer"),
            size: size_of::<Frame>() as u64,
            usage: BufferUsages::UNIFORM | BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let module = device.create_shader_module(wgpu::include_wgsl!("layers.wgsl"));
        let brush = |vertex, fragment| {
            let pipeline = pipeline(device, &module, [vertex, fragment], format);
            let frame = group(device, &pipeline, 0, uniform.as_entire_binding());
            Brush { pipeline, frame }
        };
        let drawer = Self {
            marks: brush("mark", "mark_covers"),
            ghosts: brush("ghost", "arrow_covers"),
            arrows: brush("arrow", "arrow_covers"),
            copy: brush("everywhere", "copied"),
            format,
            target: None,
            drawn: None,
            uniform,
            places: None,
            remains: None,
        };
        state.renderer.write().callback_resources.insert(drawer);
    }
}

/// What draws one kind of things, with the frame that it reads.
struct Brush {
    pipeline: wgpu::RenderPipeline,
    frame: wgpu::BindGroup,
}

impl Brush {
    fn begin(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.frame, &[]);
    }
}

/// A pipeline with these vertex and fragment functions. What is drawn of samples, a [`Place`] and a [`RemainderRow`] of
/// each, has a depth: what is near covers what is far.
fn pipeline(
    device: &Device,
    module: &wgpu::ShaderModule,
    [vertex, fragment]: [&str; 2],
    format: TextureFormat,
) -> wgpu::RenderPipeline {
    const PLACE: [wgpu::VertexAttribute; 2] =
        wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3];
    const REMAINS: [wgpu::VertexAttribute; 2] =
        wgpu::vertex_attr_array![2 => Float32x3, 3 => Float32];
    let of_samples = vertex != "everywhere";
    let columns = [
        (size_of::<Place>(), &PLACE),
        (size_of::<RemainderRow>(), &REMAINS),
    ];
    let columns = columns.map(|(stride, attributes)| {
        Some(wgpu::VertexBufferLayout {
            array_stride: stride as u64,
            step_mode: wgpu::VertexStepMode::Instance,
            attributes,
        })
    });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(vertex),
        layout: None,
        vertex: wgpu::VertexState {
            module,
            entry_point: Some(vertex),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: if of_samples { &columns } else { &[] },
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: of_samples.then(|| wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::LessEqual),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some(fragment),
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

/// The one thing that a pipeline reads as this group.
fn group(
    device: &Device,
    pipeline: &wgpu::RenderPipeline,
    index: u32,
    resource: wgpu::BindingResource<'_>,
) -> wgpu::BindGroup {
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("what a layer reads"),
        layout: &pipeline.get_bind_group_layout(index),
        entries: &[wgpu::BindGroupEntry {
            binding: 0,
            resource,
        }],
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
    fn new(device: &Device, copy: &Brush, size: [u32; 2], format: TextureFormat) -> Self {
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
        Self {
            size,
            depth: texture(DEPTH, wgpu::TextureUsages::empty()),
            group: group(device, &copy.pipeline, 1, read),
            picture,
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
                only: None,
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
