//! Which command belongs to which measurement, where both come in the same order or carry names.
//!
//! By order the counts have to agree: one measurement too many would shift all that follow. By name
//! the first occurrence of a name belongs to the first, the second to the second; what is left on
//! either side is listed.

use crate::text::{Template, Text};
use std::collections::BTreeMap;

use crate::document::number::quoted;
use crate::importers::columns::Columns;
use crate::importers::role::Role;

named! {
    /// How commands find their measurements.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub enum Matching {
        /// The first belongs to the first, and so on.
        #[default]
        Order = "order",
        /// By clock.
        Time = "time",
        /// By the points' names.
        Name = "name",
    }
    /// As `--match` takes it.
    pub fn id;
}

/// How commands find their measurements by default: by name where there are as many of both, each common name is as
/// frequent on either side, and at least half of the measured ones are among the commands in another order; else by
/// order. Of unequal numbers an instrument's own count (`1`, `2`, …) may have slipped: there the order refuses, and
/// the user decides.
pub(crate) fn suggested(measured: &Columns, commands: &Columns) -> Matching {
    let (Some(measured), Some(commands)) = (measured.points(), commands.points()) else {
        return Matching::Order;
    };
    if measured == commands || measured.len() != commands.len() {
        return Matching::Order;
    }
    let [own, other] = [&measured, &commands].map(|names| {
        let mut count = BTreeMap::<&str, usize>::new();
        for name in names.iter().filter(|name| !name.is_empty()) {
            *count.entry(name).or_default() += 1;
        }
        count
    });
    let mut common = 0;
    for (name, count) in &own {
        match other.get(name) {
            // Which of them is lost, no name says.
            Some(there) if there != count => return Matching::Order,
            Some(_) => common += count,
            None => {}
        }
    }
    if 2 * common >= measured.len() {
        Matching::Name
    } else {
        Matching::Order
    }
}

/// Rows that belong together, and what has no partner.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Pairs {
    /// Rows of measurements, increasing, and the command of each.
    pub(crate) measured: Vec<usize>,
    pub(crate) commands: Vec<usize>,
    /// Names of measurements without a command, and of commands without a measurement, in words.
    pub(crate) lonely_measured: Vec<Text>,
    pub(crate) lonely_commands: Vec<Text>,
}

/// Pairs by order. The error says what differs.
pub(crate) fn by_order(measured: &Columns, commands: &Columns) -> Result<Pairs, (Text, Template)> {
    let (m, c) = (measured.rows(), commands.rows());
    if m == c {
        return Ok(Pairs {
            measured: (0..m).collect(),
            commands: (0..c).collect(),
            ..Pairs::default()
        });
    }
    let (more, fewer) = (m.max(c), m.min(c));
    let rest: Vec<usize> = (fewer..more).collect();
    let mut found = vec![text!("{m} measurements and {c} commands", m, c)];
    found.push(if m > c {
        text!(
            "measurements without a command: {which}",
            which = listed_rows(measured, &rest)
        )
    } else {
        text!(
            "commands without a measurement: {which}",
            which = listed_rows(commands, &rest)
        )
    });
    // Names on both sides show where the first gap is.
    if let (Some(a), Some(b)) = (measured.points(), commands.points())
        && let Some(row) = (0..fewer).find(|&row| a[row] != b[row])
    {
        found.push(text!(
            "the first difference: measurement {row} is {measured}, command {row} is {commanded}",
            row = row + 1,
            measured = quoted(a[row]),
            commanded = quoted(b[row])
        ));
    }
    Err((
        Text::listed(found, "; "),
        phrase!("as many of one as of the other, or --match name or time"),
    ))
}

const BOTH: Template = phrase!("names on both sides, or --match order");

/// Pairs by name. Without names on both sides, or without a common one, the error says so.
pub(crate) fn by_name(measured: &Columns, commands: &Columns) -> Result<Pairs, (Text, Template)> {
    let lacks = |found: Text| (found, BOTH);
    let names = measured
        .points()
        .ok_or_else(|| lacks(text!("measurements or commands without a column of names")))?;
    let wanted = commands
        .points()
        .or_else(|| {
            let target = |column: &&crate::importers::columns::Column| {
                column.role.quantity() == Some(crate::sessions::columns::Quantity::Target)
            };
            let column = commands.list.iter().find(target)?;
            commands.texts(column.role)
        })
        .ok_or_else(|| lacks(text!("measurements or commands without a column of names")))?;
    // Rows of each name that are still free, the next one last.
    let mut free: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for (row, name) in wanted.iter().enumerate().rev() {
        free.entry(name).or_default().push(row);
    }
    let mut pairs = Pairs::default();
    for (row, name) in names.iter().enumerate() {
        let command = if name.is_empty() {
            None
        } else {
            free.get_mut(name).and_then(Vec::pop)
        };
        match command {
            Some(command) => {
                pairs.measured.push(row);
                pairs.commands.push(command);
            }
            None => pairs.lonely_measured.push(row_in_words(measured, row)),
        }
    }
    let mut rest: Vec<usize> = free.into_values().flatten().collect();
    rest.sort_unstable();
    pairs.lonely_commands = rest
        .into_iter()
        .map(|row| row_in_words(commands, row))
        .collect();
    if pairs.measured.is_empty() {
        let found = text!(
            "no name is on both sides: measured {lonely_measured}, commanded {lonely_commands}",
            lonely_measured = listed(&pairs.lonely_measured, BEARABLE),
            lonely_commands = listed(&pairs.lonely_commands, BEARABLE)
        );
        return Err((found, BOTH));
    }
    Ok(pairs)
}

