//! Step 2: where the joint gets corrections of its own.

mod row;
mod rows;

use egui::{Align, DragValue, Layout, Ui};

use crate::gui::core::boundaries;
use crate::gui::core::by_angle::Count;
use crate::gui::core::document::{Division, Method};
use crate::gui::style::space;
use crate::gui::view::Step;
use crate::gui::workbench::Workbench;
use crate::gui::{help, widgets};
use crate::present::numbers::grouped;

use super::{Progress, StepView};

/// Regions that are offered when there are none: the paper's number.
const OFFERED: usize = 6;

/// More even regions than this are a slip of the keyboard.
const MOST_EVEN: usize = 360;

pub(super) const STEP: StepView = StepView {
    step: Step::Regions,
    show,
    next,
    state,
};

fn state(workbench: &Workbench) -> (String, Progress) {
    let document = workbench.document();
    if document.regions.is_empty() {
        return (say!("optional").to_owned(), Progress::Open);
    }
    let used = document.identified && document.method == Method::Regional;
    let regions =
        say!(one "{count} region", "{count} regions", count = grouped(document.regions.len()));
    let caption = if used {
        regions
    } else {
        say!("optional, {regions}", regions)
    };
    (caption, Progress::of(used))
}

fn show(ui: &mut Ui, workbench: &Workbench) {
    let loaded_session = workbench.loaded_session();
    if loaded_session.is_empty() {
        widgets::hint(
            ui,
            say!(
                "Regions divide what was measured: open a session that was measured on this robot"
            ),
        );
        return;
    }
    let counts = loaded_session
        .angles()
        .by_region(&workbench.document().regions);
    division(ui, workbench);
    if workbench.document().regions.is_empty() {
        none(ui, workbench);
        return;
    }
    ui.add_space(space::TIGHT);
    rows::show(ui, workbench, &counts);
    left_out(ui, workbench, &counts);
}

/// How the range is divided.
fn division(ui: &mut Ui, workbench: &Workbench) {
    let document = workbench.document();
    let present = document.regions.len();
    let number = if present == 0 { OFFERED } else { present };
    let kinds = [
        (0, say!("Uniform")),
        (1, say!("Manual")),
        (2, say!("Adaptive")),
    ];
    let now = match document.division {
        _ if present == 0 => 3,
        Division::Even => 0,
        Division::Given => 1,
        Division::Adaptive(_) => 2,
    };
    let chosen = widgets::row(ui, |ui| {
        let chosen = widgets::segmented(ui, &kinds, now);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            widgets::question(ui, help::REGION);
        });
        chosen
    });
    match chosen {
        Some(0) => workbench.then(move |bench| {
            bench.edit(phrase!("divide into regions"), |document| {
                document.divide(number)
            })
        }),
        Some(1) if present > 0 => workbench.then(move |bench| {
            bench.edit(phrase!("keep the regions"), |document| {
                document.keep_regions()
            })
        }),
        Some(1) => workbench.then(move |bench| {
            bench.edit(phrase!("take regions from session"), |document| {
                document.regions_of_session()
            })
        }),
        Some(_) => workbench.then(Workbench::adapt),
        None => {}
    }
    match &document.division {
        Division::Even => evenly(ui, workbench),
        Division::Given => {
            widgets::hint(
                ui,
                say!("Drag a boundary on the plot, or type it; the identification follows at once"),
            );
            own(ui, workbench);
        }
        Division::Adaptive(decision) => {
            widgets::hint(ui, decision.describe(workbench.units()));
        }
    }
}

fn evenly(ui: &mut Ui, workbench: &Workbench) {
    let present = workbench.document().regions.len();
    let mut number = if present == 0 { OFFERED } else { present };
    let before = number;
    ui.horizontal(|ui| {
        let field = DragValue::new(&mut number)
            .range(1..=MOST_EVEN)
            .speed(0.1)
            .suffix(if before == 1 {
                say!(in "unit", " region")
            } else {
                say!(in "unit", " regions")
            });
        widgets::cell_number(ui, say!("Number of regions"), "", 110.0, field);
        let divide = present == 0 && ui.button(say!("Divide")).clicked();
        if number != before || divide {
            workbench.then(move |bench| {
                bench.edit(phrase!("divide into regions"), |document| {
                    document.divide(number)
                });
            });
        }
    });
}

/// Offers the regions that the session brings along.
fn own(ui: &mut Ui, workbench: &Workbench) {
    let own = &workbench.loaded_session().session.regions;
    if own.is_empty() || own[..] == workbench.document().regions[..] {
        return;
    }
    let button = ui.button(say!("Reset to session"));
    if button
        .on_hover_text(say!("take the regions that the session brings along"))
        .clicked()
    {
        workbench.then(move |bench| {
            bench.edit(phrase!("take regions from session"), |document| {
                document.regions_of_session()
            })
        });
    }
}

/// There are no regions, and what that means.
fn none(ui: &mut Ui, workbench: &Workbench) {
    let range = crate::sessions::division::range_to_divide(&workbench.loaded_session().session);
    widgets::hint(
        ui,
        if range.is_some() {
            say!(
                "There are no regions: nothing is corrected by region. Divide the range evenly, or where the data ask for it"
            )
        } else {
            say!(
                "There are no regions, because all samples are at one angle: there is no range to divide. Give the joint its limits in Session, or measure at other angles. The full model in Identify needs no regions"
            )
        },
    );
}

/// What no region covers.
fn left_out(ui: &mut Ui, workbench: &Workbench, counts: &[Count]) {
    let loaded_session = workbench.loaded_session();
    let regions = &workbench.document().regions;
    let gaps = boundaries::gaps(regions, loaded_session.travel());
    let outside = loaded_session.angles().total().all - counts.iter().map(|c| c.all).sum::<usize>();
    if let Some((from, to)) = gaps.first() {
        let units = workbench.units();
        let gap = format!("{} … {}", units.angle(*from), units.angle(*to));
        let more = match gaps.len() {
            1 => gap,
            n => say!("{gap} and {n} more", gap, n = n - 1),
        };
        let says = match outside {
            0 => say!("{more}: in no region, and no sample is there", more),
            n => say!(
                one "{more}: in no region; {count} sample there gets no correction",
                "{more}: in no region; {count} samples there get no correction",
                more,
                count = n
            ),
        };
        widgets::hint(ui, says);
    } else if outside > 0 {
        widgets::hint(
            ui,
            say!(
                one "{count} sample is in no region and gets no correction",
                "{count} samples are in no region and get no correction",
                count = outside
            ),
        );
    }
}

fn next(ui: &mut Ui, workbench: &Workbench) {
    let document = workbench.document();
    let regional = document.identified && document.method == Method::Regional;
    let loaded_session = workbench.loaded_session();
    let possible = loaded_session.single_revolute()
        && !loaded_session.is_empty()
        && !document.regions.is_empty();
    if possible && !regional {
        let says = say!("Optional: fills the next step, Identify, region by region");
        widgets::hint_above_the_button(ui, says);
        if widgets::primary(ui, say!("Identify by region")).clicked() {
            workbench.then(move |bench| bench.identify(Some(Method::Regional)));
        }
        return;
    }
    if widgets::primary(ui, say!("Continue to identify")).clicked() {
        workbench.then(move |bench| bench.view.step = Step::Identify);
    }
}
