//! What the workspace shows once for each sample, for any number of samples: error vectors,
//! measured points, and between them the error as a heat map.
//!
//! The samples go to the graphics processor once, when they change; panning, zooming, turning to
//! another plane, blending from before to after and colouring change one small uniform. So a frame
//! costs the window the same for a hundred samples as for a million. What does take time is worked
//! out where sessions are read and answers are found, in the background.
//!
//! - Model, in [`cache`](crate::gui::cache): `cloud` (the samples as they are uploaded), `heat` (the error over the
//!   plane), `nearest` (which sample is under the pointer).
//! - Layout: `frame`: where all of it goes in this frame, as the shaders take it.
//! - Paint: `gpu` (what egui calls back), `drawer` (what stays on the graphics processor) and `pipelines`
//!   with `space` (samples by their depth, in a picture of their own) and `frame.wgsl`, `sample.wgsl`, `arrows.wgsl`, `marks.wgsl`, `heat.wgsl` and
//!   `copy.wgsl`.

mod drawer;
mod frame;
mod gpu;
mod pipelines;
mod space;
mod target;
#[cfg(all(test, feature = "window-tests"))]
mod tests;

pub(crate) use frame::{Frame, HEAT, LayerOptions, OUTLINE, WEDGE, WIDTH, scale_at};
pub(crate) use gpu::{CloudLayer, HeatLayer, Layer, register};
pub(crate) use space::SpaceLayer;
