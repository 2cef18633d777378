//! What a search found: the verdict, names with their evidence and what can be done about them, what
//! cannot be told apart, what no name explains, and what was hidden where the session was simulated.

use egui::{RichText, Ui};

use crate::diagnosis::{Diagnosis, Verdict};
use crate::effects::Term;
use crate::explain::{Section, Topic};
use crate::fit::Estimate;
use crate::gui::core::edit::Edit;
use crate::gui::core::search::term_of;
use crate::gui::jobs::Running;
use crate::gui::style::tokens::{Palette, size, space, strong};
use crate::gui::views::blocks::{self, Title};
use crate::gui::views::copies;
use crate::gui::widgets;
use crate::gui::workbench::{Command, Workbench};
use crate::kinematics::JointKind;
use crate::present::names::{parameter, title_of};
use crate::present::numbers::{significant, with_minus_signs};

use super::cards::{self, curve_link, in_words, title};

pub(super) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
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
                        super::next_poses::show(ui, workbench, &d.next_poses, commands);
                    } else {
                        blocks::show(ui, &section.blocks);
                    }
                    buttons(ui, workbench, d, section, commands);
                });
            }
        }
        match section.topic {
            Topic::Answer => hidden(ui, workbench, d),
            Topic::DataProblem(index) if index + 1 == d.data_problems.len() => {
                cards::mend_all(ui, &d.data_problems, commands);
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
        Topic::DataProblem(index) => cards::of_problem(ui, &d.data_problems[index], commands),
        Topic::Found(index) => {
            in_the_model(ui, workbench, d, index, commands);
            curve_link(ui, workbench, index, commands);
        }
        Topic::Unexplained => cards::unexplained(ui, workbench, d, commands),
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

/// Adds an effect that was found to the model, or switches it off there.
fn in_the_model(
    ui: &mut Ui,
    workbench: &Workbench,
    d: &Diagnosis,
    index: usize,
    commands: &mut Vec<Command>,
) {
    let Some(term) = term_of(d, &d.found[index]) else {
        return;
    };
    let mut added = workbench.document().added.iter();
    match added.position(|a| a.term.same_column(&term)) {
        None => {
            // The button that stands out is the one at the foot of the step, which adds all of them.
            if widgets::secondary(ui, say!("Add to model")).clicked() {
                commands.push(Command::Edit(Edit::Add(vec![term])));
            }
        }
        Some(index) => {
            let mut on = workbench.document().added[index].on;
            if ui.checkbox(&mut on, say!("in the model")).changed() {
                commands.push(Command::Edit(Edit::Switch(index, on)));
            }
        }
    }
}

/// What was hidden in the simulation, beside what was found of it: a button, and behind it the truth; nothing for a session that was not simulated here.
fn hidden(ui: &mut Ui, workbench: &Workbench, d: &Diagnosis) {
    let loaded_session = workbench.loaded_session();
    let Some(hidden) = loaded_session.hidden.as_deref() else {
        return;
    };
    // The truth of this opening: another simulation hides it again.
    let id = egui::Id::unique("hidden").with(loaded_session.lineage);
    let shown: bool = ui.data(|data| data.get_temp(id)).unwrap_or(false);
    let says = if shown {
        say!("Do not show what was hidden")
    } else {
        say!("Show what was hidden")
    };
    if widgets::secondary(ui, says).clicked() {
        ui.data_mut(|data| data.insert_temp(id, !shown));
    }
    if !shown {
        return;
    }
    widgets::card(ui, |ui| {
        title(ui, say!("Hidden in this simulation"));
        if hidden.is_empty() {
            widgets::hint(ui, say!("Nothing"));
        } else {
            widgets::hint(ui, say!("hidden → found"));
        }
        for term in hidden {
            one(ui, workbench, term, d);
        }
    });
}

/// One effect that was hidden: whether the diagnosis has it, and each size beside what was found of it.
fn one(ui: &mut Ui, workbench: &Workbench, term: &Term, d: &Diagnosis) {
    let about = term.effect.about();
    let joint = about.per_joint.then_some(term.joint + 1);
    let of_this = |one: &&Estimate| one.effect == about.id && one.joint == joint;
    let found = d
        .found
        .iter()
        .find(|f| f.effect == about.id && f.joint == joint);
    let palette = Palette::of(ui);
    let (says, color) = if found.is_some() {
        (say!("found"), palette.within)
    } else if about.role.is_of_every_calibration() {
        (say!("identified"), palette.within)
    } else {
        (say!("not found"), palette.warning)
    };
    ui.horizontal_wrapped(|ui| {
        let name = in_words(about.id, joint, workbench);
        ui.label(RichText::new(name).font(strong(size::SMALL)));
        ui.label(RichText::new(says).color(color));
    });
    let estimates: Vec<&Estimate> = match found {
        Some(found) => found.parameters.iter().collect(),
        None => d.identified.iter().filter(of_this).collect(),
    };
    let units = workbench.units();
    let joints = &workbench.loaded_session().session.robot.joints;
    let kind = joints
        .get(term.joint)
        .map_or(JointKind::Revolute, |j| j.kind);
    for hidden in term.parameters_on(kind) {
        let (name, unit) = parameter(hidden.name);
        let gap = |unit: &str| if ["", "°"].contains(&unit) { "" } else { " " }.to_owned() + unit;
        let mut says = significant(hidden.value, 3) + &gap(unit);
        if let Some(one) = estimates.iter().find(|one| one.name == hidden.name) {
            let (value, half, unit) = units.estimate(one, unit);
            let half = if half.is_empty() {
                half
            } else {
                format!(" {half}")
            };
            says += &format!(" → {value}{half}{}", gap(unit));
        }
        widgets::fact(ui, &name, with_minus_signs(&says));
    }
}
