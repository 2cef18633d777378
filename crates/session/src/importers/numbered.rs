//! Columns with numbers in their headings, told by all of them together: joints that are counted from zero, and the
//! four parts of a quaternion.

use std::collections::BTreeMap;

use super::headings;
use super::joint_names::{is_one, shared, understand};
use super::reader::fixed;
use super::role::{Proposal, Role};
use super::settings::{About, ReadContext};
use crate::document::number::quoted;
use crate::sessions::columns::{Quantity, Unit};
use crate::tables::decimals::value_alone;
use crate::tables::{Complaints, Grid};

/// How far the length of a quaternion may be from 1 for its digits, and is not where four joints are meant.
const OFF_UNIT: f64 = 0.01;

impl ReadContext<'_> {
    /// What the headings of a table say.
    pub(crate) fn roles_of(&mut self, grid: &Grid<'_>, names: &[String]) -> Vec<Role> {
        let joints = &self.reading.joints;
        let mut roles: Vec<Role> = names.iter().map(|name| understand(name, joints)).collect();
        roles.truncate(grid.width);
        self.take_quaternion(grid, names, &mut roles);
        self.count_from_zero(names, &mut roles);
        self.take_shared_names(names, &mut roles);
        // O, A, T of a robot are angles, and T alone is a time.
        let is = |name: &String, letter: &str| name.trim().eq_ignore_ascii_case(letter);
        if names.iter().any(|name| is(name, "o")) && names.iter().any(|name| is(name, "a")) {
            for (role, name) in roles.iter_mut().zip(names) {
                if is(name, "t") {
                    *role = Role::Kept;
                }
            }
        }
        roles
    }

    /// Headings that are not as many as the cells below them may stand over other columns than their own: a comma in a
    /// heading, or names of rows that have none.
    pub(crate) fn ask_about_count(&mut self, grid: &Grid<'_>, names: &[String]) -> bool {
        let filled = |cells: &[String]| {
            let last = cells.iter().rposition(|cell| !cell.is_empty());
            last.map_or(0, |last| last + 1)
        };
        let rows = self.found.first_rows.iter();
        let cells = rows.map(|row| filled(row)).max().unwrap_or(grid.width);
        let headings = filled(names);
        if (cells.min(grid.width)..=grid.width).contains(&headings) {
            return false;
        }
        let says = text!(
            "headings and cells of a row are not as many, {headings} above {cells}: each may stand over another column than its own",
            headings,
            cells
        );
        self.ask(About::Columns, says, &[]);
        true
    }

    /// Joints that no heading names by itself, told by what the headings have in common.
    fn take_shared_names(&mut self, names: &[String], roles: &mut [Role]) {
        let is_commanded = |role: &Role| matches!(role.quantity(), Some(Quantity::Commanded(_)));
        if roles.iter().any(is_commanded) {
            return;
        }
        match shared(names, roles, &self.reading.joints) {
            Proposal::None => {}
            Proposal::One(columns) => {
                for (index, role) in &columns {
                    roles[*index] = *role;
                }
                let listed = columns
                    .iter()
                    .map(|(index, role)| format!("{} {role}", quoted(names[*index].trim())));
                self.note(text!(
                    "joints are taken by what their headings have in common: {columns}",
                    columns = listed.collect::<Vec<_>>().join(", ")
                ));
            }
            Proposal::Several(sets) => {
                let sets: Vec<String> = sets.iter().map(|name| quoted(name.trim())).collect();
                let says = text!(
                    "{count} sets of columns name all joints: those from {sets} on",
                    count = sets.len(),
                    sets = sets.join(", ")
                );
                self.ask(About::Columns, says, &[]);
            }
        }
    }

    /// A table that has a joint 0 is counted from zero, unless the robot's own joint is called so.
    fn count_from_zero(&mut self, names: &[String], roles: &mut [Role]) {
        let joints = &self.reading.joints;
        let is_first = |(role, name): &(&Role, &String)| {
            let from_zero = matches!(with_next_number(name), Some((0, next)) if joint_of(headings::understand(&next)) == Some(0));
            from_zero && headings::understand(name) == Role::Kept && !is_part(role)
        };
        let Some(first) = roles
            .iter()
            .zip(names)
            .find(is_first)
            .map(|(_, name)| name.clone())
        else {
            return;
        };
        let is_of_robot = is_one(&first, joints);
        for (role, name) in roles.iter_mut().zip(names) {
            if let Some((_, next)) = with_next_number(name)
                && !(is_of_robot && is_one(name, joints) || is_part(role))
                && joint_of(headings::understand(&next)).is_some()
            {
                // By their numbers joints of the robot that is counted from zero are none of its names.
                *role = if is_of_robot {
                    headings::understand(&next)
                } else {
                    understand(&next, joints)
                };
            }
        }
        let has = |joint| roles.iter().any(|role| joint_of(*role) == Some(joint));
        let count = joints.len();
        let mut beyond = Vec::new();
        if count > 0 && (0..count).all(has) {
            for (role, name) in roles.iter_mut().zip(names) {
                if joint_of(*role).is_some_and(|joint| joint >= count) {
                    *role = Role::Kept;
                    beyond.push(quoted(name));
                }
            }
        }
        self.note(text!(
            "joints are counted from zero: {first} is joint 1",
            first = quoted(&first)
        ));
        if !beyond.is_empty() {
            self.warn(
                text!(
                    "{columns}: beyond the {count} joints of the robot, not used",
                    columns = beyond.join(", "),
                    count
                ),
                text!("--columns, if the joints are others"),
            );
        }
    }

    /// Four columns whose names end as the parts of a quaternion do, or in 1 to 4, and that have the length 1 in every
    /// row, are one.
    fn take_quaternion(&mut self, grid: &Grid<'_>, names: &[String], roles: &mut [Role]) {
        let mut stems: BTreeMap<String, Vec<(usize, usize)>> = BTreeMap::new();
        let mut numbered = Vec::new();
        for (index, (name, role)) in names.iter().zip(roles.iter()).enumerate() {
            let mut plain = name.trim().to_lowercase();
            plain.retain(char::is_alphanumeric);
            if matches!(
                role,
                Role::Known(Quantity::X | Quantity::Y | Quantity::Z, _)
            ) {
                continue;
            }
            let quaternion = ["quaternion", "quat", "q"];
            let digits = quaternion.iter().find_map(|word| plain.strip_prefix(word));
            if let Some(number @ 1..=4) = digits.and_then(|digits| digits.parse().ok()) {
                numbered.push((number, index));
            }
            let part = match plain.pop() {
                Some('w' | 's' | 'r') => 0,
                Some('x' | 'i') => 1,
                Some('y' | 'j') => 2,
                Some('z' | 'k') => 3,
                Some(digit @ '0'..='3') if quaternion.contains(&&*plain) => {
                    digit as usize - '0' as usize
                }
                _ => continue,
            };
            stems.entry(plain).or_default().push((part, index));
        }
        let columns = |mut found: Vec<(usize, usize)>, from: usize| {
            found.sort_unstable();
            let is_whole =
                found.len() == 4 && (from..).zip(&found).all(|(part, (own, _))| part == *own);
            let at: Vec<usize> = found.into_iter().map(|(_, index)| index).collect();
            (is_whole && self.have_length_1(grid, &at)).then_some(at)
        };
        let named = stems.into_values().find_map(|found| columns(found, 0));
        let (at, is_named) = match (named, columns(numbered, 1)) {
            (Some(at), _) => (at, true),
            (None, Some(at)) => (at, false),
            (None, None) => return,
        };
        let parts = |order: [usize; 4]| {
            let mut roles = roles.to_vec();
            for (index, part) in at.iter().zip(order) {
                roles[*index] = fixed(Quantity::Orientation(part), Unit::Fixed);
            }
            roles
        };
        let (first, last) = (quoted(&names[at[0]]), quoted(&names[at[3]]));
        let real_first = parts([0, 1, 2, 3]);
        if *roles == *real_first {
            return;
        }
        if is_named {
            self.note(text!(
                "{first} … {last} have the length 1 in every row: a quaternion, its real part first",
                first,
                last
            ));
        } else {
            let words = |roles: &[Role]| {
                let words: Vec<String> = roles.iter().map(ToString::to_string).collect();
                words.join(",")
            };
            let says = text!(
                "{first} … {last} have the length 1 in every row: a quaternion, and which of its parts comes first is not stated",
                first,
                last
            );
            let answers = [words(&real_first), words(&parts([1, 2, 3, 0]))];
            self.ask(
                About::Columns,
                says,
                &answers.each_ref().map(String::as_str),
            );
        }
        roles.copy_from_slice(&real_first);
    }

    fn have_length_1(&self, grid: &Grid<'_>, at: &[usize]) -> bool {
        let (mut rows, mut others) = (0, 0);
        // What is wrong with rows is said when they are read.
        grid.each_row(&self.place, &mut Complaints::default(), |row, _| {
            let cell = |index: &usize| row.cells.get(*index).map_or("", |cell| cell.as_ref());
            if at.iter().all(|index| cell(index).is_empty()) {
                return;
            }
            let squares = at.iter().map(|index| value_alone(cell(index)).powi(2));
            let length = squares.sum::<f64>().sqrt();
            rows += 1;
            others += usize::from((length - 1.0).abs().is_nan() || (length - 1.0).abs() > OFF_UNIT);
        });
        rows > 1 && others == 0
    }
}

fn is_part(role: &Role) -> bool {
    matches!(role.quantity(), Some(Quantity::Orientation(_)))
}

/// The joint that a role is about.
fn joint_of(role: Role) -> Option<usize> {
    match role.quantity()? {
        Quantity::JointTemperature(_) => None,
        quantity => quantity.joint(),
    }
}

/// The first number of a heading, and the heading with the next one in its place.
fn with_next_number(heading: &str) -> Option<(usize, String)> {
    let from = heading.find(|c: char| c.is_ascii_digit())?;
    let digits = &heading[from..];
    let to = digits
        .find(|c: char| !c.is_ascii_digit())
        .unwrap_or(digits.len());
    let number: usize = digits[..to].parse().ok()?;
    let next = format!(
        "{}{}{}",
        &heading[..from],
        number.checked_add(1)?,
        &digits[to..]
    );
    Some((number, next))
}
