//! What the workspace shows once for each sample, for any number of samples: error vectors,
//! measured points, and between them the error as a heat map.
//!
//! The samples go to the graphics processor once, when they change; panning, zooming, turning to
//! another plane, blending from before to after and colouring change one small uniform. So a frame
//! costs the window the same for a hundred samples as for a million. What does take time is worked
//! out where sessions are read and answers are found, in the background.
//!
//! - Model, in [`cache`](crate::gui::cache): `cloud` (the samples as they are uploaded), `heat` (the error over the
//!   plane), `projected` (which samples are drawn, and which is under the pointer).
//! - Layout: `frame`: where all of it goes in this frame, as the shaders take it.
//! - Paint: `gpu` (what egui calls back, in space by depth and in a picture of their own), `drawer` (what stays on
//!   the graphics processor) and `pipelines` with `frame.wgsl`, `sample.wgsl`, `arrows.wgsl`, `marks.wgsl`, `heat.wgsl`
//!   and `copy.wgsl`.

mod drawer;
mod frame;
mod gpu;
mod pipelines;
#[cfg(all(test, feature = "window-tests"))]
mod tests;

pub(crate) use frame::{Frame, HEAT, LayerOptions, OUTLINE, WEDGE, WIDTH, scale_at};
pub(crate) use gpu::{CloudLayer, HeatLayer, Layer, SpaceLayer, register};
