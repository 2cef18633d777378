//! Numbers and units as the whole program writes them: [`crate::present`].

pub(crate) use crate::present::numbers::*;
pub(crate) use crate::present::table::cell;
pub(crate) use crate::present::units::*;
