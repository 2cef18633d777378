//! Commands at random about how the document is looked at (planes and 3-D, charts and how they are arranged), and
//! about the record of a machine, sensible or not.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::compensation::decision::Rule;
use crate::report::Details;

use crate::gui::charts::CHARTS;
use crate::gui::core::loaded_session::Component;
use crate::gui::core::quantity::Quantity;
use crate::gui::file_state::machines::Stated;
use crate::gui::preferences::Sizes;
use crate::gui::view::{
    Camera, ChartPane, Colouring, Edge, Key, Panes, Plane, Plot, Sheet, Side, Standard, Step, Tile,
};
use crate::gui::workbench::{Command, ViewChange, Workbench};

use super::any::{Files, one_of, pick};

fn plot_size(random: &mut ChaCha8Rng) -> ViewChange {
    ViewChange::PlotSize(pick(random, &[-1.0, 0.0, f64::NAN, 200.0, 1e300]))
}

pub(super) fn chart(random: &mut ChaCha8Rng) -> &'static str {
    CHARTS[random.random_range(0..CHARTS.len())].about().id
}

pub(super) fn plot(random: &mut ChaCha8Rng) -> Plot {
    let chart = Plot::Chart(chart(random));
    pick(random, &[Plot::Workspace, chart, chart])
}

/// What is shown of the plots, and how much of them.
pub(super) fn look(random: &mut ChaCha8Rng) -> Command {
    match random.random_range(0..4) {
        0 => Command::View(ViewChange::Fit),
        1 => Command::View(ViewChange::FitWorkspace),
        2 => Command::View(ViewChange::FitChart(random.random_range(0..9))),
        _ => Command::View(ViewChange::ActivateNext),
    }
}

/// Another way to look at the workspace, or another pose of its robot.
pub(super) fn way_to_look(random: &mut ChaCha8Rng) -> Command {
    match random.random_range(0..3) {
        0 => Command::View(ViewChange::LookFrom(
            one_of(random, &Standard::ALL).copied(),
        )),
        1 => Command::View(ViewChange::Turn(Camera {
            azimuth_rad: pick(random, &[0.3, -7.0, f64::NAN]),
            zoom: pick(random, &[1.0, -2.0, 1e300]),
            ..Camera::default()
        })),
        _ => Command::View(ViewChange::Pose(
            one_of(random, &[vec![0.3], vec![f64::NAN], vec![0.1; 6]]).cloned(),
        )),
    }
}

/// Another arrangement of the plots: split, moved, closed, pulled, looked at in another way.
pub(super) fn arrangement(random: &mut ChaCha8Rng, workbench: &Workbench) -> Command {
    let mut panes = workbench.view().panes.clone();
    let keys: Vec<Key> = panes
        .panes()
        .iter()
        .map(|pane| pane.key)
        .chain([99])
        .collect();
    let key = pick(random, &keys);
    match random.random_range(0..8) {
        0 => return Command::View(ViewChange::Activate(key)),
        1 | 2 => {
            return Command::View(ViewChange::Panes(Box::new(
                workbench.with_chart(key, pick(random, &Edge::ALL)),
            )));
        }
        3 => panes.close(key),
        4 => panes.move_to(key, pick(random, &Edge::ALL)),
        5 => {
            return Command::View(ViewChange::Pull(Box::new(
                panes.arranged(shares(random, panes.root.clone())),
            )));
        }
        6 if random.random_range(0..4) == 0 => panes = Panes::default(),
        _ => {
            let quantities = Quantity::offered(workbench.loaded_session());
            let [across, upwards] = [0, 1].map(|_| one_of(random, &quantities).copied());
            if let Some(pane) = panes.chart_mut(key) {
                *pane = ChartPane {
                    chart: Some(chart(random).to_owned()),
                    component: one_of(random, &Component::ALL).copied(),
                    joint: Some(random.random_range(0..9)),
                    axes: across
                        .zip(upwards)
                        .map(|(across, upwards)| [across, upwards]),
                    fitted: 0,
                };
            }
        }
    }
    Command::View(ViewChange::Panes(Box::new(panes)))
}

/// The same tiles with other shares, which may be no numbers.
fn shares(random: &mut ChaCha8Rng, mut tile: Tile) -> Tile {
    if let Tile::Beside(parts) | Tile::Below(parts) = &mut tile {
        for part in parts {
            part.share = pick(random, &[0.0, -1.0, f32::NAN, 1e30, 0.2, 3.0]);
        }
    }
    tile
}

/// What the chart is about.
pub(super) fn chart_of(random: &mut ChaCha8Rng) -> Command {
    match random.random_range(0..2) {
        0 => Command::View(ViewChange::ChartJoint(random.random_range(0..7))),
        _ => Command::View(ViewChange::ShowEffect(random.random_range(0..4))),
    }
}

/// The document looked at otherwise: each of these numbers is one of the ways.
pub(super) fn seen(random: &mut ChaCha8Rng, workbench: &Workbench, at: i32) -> ViewChange {
    let samples = workbench.loaded_session().len();
    let sample = |random: &mut ChaCha8Rng| {
        random
            .random::<bool>()
            .then(|| random.random_range(0..samples.max(1) + 10))
    };
    match at {
        107..=112 => ViewChange::GoTo(pick(random, &Step::ALL)),
        113 | 114 => ViewChange::Look(pick(random, &Plane::ALL)),
        115 => ViewChange::Magnify(one_of(random, &[0.0, -1.0, f64::NAN, 20.0, 1e300]).copied()),
        116 if random.random() => plot_size(random),
        116 => ViewChange::Blend(pick(random, &[-1.0, 0.0, 0.4, 1.0, 2.0, f32::NAN])),
        117 => ViewChange::Colour(pick(random, &Colouring::ALL)),
        118 => ViewChange::Heat(random.random()),
        119 | 120 => ViewChange::Component(pick(random, &Component::ALL)),
        121 => ViewChange::OnlyAfter(random.random()),
        122..=125 => ViewChange::Hover(sample(random)),
        126..=129 => ViewChange::Select(sample(random)),
        130 | 131 => ViewChange::Mark((0..random.random_range(0..500)).collect()),
        _ => ViewChange::Side(pick(random, &[Side::Results, Side::Samples])),
    }
}

pub(super) fn sizes(random: &mut ChaCha8Rng) -> Sizes {
    Sizes {
        left: one_of(random, &[0.0, 300.0, f32::NAN, 1e9]).copied(),
        ..Sizes::default()
    }
}

pub(super) fn record(random: &mut ChaCha8Rng, workbench: &Workbench, files: &Files) -> Command {
    match random.random_range(0..5) {
        0 => Command::CompareSessions(files.any(random)),
        1 => Command::sheet(Sheet::DETAILS),
        2 => Command::sheet(Sheet::HISTORY),
        _ => Command::State(Box::new(stated(random, workbench, files))),
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
