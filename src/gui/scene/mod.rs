//! What is seen, once: lines, faces, vectors, marks and labels in mm, with sizes in points and
//! tokens of the style as colours. The model of a view decides what is in its scene; [`paint()`]
//! draws it through a [`Camera`] on a [`Canvas`], of which there are two: the screen, and a drawing
//! for a picture. So a picture shows what the screen shows.

mod camera;
mod items;
mod paint;
mod screen;
mod sheet;
mod tint;

pub(crate) use camera::{Bearing, Camera, Projection};
pub(crate) use items::{
    Form, Item, Label, Layer, LegendEntry, Mark, Place, SIGN, Samples, Scene, Triangle,
};
pub(crate) use paint::{DIAMOND, TRIANGLE, corners_of, paint};
pub(crate) use screen::{Screen, dashes};
pub(crate) use sheet::{SIZE, Sheet};
pub(crate) use tint::{ColourToken, Stroke, Tint};
