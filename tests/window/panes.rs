//! Several plots at once, without a display: split, moved, pulled, closed and put back, with the
//! pointer, the keyboard and the menu; kept for tomorrow, and usable where there is little room.

use crate::window::{Window, keys, press, there, window, window_at, window_of};
use egui::accesskit::Role;
use egui::{Key, Modifiers, Rect};
use egui_kittest::kittest::{NodeT, Queryable};
use truepose::gui::Runner;

const SHIFTED: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

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

/// Drags from one place to another, as a hand does.
fn drag(window: &mut Window, from: egui::Pos2, to: egui::Pos2) {
    window.hover_at(from);
    window.run_steps(1);
    window.drag_at(from);
    window.step();
    for k in 1_u8..=8 {
        window.hover_at(from + (to - from) * (f32::from(k) / 8.0));
        window.step();
    }
    window.drop_at(to);
    window.run_steps(6);
}

fn choose(window: &mut Window, list: &str, name: &str) {
    press(window, list);
    // Elsewhere the same word may be a label, and a long list scrolls.
    let entries = window.get_all_by_role_and_label(Role::Button, name);
    entries.last().expect(name).scroll_to_me();
    window.run_steps(6);
    let entries = window.get_all_by_role_and_label(Role::Button, name);
    entries.last().expect(name).click();
    window.run_steps(6);
}

#[test]
fn a_chart_is_split_off_beside_another_and_each_shows_what_was_chosen_for_it() {
    let mut window = window(None);
    press(&mut window, "Arrange Deviation over angle");
    press(&mut window, "Add chart beside");
    assert_eq!(plots(&window).len(), 3, "{:?}", plots(&window));
    choose(&mut window, "Choose chart, 2", "Histogram");
    let [left, right] =
        ["deviation chart, tangential", "histogram, tangential"].map(|name| plot(&window, name));
    assert!(left.right() < right.left() && (left.bottom() - right.bottom()).abs() < 3.0);
    choose(&mut window, "Component, 2", "radial");
    plot(&window, "deviation chart, tangential");
    plot(&window, "histogram, radial");
    // The pointer on a sample in one is on it in all.
    assert!(window.unnamed_widgets().is_empty());
    // What the narrow bar has no room for is in the menu.
    press(&mut window, "Arrange Deviation over angle");
    press(&mut window, "Fit chart to view");
    press(&mut window, "Arrange Histogram");
    press(&mut window, "Close chart");
    assert_eq!(plots(&window).len(), 2);
    plot(&window, "deviation chart, tangential");
}

#[test]
fn a_chart_is_dragged_beside_the_workspace_and_back_below_it() {
    let mut window = window(None);
    let grip = |window: &Window| {
        let grip = window.get_by_label("Arrange Deviation over angle");
        grip.rect().center()
    };
    let workspace = plot(&window, "workspace plot");
    let from = grip(&window);
    drag(&mut window, from, from + egui::vec2(3.0, 12.0));
    assert_eq!(plot(&window, "workspace plot"), workspace, "let go at home");
    let to = egui::pos2(workspace.right() - 30.0, workspace.center().y);
    drag(&mut window, from, to);
    let [workspace, chart] = ["workspace plot", "deviation chart"].map(|name| plot(&window, name));
    assert!(workspace.right() < chart.left(), "{workspace} {chart}");
    assert!(chart.height() > 300.0, "{chart}");
    let below = egui::pos2(workspace.center().x, workspace.bottom() - 10.0);
    let from = grip(&window);
    drag(&mut window, from, below);
    let [workspace, chart] = ["workspace plot", "deviation chart"].map(|name| plot(&window, name));
    assert!(workspace.bottom() < chart.top(), "{workspace} {chart}");
}

