//! What a search found: the verdict, names with their evidence, what cannot be told apart, what no
//! name explains, and what to measure next.

use egui::{CollapsingHeader, Grid, RichText, Ui};

use crate::diagnosis::next_poses::NextPose;
use crate::diagnosis::{Diagnosis, FloorFrom, Found, Mend, Sight, Verdict};
use crate::effects::find;
use crate::gui::commands::{Command, Workbench};
use crate::gui::edit::Edit;
use crate::gui::help;
use crate::gui::search::term_of;
use crate::gui::tasks::What;
use crate::gui::tokens::{Palette, size, space, strong};
use crate::gui::units::{significant, trimmed, with_interval};
use crate::gui::view::Chart;
use crate::gui::widgets::{self, dense};
use crate::identification::Estimate;
use crate::kinematics::JointKind;
use crate::units::deg_from_rad;

use super::results::named;
use super::unexplained;

/// Shows the right-hand side of the step.
pub(super) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    widgets::heading(ui, "What is missing");
    ui.add_space(space::TIGHT);
    widgets::scroll(ui, "findings", |ui| {
        ui.spacing_mut().item_spacing.y = space::ROW;
        match workbench.searched() {
            None => super::known::show(ui, workbench),
            Some(Err(because)) => widgets::hint(ui, because),
            Some(Ok(diagnosis)) => all(ui, workbench, diagnosis, commands),
        }
    });
}

fn all(ui: &mut Ui, workbench: &Workbench, d: &Diagnosis, commands: &mut Vec<Command>) {
    verdict(ui, workbench, d);
    data_problems(ui, d, commands);
    for (index, found) in d.found.iter().enumerate() {
        widgets::card(ui, |ui| {
            card(ui, workbench, d, found, commands);
            curve_link(ui, workbench, index, commands);
        });
    }
    equivalent(ui, d);
    unexplained::card(ui, workbench, d, commands);
    if !d.next_poses.is_empty() {
        widgets::card(ui, |ui| next_poses(ui, workbench, &d.next_poses, commands));
    }
    suspected(ui, workbench, d);
    limits(ui, d);
    not_testable(ui, d);
}

fn title(ui: &mut Ui, text: &str) {
    ui.label(RichText::new(text).font(strong(size::BODY)));
}

/// A name in words, with its joint where there are several.
fn in_words(id: &str, joint: Option<usize>, workbench: &Workbench) -> String {
    let title = find(id).map_or(id, |e| e.about().title);
    let joints = workbench.subject().session.robot.joints.len();
    match joint {
        Some(joint) if joints > 1 => format!("{title}, joint {joint}"),
        _ => title.to_owned(),
    }
}

pub(super) fn titles(ids: &[&str]) -> String {
    let title = |id: &&str| find(id).map_or(*id, |e| e.about().title).to_lowercase();
    ids.iter().map(title).collect::<Vec<_>>().join(" and ")
}

fn verdict(ui: &mut Ui, workbench: &Workbench, d: &Diagnosis) {
    let palette = Palette::of(ui);
    let units = workbench.units();
    let (says, color) = match d.verdict {
        Verdict::Noise => ("Nothing is missing", palette.within),
        Verdict::Explained => ("The gap is explained", palette.within),
        Verdict::PartlyExplained => ("A part of the gap is explained", palette.warning),
        Verdict::Unexplained => ("No name explains what is left", palette.warning),
    };
    let from = match d.floor.from {
        FloorFrom::Repeats => "from repeats",
        FloorFrom::Instrument => "of the instrument",
        FloorFrom::Estimated => "estimated",
    };
    widgets::card(ui, |ui| {
        let says = RichText::new(says).font(strong(size::HEADING));
        ui.label(says.color(color));
        if !d.equivalent.is_empty() {
            let also = "the samples also allow another explanation, see below";
            ui.label(RichText::new(also).color(palette.warning));
        }
        let mm = |mm: f64| units.length_number(mm);
        let gaps = format!(
            "{} → {} → {} {}",
            mm(d.gap.start_mm),
            mm(d.gap.identified_mm),
            mm(d.gap.end_mm),
            units.length_name()
        );
        widgets::fact(ui, "gap", gaps);
        if let Some(unseen) = &d.held_out.gaps {
            let gaps = format!("{} → {}", mm(unseen.identified_mm), mm(unseen.end_mm));
            widgets::fact(ui, "held out", format!("{gaps} {}", units.length_name()));
        }
        let floor = format!("{}, {from}", units.length(d.floor.mm));
        widgets::fact(ui, "noise floor", floor);
        widgets::hint(ui, format!("Held out: {}", d.held_out.how));
    });
}

