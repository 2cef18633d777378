//! The window at every size it is used at, from a small laptop to a wall: nothing sticks out of its
//! panel, nothing lies on something else, no text is cut, the plots stay readable and what comes
//! next stays in sight.

use std::path::PathBuf;

use crate::window::{STEPS, Window, copied, into_sight, press, there, window_of};
use egui::accesskit::Role;
use egui::{Color32, FontFamily, FontId, Rect, Shape};
use egui_kittest::kittest::{NodeT, Queryable};
use truepose::gui::Runner;

/// Width and height in points; the last five are 1920 × 1080, 1366 × 768, 1280 × 800 and 1024 × 700
/// with text of 150 %, and 1280 × 800 with text of 200 %, the largest that it has room for.
const SIZES: [[f32; 2]; 9] = [
    [1024.0, 700.0],
    [1280.0, 800.0],
    [1920.0, 1080.0],
    [3840.0, 2160.0],
    [1280.0, 720.0],
    [911.0, 512.0],
    [853.0, 533.0],
    [683.0, 467.0],
    [640.0, 400.0],
];

/// Inner margin of the side panels, points.
const MARGIN: f32 = 16.0;
/// Rounding to whole pixels, points.
const ROUNDING: f32 = 1.5;
/// The least that the workspace and a chart may be, points: with text of 200 %, in a low window, where one of them is
/// shown, and else.
const LEAST_LARGE_TEXT: [[f32; 2]; 2] = [[270.0, 130.0], [270.0, 130.0]];
const LEAST_LOW: [[f32; 2]; 2] = [[300.0, 150.0], [300.0, 150.0]];
const LEAST: [[f32; 2]; 2] = [[300.0, 220.0], [300.0, 130.0]];

fn window(size: [f32; 2]) -> Window {
    window_of(size, None, Runner::AtOnce)
}

/// Something on the screen.
#[derive(Debug, Clone)]
pub(crate) struct Thing {
    pub(crate) role: Role,
    pub(crate) says: String,
    pub(crate) rect: Rect,
}

pub(crate) fn things(window: &Window) -> Vec<Thing> {
    let nodes = window.root().children_recursive();
    // What has no place is not drawn.
    let thing = |node: egui_kittest::Node<'_>| {
        let inner = node.accesskit_node();
        inner.bounding_box()?;
        let says = inner.label().or(inner.value()).unwrap_or_default();
        Some(Thing {
            role: inner.role(),
            says,
            rect: node.rect(),
        })
    };
    nodes.filter_map(thing).collect()
}

/// Whether something can be pressed or filled in.
pub(crate) fn interactive(role: Role) -> bool {
    matches!(
        role,
        Role::Button
            | Role::CheckBox
            | Role::RadioButton
            | Role::ComboBox
            | Role::Slider
            | Role::SpinButton
            | Role::TextInput
            | Role::Link
            | Role::Tab
    )
}

/// Where the panels are, as what stands in them says.
struct Panels {
    left: f32,
    right: Option<f32>,
    whole: Rect,
}

impl Panels {
    fn of(window: &Window, all: &[Thing]) -> Self {
        let tabs = all.iter().filter(|t| t.role == Role::Tab);
        let left = tabs.map(|t| t.rect.right()).fold(0.0, f32::max) + MARGIN;
        let heads = [
            "Results",
            "Diagnosis",
            "Export",
            "Ergebnisse",
            "Diagnose",
            "结果",
            "诊断",
            "导出",
        ];
        let head = all
            .iter()
            .filter(|t| t.role == Role::Label && t.rect.left() > left);
        let head = head.filter(|t| heads.contains(&t.says.trim_end_matches('~')));
        Self {
            left,
            right: head.map(|t| t.rect.left() - MARGIN).next(),
            whole: window.ctx.content_rect(),
        }
    }

    /// The panel that this is in, from left to right; the bars have the whole width.
    fn around(&self, rect: Rect) -> [f32; 2] {
        let bar = rect.center().y < 42.0 || rect.center().y > self.whole.bottom() - 32.0;
        let right = self.right.unwrap_or(self.whole.right());
        match rect.center().x {
            _ if bar => [0.0, self.whole.right()],
            x if x < self.left => [0.0, self.left],
            x if x < right => [self.left, right],
            _ => [right, self.whole.right()],
        }
    }
}

