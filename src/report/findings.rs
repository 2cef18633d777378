//! What a diagnosis found, what it leaves open, and what it could not see.

use crate::diagnosis::Found;
use crate::effects;

use super::document::{Block, Section, Table, clean};
use super::parts::fact;
use super::session::{MOST_ROWS, Told};
use crate::present::limits;
use crate::present::names::{detection_limit, title_of, title_on};
use crate::present::numbers::{mm, plain};
use crate::present::poses::{new_reflectors, table};

impl Told<'_> {
    pub(super) fn effects(&self) -> Option<Section> {
        let found = &self.found.found;
        if found.is_empty() {
            return None;
        }
        Some(Section {
            title: "Effects found".to_owned(),
            blocks: found.iter().flat_map(|f| self.effect(f)).collect(),
        })
    }

    fn effect(&self, f: &Found) -> [Block; 2] {
        let about = effects::find(f.effect).map(effects::Effect::about);
        let percent = format!("{:.1} %", f.share * 100.0);
        let unseen = f.held_out_mm.map_or_else(
            || "too few samples".to_owned(),
            |[before, after]| format!("{} → {} mm", plain(before), plain(after)),
        );
        let fit = format!("{} → {} mm", plain(f.gap_mm[0]), plain(f.gap_mm[1]));
        let mut facts = vec![
            fact("Evidence", sentence(&f.says)),
            fact(
                "RMS error, fit; cross-validated",
                format!("{fit}; {unseen}"),
            ),
            fact("Share of what was explained", percent),
        ];
        if let Some(about) = about {
            facts.push(fact("Usual cause", about.cause.english()));
        }
        facts.push(fact("Check on the machine", f.check));
        [
            Block::Heading(title_on(f.effect, f.joint, self.robot().joints.len())),
            Block::Facts(facts),
        ]
    }

    pub(super) fn open(&self) -> Section {
        let d = self.found;
        let mut blocks = Vec::new();
        for problem in &d.data_problems {
            blocks.push(Block::Heading(format!("Data: {}", clean(&problem.what))));
            blocks.push(Block::Facts(vec![
                fact("Evidence", clean(&problem.evidence)),
                fact("Proposal", clean(&problem.proposal)),
            ]));
        }
        if d.unexplained.present {
            blocks.push(Block::Heading("Left without a name".to_owned()));
            let mut facts = vec![
                fact(
                    "Size",
                    format!("{} root mean square", mm(d.unexplained.rms_mm)),
                ),
                fact("Evidence", clean(&d.unexplained.says)),
            ];
            if let Some(place) = &d.unexplained.place {
                facts.push(fact("Where", clean(&place.says())));
            }
            if !d.unexplained.resembles.is_empty() {
                let names = d.unexplained.resembles.iter().map(|n| title_of(n));
                facts.push(fact(
                    "Resembles in part",
                    names.collect::<Vec<_>>().join(", "),
                ));
            }
            blocks.push(Block::Facts(facts));
        }
        if let Some(unnamed) = &d.unnamed {
            blocks.push(Block::Heading("Predicts without a name".to_owned()));
            blocks.push(Block::Facts(vec![fact("In the model", unnamed.says())]));
        }
        if !d.equivalent.is_empty() {
            blocks.push(Block::Heading(
                "Names that the samples cannot tell apart".to_owned(),
            ));
            let mut table =
                Table::headed("In the model | Could be instead | >Odds against | What would tell");
            for rival in &d.equivalent {
                table.row([
                    rival.explanation.join(" + "),
                    rival.instead.join(" + "),
                    format!("{:.1} : 1", rival.odds),
                    clean(&rival.separate_by),
                ]);
            }
            blocks.push(Block::Table(table));
        }
        if !d.identification.not_identifiable.is_empty() {
            blocks.push(Block::Heading("Not identifiable".to_owned()));
            let mut table = Table::new(["Parameter or combination", "Why"]);
            for open in d.identification.not_identifiable.iter().take(4 * MOST_ROWS) {
                table.row([clean(&open.combination), clean(&open.because)]);
            }
            blocks.push(Block::Table(table));
        }
        blocks.extend(self.next_poses());
        blocks.extend(self.outliers());
        if let Some(says) = d.identification.excluded_in_words() {
            blocks.push(Block::Heading("Samples excluded by hand".to_owned()));
            blocks.push(Block::Text(says));
        }
        if blocks.is_empty() {
            let mut text =
                "Nothing in these samples: no data problem, no rival explanation, nothing \
                            left without a name, no outlier"
                    .to_owned();
            if !self.given.note.trim().is_empty() {
                text += ". The note says where they come from";
            }
            blocks.push(Block::Text(text));
        }
        Section::new("Open points", blocks)
    }

    fn next_poses(&self) -> Vec<Block> {
        let poses = &self.found.next_poses;
        if poses.is_empty() {
            return Vec::new();
        }
        let shown = &poses[..poses.len().min(MOST_ROWS)];
        let mut table = table(shown, self.robot());
        for column in &mut table.columns {
            column.heading = sentence(&column.heading);
        }
        for cell in table.rows.iter_mut().flatten() {
            cell.shown = clean(&cell.shown);
        }
        let mut blocks = vec![
            Block::Heading("Poses that would decide".to_owned()),
            Block::Table(table),
        ];
        let new = new_reflectors(poses);
        if !new.is_empty() {
            blocks.push(Block::List(new.iter().map(|line| clean(line)).collect()));
        }
        if poses.len() > MOST_ROWS {
            blocks.push(Block::Text(format!("and {} more", poses.len() - MOST_ROWS)));
        }
        blocks
    }

    fn outliers(&self) -> Vec<Block> {
        let outliers = &self.found.outliers;
        if outliers.is_empty() {
            return Vec::new();
        }
        let mut table = Table::new(["Sample", ">Off by, mm"]);
        for outlier in outliers.iter().take(MOST_ROWS) {
            table.row([
                (outlier.sample + 1).to_string(),
                plain(outlier.deviation_mm),
            ]);
        }
        let mut text = "They count in the largest deviation and in no root mean square".to_owned();
        if outliers.len() > MOST_ROWS {
            text += &format!("; {} of {} are listed", MOST_ROWS, outliers.len());
        }
        vec![
            Block::Heading(format!(
                "Excluded outliers: {} of {} samples",
                outliers.len(),
                self.found.samples
            )),
            Block::Text(text),
            Block::Table(table),
        ]
    }

    pub(super) fn limits(&self) -> Section {
        let d = self.found;
        let mut blocks = Vec::new();
        let name = |effect: &str| title_on(effect, None, 1);
        let not_testable = limits::not_testable(d, name);
        if !not_testable.is_empty() {
            blocks.push(Block::Heading("Not testable with this session".to_owned()));
            let mut table = Table::new(["Effect", "Why"]);
            for line in not_testable.into_iter().take(4 * MOST_ROWS) {
                table.row([line.names, clean(&line.says)]);
            }
            blocks.push(Block::Table(table));
        }
        let several = self.robot().joints.len() > 1;
        let rows: Vec<[String; 2]> = if several {
            let lines = limits::limits(d, name).into_iter();
            lines.map(|line| [line.names, line.says]).collect()
        } else {
            let limits = d.not_found.iter();
            limits
                .map(|limit| [name(limit.effect), detection_limit(limit)])
                .collect()
        };
        if !rows.is_empty() {
            blocks.push(Block::Heading(
                "Not found, with detection limits".to_owned(),
            ));
            let mut table = Table::new(["Effect", "Detection limit (95 %)"]);
            for row in rows.into_iter().take(4 * MOST_ROWS) {
                table.row(row);
            }
            blocks.push(Block::Table(table));
        }
        if blocks.is_empty() {
            blocks.push(Block::Text(
                "Every effect of the catalogue is in the model".to_owned(),
            ));
        }
        Section::new("What the session could not show", blocks)
    }
}

fn sentence(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or_else(String::new, |first| {
        first.to_uppercase().collect::<String>() + chars.as_str()
    })
}
