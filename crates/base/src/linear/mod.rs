//! Least squares on explicit columns: their products with wide vectors, orthonormal bases, and triangles.

mod basis;
mod kept;
pub mod products;
mod subtraction;
mod triangle;

#[doc(hidden)]
pub use basis::Basis;
#[doc(hidden)]
pub use kept::Kept;
#[doc(hidden)]
pub use products::{along, cross, gram, lower_cross, own_products, products, some_columns, square_apart};
#[doc(hidden)]
pub use subtraction::{reject_all, subtract};
#[doc(hidden)]
pub use triangle::{cholesky, inverse_of_lower, small_cholesky, small_gain, solve_lower};