/// The narrowest that this text can be on one line as high as this; `None`: it has more lines.
fn natural_width(window: &Window, text: &str, height: f32) -> Option<f32> {
    let mut found: Option<f32> = None;
    for size in [10.0, 11.5, 12.0, 13.0, 16.0, 26.0] {
        for family in [FontFamily::Proportional, FontFamily::Name("strong".into())] {
            let font = FontId::new(size, family);
            window.ctx.fonts_mut(|fonts| {
                let galley = fonts.layout_no_wrap(text.to_owned(), font, Color32::PLACEHOLDER);
                if (galley.size().y - height).abs() < 0.8 {
                    let width = galley.size().x;
                    found = Some(found.map_or(width, |least| least.min(width)));
                }
            });
        }
    }
    found
}

/// Every text that is painted, with its part of the screen.
fn texts(window: &Window) -> Vec<(Rect, egui::epaint::TextShape)> {
    fn gather(clip: Rect, shape: &Shape, all: &mut Vec<(Rect, egui::epaint::TextShape)>) {
        match shape {
            Shape::Text(text) => all.push((clip, text.clone())),
            Shape::Vec(shapes) => shapes.iter().for_each(|shape| gather(clip, shape, all)),
            _ => {}
        }
    }
    let mut all = Vec::new();
    for shape in &window.output().shapes {
        gather(shape.clip_rect, &shape.shape, &mut all);
    }
    all
}

/// The name of a file, which stands in the bar above, may be as long as it likes.
fn is_a_file_in_the_bar(says: &str, rect: Rect) -> bool {
    rect.center().y < 42.0 && says.contains(".json")
}

/// No painted text ends in an ellipsis that was not written, and none is cut at its left or right.
pub(crate) fn no_text_is_cut(window: &Window, at: &str) {
    no_text_is_cut_but_at_the_right(window, at, false);
}

/// The same where there is a table whose columns scroll in from the right (`scrolls`).
pub(crate) fn no_text_is_cut_but_at_the_right(window: &Window, at: &str, scrolls: bool) {
    for (clip, text) in texts(window) {
        let says = text.galley.text();
        let rect = text.visual_bounding_rect();
        // Lines of a file scroll sideways, and what is above or below scrolls into sight.
        let sections = &text.galley.job.sections;
        let of_a_file =
            |s: &egui::text::LayoutSection| s.format.font_id.family == FontFamily::Monospace;
        if sections.iter().any(of_a_file) || !clip.y_range().contains(rect.center().y) {
            continue;
        }
        assert!(
            !text.galley.elided || is_a_file_in_the_bar(says, rect),
            "{at}: {says:?} is shortened"
        );
        let inside =
            rect.left() >= clip.left() - ROUNDING && rect.right() <= clip.right() + ROUNDING;
        let inside = inside || scrolls && rect.right() > clip.right();
        assert!(inside, "{at}: {says:?} at {rect} is cut by {clip}");
    }
}

/// Everything that has to hold wherever the work stands.
pub(crate) fn look(window: &Window, at: &str) {
    no_text_is_cut(window, at);
    let all = things(window);
    let panels = Panels::of(window, &all);
    let whole = panels.whole;
    for thing in &all {
        let Thing { role, says, rect } = thing;
        let is_text = *role == Role::Label;
        if !(is_text || interactive(*role)) || rect.width() < 1.0 {
            continue;
        }
        // Lines of a file that is shown scroll sideways; in a sentence a space follows a comma.
        if is_text && says.contains(',') && !says.contains(", ") {
            continue;
        }
        let [from, to] = panels.around(*rect);
        assert!(
            rect.left() >= from - ROUNDING && rect.right() <= to + ROUNDING,
            "{at}: {role:?} {says:?} at {rect} sticks out of its panel {from} … {to}"
        );
        if is_text && !says.contains('\n') && !is_a_file_in_the_bar(says, *rect) {
            let natural = natural_width(window, says, rect.height());
            assert!(
                natural.is_none_or(|width| width <= rect.width() + ROUNDING),
                "{at}: {says:?} is cut: {natural:?} in {}",
                rect.width()
            );
        }
    }
    // Lists scroll: what is in them may be out of sight. Bars do not, and nothing lies on anything.
    let middle: Vec<&Thing> = all
        .iter()
        .filter(|t| interactive(t.role) && t.role != Role::Slider)
        .filter(|t| {
            t.rect.left() >= panels.left && panels.right.is_none_or(|r| t.rect.right() <= r)
        })
        .collect();
    for (k, a) in middle.iter().enumerate() {
        assert!(whole.contains_rect(a.rect.shrink(1.0)), "{at}: {a:?}");
        for b in &middle[..k] {
            let common = a.rect.intersect(b.rect);
            let apart = common.width() <= ROUNDING || common.height() <= ROUNDING;
            assert!(apart, "{at}: {a:?} lies on {b:?}");
        }
    }
    let [workspace, chart] = match whole.height() {
        ..450.0 => LEAST_LARGE_TEXT,
        ..600.0 => LEAST_LOW,
        _ => LEAST,
    };
    for (name, least) in [
        ("workspace plot", workspace),
        ("deviation chart", chart),
        ("gap by step", chart),
    ] {
        let figures = all.iter().filter(|t| t.role == Role::Figure);
        for plot in figures.filter(|t| t.says.starts_with(name)) {
            let size = plot.rect.size();
            assert!(
                size.x >= least[0] && size.y >= least[1],
                "{at}: {name} is only {size}"
            );
            assert!(whole.contains_rect(plot.rect.shrink(1.0)), "{at}: {plot:?}");
        }
    }
}

