//! The corrections that predict without a name, on disk: the numbers that the program computes with (rad, mm), so that
//! they are read back to the last bit.

use crate::text::{Template, Text};
use std::sync::Arc;

use super::curve::LIST;
use crate::document::object::{Cursor, Object, written};
use crate::document::{Member, Value};
use crate::effects::rest::{Along, MOVES, Rest, Wave};
use crate::effects::{REST, Term};

const OBJECT: Template = phrase!("an object with ranges_inner and what is added in each direction");
/// Keys of each move: moments, conditions, orders of the waves (one for each joint, wave after
/// wave), their sines and their cosines.
const KEYS: [[&str; 5]; MOVES] = [
    [
        "motion_moments_inner",
        "motion_conditions_inner",
        "motion_orders_inner",
        "motion_sines_inner",
        "motion_cosines_inner",
    ],
    [
        "radial_moments_mm",
        "radial_conditions_inner",
        "radial_orders_inner",
        "radial_sines_mm",
        "radial_cosines_mm",
    ],
    [
        "axial_moments_mm",
        "axial_conditions_inner",
        "axial_orders_inner",
        "axial_sines_mm",
        "axial_cosines_mm",
    ],
    [
        "about_motion_moments_inner",
        "about_motion_conditions_inner",
        "about_motion_orders_inner",
        "about_motion_sines_rad",
        "about_motion_cosines_rad",
    ],
    [
        "about_radial_moments_inner",
        "about_radial_conditions_inner",
        "about_radial_orders_inner",
        "about_radial_sines_rad",
        "about_radial_cosines_rad",
    ],
    [
        "about_axial_moments_inner",
        "about_axial_conditions_inner",
        "about_axial_orders_inner",
        "about_axial_sines_rad",
        "about_axial_cosines_rad",
    ],
];

/// The lists as they are in the file.
#[derive(Clone, Default)]
struct Lists {
    ranges: Vec<f64>,
    condition_ranges: Vec<f64>,
    geometry_alone: Vec<f64>,
    along: [[Vec<f64>; 5]; MOVES],
}

impl Lists {
    fn of(rest: &Rest) -> Self {
        let along = rest.along.each_ref().map(|along| {
            let given = along.conditions.iter().any(|c| *c != 0.0);
            let each = |read: fn(&Wave) -> f64| along.waves.iter().map(read).collect();
            [
                along.moments.clone(),
                if given {
                    along.conditions.to_vec()
                } else {
                    Vec::new()
                },
                along.waves.iter().flat_map(|w| w.orders.clone()).collect(),
                each(|w| w.sine),
                each(|w| w.cosine),
            ]
        });
        Self {
            ranges: rest.ranges.as_flattened().to_vec(),
            condition_ranges: rest.condition_ranges.as_flattened().to_vec(),
            geometry_alone: rest.geometry_alone.clone(),
            along,
        }
    }

    /// `None` where the lists do not belong together.
    fn rest(&self, joints: usize) -> Option<Rest> {
        let mut along: [Along; MOVES] = std::array::from_fn(|_| Along::default());
        for (along, lists) in along.iter_mut().zip(&self.along) {
            let [moments, conditions, orders, sines, cosines] = lists;
            along.moments.clone_from(moments);
            if !conditions.is_empty() {
                along.conditions = conditions.as_slice().try_into().ok()?;
            }
            if sines.len() != cosines.len() || orders.len() != joints * sines.len() {
                return None;
            }
            let waves = orders.chunks(joints).zip(sines.iter().zip(cosines));
            along.waves = waves
                .map(|(orders, (sine, cosine))| Wave {
                    orders: orders.to_vec(),
                    sine: *sine,
                    cosine: *cosine,
                })
                .collect();
        }
        let (ranges, odd) = self.ranges.as_chunks::<2>();
        let (condition_ranges, odd_too) = self.condition_ranges.as_chunks::<2>();
        (odd.is_empty() && odd_too.is_empty()).then(|| Rest {
            ranges: ranges.to_vec(),
            condition_ranges: condition_ranges.to_vec(),
            along,
            geometry_alone: self.geometry_alone.clone(),
        })
    }
}

pub(super) fn written_rest(rest: &Rest) -> Value {
    written(Lists::of(rest), declare)
}

fn declare(o: &mut Object<'_, '_>, own: &mut Lists) {
    o.required("ranges_inner", &mut own.ranges, &LIST);
    let stated = !own.condition_ranges.is_empty();
    let key = "condition_ranges_inner";
    o.usual_if(stated, key, &mut own.condition_ranges, &LIST);
    let key = "others_without_it_inner";
    let stated = !own.geometry_alone.is_empty();
    o.usual_if(stated, key, &mut own.geometry_alone, &LIST);
    for (keys, lists) in KEYS.iter().zip(&mut own.along) {
        for (key, list) in keys.iter().zip(lists) {
            o.usual_if(!list.is_empty(), key, list, &LIST);
        }
    }
}

/// The term of what predicts without a name; `joint` is counted from 1.
pub(super) fn unnamed(
    at: &mut Cursor<'_, '_>,
    members: &[Member],
    joint: usize,
    joints: usize,
) -> Option<Term> {
    let rest = at.under(members, "rest", OBJECT, |at| {
        let lists = at.object(Lists::default(), declare)?;
        let Some(rest) = lists.rest(joints) else {
            return at.error(
                text!("lists of different lengths"),
                text!(
                    "five conditions, one order for each joint and wave, as many sines as cosines"
                ),
            );
        };
        match rest.check(joints) {
            Ok(()) => Some(rest),
            Err(error) => at.error(Text::verbatim(error.to_string()), OBJECT),
        }
    })?;
    Some(Term {
        rest: Some(Arc::new(rest)),
        ..Term::absent(&REST, joint - 1, 0.0)
    })
}