/// A row by its name and line.
pub(crate) fn row_in_words(columns: &Columns, row: usize) -> Text {
    let name = columns.point(row);
    let line = columns.lines.get(row);
    match (name.filter(|name| !name.is_empty()), line) {
        (Some(name), Some(line)) => {
            text!("{name} (line {line})", name = quoted(name), line)
        }
        (Some(name), None) => Text::verbatim(quoted(name)),
        (None, Some(line)) => text!("line {line}", line),
        (None, None) => text!("row {rows}", rows = row + 1),
    }
}

/// How many rows or names a line can bear.
pub(crate) const BEARABLE: usize = 8;

/// Rows by their names and lines, the first ones.
pub(crate) fn listed_rows(columns: &Columns, rows: &[usize]) -> Text {
    let named = rows.iter().map(|&row| row_in_words(columns, row));
    listed(named, BEARABLE)
}

/// A list of at most so many names, and how many more there are.
pub(crate) fn listed_names(
    names: impl IntoIterator<Item = impl Into<String>>,
    shown: usize,
) -> Text {
    listed(names.into_iter().map(Text::verbatim), shown)
}

/// The same of words.
pub(crate) fn listed(words: impl IntoIterator<Item = impl Into<Text>>, shown: usize) -> Text {
    let mut words: Vec<Text> = words.into_iter().map(Into::into).collect();
    let more = words.len().saturating_sub(shown);
    words.truncate(shown);
    let first = Text::listed(words, ", ");
    match more {
        0 => first,
        more => text!("{first} and {more} more", first, more),
    }
}

/// Puts the columns of matched rows side by side. What both sides have is taken from the
/// measurements; the headings of what was not taken come back.
pub(crate) fn join(measured: Columns, commands: Columns, pairs: &Pairs) -> (Columns, Vec<String>) {
    let mut joined = measured.only(&pairs.measured);
    let mut left = Vec::new();
    for mut column in commands.only(&pairs.commands).list {
        match column.role {
            Role::Point | Role::Group | Role::Left => continue,
            Role::Kept => {
                if joined.list.iter().any(|other| other.name == column.name) {
                    column.name = format!("{} (commands)", column.name);
                }
            }
            role => {
                let quantity = role.quantity();
                if joined
                    .list
                    .iter()
                    .any(|other| other.role.quantity() == quantity)
                {
                    left.push(column.name);
                    continue;
                }
            }
        }
        joined.list.push(column);
    }
    (joined, left)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::importers::columns::Column;
    use crate::tables::Cells;

    #[test]
    fn names_say_more_than_the_order_where_they_are_the_same_in_another_one() {
        let suggests =
            |measured: &[&str], commands: &[&str]| suggested(&points(measured), &points(commands));
        assert_eq!(suggests(&["a", "b", "c"], &["c", "a", "b"]), Matching::Name);
        // One was lost and another measured twice.
        assert_eq!(
            suggests(&["a", "c", "c2"], &["a", "b", "c"]),
            Matching::Name
        );
        // The instrument counts by itself: one was lost, and from there on the numbers are of the next ones.
        assert_eq!(suggests(&["1", "2"], &["1", "2", "3"]), Matching::Order);
        assert_eq!(suggests(&["a", "b"], &["a", "b"]), Matching::Order);
        // Reflectors have names as well, and poses others.
        assert_eq!(suggests(&["T1", "T2"], &["p1", "p2"]), Matching::Order);
        // Which measurement of three was lost, no name says.
        assert_eq!(
            suggests(&["a", "a", "b", "c"], &["a", "a", "a", "b"]),
            Matching::Order
        );
    }

    fn points(names: &[&str]) -> Columns {
        let mut columns = Columns::default();
        let names: Vec<String> = names.iter().map(|&name| name.to_owned()).collect();
        columns.lines.add(2, names.len());
        columns.list.push(Column {
            name: "name".to_owned(),
            number: 1,
            role: Role::Point,
            cells: Cells::Text(names),
        });
        columns
    }

    #[test]
    fn names_that_recur_are_matched_by_occurrence() {
        let measured = points(&["A", "B", "A", "X", "A", ""]);
        let commands = points(&["B", "A", "A", "C"]);
        let pairs = by_name(&measured, &commands).unwrap();
        assert_eq!(pairs.measured, [0, 1, 2]);
        assert_eq!(pairs.commands, [1, 0, 2]);
        let said = |rows: &[Text]| rows.iter().map(Text::to_string).collect::<Vec<_>>();
        assert_eq!(
            said(&pairs.lonely_measured),
            ["'X' (line 5)", "'A' (line 6)", "line 7"]
        );
        assert_eq!(said(&pairs.lonely_commands), ["'C' (line 5)"]);
        assert!(by_name(&points(&["P"]), &points(&["Q"])).is_err());
    }

    #[test]
    fn counts_that_differ_are_listed() {
        let (found, _) = by_order(&points(&["A", "X", "B"]), &points(&["A", "B"])).unwrap_err();
        for part in [
            "3 measurements and 2 commands",
            "'B' (line 4)",
            "measurement 2 is 'X', command 2 is 'B'",
        ] {
            assert!(found.to_string().contains(part), "{found}");
        }
    }
}
