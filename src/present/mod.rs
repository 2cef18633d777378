//! What is shown of an answer, without computing any of it: JSON documents and the words for a place.

pub mod compensation_v1;
pub mod diagnosis_v1;
pub mod kinds;
pub mod plan_v1;
pub mod test_cube_v1;

mod place;