fn data_problems(ui: &mut Ui, d: &Diagnosis, commands: &mut Vec<Command>) {
    let palette = Palette::of(ui);
    let mends: Vec<_> = d
        .data_problems
        .iter()
        .filter_map(|p| p.mend.clone())
        .collect();
    for problem in &d.data_problems {
        widgets::card(ui, |ui| {
            let text = RichText::new(&problem.what).font(strong(size::BODY));
            ui.label(text.color(palette.outside));
            widgets::hint(ui, &problem.evidence);
            ui.label(&problem.proposal);
            if !problem.samples.is_empty() && ui.link("Show these samples").clicked() {
                commands.push(Command::Mark(problem.samples.clone()));
            }
            let Some(mend) = &problem.mend else {
                return;
            };
            if widgets::secondary(ui, &mend.says()).clicked() {
                commands.push(Command::Edit(Edit::Mend(vec![mend.clone()])));
            }
        });
    }
    if mends.len() > 1 {
        let text = format!("Mend all {}", mends.len());
        if widgets::secondary(ui, &text).clicked() {
            commands.push(Command::Edit(Edit::Mend(in_order(mends))));
        }
    }
}

/// Samples are removed last, all at once: until then they have their numbers.
fn in_order(mends: Vec<Mend>) -> Vec<Mend> {
    let mut rows = Vec::new();
    let mut ordered = Vec::new();
    for mend in mends {
        match mend {
            Mend::Remove(some) => rows.extend(some),
            other => ordered.push(other),
        }
    }
    rows.sort_unstable();
    rows.dedup();
    if !rows.is_empty() {
        ordered.push(Mend::Remove(rows));
    }
    ordered
}

fn estimates(ui: &mut Ui, id: &str, parameters: &[Estimate]) {
    let palette = Palette::of(ui);
    Grid::new(("found", id))
        .num_columns(3)
        .spacing([10.0, 4.0])
        .min_col_width(0.0)
        .show(ui, |ui| {
            for one in parameters {
                let (name, unit) = named(one.name);
                let (value, half) = with_interval(one.value, one.ci95);
                ui.label(name);
                widgets::cell_right(ui, RichText::new(value).font(strong(size::BODY)));
                ui.label(RichText::new(format!("{half} {unit}")).color(palette.muted));
                ui.end_row();
            }
        });
}

fn card(
    ui: &mut Ui,
    workbench: &Workbench,
    d: &Diagnosis,
    found: &Found,
    commands: &mut Vec<Command>,
) {
    let units = workbench.units();
    let name = in_words(found.effect, found.joint, workbench);
    let head = ui.label(RichText::new(&name).font(strong(size::HEADING)));
    widgets::explained_effect(head, found.effect);
    ui.scope(|ui| {
        dense(ui);
        estimates(ui, found.effect, &found.parameters);
        let bound = if found.p_family.bound {
            "fewer than "
        } else {
            ""
        };
        let sessions = (1.0 / found.p_family.p).round();
        widgets::hint_about(
            ui,
            format!("Noise alone would look like this in {bound}1 of {sessions} sessions"),
            help::P_FAMILY,
        );
        if let Some(next) = &found.next {
            let odds = if found.odds_over_next > 1000.0 {
                "More than 1000".to_owned()
            } else {
                significant(found.odds_over_next, 2)
            };
            let next = find(next).map_or(next.as_str(), |e| e.about().title);
            let next = next.to_lowercase();
            let text = format!("{odds} : 1 over the next name, {next}");
            widgets::hint_about(ui, text, help::ODDS);
        }
    });
    let mm = |mm: f64| units.length_number(mm);
    let from_to = |[a, b]: [f64; 2]| format!("{} → {} {}", mm(a), mm(b), units.length_name());
    match found.held_out_mm {
        Some(gap) => widgets::fact(ui, "held-out gap", from_to(gap)),
        None => widgets::fact(ui, "gap", from_to(found.gap_mm)),
    }
    widgets::fact(ui, "noise floor", units.length(d.floor.mm));
    ui.label(RichText::new("What to check").font(strong(size::SMALL)));
    widgets::hint(ui, found.check);
    let Some(term) = term_of(d, found) else {
        return;
    };
    let mut added = workbench.document().added.iter();
    match added.position(|a| a.term.same_column(&term)) {
        None => {
            // One thing stands out: with several names it is to add them all.
            let button = if super::gap::missing(workbench).len() > 1 {
                widgets::secondary(ui, "Add to model")
            } else {
                widgets::primary(ui, "Add to model")
            };
            if button.clicked() {
                commands.push(Command::Edit(Edit::Add(vec![term])));
            }
        }
        Some(index) => {
            let mut on = workbench.document().added[index].on;
            if ui.checkbox(&mut on, "in the model").changed() {
                commands.push(Command::Edit(Edit::Switch(index, on)));
            }
        }
    }
}

/// Shows what an effect does, in the chart.
pub(super) fn curve_link(
    ui: &mut Ui,
    workbench: &Workbench,
    index: usize,
    commands: &mut Vec<Command>,
) {
    let view = workbench.view();
    let shown = workbench.chart() == Chart::Effect && view.effect == index;
    let button = ui.add_enabled_ui(!shown, |ui| widgets::secondary(ui, "Show its curve"));
    if button.inner.clicked() {
        commands.push(Command::ShowEffect(index));
    }
}

