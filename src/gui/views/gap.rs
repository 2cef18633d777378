//! Step 4: search for what is missing.

use std::borrow::Cow;

use egui::{
    Checkbox, CursorIcon, ProgressBar, RichText, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo,
    vec2,
};

use crate::diagnosis::{Diagnosis, Verdict};
use crate::effects::Term;
use crate::explain::{Block, Detail, Section, Topic, found_effect};
use crate::fit::Estimate;
use crate::gui::actions;
use crate::gui::charts::{Shown, effect};
use crate::gui::core::document::Method;
use crate::gui::core::search::term_of;
use crate::gui::jobs::Running;
use crate::gui::plots;
use crate::gui::style::{Palette, size, space, strong};
use crate::gui::view::{Step, What};
use crate::gui::views::blocks::{self, curve_link, in_words};
use crate::gui::views::copies;
use crate::gui::widgets::{self, Buttons, Does, Forms, Words};
use crate::gui::workbench::Workbench;
use crate::kinematics::JointKind;
use crate::present::names::{parameter, title_of};
use crate::present::numbers::{significant, with_minus_signs};
use crate::text::{capital, within};

pub(super) fn show(ui: &mut Ui, workbench: &Workbench) {
    if workbench.loaded_session().is_empty() {
        ui.hint(say!("Open a session that was measured on this robot"));
        return;
    }
    if let Some(running) = workbench.searching() {
        return under_way_here(ui, running, workbench);
    }
    if workbench.diagnosis().is_some() {
        let again = ui.secondary(say!("Run diagnosis again"));
        again.does(workbench, Workbench::search);
    } else {
        before(ui, workbench);
    }
    // Without a diagnosis it was restored after a kill, or the samples are others: what was added stays in the model.
    switches(ui, workbench);
}

/// What the search does, where the work stands, and what it takes the place of.
fn before(ui: &mut Ui, workbench: &Workbench) {
    ui.hint(say!(
        "Finds the physical effects that the model lacks. Each is checked on samples that its fit has not used (cross-validation)"
    ));
    let left_mm = workbench
        .answer()
        .map(|a| a.identification.gap.after.rms_mm);
    let floor_mm = workbench.loaded_session().coverage.floor_mm;
    if let (Some(left), Some(floor)) = (left_mm, floor_mm) {
        ui.hint(if left < 1.2 * floor {
            say!("Little error is left above the instrument's noise. The diagnosis says where nothing is missing, with the detection limits")
        } else {
            say!("More error is left than noise explains: something is missing in the model")
        });
    }
    let document = workbench.document();
    if document.loaded_model.is_some() || document.identified && document.method == Method::Regional
    {
        ui.hint(say!(
            "The diagnosis starts from the full model, which takes the place of what is identified now. Undo brings that back"
        ));
    }
}

/// How far the search is; the results name what was found, where they are in sight.
fn under_way_here(ui: &mut Ui, running: &Running, workbench: &Workbench) {
    ui.section(say!("Diagnosis is running"));
    if !actions::layout(ui.ctx(), workbench).results() {
        names(ui, &running.found());
    }
    let bar = ProgressBar::new(running.progress().unwrap_or(0.0));
    ui.add(bar.desired_height(8.0).fill(Palette::of(ui).accent));
    widgets::look_again_soon(ui);
}

/// What each effect is worth: switched off and on.
pub(super) fn switches(ui: &mut Ui, workbench: &Workbench) {
    let added = &workbench.document().added;
    if added.is_empty() {
        return;
    }
    ui.section(&capital(say!("in the model")));
    for (index, one) in added.iter().enumerate() {
        let mut on = one.on;
        let name = in_words(&one.term, workbench);
        let switch = Checkbox::new(&mut on, &name);
        let name = say!("use {effect}", effect = within(&name));
        if ui.named(name, switch).changed() {
            workbench.edits(move |document| document.switch(&[index], on));
        }
    }
}

pub(super) fn next(ui: &mut Ui, workbench: &Workbench) {
    if workbench.searching().is_some() {
        // It lies where it was started: the second click of a double click is not meant for it.
        let meant = widgets::has_stood(ui, "stop the search");
        let stop = |ui: &mut Ui| ui.secondary(say!("Stop the search"));
        let stop = ui.add_enabled_ui(meant, stop).inner;
        return stop.does(workbench, Workbench::stop_search);
    }
    let names = workbench.not_added();
    let missing = [names.clone(), workbench.predicting_not_added()].concat();
    if workbench.diagnosis().is_none() {
        actions::SEARCH.next(ui, workbench);
    } else if !missing.is_empty() {
        // What was found comes before the table that would leave it uncorrected.
        let says = match names.len() {
            0 => say!("Add the predictive part to the model").to_owned(),
            count => blocks::add_all(count),
        };
        ui.primary(&says)
            .does(workbench, move |bench| bench.edit(|d| d.add(&missing)));
    } else {
        actions::go_on(ui, workbench, Step::Export);
    }
}