/// What comes next is in sight, whole, and as wide as its panel allows.
fn next_is_in_sight(window: &Window, label: &str, at: &str) {
    let button = window.get_by_label(label).rect();
    let whole = window.ctx.content_rect();
    assert!(whole.contains_rect(button), "{at}: {label} at {button}");
    assert!(button.height() >= 36.0, "{at}: {label} at {button}");
    let all = things(window);
    let tabs = all.iter().filter(|t| t.role == Role::Tab);
    let lowest = tabs.map(|t| t.rect.bottom()).fold(0.0, f32::max);
    assert!(
        button.top() >= lowest + 60.0,
        "{at}: no room for the controls of the step above {label}"
    );
    assert!(
        button.bottom() <= 1040.0,
        "{at}: {label} is far away, at {button}"
    );
}

#[test]
fn every_step_fits_at_every_size_before_anything_is_identified() {
    let next = [
        "Continue to regions",
        "Continue to identify",
        "Identify",
        "Run diagnosis",
        "Continue to identify",
    ];
    for size in SIZES {
        let mut window = window(size);
        for (step, next) in STEPS.into_iter().zip(next) {
            press(&mut window, step);
            let at = format!("{size:?}, {step}");
            look(&window, &at);
            next_is_in_sight(&window, next, &at);
        }
    }
}

#[test]
fn every_step_fits_at_every_size_when_all_is_found() {
    // The search is done once: sizes follow it in one window.
    let mut window = window([1280.0, 800.0]);
    press(&mut window, "3 Identify");
    press(&mut window, "Identify");
    press(&mut window, "4 Diagnose");
    press(&mut window, "Run diagnosis");
    press(&mut window, "Add all 5 effects to the model");
    for size in SIZES {
        window.set_size(size.into());
        window.run_steps(5);
        for step in STEPS {
            press(&mut window, step);
            look(&window, &format!("{size:?}, {step}, found"));
        }
        press(&mut window, "4 Diagnose");
        next_is_in_sight(&window, "Continue to export", &format!("{size:?}"));
    }
}

#[test]
fn every_step_of_an_arm_and_of_a_positioner_fits_at_every_size() {
    for name in ["six-60", "positioner-60"] {
        let file = format!("{}/tests/data/arms/{name}.json", env!("CARGO_MANIFEST_DIR"));
        let mut window = window_of([1280.0, 800.0], Some(file.into()), Runner::AtOnce);
        for step in ["1 Session", "2 Identify", "3 Diagnose", "4 Export"] {
            press(&mut window, step);
            for work in ["Identify", "Run diagnosis"] {
                if there(&window, work) {
                    press(&mut window, work);
                }
            }
            for size in SIZES {
                window.set_size(size.into());
                window.run_steps(6);
                look(&window, &format!("{size:?}, {name}, {step}"));
                // Where results have no room beside the plots they are looked at on demand.
                if there(&window, "Show results") {
                    press(&mut window, "Show results");
                    look(&window, &format!("{size:?}, {name}, {step}, results"));
                    press(&mut window, "Hide results");
                }
            }
            window.set_size([1280.0, 800.0].into());
            window.run_steps(6);
        }
    }
}

