//! What a search found: the verdict, names with their evidence, what cannot be told apart, what no
//! name explains, and what to measure next.

mod actions;
mod hidden;
mod next;

use egui::Ui;

use crate::diagnosis::{Diagnosis, Verdict};
use crate::explain::{Section, Topic};
use crate::gui::jobs::Running;
use crate::gui::style::tokens::{Palette, size, space};
use crate::gui::views::blocks::{self, Title};
use crate::gui::views::names::title;
use crate::gui::views::{copies, problems, unexplained};
use crate::gui::widgets;
use crate::gui::workbench::{Command, Workbench};
use crate::present::names::title_of;

pub(in crate::gui::views) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    widgets::heading(ui, say!("Diagnosis"));
    ui.add_space(space::TIGHT);
    widgets::scroll(ui, "findings", |ui| {
        ui.spacing_mut().item_spacing.y = space::ROW;
        let beneath = if workbench.searching().is_some() {
            under_way(ui, workbench);
            None
        } else {
            stopped(ui, workbench);
            workbench.searched()
        };
        match beneath {
            None => crate::gui::views::coverage::show(ui, workbench),
            Some(Err(because)) => widgets::hint(ui, because),
            Some(Ok(diagnosis)) => all(ui, workbench, diagnosis, commands),
        }
    });
}

/// A diagnosis is running: what it has found so far.
fn under_way(ui: &mut Ui, workbench: &Workbench) {
    let found = workbench.searching().map(Running::found);
    let says = match found.as_ref().map_or(0, Vec::len) {
        0 => say!("Nothing found so far"),
        _ => say!("Found so far; a likelier name may take the place of one"),
    };
    so_far(
        ui,
        say!("Diagnosis is running"),
        says,
        &found.unwrap_or_default(),
    );
}

/// What a diagnosis that was stopped had found until then.
fn stopped(ui: &mut Ui, workbench: &Workbench) {
    let Some(found) = workbench.stopped() else {
        return;
    };
    let says = match found.len() {
        0 => say!("It had found nothing until then"),
        _ => {
            say!(
                "Found until then, not yet tested against other names: run the diagnosis again to test them"
            )
        }
    };
    so_far(ui, say!("Diagnosis stopped"), says, found);
}

fn so_far(ui: &mut Ui, name: &str, says: &str, found: &[String]) {
    widgets::card(ui, |ui| {
        title(ui, name);
        widgets::hint(ui, says);
        for name in found {
            let label = ui.label(title_of(name));
            let id = name.split(' ').next().unwrap_or(name);
            widgets::explained_effect(label, id);
        }
    });
}

fn all(ui: &mut Ui, workbench: &Workbench, d: &Diagnosis, commands: &mut Vec<Command>) {
    let sections = workbench.diagnosis_sections();
    for section in sections.iter() {
        match section.topic {
            Topic::NotIdentifiable | Topic::Limits | Topic::NotTestable => {
                in_small(ui, section, d);
            }
            _ => {
                widgets::card(ui, |ui| {
                    heading(ui, section, d);
                    if section.topic == Topic::NextPoses {
                        next::show(ui, workbench, &d.next_poses, commands);
                    } else {
                        blocks::show(ui, &section.blocks);
                    }
                    buttons(ui, workbench, d, section, commands);
                });
            }
        }
        match section.topic {
            Topic::Answer => hidden::show(ui, workbench, d),
            Topic::DataProblem(index) if index + 1 == d.data_problems.len() => {
                problems::mend_all(ui, &d.data_problems, commands);
            }
            Topic::Found(index) if index + 1 == d.found.len() => {
                copies::button(ui, say!("found effects"), || copies::found(d));
            }
            _ => {}
        }
    }
}

/// The title of a card: in the colour of the verdict, of a mistake; an effect is explained under the pointer.
fn heading(ui: &mut Ui, section: &Section, d: &Diagnosis) {
    let palette = Palette::of(ui);
    let look = match section.topic {
        Topic::Answer => Title::Large(match d.verdict {
            Verdict::Noise | Verdict::Explained => palette.within,
            Verdict::PartlyExplained | Verdict::Unexplained => palette.warning,
        }),
        Topic::DataProblem(_) => Title::Large(palette.outside),
        Topic::Unexplained => Title::Large(palette.warning),
        Topic::Found(_) => Title::Large(palette.text),
        _ => Title::Plain,
    };
    let label = blocks::title(ui, section, look);
    if let Topic::Found(index) = section.topic {
        widgets::explained_effect(label, d.found[index].effect);
    }
}

/// What the window can do about a section.
fn buttons(
    ui: &mut Ui,
    workbench: &Workbench,
    d: &Diagnosis,
    section: &Section,
    commands: &mut Vec<Command>,
) {
    match section.topic {
        Topic::DataProblem(index) => problems::of_problem(ui, &d.data_problems[index], commands),
        Topic::Found(index) => actions::of_effect(ui, workbench, d, index, commands),
        Topic::Unexplained => unexplained::actions(ui, workbench, d, commands),
        _ => {}
    }
}

/// What is looked up once in a while, folded below its title.
fn in_small(ui: &mut Ui, section: &Section, d: &Diagnosis) {
    widgets::folded(ui, &section.title, size::SMALL, |ui| {
        blocks::show(ui, &section.blocks);
        if section.topic == Topic::Limits {
            copies::button(ui, say!("detection limits"), || copies::limits(d));
        }
    });
}
