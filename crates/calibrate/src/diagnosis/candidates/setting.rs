//! The setting of a term, as a number and in words.

use crate::effects::words::parameter;
use crate::effects::{Setting, Term, called};
use crate::text::Text;

/// The quantity that is set: English has the first word of its name in files.
fn setting_in_words(name: &'static str) -> Text {
    let english = name.split('_').next().unwrap_or(name);
    Text::named(english, parameter(name).0)
}

/// A setting and whose it is, in words.
pub(crate) fn setting(term: &Term) -> Text {
    let (value, effect) = (shown(value(term)), called(term.effect.about().id));
    match term.effect.about().setting {
        Setting::Order { .. } => {
            text!("order {value} of {effect}", value, effect)
        }
        Setting::Listed(listed) => text!(
            "{quantity} {value} of {effect}",
            quantity = setting_in_words(listed.quantity.name),
            value,
            effect
        ),
        _ => text!("setting {value} of {effect}", value, effect),
    }
}

/// A setting as it is read.
pub(crate) fn value(term: &Term) -> f64 {
    match term.effect.about().setting {
        Setting::Listed(listed) => term.setting / listed.quantity.unit.scale,
        _ => term.setting,
    }
}

/// A number without digits that are not significant.
pub(crate) fn shown(value: f64) -> String {
    if value.fract() == 0.0 {
        format!("{value:.0}")
    } else {
        format!("{value:.3}")
    }
}
