//! Sections and blocks in the terminal: a heading, and beneath it what belongs to it, set in.

use crate::explain::{Block, Fact, Section};
use crate::present::table::width;

use super::words::{line, padded};

/// Names wider than this stand before their value without being aligned: one long name would push all values away.
const WIDEST: usize = 36;

/// Sections one after the other.
pub(super) fn sections(sections: &[Section]) -> String {
    sections.iter().map(section).collect()
}

/// A heading and what belongs to it.
pub(super) fn section(section: &Section) -> String {
    let mut text = String::new();
    line(&mut text, &section.title);
    text + &blocks(&section.blocks, 2)
}

/// Blocks, set in by so many blanks.
pub(super) fn blocks(blocks: &[Block], indent: usize) -> String {
    blocks.iter().map(|one| block(one, indent)).collect()
}

fn block(block: &Block, indent: usize) -> String {
    let blanks = " ".repeat(indent);
    let mut text = String::new();
    match block {
        Block::Heading(own) | Block::Text(own) | Block::Warning(own) => {
            line(&mut text, format!("{blanks}{own}"));
        }
        Block::List(points) => {
            for point in points {
                line(&mut text, format!("{blanks}{point}"));
            }
        }
        Block::Facts(facts) => facts_in_words(&mut text, facts, &blanks),
        Block::Table(table) => text = table.aligned(indent),
        // What is drawn or signed is for paper.
        Block::Plot(..) | Block::Sign(_) => {}
    }
    text
}

fn facts_in_words(text: &mut String, facts: &[Fact], blanks: &str) {
    let widths = facts.iter().map(|(name, _)| width(name));
    let wide = widths.filter(|wide| *wide <= WIDEST).max().unwrap_or(0) + 2;
    for (name, value) in facts {
        let value = value.replace('\n', "; ");
        if width(name) <= WIDEST {
            line(text, format!("{blanks}{}{value}", padded(name, wide)));
        } else {
            line(text, format!("{blanks}{name}: {value}"));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn facts_stand_below_each_other_and_long_names_before_theirs() {
        let fact = |name: &str, value: &str| (name.to_owned(), value.to_owned());
        let facts = vec![
            fact("Size", "0.05 mm"),
            fact("Noise floor", "0.03 mm"),
            fact("Expected error of the model over the joint ranges", "1 mm"),
        ];
        let blocks = vec![Block::Text("why".to_owned()), Block::Facts(facts)];
        let lines = [
            "Left",
            "  why",
            "  Size         0.05 mm",
            "  Noise floor  0.03 mm",
            "  Expected error of the model over the joint ranges: 1 mm",
        ];
        let said = section(&Section::new("Left", blocks));
        assert_eq!(said, lines.join("\n") + "\n");
    }
}
