//! From blocks to pages of A4: every page is a drawing.

use super::super::fonts::Fonts;
use super::flow::{BOTTOM, Flow, LEFT, LINE, NAMES, PAGE, TEXT, TOP};
use crate::compensation::decision::Outcome;
use crate::present::chart::FULL_WIDTH;
use crate::present::decision::title;
use crate::present::drawing::{
    AFTER, Anchor, BEFORE, CORRECTED, Colour, Drawing, INK, Label, MUTED, RULE, Stroke,
};
use crate::report::document::{Block, Figure, Report};
use crate::report::logo::LOGO;
use crate::text::Text;

/// Room that a page keeps for what comes before a block: its section's heading, points.
const MOST_BEFORE: f64 = 90.0;

/// What a section's heading takes with the gap before it, and that gap, points.
const SECTION: f64 = BEFORE_SECTION + 17.0 + 7.0;
const BEFORE_SECTION: f64 = 16.0;

/// A tolerance that is not kept.
const FAIL: Colour = Colour(0xb4, 0x23, 0x18);

/// A section's heading as the reader's side bar lists it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Mark {
    pub(super) title: String,
    pub(super) page: usize,
    pub(super) y: f64,
}

/// All pages of a report.
pub(super) fn pages(report: &Report, fonts: &Fonts) -> (Vec<Drawing>, Vec<Mark>) {
    let mut flow = Flow {
        fonts,
        pages: vec![Drawing::new(PAGE[0], PAGE[1])],
        y: TOP,
    };
    let mut marks = Vec::new();
    flow.head(report);
    for section in &report.sections {
        // A heading does not stand alone at the foot of a page.
        flow.room_for(SECTION + flow.opening_height(&section.blocks));
        if flow.y > TOP {
            flow.y += BEFORE_SECTION;
        }
        marks.push(Mark {
            title: section.title.clone(),
            page: flow.pages.len() - 1,
            y: flow.y,
        });
        flow.line_of(&section.title, 12.5, 17.0, true, INK, LEFT);
        let rule = flow.y + 1.0;
        flow.rule(rule, 0.7, RULE);
        flow.y += 7.0;
        for (k, block) in section.blocks.iter().enumerate() {
            let next = flow.opening_height(&section.blocks[k + 1..]);
            flow.block(block, next);
        }
    }
    let count = flow.pages.len();
    for (k, page) in flow.pages.iter_mut().enumerate() {
        foot(page, report, k + 1, count, fonts);
    }
    (flow.pages, marks)
}

fn foot(page: &mut Drawing, report: &Report, number: usize, of: usize, fonts: &Fonts) {
    let y = PAGE[1] - 36.0;
    page.line(
        [LEFT, y - 12.0],
        [LEFT + FULL_WIDTH, y - 12.0],
        Stroke::new(0.5, RULE),
    );
    let lines = fonts.wrapped(&report.foot, 7.2, false, FULL_WIDTH - 80.0);
    let mut shown = lines.first().cloned().unwrap_or_default();
    if lines.len() > 1 {
        shown.push('…');
    }
    page.text(Label::new([LEFT, y], shown, 7.2, MUTED));
    let number = text!("page {number} of {of}", number, of);
    let number = number.spoken_in(report.language);
    let label = Label::new([LEFT + FULL_WIDTH, y], number, 7.2, MUTED);
    page.text(label.anchored(Anchor::End));
}

