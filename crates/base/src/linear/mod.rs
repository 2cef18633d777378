//! Least squares on explicit columns: products of matrices with many rows, orthonormal bases, and triangles.

mod basis;
mod kept;
mod products;
mod triangle;

pub use basis::{Basis, DEPENDENT};
pub use kept::Kept;
pub use products::{cross, gram, reject_all};
pub use triangle::{inverse_of_lower, small_cholesky, small_gain, solve_lower};
