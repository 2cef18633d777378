//! Columns that belong together by a common first word: `polaris_position_x, polaris_position_y,
//! polaris_position_z`.
//!
//! Where no heading says x or y by itself, one such family is proposed, and only a person can say
//! that it is what was measured. Of several families none is proposed.

use std::collections::BTreeMap;

use crate::importers::columns::COORDINATES;
use crate::importers::headings::{Words, is_among, words_and_unit};
use crate::importers::role::{Proposal, Role, has};
use crate::importers::turns::{axis_of, part_of};
use crate::importers::units::Word;
use crate::sessions::columns::{Quantity, Unit};

/// Words of families that are no measured position.
const NOT_MEASURED: Words = "nominal nom dev deviation delta error err sigma std stddev cov cmd command commanded \
                             setpoint soll desired expected reference ref velocity vel speed linear angular twist \
                             acceleration acc accel force torque moment wrench normal rotation rot euler rpy \
                             orientation quat quaternion rvec rotvec angle axis scale size";
/// Words of families that are an orientation.
const ORIENTATION: Words = "orientation quat quaternion rotation rot q";

/// What the columns are proposed to be, with the roles that are known already: a family that has x and y, or the one
/// coordinate that is missing; or the names of several families.
pub(crate) fn proposed(headings: &[String], roles: &[Role]) -> Proposal<Vec<Role>> {
    if COORDINATES.into_iter().any(|axis| has(roles, axis)) {
        return lone_coordinate(headings, roles).map_or(Proposal::None, Proposal::One);
    }
    let mut positions: BTreeMap<String, Vec<(usize, Quantity, Option<Unit>)>> = BTreeMap::new();
    let mut orientations: BTreeMap<String, Vec<(usize, usize)>> = BTreeMap::new();
    for (index, (heading, role)) in headings.iter().zip(roles).enumerate() {
        if *role != Role::Kept {
            continue;
        }
        let (words, unit) = words_and_unit(&heading.trim().to_lowercase());
        let Some((last, before)) = words.split_last() else {
            continue;
        };
        // `x1` and `x_1` are of the first of several points.
        let last_letter = last.trim_end_matches(|c: char| c.is_ascii_digit());
        let (last, before, number) = match (last_letter, before.split_last()) {
            ("", Some((letter, before))) => (letter.as_str(), before, last.as_str()),
            _ => (last_letter, before, &last[last_letter.len()..]),
        };
        let name = format!("{} {number}", before.join(" "));
        let name = name.trim().to_owned();
        let among = |list| before.iter().any(|word| is_among(word, list));
        let letter = last.strip_prefix('q').unwrap_or(last);
        let part = part_of(letter);
        let is_part = last.len() == 2 || among(ORIENTATION);
        if let Some(part) = part.filter(|_| is_part) {
            orientations.entry(name).or_default().push((index, part));
            continue;
        }
        let unit = match unit {
            None => None,
            Some(Word::Unit(unit @ Unit::Length(_))) => Some(unit),
            Some(_) => continue,
        };
        let Some(axis) = axis_of(last.strip_prefix(['t', 'p']).unwrap_or(last)) else {
            continue;
        };
        if !name.is_empty() && !among(NOT_MEASURED) {
            positions
                .entry(name)
                .or_default()
                .push((index, COORDINATES[axis], unit));
        }
    }
    positions.retain(|_, members| members.len() == 3 || members.len() == 2);
    let members = match positions.len() {
        0 => return Proposal::None,
        1 => positions.into_values().flatten(),
        _ => return Proposal::Several(positions.into_keys().collect()),
    };
    let mut all = roles.to_vec();
    for (index, quantity, unit) in members {
        all[index] = Role::Known(quantity, unit);
    }
    orientations.retain(|_, members| members.len() == 4);
    let is_known = |role: &Role| matches!(role.quantity(), Some(Quantity::Orientation(_)));
    if let [parts] = &orientations.into_values().collect::<Vec<_>>()[..]
        && !roles.iter().any(is_known)
    {
        for (index, part) in parts {
            all[*index] = Role::Known(Quantity::Orientation(*part), Some(Unit::Fixed));
        }
    }
    Proposal::One(all)
}

/// The one coordinate that a heading hides beside two that are known: `tool X`, `Y`, `Z`.
fn lone_coordinate(headings: &[String], roles: &[Role]) -> Option<Vec<Role>> {
    let mut lacking = (0..3).filter(|axis| !has(roles, COORDINATES[*axis]));
    let (Some(lacking), None) = (lacking.next(), lacking.next()) else {
        return None;
    };
    let unit = COORDINATES.iter().find_map(|quantity| {
        let of = |role: &Role| match role {
            Role::Known(own, unit) if own == quantity => Some(*unit),
            _ => None,
        };
        roles.iter().find_map(of)
    })?;
    let is_it = |(heading, role): &(&String, &Role)| {
        let (words, _) = words_and_unit(&heading.trim().to_lowercase());
        **role == Role::Kept
            && words.last().and_then(|word| axis_of(word)) == Some(lacking)
            && !words.iter().any(|word| is_among(word, NOT_MEASURED))
    };
    let mut those = (0..)
        .zip(headings.iter().zip(roles))
        .filter(|(_, one)| is_it(one));
    let (Some((at, _)), None) = (those.next(), those.next()) else {
        return None;
    };
    let mut proposed = roles.to_vec();
    proposed[at] = Role::Known(COORDINATES[lacking], unit);
    Some(proposed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::importers::headings::understand;

    fn proposal(headings: &str) -> Option<String> {
        let headings: Vec<String> = headings.split(',').map(str::to_owned).collect();
        let roles: Vec<Role> = headings.iter().map(|heading| understand(heading)).collect();
        let Proposal::One(words) = proposed(&headings, &roles) else {
            return None;
        };
        Some(
            words
                .iter()
                .map(ToString::to_string)
                .collect::<Vec<_>>()
                .join(","),
        )
    }

    #[test]
    fn one_family_is_proposed_and_of_two_none() {
        for (headings, meant) in [
            (
                "time_s,polaris_position_x,polaris_position_y,polaris_position_z",
                Some("time_s,x,y,z"),
            ),
            (
                "leica_x_mm,leica_y_mm,leica_z_mm,leica_q_w,leica_q_x,leica_q_y,leica_q_z",
                Some("x_mm,y_mm,z_mm,qw,qx,qy,qz"),
            ),
            ("a_x,a_y,a_z,b_x,b_y,b_z", None),
            (
                "nominal_x,nominal_y,nominal_z,t1_x,t1_y,t1_z",
                Some("-,-,-,x,y,z"),
            ),
            ("x,y,z,cam_x,cam_y,cam_z", None),
            ("force_x,force_y,force_z", None),
        ] {
            assert_eq!(proposal(headings).as_deref(), meant, "{headings}");
        }
    }
}
