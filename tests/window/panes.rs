//! The workspace and the chart below it, without a display: the edge between them is pulled, and where there is no
//! room for both a switch shows one.

use crate::window::{Window, press, window_of};
use egui::accesskit::Role;
use egui::{Rect, pos2, vec2};
use egui_kittest::kittest::NodeT;
use truepose::gui::Runner;

/// What all plots are called, and where they are.
fn plots(window: &Window) -> Vec<(String, Rect)> {
    let nodes = window.root().children_recursive();
    let figures = nodes.filter(|node| node.accesskit_node().role() == Role::Figure);
    let named = figures.filter_map(|node| Some((node.accesskit_node().label()?, node.rect())));
    named.collect()
}

fn plot(window: &Window, name: &str) -> Rect {
    let all = plots(window);
    let found = all.iter().find(|(label, _)| label.starts_with(name));
    found
        .unwrap_or_else(|| panic!("{name} is not among {all:?}"))
        .1
}

#[test]
fn the_chart_is_pulled_higher_and_the_workspace_keeps_what_it_needs() {
    let mut window = window_of([1280.0, 1000.0], None, Runner::AtOnce);
    let pull = |window: &mut Window, by: f32| {
        // The edge is above the bar of the chart and its legend.
        let chart = plot(window, "deviation chart");
        let places = (40_u8..110).map(|up| pos2(chart.center().x, chart.top() - f32::from(up)));
        for from in places.collect::<Vec<_>>() {
            window.hover_at(from);
            window.step();
            window.drag_at(from);
            window.step();
            window.hover_at(from - vec2(0.0, by));
            window.step();
            window.drop_at(from - vec2(0.0, by));
            window.run_steps(3);
            if (plot(window, "deviation chart").top() - chart.top()).abs() > 10.0 {
                return;
            }
        }
        panic!("there is no edge to pull");
    };
    let before = plot(&window, "deviation chart");
    pull(&mut window, 60.0);
    let pulled = plot(&window, "deviation chart");
    assert!(
        (before.top() - pulled.top() - 60.0).abs() < 12.0,
        "{before} {pulled}"
    );
    pull(&mut window, 2000.0);
    assert!(plot(&window, "workspace plot").height() > 200.0);
}

#[test]
fn where_there_is_no_room_for_both_a_switch_shows_one() {
    let mut window = window_of([1280.0, 800.0], None, Runner::AtOnce);
    assert_eq!(plots(&window).len(), 2);
    for size in [[683.0, 467.0], [520.0, 400.0]] {
        window.set_size(size.into());
        window.run_steps(6);
        for (name, shown) in [
            ("Chart", "deviation chart"),
            ("Workspace", "workspace plot"),
        ] {
            press(&mut window, name);
            let all = plots(&window);
            assert_eq!(all.len(), 1, "{size:?}, {name}");
            assert!(all[0].1.width() > 160.0, "{size:?}, {name}: {all:?}");
            assert!(all[0].0.starts_with(shown), "{all:?}");
            if size[0] > 600.0 {
                crate::sizes::look(&window, &format!("{size:?}, {name}"));
            }
        }
    }
    window.set_size(vec2(1280.0, 800.0));
    window.run_steps(6);
    assert_eq!(plots(&window).len(), 2);
}