// What a search found: the verdict, names with their evidence and what can be done about them, what
// cannot be told apart, what no name explains, what to measure next, and what was hidden where the session was
// simulated.

pub(super) fn findings(ui: &mut Ui, workbench: &Workbench) {
    ui.heading(say!("Diagnosis"));
    ui.add_space(space::TIGHT);
    widgets::scroll(ui, "findings", |ui| {
        ui.spacing_mut().item_spacing.y = space::ROW;
        let beneath = if let Some(running) = workbench.searching() {
            let says = say!("Found so far; a likelier name may take the place of one");
            so_far(ui, say!("Diagnosis is running"), says, &running.found());
            None
        } else {
            if let Some(found) = workbench.stopped() {
                let says = say!(
                    "Found until then, not yet tested against other names: run the diagnosis again to test them"
                );
                so_far(ui, say!("Diagnosis stopped"), says, found);
            }
            workbench.searched()
        };
        match beneath {
            None => crate::gui::views::results::beforehand(ui, workbench),
            Some(Err(because)) => ui.hint(because),
            Some(Ok(diagnosis)) => all(ui, workbench, diagnosis),
        }
    });
}

/// What a diagnosis that is running has found so far, or one that was stopped until then.
fn so_far(ui: &mut Ui, name: &str, says: &str, found: &[String]) {
    widgets::card(ui, |ui| {
        ui.bold(name);
        if !found.is_empty() {
            ui.hint(says);
        }
        names(ui, found);
    });
}

fn names(ui: &mut Ui, found: &[String]) {
    for name in found {
        let label = ui.label(title_of(name));
        let id = name.split(' ').next().unwrap_or(name);
        widgets::explained_effect(label, id);
    }
}

fn all(ui: &mut Ui, workbench: &Workbench, d: &Diagnosis) {
    let sections = workbench.diagnosis_sections();
    for section in sections.iter() {
        match section.topic {
            Topic::NotIdentifiable | Topic::Limits | Topic::NotTestable => {
                in_small(ui, section);
            }
            _ => {
                widgets::card(ui, |ui| {
                    heading(ui, section, d);
                    match section.topic {
                        Topic::Found(k) => effect_card(ui, workbench, (d, k, section)),
                        _ => blocks::show(ui, &section.blocks),
                    }
                    buttons(ui, workbench, d, section);
                });
            }
        }
        match section.topic {
            Topic::Answer => hidden(ui, workbench, d),
            Topic::DataProblem(index) if index + 1 == d.data_problems.len() => {
                blocks::mend_all(ui, &d.data_problems, workbench);
            }
            Topic::Found(index) if index + 1 == d.found.len() => {
                copies::button(ui, workbench, say!("found effects"), || copies::found(d));
            }
            _ => {}
        }
    }
}

/// The title of a card: in the colour of the verdict, of a mistake; an effect is explained under the pointer.
fn heading(ui: &mut Ui, section: &Section, d: &Diagnosis) {
    let palette = Palette::of(ui);
    let look = match section.topic {
        Topic::Answer => Some(match d.verdict {
            Verdict::Noise | Verdict::Explained => palette.within,
            Verdict::PartlyExplained | Verdict::Unexplained => palette.warning,
        }),
        Topic::DataProblem(_) => Some(palette.outside),
        Topic::Unexplained => Some(palette.warning),
        Topic::Found(_) => Some(palette.text),
        _ => None,
    };
    let label = blocks::title(ui, section, look);
    if let Topic::Found(index) = section.topic {
        widgets::explained_effect(label, d.found[index].effect);
    }
}

/// What the window can do about a section.
fn buttons(ui: &mut Ui, workbench: &Workbench, d: &Diagnosis, section: &Section) {
    match section.topic {
        Topic::DataProblem(index) => blocks::of_problem(ui, &d.data_problems[index], workbench),
        Topic::Unnamed => blocks::unexplained(ui, workbench, d),
        Topic::NextPoses => {
            let save = ui.secondary(&widgets::dots(say!("Save measuring list")));
            save.does(workbench, |bench| bench.choose_where_to_export(What::Poses));
        }
        _ => {}
    }
}

/// What is looked up once in a while, folded below its title.
fn in_small(ui: &mut Ui, section: &Section) {
    ui.folded(&section.title, |ui| {
        blocks::show(ui, &section.blocks);
    });
}

/// What was hidden in the simulation, beside what was found of it, on demand; nothing for a session that was not simulated here.
fn hidden(ui: &mut Ui, workbench: &Workbench, d: &Diagnosis) {
    let loaded_session = workbench.loaded_session();
    let Some(hidden) = loaded_session.hidden.as_deref() else {
        return;
    };
    // The truth of this opening: another simulation hides it again.
    ui.push_id(loaded_session.lineage, |ui| {
        ui.folded(say!("Show what was hidden"), |ui| {
            if hidden.is_empty() {
                ui.hint(say!("Nothing"));
            }
            for term in hidden {
                one(ui, workbench, term, d);
            }
        });
    });
}

