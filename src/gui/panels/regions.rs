//! Step 2: where the joint gets corrections of its own.

use std::sync::{Arc, Weak};

use egui::{DragValue, Grid, RichText, TextEdit, Ui};

use crate::gui::boundaries;
use crate::gui::commands::{Command, Workbench};
use crate::gui::document::Method;
use crate::gui::edit::Edit;
use crate::gui::subject::Subject;
use crate::gui::tokens::{Palette, size};
use crate::gui::view::Step;
use crate::gui::widgets;
use crate::identification::regions::Assignment;
use crate::sessions::Region;
use crate::units::{deg_from_rad, rad_from_deg};

/// More regions than this are too many to be listed with fields.
const MOST_LISTED: usize = 60;

/// Shows the step.
pub(crate) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    if !workbench.subject().single_revolute() {
        widgets::hint(
            ui,
            "Regions are the paper's method for a single joint that turns. This robot is \
             identified by the exact fit: continue to the next step",
        );
        return;
    }
    if workbench.subject().is_empty() {
        widgets::hint(
            ui,
            "Regions divide what was measured: open a session that was measured on this robot",
        );
        return;
    }
    widgets::hint(
        ui,
        "Each region gets a correction of its own. Drag a boundary on the plot, or type it; \
         the identification follows at once",
    );
    divide(ui, workbench, commands);
    widgets::section(ui, "Boundaries and samples");
    table(ui, workbench, commands);
}

fn divide(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    widgets::section(ui, "Divide evenly");
    let id = ui.scope_id().with("number of regions");
    let present = workbench.document().regions.len().max(1);
    let mut number = ui.data_mut(|data| data.get_temp(id)).unwrap_or(present);
    ui.horizontal(|ui| {
        let field = DragValue::new(&mut number)
            .range(1..=360)
            .suffix(" regions");
        widgets::cell_number(ui, "Number of regions", 110.0, field);
        if ui.button("Divide").clicked() {
            commands.push(Command::Edit(Edit::Divide(number)));
        }
        let own = &workbench.subject().session.regions;
        if !own.is_empty() && own[..] != workbench.document().regions[..] {
            let button = ui.button("From session");
            if button
                .on_hover_text("take the regions that the session brings along")
                .clicked()
            {
                commands.push(Command::Edit(Edit::RegionsOfSession));
            }
        }
    });
    ui.data_mut(|data| data.insert_temp(id, number));
}

fn table(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let regions = &workbench.document().regions;
    let palette = Palette::of(ui);
    let counts = counted(ui, workbench);
    let all = boundaries::boundaries(regions);
    Grid::new("regions")
        .num_columns(5)
        .spacing([6.0, 4.0])
        .min_col_width(0.0)
        .show(ui, |ui| {
            for title in ["name", "from", "to", "samples", ""] {
                ui.label(RichText::new(title).size(size::SMALL).color(palette.muted));
            }
            ui.end_row();
            for (k, region) in regions.iter().enumerate().take(MOST_LISTED) {
                name_field(ui, k, &region.name, commands);
                let ends = [
                    (
                        "From",
                        region.from_rad,
                        all.iter().position(|b| b.above == Some(k)),
                    ),
                    (
                        "To",
                        region.to_rad,
                        all.iter().position(|b| b.below == Some(k)),
                    ),
                ];
                for (end, at_rad, boundary) in ends {
                    let name = format!("{end}, region {}", region.name);
                    if let Some(boundary) = boundary {
                        angle_field(ui, workbench, &name, at_rad, boundary, commands);
                    }
                }
                let count = counts[k];
                let color = if count == 0 {
                    palette.warning
                } else {
                    palette.text
                };
                ui.label(RichText::new(count.to_string()).color(color));
                more(ui, k, &region.name, regions.len(), commands);
                ui.end_row();
            }
        });
    if regions.len() > MOST_LISTED {
        widgets::hint(ui, format!("and {} more", regions.len() - MOST_LISTED));
    }
    let outside = workbench.subject().len() - counts.iter().sum::<usize>();
    if outside > 0 {
        let samples = if outside == 1 {
            "sample is"
        } else {
            "samples are"
        };
        widgets::hint(
            ui,
            format!("{outside} {samples} in no region and get no correction"),
        );
    }
}

