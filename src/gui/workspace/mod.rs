//! The workspace: sectors, nominal path, the robot, measured points, error vectors; or the
//! deviation around the joint's angle.

mod about;
mod card;
mod decimation;
mod free_space;
mod handles;
mod layout;
mod legend;
mod model;
mod notes;
mod over;
mod plot_size;
mod pointer;
mod polar;
mod robot;
mod scales;
mod scene;
mod show;
mod space;
mod toolbar;

pub(crate) use layout::nearest;
pub(crate) use pointer::{hover, marked, sample_menu};
pub(crate) use polar::sheet as polar_sheet;
pub(crate) use show::{sheet as plane_sheet, show};
pub(crate) use space::robot_alone;
pub(crate) use space::sheet as space_sheet;
pub(crate) use toolbar::show as bar;