/// One effect that was hidden: whether the diagnosis has it, and each size beside what was found of it.
fn one(ui: &mut Ui, workbench: &Workbench, term: &Term, d: &Diagnosis) {
    let about = term.effect.about();
    let joint = about.per_joint.then_some(term.joint + 1);
    let of_this = |one: &&Estimate| one.effect == about.id && one.joint == joint;
    let mut found = d.found.iter();
    let found = found.find(|f| f.effect == about.id && f.joint == joint);
    let palette = Palette::of(ui);
    let (says, color) = if found.is_some() {
        (say!("found"), palette.within)
    } else if about.role.is_of_every_calibration() {
        (say!("identified"), palette.within)
    } else {
        (say!("not found"), palette.warning)
    };
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(in_words(term, workbench)).font(strong(size::SMALL)));
        ui.colored_label(color, says);
    });
    let estimates: Vec<&Estimate> = match found {
        Some(found) => found.parameters.iter().collect(),
        None => d.identified.iter().filter(of_this).collect(),
    };
    let units = workbench.units();
    let joints = &workbench.loaded_session().session.robot.joints;
    let joint = joints.get(term.joint);
    let kind = joint.map_or(JointKind::Revolute, |joint| joint.kind);
    for hidden in term.parameters_on(kind) {
        let (name, unit) = parameter(hidden.name);
        let gap = |unit: &str| if ["", "°"].contains(&unit) { "" } else { " " }.to_owned() + unit;
        let mut says = significant(hidden.value, 3) + &gap(unit);
        if let Some(one) = estimates.iter().find(|one| one.name == hidden.name) {
            let (value, half, unit) = units.estimate(one, unit);
            let value = format!("{value} {half}");
            says += &format!(" → {}{}", value.trim_end(), gap(unit));
        }
        ui.fact(&name, with_minus_signs(&says));
    }
}

/// What stands below its title.
fn effect_card(
    ui: &mut Ui,
    workbench: &Workbench,
    (d, index, section): (&Diagnosis, usize, &Section),
) {
    let section = in_use(workbench, d, index).map_or(Cow::Borrowed(section), Cow::Owned);
    let is_facts = |block: &&Block| matches!(block, Block::Facts(_));
    let rest = section.blocks.iter().skip(1).position(|b| is_facts(&b));
    let (first, more) = section.blocks.split_at(rest.map_or(0, |rest| rest + 1));
    blocks::show(ui, first);
    match workbench.sketch(index) {
        Some(shown) => sketch(ui, workbench, index, shown),
        None => curve_link(ui, workbench, index),
    }
    // The button that stands out is the one at the foot of the step, which adds all of them.
    let term = term_of(d, &d.found[index]).into_iter().collect();
    let says = [&capital(say!("add to model")), say!("in the model")];
    blocks::in_the_model(ui, workbench, Vec::new(), term, says);
    ui.push_id(index, |ui| {
        ui.folded(say!("More"), |ui| blocks::show(ui, more));
    });
}

/// The same with the sizes that the model in use has: with fewer effects in it, it is another fit than the search's.
fn in_use(workbench: &Workbench, d: &Diagnosis, index: usize) -> Option<Section> {
    let found = &d.found[index];
    let term = term_of(d, found)?;
    let mut added = workbench.document().in_the_model();
    added.find(|t| t.same_column(&term))?;
    let all = &workbench.answer()?.identification.parameters;
    let of_it = |one: &&Estimate| one.effect == found.effect && one.joint == found.joint;
    let sizes: Vec<Estimate> = all.iter().filter(of_it).cloned().collect();
    let detail = Detail::window(workbench.units());
    (!sizes.is_empty()).then(|| found_effect(d, detail, index, &sizes))
}

/// Height of a small curve, points.
const HIGH: f32 = 46.0;

/// What is left without the effect, and what it does; a click shows the chart of it.
fn sketch(ui: &mut Ui, workbench: &Workbench, index: usize, curve: &Shown) {
    let palette = Palette::of(ui);
    let shown = workbench.shows(effect::ID) && workbench.view.effect == index;
    let sense = [Sense::click(), Sense::hover()][usize::from(shown)];
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), HIGH), sense);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, !shown, say!("Show its curve")));
    let edge = if shown || response.hovered() || response.has_focus() {
        palette.accent
    } else {
        palette.line
    };
    let round = f32::from(space::ROUND);
    let edge = Stroke::new(1.0, edge);
    ui.painter()
        .rect(rect, round, palette.surface, edge, StrokeKind::Inside);
    plots::chart::sketch(ui.painter(), rect.shrink(3.0), curve, &palette);
    response.does(workbench, move |bench| bench.show_effect(index));
    if !shown {
        let response = response.on_hover_cursor(CursorIcon::PointingHand);
        response.on_hover_text(say!("Show its curve"));
    }
}
