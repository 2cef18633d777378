//! What a diagnosis found, what it leaves open, and what it could not see.

use crate::diagnosis::Found;
use crate::effects;

use super::document::{Block, Column, Section, Table, clean};
use super::parts::{fact, told};
use super::session::{MOST_ROWS, Told};
use crate::language::names::{combination, detection_limit, title_of, title_on};
use crate::language::of_core;
use crate::present::limits;
use crate::present::numbers::{mm, plain};
use crate::present::poses::{new_reflectors, table};
use crate::text::{spoken, within};

impl Told<'_> {
    pub(super) fn effects(&self) -> Option<Section> {
        let found = &self.found.found;
        if found.is_empty() {
            return None;
        }
        Some(Section {
            title: say!("Effects found").to_owned(),
            blocks: found.iter().flat_map(|f| self.effect(f)).collect(),
        })
    }

    fn effect(&self, f: &Found) -> [Block; 2] {
        let about = effects::find(f.effect).map(effects::Effect::about);
        let percent = format!("{:.1} %", f.share * 100.0);
        let unseen = f.held_out_mm.map_or_else(
            || say!("too few samples").to_owned(),
            |[before, after]| format!("{} → {} mm", plain(before), plain(after)),
        );
        let fit = format!("{} → {} mm", plain(f.gap_mm[0]), plain(f.gap_mm[1]));
        let mut facts = vec![
            fact(say!("Evidence"), sentence(&self.evidence(f))),
            fact(
                say!("RMS error, fit; cross-validated"),
                format!("{fit}; {unseen}"),
            ),
            fact(say!("Share of what was explained"), percent),
        ];
        if let Some(about) = about {
            facts.push(fact(say!("Usual cause"), spoken(about.cause)));
        }
        facts.push(fact(say!("Check on the machine"), of_core(f.check)));
        [
            Block::Heading(title_on(f.effect, f.joint, self.robot().joints.len())),
            Block::Facts(facts),
        ]
    }

    /// Why a name is believed: as [`Found::says`] has it, in the language of the report.
    fn evidence(&self, f: &Found) -> String {
        let chance = say!(
            "p {sign} {p} (chance that noise alone looks like this)",
            sign = if f.p_family.bound { '<' } else { '=' },
            p = f.p_family.p
        );
        let next = f.next.as_ref().map(|next| title_of(next));
        let over = match next.as_deref().map(within) {
            Some(next) if f.odds_over_next > 1000.0 => say!(
                "more than 1000 times likelier than the next candidate ({next})",
                next = next
            ),
            Some(next) => say!(
                "{odds} times likelier than the next candidate ({next})",
                odds = format!("{:.1}", f.odds_over_next),
                next = next
            ),
            None => say!("no other effect was a candidate").to_owned(),
        };
        let unseen = f.held_out_mm.map_or_else(String::new, |[before, after]| {
            say!(
                "; cross-validated RMS error {before} → {after} mm, floor {floor}",
                before = plain(before),
                after = plain(after),
                floor = plain(self.found.floor.mm)
            )
        });
        format!("{chance}; {over}{unseen}")
    }

    pub(super) fn open(&self) -> Section {
        let d = self.found;
        let mut blocks = Vec::new();
        for problem in &d.data_problems {
            blocks.push(Block::Heading(say!(
                "Data: {problem}",
                problem = told(&problem.what)
            )));
            blocks.push(Block::Facts(vec![
                fact(say!("Evidence"), told(&problem.evidence)),
                fact(say!("Proposal"), told(&problem.proposal)),
            ]));
        }
        if d.unexplained.present {
            blocks.push(Block::Heading(say!("Left without a name").to_owned()));
            let mut facts = vec![
                fact(
                    say!("Size"),
                    say!("{size} root mean square", size = mm(d.unexplained.rms_mm)),
                ),
                fact(say!("Evidence"), told(&d.unexplained.says)),
            ];
            if let Some(place) = &d.unexplained.place {
                facts.push(fact(say!("Where"), told(&place.says())));
            }
            if !d.unexplained.resembles.is_empty() {
                let names = d.unexplained.resembles.iter().map(|n| title_of(n));
                facts.push(fact(
                    say!("Resembles in part"),
                    names.collect::<Vec<_>>().join(", "),
                ));
            }
            blocks.push(Block::Facts(facts));
        }
        if let Some(unnamed) = &d.unnamed {
            blocks.push(Block::Heading(say!("Predicts without a name").to_owned()));
            blocks.push(Block::Facts(vec![fact(
                say!("In the model"),
                of_core(&unnamed.says()),
            )]));
        }
        if !d.equivalent.is_empty() {
            blocks.push(Block::Heading(
                say!("Names that the samples cannot tell apart").to_owned(),
            ));
            let mut table = Table::of([
                Column::words(say!("In the model")),
                Column::words(say!("Could be instead")),
                Column::numbers(say!("Odds against")),
                Column::words(say!("What would tell")),
            ]);
            for rival in &d.equivalent {
                table.row([
                    titles(&rival.explanation),
                    titles(&rival.instead),
                    format!("{:.1} : 1", rival.odds),
                    told(&rival.separate_by),
                ]);
            }
            blocks.push(Block::Table(table));
        }
        if !d.identification.not_identifiable.is_empty() {
            blocks.push(Block::Heading(say!("Not identifiable").to_owned()));
            let mut table = Table::of([
                Column::words(say!("Parameter or combination")),
                Column::words(say!("Why")),
            ]);
            for open in d.identification.not_identifiable.iter().take(4 * MOST_ROWS) {
                table.row([combination(&clean(&open.combination)), told(&open.because)]);
            }
            blocks.push(Block::Table(table));
        }
        blocks.extend(self.next_poses());
        blocks.extend(self.outliers());
        if let Some(says) = d.identification.excluded_in_words() {
            blocks.push(Block::Heading(say!("Samples excluded by hand").to_owned()));
            blocks.push(Block::Text(says));
        }
        if blocks.is_empty() {
            let mut text = say!(
                "Nothing in these samples: no data problem, no rival explanation, nothing left without a name, no outlier"
            )
            .to_owned();
            if !self.given.note.trim().is_empty() {
                text += say!(". The note says where they come from");
            }
            blocks.push(Block::Text(text));
        }
        Section::new(say!("Open points"), blocks)
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
        for row in &mut table.rows {
            for cell in row.iter_mut() {
                cell.shown = clean(&cell.shown);
            }
            // Why, as the core says it.
            if let Some(why) = row.last_mut() {
                why.shown = of_core(&why.shown).into_owned();
            }
        }
        let mut blocks = vec![
            Block::Heading(say!("Poses that would decide").to_owned()),
            Block::Table(table),
        ];
        let new = new_reflectors(poses);
        if !new.is_empty() {
            blocks.push(Block::List(new.iter().map(|line| clean(line)).collect()));
        }
        if poses.len() > MOST_ROWS {
            let more = poses.len() - MOST_ROWS;
            blocks.push(Block::Text(say!("and {more} more", more = more)));
        }
        blocks
    }

    fn outliers(&self) -> Vec<Block> {
        let outliers = &self.found.outliers;
        if outliers.is_empty() {
            return Vec::new();
        }
        let mut table = Table::of([
            Column::words(say!("Sample")),
            Column::numbers(say!("Off by, mm")),
        ]);
        for outlier in outliers.iter().take(MOST_ROWS) {
            table.row([
                (outlier.sample + 1).to_string(),
                plain(outlier.deviation_mm),
            ]);
        }
        let mut text =
            say!("They count in the largest deviation and in no root mean square").to_owned();
        if outliers.len() > MOST_ROWS {
            text += &say!(
                "; {listed} of {all} are listed",
                listed = MOST_ROWS,
                all = outliers.len()
            );
        }
        vec![
            Block::Heading(say!(
                "Excluded outliers: {excluded} of {all} samples",
                excluded = outliers.len(),
                all = self.found.samples
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
            blocks.push(Block::Heading(
                say!("Not testable with this session").to_owned(),
            ));
            let mut table = Table::of([Column::words(say!("Effect")), Column::words(say!("Why"))]);
            for line in not_testable.into_iter().take(4 * MOST_ROWS) {
                table.row([line.names, told(&line.says)]);
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
                say!("Not found, with detection limits").to_owned(),
            ));
            let mut table = Table::of([
                Column::words(say!("Effect")),
                Column::words(say!("Detection limit (95 %)")),
            ]);
            for row in rows.into_iter().take(4 * MOST_ROWS) {
                table.row(row);
            }
            blocks.push(Block::Table(table));
        }
        if blocks.is_empty() {
            blocks.push(Block::Text(
                say!("Every effect of the catalogue is in the model").to_owned(),
            ));
        }
        Section::new(say!("What the session could not show"), blocks)
    }
}

/// Names of effects, each with its joint, that explain something together.
fn titles(names: &[String]) -> String {
    let titles: Vec<String> = names.iter().map(|name| title_of(name)).collect();
    titles.join(" + ")
}

fn sentence(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or_else(String::new, |first| {
        first.to_uppercase().collect::<String>() + chars.as_str()
    })
}