/// The numbers of samples, counted again only when regions or session have changed.
fn counted(ui: &Ui, workbench: &Workbench) -> Arc<[usize]> {
    type Counted = (Arc<[Region]>, Weak<Subject>, Arc<[usize]>);
    let document = workbench.document();
    let id = ui.scope_id().with("samples by region");
    let last: Option<Counted> = ui.data(|data| data.get_temp(id));
    if let Some((regions, subject, counts)) = last
        && Arc::ptr_eq(&regions, &document.regions)
        && subject.as_ptr() == Arc::as_ptr(&document.subject)
    {
        return counts;
    }
    let counts: Arc<[usize]> = samples_by_region(workbench).into();
    let regions = Arc::clone(&document.regions);
    let subject = Arc::downgrade(&document.subject);
    let counted: Counted = (regions, subject, Arc::clone(&counts));
    ui.data_mut(|data| data.insert_temp(id, counted));
    counts
}

fn samples_by_region(workbench: &Workbench) -> Vec<usize> {
    let regions = &workbench.document().regions;
    if let Some(tally) = workbench.subject().tallied.ready() {
        return tally
            .held(regions)
            .iter()
            .map(|held| held.samples)
            .collect();
    }
    let assignment = Assignment::new(regions);
    let mut counts = vec![0; regions.len()];
    let subject = workbench.subject();
    for q in &subject.session.samples.q[0] {
        if let Some(region) = assignment.region_of(*q) {
            counts[region] += 1;
        }
    }
    counts
}

fn name_field(ui: &mut Ui, region: usize, name: &str, commands: &mut Vec<Command>) {
    let id = ui.scope_id().with(("name of region", region));
    let typed: Option<String> = ui.data_mut(|data| data.get_temp(id));
    let mut text = typed.unwrap_or_else(|| name.to_owned());
    let field = ui.add_sized([40.0, 24.0], TextEdit::singleline(&mut text));
    ui.ctx().accesskit_node_builder(field.id, |node| {
        node.set_label(format!("Name of region {name}"));
    });
    if field.has_focus() {
        ui.data_mut(|data| data.insert_temp(id, text));
    } else {
        if field.lost_focus() && text != name {
            commands.push(Command::Edit(Edit::Rename(region, text)));
        }
        ui.data_mut(|data| data.remove::<String>(id));
    }
}

fn angle_field(
    ui: &mut Ui,
    workbench: &Workbench,
    name: &str,
    at_rad: f64,
    boundary: usize,
    commands: &mut Vec<Command>,
) {
    let regions = &workbench.document().regions;
    let within = workbench.subject().travel();
    let (low, high) = boundaries::room(regions, boundary, within).unwrap_or((at_rad, at_rad));
    let now = deg_from_rad(at_rad);
    let mut degrees = now;
    let field = DragValue::new(&mut degrees)
        .range(deg_from_rad(low)..=deg_from_rad(high))
        .clamp_existing_to_range(false)
        .speed(0.2)
        .custom_formatter(|value, _| crate::gui::units::trimmed(value, 2))
        .suffix("°");
    let response = widgets::cell_number(ui, name, 62.0, field);
    if degrees != now {
        let edit = Edit::MoveBoundary(boundary, rad_from_deg(degrees));
        commands.push(if response.dragged() {
            Command::Drag(edit)
        } else {
            Command::Edit(edit)
        });
    }
    if response.drag_stopped() {
        commands.push(Command::EndDrag);
    }
}

fn more(ui: &mut Ui, region: usize, name: &str, regions: usize, commands: &mut Vec<Command>) {
    let menu = ui.menu_button("…", |ui| {
        if ui.button("Split in half").clicked() {
            commands.push(Command::Edit(Edit::Split(region)));
            ui.close();
        }
        let button = egui::Button::new("Merge with its neighbour");
        if ui.add_enabled(regions > 1, button).clicked() {
            commands.push(Command::Edit(Edit::Merge(region)));
            ui.close();
        }
    });
    let says = format!("Change region {name}");
    ui.ctx()
        .accesskit_node_builder(menu.response.id, |node| node.set_label(says));
}

/// What to do next.
pub(crate) fn next(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let document = workbench.document();
    let regional = document.identified && document.method == Method::Regional;
    let subject = workbench.subject();
    if subject.single_revolute() && !subject.is_empty() && !regional {
        if widgets::primary(ui, "Identify by region").clicked() {
            commands.push(Command::Edit(Edit::IdentifyBy(Method::Regional)));
        }
        return;
    }
    if widgets::primary(ui, "Continue to identify").clicked() {
        commands.push(Command::GoTo(Step::Identify));
    }
}
