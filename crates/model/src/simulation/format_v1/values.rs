//! Values that several objects of a scenario have.

use crate::document::Value;
use crate::document::object::Kind;

pub(super) const FLAG: Kind<bool> = Kind {
    expected: phrase!("true or false"),
    read: |at| match at.node.value {
        Value::Bool(value) => Some(value),
        _ => at.wrong(),
    },
    write: |value| (*value).into(),
};

/// A whole number from 0 on that a double holds exactly.
pub(super) const WHOLE: Kind<u64> = Kind {
    expected: phrase!("a whole number from 0 on"),
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a whole number in the range of the type"
    )]
    read: |at| {
        let whole = |v: f64| v.fract() == 0.0 && (0.0..=9007199254740992.0).contains(&v);
        at.number(whole).map(|value| value as u64)
    },
    write: |value| (*value).into(),
};
