//! Which decimal sign a table has: found by all of its cells, or asked for.

use super::settings::{About, Question, ReadContext};
use crate::diagnostic::Diagnostic;
use crate::document::number::quoted;
use crate::tables::Grid;
use crate::tables::decimals::{Decimal, Decision, Example};

impl ReadContext<'_> {
    /// Which decimal sign the number columns have; `None` while it is asked for, or wrong.
    pub(crate) fn decimal_sign(
        &mut self,
        grid: &Grid<'_>,
        is_number: &dyn Fn(usize) -> bool,
    ) -> Option<Decimal> {
        let given = self.reading.decimal;
        self.found.decimal = given.or_else(|| self.found_sign(grid, is_number));
        self.found.decimal
    }

    fn found_sign(
        &mut self,
        grid: &Grid<'_>,
        is_number: &dyn Fn(usize) -> bool,
    ) -> Option<Decimal> {
        let place = |example: &Example| {
            let place = self.place.clone().at_line(example.line);
            place.at_column(example.column as u64)
        };
        match grid.votes(is_number, &self.place).decide() {
            Decision::Is(decimal) => return Some(decimal),
            Decision::Ask(example) => {
                let says = text!(
                    "{cell} is {decimal} with a decimal comma, or {grouped} with a comma between thousands, and no other number tells",
                    cell = quoted(&example.cell),
                    decimal = example.cell.replace(',', "."),
                    grouped = example.cell.replace(',', "")
                );
                let asked = Question::new(About::Decimal, place(&example), says, &[",", "."]);
                self.found.questions.push(asked);
            }
            Decision::Mixed(point, comma) => {
                let found = text!(
                    "{cell} here and {other} in line {line}: a decimal point and a decimal comma",
                    cell = quoted(&comma.cell),
                    other = quoted(&point.cell),
                    line = point.line
                );
                let expected = text!(
                    "one decimal sign in the whole file, or --decimal if one of the two separates thousands"
                );
                let wrong = Diagnostic::error(place(&comma), found, expected);
                self.found.findings.push(wrong);
            }
        }
        None
    }
}