/// The lengths of all arrows in a rectangle as they are painted, points: a shaft, and a head of the
/// same colour whose first corner is the tip.
fn arrows(window: &Window, within: Rect) -> Vec<f32> {
    fn flat<'a>(shape: &'a Shape, all: &mut Vec<&'a Shape>) {
        match shape {
            Shape::Vec(shapes) => shapes.iter().for_each(|shape| flat(shape, all)),
            other => all.push(other),
        }
    }
    let mut all = Vec::new();
    for shape in &window.output().shapes {
        flat(&shape.shape, &mut all);
    }
    let arrow = |pair: &[&Shape]| match pair {
        [Shape::LineSegment { points, stroke }, Shape::Path(head)]
            if head.points.len() == 3
                && head.fill == stroke.color
                && within.contains(points[0]) =>
        {
            Some((head.points[0] - points[0]).length())
        }
        _ => None,
    };
    all.windows(2).filter_map(arrow).collect()
}

/// How long a vector of a millimetre is drawn, points: the arrow of the scale over the plot, and what stands beside it.
fn points_per_mm(window: &Window, plot: Rect) -> f32 {
    // The names beside its axis stand left of the plot, and the scale above them.
    let left = plot.left() - 80.0;
    let above = Rect::from_x_y_ranges(left..=plot.right(), plot.top() - 100.0..=plot.top());
    let [arrow] = arrows(window, above)[..] else {
        panic!("one scale above the plot");
    };
    let shapes = window.output().shapes.iter();
    let texts = shapes.filter_map(|shape| match &shape.shape {
        Shape::Text(text) if above.contains(text.pos) => Some(text.galley.text()),
        _ => None,
    });
    let mut lengths = texts.filter_map(|text| text.strip_suffix(" mm")?.parse::<f32>().ok());
    arrow / lengths.next().expect("what it stands for")
}

/// Deviations of the nominal robot of a session, ascending, mm.
fn before_mm(file: Option<PathBuf>) -> Vec<f32> {
    let mut window = window_of([1280.0, 800.0], file, Runner::AtOnce);
    press(&mut window, "Samples");
    let rows = copied(&mut window, "Copy table of samples");
    let column = rows[0].iter().position(|head| head == "before, mm");
    let column = column.expect("a column of deviations");
    let before = rows[1..].iter().map(|row| row[column].parse::<f32>());
    let mut before: Vec<f32> = before.map(|mm| mm.expect("a number")).collect();
    before.sort_by(f32::total_cmp);
    before
}

#[test]
fn the_median_arrow_can_be_read_at_every_usual_size_where_a_robot_is_looked_at_first() {
    // Points; magnifications are round numbers.
    const LEAST: f32 = 18.0;
    const MOST: f32 = 32.0;
    // Some of an arm's stand for all of them, and are longer.
    const MOST_OF_AN_ARM: f32 = 48.0;
    const FORESHORTENED: f32 = std::f32::consts::FRAC_PI_4;
    let arm = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/arms/six-60.json");
    // Of an arm half of what is drawn are the 32 largest, so that the least of these is the median.
    let of_all = before_mm(None);
    let of_arm = before_mm(Some(arm.into()));
    let medians_mm = [of_all[of_all.len() / 2], of_arm[of_arm.len() - 32]];
    let mut medians = Vec::new();
    // A plane shows several joints too small; an arm begins in space.
    let axis = (None, &["x y", "3-D"][..]);
    for (file, views) in [axis, (Some(arm.into()), &["3-D"][..])] {
        for size in [[1024.0, 700.0], [1280.0, 800.0], [1920.0, 1080.0]] {
            let mut window = window_of(size, file.clone(), Runner::AtOnce);
            for view in views {
                press(&mut window, view);
                window.run_steps(6);
                let all = things(&window);
                let names = ["workspace plot", "3-D view"];
                let mut figures = all.iter().filter(|t| t.role == Role::Figure);
                let plot = figures.find(|t| names.iter().any(|name| t.says.starts_with(name)));
                let plot = plot.expect("a plot").rect;
                let is_arm = file.is_some();
                // What the graphics processor draws is not among the shapes; in space it is foreshortened.
                let seen = if *view == "3-D" { FORESHORTENED } else { 1.0 };
                let median_mm = medians_mm[usize::from(is_arm)];
                let median = seen * median_mm * points_per_mm(&window, plot);
                medians.push((is_arm, size, *view, median));
            }
        }
    }
    let readable = |(is_arm, .., median): &(bool, [f32; 2], &str, f32)| {
        let most = if *is_arm { MOST_OF_AN_ARM } else { MOST };
        (LEAST..=most).contains(median)
    };
    // For docs/trust.md: `-- --nocapture`.
    eprintln!("{medians:?}");
    assert!(medians.iter().all(readable), "{medians:#?}");
}

