//! Enums whose values have names: each value is declared once, together with its name. Names are `&str`, or of the
//! type behind an arrow.
//!
//! ```text
//! named! {
//!     pub enum Plane { Top = "top", Side = "side", }
//!     pub fn name;
//!     pub const ALL;          // if it is asked for
//! }
//! ```

/// An enum, a function with the name of each value, and if it is asked for every value in order.
#[doc(hidden)]
#[macro_export]
macro_rules! named {
    (
        $(#[$about:meta])*
        $vis:vis enum $Name:ident {
            $($(#[$of_value:meta])* $Value:ident = $name:expr,)*
        }
        $(#[$of_fn:meta])*
        $fn_vis:vis fn $fn_name:ident;
    ) => {
        $crate::named! {
            $(#[$about])*
            $vis enum $Name {
                $($(#[$of_value])* $Value = $name,)*
            }
            $(#[$of_fn])*
            $fn_vis fn $fn_name -> &'static str;
        }
    };
    (
        $(#[$about:meta])*
        $vis:vis enum $Name:ident {
            $($(#[$of_value:meta])* $Value:ident = $name:expr,)*
        }
        $(#[$of_fn:meta])*
        $fn_vis:vis fn $fn_name:ident -> $Of:ty;
    ) => {
        $(#[$about])*
        $vis enum $Name {
            $($(#[$of_value])* $Value,)*
        }

        impl $Name {
            $(#[$of_fn])*
            $fn_vis fn $fn_name(self) -> $Of {
                match self {
                    $(Self::$Value => $name,)*
                }
            }
        }
    };
    (
        $(#[$about:meta])*
        $vis:vis enum $Name:ident {
            $($(#[$of_value:meta])* $Value:ident = $name:expr,)*
        }
        $(#[$of_fn:meta])*
        $fn_vis:vis fn $fn_name:ident $(-> $Of:ty)?;
        $(#[$of_all:meta])*
        $all_vis:vis const ALL;
    ) => {
        $crate::named! {
            $(#[$about])*
            $vis enum $Name {
                $($(#[$of_value])* $Value = $name,)*
            }
            $(#[$of_fn])*
            $fn_vis fn $fn_name $(-> $Of)?;
        }

        impl $Name {
            $(#[$of_all])*
            $all_vis const ALL: [Self; [$(stringify!($Value)),*].len()] = [$(Self::$Value),*];
        }
    };
}
