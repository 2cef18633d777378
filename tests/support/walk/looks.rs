//! Commands at random about how the document is looked at (planes and 3-D, charts and how they are arranged), and
//! about the record of a machine, sensible or not.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::compensation::decision::Rule;
use crate::report::Details;

use crate::gui::charts::CHARTS;
use crate::gui::core::loaded_session::Component;
use crate::gui::file_state::Stated;

use crate::gui::view::{Camera, Front, Plane, Plot, Sheet, Side, Step};
use crate::gui::workbench::Workbench;

use super::any::{Deed, Files, deed, one_of, pick};

fn plot_size(random: &mut ChaCha8Rng) -> Deed {
    deed(
        "PlotSize",
        pick(random, &[60.0, 200.0, 1e300]),
        |bench, it| bench.view.plot_size = it,
    )
}

pub(super) fn chart(random: &mut ChaCha8Rng) -> &'static str {
    CHARTS[random.random_range(0..CHARTS.len())].id
}

pub(super) fn plot(random: &mut ChaCha8Rng) -> Plot {
    let chart = Plot::Chart(chart(random));
    pick(random, &[Plot::Workspace, chart, chart])
}

/// What is shown of the plots, and how much of them.
pub(super) fn look(random: &mut ChaCha8Rng) -> Deed {
    match random.random_range(0..4) {
        0 => deed("Fit", (), |bench, ()| bench.view.fit()),
        1 => deed("FitWorkspace", (), |bench, ()| bench.view.fit_workspace()),
        2 => {
            let front = pick(random, &[Front::Workspace, Front::Chart]);
            deed("Front", front, |bench, it| bench.view.front = it)
        }
        _ => deed("ShowChart", chart(random), Workbench::show_chart),
    }
}

/// Another way to look at the workspace, or another pose of its robot.
pub(super) fn way_to_look(random: &mut ChaCha8Rng) -> Deed {
    match random.random_range(0..3) {
        0 => deed("LookInSpace", (), |bench, ()| bench.view.look_in_space()),
        _ => deed(
            "Turn",
            Camera::default()
                .orbited([pick(random, &[40.0, -900.0]), 0.0])
                .zoomed(pick(random, &[1.0, 1e-9, 1e300]), [0.0; 2]),
            |bench, it| bench.view.camera = it,
        ),
    }
}

/// What the chart is about.
pub(super) fn chart_of(random: &mut ChaCha8Rng) -> Deed {
    match random.random_range(0..2) {
        0 => deed("ChartJoint", random.random_range(0..7), |bench, it| {
            bench.view.joint = it;
        }),
        _ => deed("ShowEffect", random.random_range(0..4), |bench, it| {
            bench.show_effect(it);
        }),
    }
}

/// The document looked at otherwise: each of these numbers is one of the ways.
pub(super) fn seen(random: &mut ChaCha8Rng, workbench: &Workbench, at: i32) -> Deed {
    let samples = workbench.loaded_session().len();
    let sample = |random: &mut ChaCha8Rng| {
        random
            .random::<bool>()
            .then(|| random.random_range(0..samples.max(1) + 10))
    };
    match at {
        107..=112 => deed("GoTo", pick(random, &Step::ALL), |bench, it| {
            bench.view.step = it;
        }),
        113 | 114 => deed("Look", pick(random, &Plane::ALL), |bench, it| {
            bench.view.look_in(it);
        }),
        115 => deed(
            "Magnify",
            one_of(random, &[1.0, 20.0, 1e300]).copied(),
            |bench, it| bench.view.magnification = it,
        ),
        116 if random.random() => plot_size(random),
        116 => deed("Blend", pick(random, &[0.0, 0.4, 1.0]), |bench, it| {
            bench.view.blend = it;
        }),
        117 | 118 => deed("Heat", random.random(), |bench, it| bench.view.heat = it),
        119 | 120 => deed("Component", pick(random, &Component::ALL), |bench, it| {
            bench.view.component = it;
        }),
        121 => deed("OnlyAfter", random.random(), |bench, it| {
            bench.view.only_after = it;
        }),
        122..=125 => deed("Hover", sample(random), |bench, it| bench.view.hovered = it),
        126..=129 => deed("Select", sample(random), |bench, it| bench.view.select(it)),
        130 | 131 => deed(
            "Mark",
            (0..random.random_range(0..500)).collect::<Vec<_>>(),
            |bench, it| bench.view.mark(it),
        ),
        _ => deed(
            "Side",
            pick(random, &[Side::Results, Side::Samples]),
            |bench, it| bench.view.side = it,
        ),
    }
}

pub(super) fn record(random: &mut ChaCha8Rng, workbench: &Workbench, files: &Files) -> Deed {
    match random.random_range(0..4) {
        0 | 1 => deed("Sheet", (), |bench, ()| {
            bench.show_sheet(Some(Sheet::Details));
        }),

        _ => deed("State", stated(random, workbench, files), |bench, it| {
            bench.state(it);
        }),
    }
}

fn stated(random: &mut ChaCha8Rng, workbench: &Workbench, files: &Files) -> Stated {
    let mut stated = workbench.stated();
    let texts = ["", "L-17", "<b>ß·∆\u{202e}", "22 Nov 2026"];
    if let (Some(line), Some(text)) = (one_of(random, Details::LINES), one_of(random, &texts)) {
        (*text).clone_into((line.of)(&mut stated.details));
    }
    stated.details.rule = one_of(random, &Rule::ALL).copied();
    stated.details.tolerance_mm = one_of(random, &[None, Some(0.2)]).copied().flatten();
    if random.random_range(0..4) == 0 {
        stated.logo = files.any(random).display().to_string();
    }
    stated
}
