//! What the window works on, without a view and without anything that is drawn: the session and what
//! follows from it, the document, its changes and their history.

pub(crate) mod answer;
pub(crate) mod compensated;
pub(crate) mod disk;
pub(crate) mod document;
pub(crate) mod history;
pub(crate) mod loaded_session;
pub(crate) mod overview;
pub(crate) mod quantity;
pub(crate) mod regions;
pub(crate) mod robot_table;
pub(crate) mod setup;
pub(crate) mod simulate;
pub(crate) mod skeleton;
