//! Least squares on explicit columns: their products with wide vectors, orthonormal bases, and triangles.

mod basis;
mod kept;
mod products;
mod subtraction;
mod triangle;

pub(crate) use basis::Basis;
pub(crate) use kept::Kept;
pub(crate) use products::{
    along, cross, gram, lower_cross, own_products, products, some_columns, square_apart,
};
pub(crate) use subtraction::{reject_all, subtract};
pub(crate) use triangle::{cholesky, inverse_of_lower, small_cholesky, small_gain, solve_lower};