impl Flow<'_> {
    fn head(&mut self, report: &Report) {
        if let Some(logo) = &report.logo {
            self.y += logo.within(LOGO)[1] + 10.0;
        }
        self.line_of(&report.title, 9.5, 14.0, true, AFTER, LEFT);
        for line in self
            .fonts
            .wrapped(&report.subject, 20.0, true, FULL_WIDTH)
            .iter()
            .take(4)
        {
            self.line_of(line, 20.0, 27.0, true, INK, LEFT);
        }
        self.y += 3.0;
        self.paragraph(&report.answer, 10.5, 15.0, INK);
        if let Some((outcome, says)) = &report.decision {
            let colour = match outcome {
                Outcome::Pass => CORRECTED,
                Outcome::Fail => FAIL,
                Outcome::Undecided => BEFORE,
            };
            self.y += 6.0;
            let title = Text::from(title(*outcome)).spoken_in(report.language);
            self.line_of(&title, 11.5, 16.0, true, colour, LEFT);
            self.paragraph(says, TEXT, LINE, INK);
        }
        self.y += 10.0;
        self.headline(&report.headline);
        let y = self.y;
        self.rule(y, 1.4, INK);
    }

    fn headline(&mut self, figures: &[Figure]) {
        if figures.is_empty() {
            return;
        }
        let width = FULL_WIDTH / figures.len().max(4) as f64;
        let top = self.y;
        let mut lowest = top;
        let name = |figure: &Figure| self.fonts.wrapped(&figure.name, 7.6, false, width - 14.0);
        let names: Vec<Vec<String>> = figures.iter().map(name).collect();
        // The values stand beside each other, however long the names are.
        let most = names.iter().map(Vec::len).max().unwrap_or(1);
        for (k, (figure, name)) in figures.iter().zip(&names).enumerate() {
            let x = LEFT + width * k as f64 + 8.0;
            self.y = top;
            for line in name {
                self.line_of(line, 7.6, 11.0, false, MUTED, x);
            }
            self.y = top + 11.0 * most as f64;
            self.line_of(&figure.value, 13.0, 18.0, true, INK, x);
            for line in self
                .fonts
                .wrapped(&figure.reference, 7.2, false, width - 14.0)
            {
                self.line_of(&line, 7.2, 9.6, false, MUTED, x);
            }
            lowest = lowest.max(self.y);
        }
        for k in 0..figures.len() {
            let x = LEFT + width * k as f64;
            let stroke = Stroke::new(1.8, AFTER);
            self.page()
                .line([x + 1.0, top + 1.0], [x + 1.0, lowest - 1.0], stroke);
        }
        self.y = lowest + 12.0;
    }

    /// What these blocks need at least to begin on a page: a heading with what it is a heading of.
    fn opening_height(&self, blocks: &[Block]) -> f64 {
        let height = match blocks {
            [] => 0.0,
            [heading @ Block::Heading(_), rest @ ..] => {
                self.least_height(heading) + self.opening_height(rest)
            }
            // What is said before a signature or the first heading belongs to it.
            [says @ (Block::Text(_) | Block::Warning(_)), rest @ ..]
                if matches!(rest, [Block::Sign(_) | Block::Heading(_), ..]) =>
            {
                self.block_height(says) + self.opening_height(rest)
            }
            [first, ..] => self.least_height(first),
        };
        height.min(BOTTOM - TOP - MOST_BEFORE)
    }

    /// What a block needs at least to begin on a page.
    fn least_height(&self, block: &Block) -> f64 {
        match block {
            Block::Heading(_) => 26.0,
            Block::Text(_) | Block::Warning(_) | Block::List(_) => 2.0 * LINE,
            Block::Facts(facts) => self.facts_height(facts).min(150.0),
            Block::Table(table) => self.table_layout(table).least_height(),
            Block::Plot(..) => self.block_height(block),
            Block::Sign(lines) => 46.0 * lines.len().div_ceil(2) as f64 + 16.0,
        }
    }

    /// What a text or a plot with its caption takes.
    fn block_height(&self, block: &Block) -> f64 {
        let lines = |text: &str, size: f64| self.fonts.wrapped(text, size, false, FULL_WIDTH).len();
        match block {
            Block::Text(text) | Block::Warning(text) => lines(text, TEXT) as f64 * LINE + 3.0,
            Block::Plot(drawing, caption) => {
                drawing.height + 16.0 + 11.0 * lines(caption, 7.8) as f64
            }
            other => self.least_height(other),
        }
    }

    /// `next`: what the block after it needs to begin.
    fn block(&mut self, block: &Block, next: f64) {
        match block {
            Block::Heading(text) => {
                self.room_for(26.0 + next);
                self.y += 7.0;
                for line in self
                    .fonts
                    .wrapped(text, 9.6, true, FULL_WIDTH)
                    .iter()
                    .take(4)
                {
                    self.line_of(line, 9.6, 14.0, true, INK, LEFT);
                }
                self.y += 2.0;
            }
            Block::Text(text) | Block::Warning(text) => {
                self.paragraph(text, TEXT, LINE, INK);
                self.y += 3.0;
            }
            Block::List(points) => {
                for point in points {
                    let lines = self.fonts.wrapped(point, TEXT, false, FULL_WIDTH - 12.0);
                    for (k, line) in lines.iter().enumerate() {
                        self.room_for(LINE);
                        if k == 0 {
                            let y = self.y + LINE / 2.0 + TEXT * 0.35;
                            self.page().text(Label::new([LEFT, y], "–", TEXT, MUTED));
                        }
                        self.line_of(line, TEXT, LINE, false, INK, LEFT + 12.0);
                    }
                }
                self.y += 3.0;
            }
            Block::Facts(facts) => self.facts(facts),
            Block::Table(table) => self.table(table),
            Block::Plot(drawing, caption) => {
                self.room_for(self.block_height(block));
                let at = [LEFT, self.y + 4.0];
                self.page().place(drawing, at);
                self.y += drawing.height + 8.0;
                self.paragraph(caption, 7.8, 11.0, MUTED);
                self.y += 8.0;
            }
            Block::Sign(lines) => self.sign(lines),
        }
    }

    /// A fact's value in lines: its own, each as long as there is room; what runs over is set in.
    fn fact_lines(&self, value: &str) -> Vec<(f64, String)> {
        let own: Vec<&str> = value.split('\n').collect();
        let over = if own.len() > 1 { 10.0 } else { 0.0 };
        let width = FULL_WIDTH - NAMES - over;
        let wrapped = own.into_iter().flat_map(|line| {
            let lines = self.fonts.wrapped(line, TEXT, false, width).into_iter();
            lines
                .enumerate()
                .map(move |(k, line)| (if k == 0 { 0.0 } else { over }, line))
        });
        wrapped.collect()
    }

    fn facts_height(&self, facts: &[(String, String)]) -> f64 {
        let height = |(name, value): &(String, String)| {
            let names = self.fonts.wrapped(name, TEXT, false, NAMES - 8.0);
            let most = self.fact_lines(value).len().max(names.len());
            LINE * most as f64 + 3.0
        };
        facts.iter().map(height).sum()
    }

    fn facts(&mut self, facts: &[(String, String)]) {
        for (name, value) in facts {
            let lines = self.fact_lines(value);
            let names = self.fonts.wrapped(name, TEXT, false, NAMES - 8.0);
            self.room_for((LINE + 3.0).max(LINE * names.len() as f64));
            self.y += 1.5;
            let top = self.y;
            for (k, name) in names.iter().enumerate() {
                let y = top + LINE * (k as f64 + 0.5) + TEXT * 0.35;
                self.page()
                    .text(Label::new([LEFT, y], name.clone(), TEXT, MUTED));
            }
            let pages = self.pages.len();
            for (over, line) in lines {
                self.line_of(&line, TEXT, LINE, false, INK, LEFT + NAMES + over);
            }
            if self.pages.len() == pages {
                self.y = self.y.max(top + LINE * names.len() as f64);
            }
            self.y += 1.5;
            let y = self.y;
            self.rule(y, 0.4, RULE);
        }
        self.y += 5.0;
    }

    fn sign(&mut self, lines: &[(String, String)]) {
        let height = 46.0;
        self.room_for(height * lines.len().div_ceil(2) as f64 + 12.0);
        self.y += 8.0;
        let width = (FULL_WIDTH - 28.0) / 2.0;
        for pair in lines.chunks(2) {
            for (k, (name, value)) in pair.iter().enumerate() {
                let x = LEFT + k as f64 * (width + 28.0);
                let y = self.y + 30.0;
                let page = self.page();
                page.line([x, y], [x + width, y], Stroke::new(0.7, INK));
                page.text(Label::new([x, y + 10.0], name.clone(), 7.6, MUTED));
                page.text(Label::new([x + 2.0, y - 4.0], value.clone(), 9.0, INK));
            }
            self.y += height;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::explain::{Section, Topic};

    /// However much is before them: a picture is below its heading, and a signature below what is signed.
    #[test]
    fn what_belongs_together_is_on_one_page() {
        let plot = || Block::Plot(Drawing::new(FULL_WIDTH, 130.0), "What it shows".to_owned());
        let says = || Block::Text("The figures above were made by the program".to_owned());
        let sign = || Block::Sign(vec![(String::new(), "Name".to_owned()); 2]);
        let section = |title: &str, blocks| Section::of(Topic::Answer, title, blocks);
        let fonts = Fonts::new().expect("the bundled fonts");
        for before in 0..60 {
            let points = vec!["a point".to_owned(); before];
            let report = Report {
                title: "Report".to_owned(),
                subject: "A machine".to_owned(),
                answer: String::new(),
                logo: None,
                decision: None,
                headline: Vec::new(),
                sections: vec![
                    section("Points", vec![Block::List(points)]),
                    section("Deviations", vec![plot()]),
                    section("Signatures", vec![says(), sign()]),
                ],
                foot: String::new(),
                language: crate::text::Language::English,
            };
            let (_, marks) = pages(&report, &fonts);
            let below = [130.0 + 16.0 + 11.0, LINE + 3.0 + 46.0 + 16.0];
            for (mark, below) in marks[1..].iter().zip(below) {
                let ends = mark.y + SECTION - BEFORE_SECTION + below;
                assert!(
                    ends <= BOTTOM + 0.5,
                    "{} after {before}: {ends}",
                    mark.title
                );
            }
        }
    }
}