#[test]
fn results_give_way_to_the_plots_where_there_is_no_room_and_come_back_on_demand() {
    let mut window = window([911.0, 512.0]);
    assert!(!there(&window, "Results") && there(&window, "Show results"));
    press(&mut window, "Show results");
    assert!(there(&window, "Results") && there(&window, "Hide results"));
    look(&window, "911 × 512, results");
    press(&mut window, "Hide results");
    assert!(!there(&window, "Results"));
    // With text of 200 % they take the place of the plots.
    window.set_size([683.0, 384.0].into());
    window.run_steps(4);
    press(&mut window, "Show results");
    assert!(there(&window, "Results"));
    assert!(window.query_by_label_contains("workspace plot").is_none());
    press(&mut window, "Hide results");
    assert!(window.query_by_label_contains("workspace plot").is_some());
}

#[test]
fn what_is_longer_than_its_panel_scrolls() {
    let mut window = window([911.0, 512.0]);
    let button = window.get_by_label("Continue to regions").rect();
    let last = "Robots…";
    let below = window.get_by_label(last).rect();
    assert!(
        below.top() > button.top(),
        "{below} has room without scrolling"
    );
    into_sight(&mut window, last);
    let now = window.get_by_label(last).rect();
    assert!(now.bottom() <= button.top(), "{now} is not in sight");
}

#[test]
fn samples_stand_beside_the_results_on_a_large_screen() {
    let mut window = window([3840.0, 2160.0]);
    let results = window.get_by_label("Results").rect();
    let samples = window.get_by_label("Samples").rect();
    assert!(samples.left() > results.right() + 200.0);
    window.set_size([1920.0, 1080.0].into());
    window.run_steps(4);
    press(&mut window, "Samples");
    assert!(there(&window, "sample"));
}

#[test]
fn every_sheet_fits_and_is_left_by_its_button_by_enter_and_by_escape() {
    let sheets = [
        ("Edit", "Preferences…", "Preferences"),
        ("Help", "Glossary", "Glossary"),
        ("Help", "About truepose", "About truepose"),
    ];
    let buttons = |window: &Window| window.query_all_by_label("Done").count();
    for size in [[911.0, 512.0], [1024.0, 700.0]] {
        let mut window = window(size);
        let whole = window.ctx.content_rect();
        for (menu, item, sheet) in sheets {
            for leave in ["button", "Enter", "Escape"] {
                let at = format!("{size:?}, {sheet}, {leave}");
                press(&mut window, menu);
                window.get_by_label(item).click();
                window.run_steps(5);
                assert_eq!(buttons(&window), 1, "{at}");
                match leave {
                    "Enter" => window.key_press(egui::Key::Enter),
                    "Escape" => window.key_press(egui::Key::Escape),
                    _ => {
                        window.get_by_label("Done").scroll_to_me();
                        window.run_steps(6);
                        let done = window.get_by_label("Done").rect();
                        assert!(whole.contains_rect(done), "{at}: {done}");
                        window.get_by_label("Done").click();
                    }
                }
                window.run_steps(4);
                assert_eq!(buttons(&window), 0, "{at}");
            }
        }
    }
}

#[test]
fn whatever_has_the_keyboard_shows_it_and_tab_reaches_every_control_of_a_step() {
    let mut window = window([1280.0, 800.0]);
    let mut reached = std::collections::BTreeSet::new();
    for _ in 0..60 {
        window.key_press(egui::Key::Tab);
        window.run_steps(2);
        let focused = window.root().children_recursive();
        let focused = focused.filter(egui_kittest::Node::is_focused);
        let names = focused.filter_map(|node| node.accesskit_node().label());
        reached.extend(names);
    }
    for name in [
        "1 Session",
        "5 Export",
        "Open…",
        "Simulate session…",
        "Continue to regions",
        "Hide results",
        "display …",
        "Samples",
    ] {
        assert!(reached.contains(name), "{name} is not among {reached:?}");
    }
}

