//! Least squares on explicit columns: their products with wide vectors, orthonormal bases, and triangles.

mod basis;
mod kept;
#[doc(hidden)]
pub mod products;
mod subtraction;
mod triangle;

pub use basis::Basis;
pub use kept::Kept;
pub use products::{
    along, cross, gram, lower_cross, own_products, products, some_columns, square_apart,
};
pub use subtraction::{reject_all, subtract};
pub use triangle::{cholesky, inverse_of_lower, small_cholesky, small_gain, solve_lower};
