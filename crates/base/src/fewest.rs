//! The fewest data for a statement.

/// So many of a kind are no accident: one is, and two may be.
pub const NO_ACCIDENT: usize = 3;
/// Points that determine the orientation of a body.
pub const OF_A_BODY: usize = 3;
/// So many samples on one side, or in a part, determine its mean to half of the scatter.
pub const OF_A_PART: usize = 4;
/// So many determine a median or a root mean square to a quarter (1/√(2·8)), so that outliers are distinguished from
/// noise.
pub const TO_JUDGE: usize = 8;
/// So many for a search over some columns: with fewer one of them fits whatever is there.
pub const TO_SEARCH: usize = 20;
/// So many for a scan over a setting (an order, a place in time): fewer show the same at several.
pub const TO_SCAN: usize = 60;
/// Measured numbers for each that is fitted to them: three distances have a place however wild they are.
pub const ROWS_TO_A_COLUMN: usize = 2;
