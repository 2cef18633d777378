//! The workspace: sectors, nominal path, the robot, measured points, error vectors; or the
//! deviation around the joint's angle.

mod about;
mod apart;
mod card;
mod drawn;
mod extent;
mod free_space;
mod handles;
mod label_layout;
mod layers;
mod layout;
mod legend;
mod model;
mod notes;
mod paint;
mod pointer;
mod polar;
mod robot;
mod room;
mod scales;
mod space;
mod toolbar;

pub(crate) use layout::nearest;
pub(crate) use paint::show;
pub(crate) use pointer::{hover, marked, sample_menu};
pub(crate) use polar::sheet::sheet as polar_sheet;
pub(crate) use space::robot_alone;
pub(crate) use space::sheet as space_sheet;
pub(crate) use toolbar::show as bar;