fn equivalent(ui: &mut Ui, d: &Diagnosis) {
    if d.equivalent.is_empty() {
        return;
    }
    widgets::card(ui, |ui| {
        title(ui, "The samples cannot rule out");
        for one in &d.equivalent {
            ui.label(format!(
                "{} instead of {}",
                titles(&one.instead),
                titles(&one.explanation)
            ));
            let odds = significant(one.odds, 2);
            widgets::hint(ui, format!("{odds} : 1 against it. {}", one.separate_by));
        }
    });
}

fn next_poses(ui: &mut Ui, workbench: &Workbench, poses: &[NextPose], commands: &mut Vec<Command>) {
    const MOST: usize = 24;
    let palette = Palette::of(ui);
    let robot = &workbench.subject().session.robot;
    title(ui, "Measure these poses next");
    Grid::new("next poses")
        .num_columns(4)
        .spacing([14.0, 4.0])
        .min_col_width(0.0)
        .show(ui, |ui| {
            for head in ["pose", "from", "reflector", "conditions"] {
                ui.label(RichText::new(head).size(size::SMALL).color(palette.muted));
            }
            ui.end_row();
            for pose in poses.iter().take(MOST) {
                let q = pose.q.iter().zip(&robot.joints);
                let q = q.map(|(q, joint)| match joint.kind {
                    JointKind::Revolute => format!("{}°", trimmed(deg_from_rad(*q), 2)),
                    JointKind::Prismatic => format!("{} mm", trimmed(*q, 2)),
                });
                ui.label(q.collect::<Vec<_>>().join(" "))
                    .on_hover_text(&pose.why);
                let side = |d: &f64| match *d {
                    d if d > 0.0 => "+",
                    d if d < 0.0 => "−",
                    _ => "any",
                };
                ui.label(pose.dir.iter().map(side).collect::<Vec<_>>().join(" "));
                ui.label(pose.target.as_deref().unwrap_or(""));
                ui.label(conditions(pose, robot.joints[0].kind));
                ui.end_row();
            }
        });
    if widgets::secondary(ui, "Save measuring list…").clicked() {
        commands.push(Command::ChooseWhereToExport(What::Poses));
    }
}

fn conditions(pose: &NextPose, kind: JointKind) -> String {
    let speed = pose.speed.iter().flatten().map(|v| match kind {
        JointKind::Revolute => format!("{}°/s", trimmed(deg_from_rad(*v), 2)),
        JointKind::Prismatic => format!("{} mm/s", trimmed(*v, 2)),
    });
    let load = pose.load_kg.map(|kg| format!("{} kg", trimmed(kg, 2)));
    let warm = pose.temperature_c.map(|t| format!("{} °C", trimmed(t, 1)));
    let all: Vec<String> = speed.chain(load).chain(warm).collect();
    all.join(", ")
}

fn suspected(ui: &mut Ui, workbench: &Workbench, d: &Diagnosis) {
    const MOST: usize = 8;
    if d.outliers.is_empty() {
        return;
    }
    widgets::card(ui, |ui| {
        title(ui, "Suspected samples");
        for one in d.outliers.iter().take(MOST) {
            let off = workbench.units().length(one.deviation_mm);
            widgets::fact(ui, &format!("sample {}", one.sample + 1), off);
        }
        if d.outliers.len() > MOST {
            widgets::hint(ui, format!("and {} more", d.outliers.len() - MOST));
        }
    });
}

fn folded(ui: &mut Ui, text: String, contents: impl FnOnce(&mut Ui)) {
    let muted = Palette::of(ui).muted;
    let title = RichText::new(text.clone()).size(size::SMALL).color(muted);
    CollapsingHeader::new(title)
        .id_salt(text)
        .show(ui, contents);
}

fn limits(ui: &mut Ui, d: &Diagnosis) {
    if d.not_found.is_empty() {
        return;
    }
    let text = format!("What would have been seen: {} effects", d.not_found.len());
    folded(ui, text, |ui| {
        for limit in &d.not_found {
            ui.label(find(limit.effect).map_or(limit.effect, |e| e.about().title));
            let sizes = limit.sizes.iter().map(|(name, size)| {
                let (name, unit) = named(name);
                match Sight::of(*size) {
                    Sight::Above(size) => {
                        format!("{name} above {} {unit} (95 %)", significant(size, 2))
                    }
                    Sight::AtAnySize => format!("{name} of any size: there is no noise"),
                    Sight::AtNoSize => format!("{name} at no size, by these poses"),
                }
            });
            widgets::hint(ui, sizes.collect::<Vec<_>>().join(", "));
        }
    });
}

fn not_testable(ui: &mut Ui, d: &Diagnosis) {
    if d.not_testable.is_empty() {
        return;
    }
    let text = format!("Not testable: {} effects", d.not_testable.len());
    folded(ui, text, |ui| {
        for one in &d.not_testable {
            ui.label(find(one.effect).map_or(one.effect, |e| e.about().title));
            widgets::hint(ui, &one.because);
        }
    });
}
