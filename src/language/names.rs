//! Names in the language of this thread: those of [`crate::present::names`], and what the core puts together of them.

pub(crate) use crate::present::names::{
    detection_limit, figure, parameter, title, title_of, title_on, usual_size,
};