#[test]
fn the_chart_keeps_its_share_of_a_window_that_is_made_larger_and_smaller() {
    let mut window = window_of([1280.0, 800.0], None, Runner::AtOnce);
    let share = |window: &Window, height: f32| {
        let chart = window.get_by_label("deviation chart, tangential");
        chart.rect().height() / height
    };
    let first = share(&window, 800.0);
    window.set_size(egui::vec2(3840.0, 2160.0));
    window.run_steps(6);
    let large = share(&window, 2160.0);
    assert!(large > first, "{first} → {large}");
    window.set_size(egui::vec2(1280.0, 800.0));
    window.run_steps(6);
    let back = share(&window, 800.0);
    assert!((back - first).abs() < 0.01, "{first} → {back}");
}

/// The height of the plot of this name, if it is there.
fn height(window: &Window, name: &str) -> Option<f32> {
    let all = things(window);
    let mut figures = all.iter().filter(|t| t.role == Role::Figure);
    let plot = figures.find(|t| t.says.starts_with(name))?;
    Some(plot.rect.height())
}

#[test]
fn a_chart_that_was_in_a_small_window_is_as_high_as_before_in_a_large_one() {
    let mut window = window([1280.0, 800.0]);
    let chart = |window: &Window| height(window, "deviation chart");
    let first = chart(&window).expect("a chart");
    let sizes = [
        [1024.0, 700.0],
        [683.0, 467.0],
        [1024.0, 700.0],
        [853.0, 533.0],
        [1280.0, 720.0],
        [1280.0, 800.0],
    ];
    for size in sizes {
        window.set_size(size.into());
        window.run_steps(6);
        if let Some(now) = chart(&window) {
            assert!(now >= 130.0, "{size:?}: {now}");
        }
    }
    let back = chart(&window).expect("a chart");
    assert!((back - first).abs() < 2.0, "{first} → {back}");
}

#[test]
fn in_a_low_window_one_plot_is_shown_and_a_switch_brings_the_other() {
    for size in [[683.0, 467.0], [911.0, 512.0]] {
        let mut window = window(size);
        let shown = |window: &Window| {
            ["workspace plot", "deviation chart"].map(|name| height(window, name))
        };
        let [workspace, chart] = shown(&window);
        assert!(
            workspace.is_some_and(|h| h >= 150.0) && chart.is_none(),
            "{workspace:?}"
        );
        press(&mut window, "Chart");
        let [workspace, chart] = shown(&window);
        assert!(
            chart.is_some_and(|h| h >= 150.0) && workspace.is_none(),
            "{chart:?}"
        );
        look(&window, &format!("{size:?}, chart"));
        // Whoever looks from another side wants to see it.
        window.key_press_modifiers(
            egui::Modifiers::COMMAND.plus(egui::Modifiers::SHIFT),
            egui::Key::Num2,
        );
        window.run_steps(4);
        assert!(shown(&window)[0].is_some());
        press(&mut window, "Chart");
        press(&mut window, "Workspace");
        // Where there is room for both there is no switch.
        window.set_size([1280.0, 800.0].into());
        window.run_steps(4);
        assert!(shown(&window).iter().all(Option::is_some));
        assert!(!there(&window, "Chart"));
    }
}

#[test]
fn a_long_message_leaves_the_plots_their_room_and_can_be_closed() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = crate::window::copy_of("lamp-commissioning", folder.path());
    let rows = path.with_extension("csv");
    let text = std::fs::read_to_string(&rows).expect("a copy");
    let wrong: Vec<String> = text
        .lines()
        .enumerate()
        .map(|(k, line)| {
            if k > 0 && k < 40 {
                format!("wrong{line}")
            } else {
                line.to_owned()
            }
        })
        .collect();
    std::fs::write(&rows, wrong.join("\n")).expect("a copy");
    for (size, least) in [
        ([683.0, 467.0], 90.0),
        ([1024.0, 700.0], 150.0),
        ([1280.0, 800.0], 150.0),
    ] {
        let mut window = window(size);
        crate::window::open(&mut window, &path);
        let plot = height(&window, "workspace plot").expect("a plot");
        assert!(plot >= least, "{size:?}: {plot}");
        let dismiss = window.get_by_label("Dismiss").rect();
        assert!(
            window.ctx.content_rect().contains_rect(dismiss),
            "{dismiss}"
        );
        press(&mut window, "Dismiss");
        assert!(!there(&window, "Dismiss"));
    }
}