#[test]
fn the_keyboard_alone_splits_moves_pulls_and_closes() {
    let mut window = window(None);
    keys(&mut window, Modifiers::COMMAND, Key::E);
    let [workspace, chart] =
        ["workspace plot", "deviation over time chart"].map(|name| plot(&window, name));
    assert!(workspace.right() < chart.left(), "beside the workspace");
    // The new one is the active one.
    keys(&mut window, Modifiers::COMMAND, Key::W);
    assert_eq!(plots(&window).len(), 2);
    window.set_size(egui::vec2(1280.0, 1100.0));
    window.run_steps(6);
    for _ in 0..3 {
        keys(&mut window, Modifiers::NONE, Key::F6);
    }
    keys(&mut window, SHIFTED, Key::E);
    assert_eq!(plots(&window).len(), 3);
    let grip = "height of Workspace";
    let before = plot(&window, "workspace plot").height();
    window.get_by_label(grip).focus();
    window.run_steps(2);
    for _ in 0..3 {
        window.key_press(Key::ArrowDown);
        window.run_steps(3);
    }
    let after = plot(&window, "workspace plot").height();
    assert!((after - before - 48.0).abs() < 4.0, "{before} {after}");
    window.get_by_label("Arrange Workspace").focus();
    window.run_steps(2);
    window.key_press(Key::Enter);
    window.run_steps(4);
    press(&mut window, "Move to the bottom");
    let [workspace, chart] = ["workspace plot", "deviation chart"].map(|name| plot(&window, name));
    assert!(chart.bottom() < workspace.top());
    keys(&mut window, SHIFTED, Key::W);
    let [workspace, chart] = ["workspace plot", "deviation chart"].map(|name| plot(&window, name));
    assert!(workspace.bottom() < chart.top(), "as they usually are");
}

#[test]
fn the_menu_of_the_window_has_the_same_and_all_charts_can_go_and_come_back() {
    let mut window = window(None);
    let choose = |window: &mut Window, item: &str| {
        press(window, "View");
        press(window, "Charts");
        window.get_by_label(item).click();
        window.run_steps(6);
    };
    let low = plot(&window, "workspace plot").height();
    choose(&mut window, "Close chart");
    assert_eq!(plots(&window).len(), 1);
    assert!(plot(&window, "workspace plot").height() > low + 150.0);
    choose(&mut window, "Add chart below");
    assert_eq!(plots(&window).len(), 2);
    choose(&mut window, "Usual arrangement");
    plot(&window, "deviation chart");
}

#[test]
fn the_arrangement_is_kept_and_a_chart_that_no_longer_exists_costs_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window_at(None, Some(folder.path()));
    keys(&mut window, Modifiers::COMMAND, Key::E);
    choose(&mut window, "Choose chart, 1", "Histogram");
    crate::window::seconds(&mut window, 1);
    let kept: Vec<String> = plots(&window).into_iter().map(|plot| plot.0).collect();
    assert_eq!(kept.len(), 3);
    drop(window);
    let again = window_at(None, Some(folder.path()));
    let shown: Vec<String> = plots(&again).into_iter().map(|plot| plot.0).collect();
    assert_eq!(shown, kept);
    drop(again);
    let file = folder.path().join("settings.json");
    let text = std::fs::read_to_string(&file).expect("they are kept");
    assert!(text.contains("\"histogram\""), "{text}");
    let text = text.replace("\"histogram\"", "\"a chart of tomorrow\"");
    std::fs::write(&file, text).expect("it can be written");
    let without = window_at(None, Some(folder.path()));
    let shown: Vec<String> = plots(&without).into_iter().map(|plot| plot.0).collect();
    assert_eq!(shown.len(), 2, "{shown:?}");
    assert!(!there(&without, "Dismiss"), "and nobody complains");
}

#[test]
fn where_there_is_no_room_for_all_a_switch_shows_one_and_what_is_chosen_there_is_kept() {
    let mut window = window_of([1920.0, 1080.0], None, Runner::AtOnce);
    keys(&mut window, Modifiers::COMMAND, Key::E);
    keys(&mut window, SHIFTED, Key::E);
    assert_eq!(plots(&window).len(), 4);
    crate::sizes::look(&window, "four plots");
    for size in [[1024.0, 700.0], [683.0, 467.0], [520.0, 400.0]] {
        window.set_size(size.into());
        window.run_steps(6);
        assert_eq!(plots(&window).len(), 1, "{size:?}");
        for number in ["1: ", "2: ", "3: "] {
            window.get_by_label_contains(number).click();
            window.run_steps(6);
            let all = plots(&window);
            assert_eq!(all.len(), 1, "{size:?}, {number}");
            assert!(all[0].1.width() > 160.0, "{size:?}, {number}: {all:?}");
            assert!(!all[0].0.starts_with("workspace"), "{all:?}");
            if size[0] > 600.0 {
                crate::sizes::look(&window, &format!("{size:?}, {number}"));
            }
        }
        press(&mut window, "Workspace");
        plot(&window, "workspace plot");
    }
    window.set_size(egui::vec2(1920.0, 1080.0));
    window.run_steps(6);
    assert_eq!(plots(&window).len(), 4);
}
