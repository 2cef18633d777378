//! What is shown of an answer, without computing any of it: JSON documents, charts and drawings, the words
//! for a place.

pub mod chart;
pub mod compensation_v1;
pub mod diagnosis_v1;
pub mod drawing;
pub mod kinds;
pub mod plan_v1;
pub mod test_cube_v1;

mod place;
