//! The step that divides the joint's range, as a person works in it: even, by hand, where the data
//! ask for it; typed, split, merged, deleted, renamed, and what is said when it cannot be.

use crate::window::{Window, copy_of, keys, press, says, there, type_into, window};
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT, Queryable};

/// The window on the session that it opens with: six regions of 50° from −150° to 150°.
fn regions() -> Window {
    let mut window = window(None);
    press(&mut window, "2 Regions");
    window
}

fn value(window: &Window, label: &str) -> String {
    let field = window.get_by_label(label);
    let value = field.accesskit_node().value();
    value.expect("it is a field").clone()
}

/// From and to of a region, as its fields say it.
fn ends(window: &Window, region: &str) -> (String, String) {
    let of = |end: &str| value(window, &format!("region {region}: {end}"));
    (of("from"), of("to"))
}

fn pair(from: &str, to: &str) -> (String, String) {
    (from.to_owned(), to.to_owned())
}

/// Uses a region's menu.
fn with_region(window: &mut Window, region: &str, what: &str) {
    press(window, &format!("region {region}: Edit"));
    window.get_by_label_contains(what).click();
    window.run_steps(4);
}

#[test]
fn the_number_of_even_regions_is_taken_at_once_and_undone_in_one_step() {
    let mut window = regions();
    press(&mut window, "Uniform");
    type_into(&mut window, "Number of regions", "4");
    assert_eq!(ends(&window, "4"), pair("75", "150"));
    assert!(there(&window, "region 4: to") && !there(&window, "region 5: to"));
    assert!(says(&window, "Correction of each region"));
    keys(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(ends(&window, "6"), pair("100", "150"));
}

/// A diagnosis replaces what is identified by region: the main button passes it by, unless regions were made by hand.
#[test]
fn only_regions_made_by_hand_are_led_to() {
    let mut window = regions();
    keys(&mut window, Modifiers::COMMAND, Key::Enter);
    assert!(
        !says(&window, "by region"),
        "nothing is identified by region"
    );
    assert!(says(&window, "Effects to fit"), "the next step is");
    press(&mut window, "2 Regions");
    type_into(&mut window, "region 1: name", "left");
    keys(&mut window, Modifiers::COMMAND, Key::Enter);
    assert!(says(&window, "Correction of each region"));
    keys(&mut window, Modifiers::COMMAND, Key::Z);
    // Once the full model is identified nothing leads back.
    press(&mut window, "3 Identify");
    press(&mut window, "Identify");
    press(&mut window, "2 Regions");
    window.get_by_label("Identify by region");
    keys(&mut window, Modifiers::COMMAND, Key::Enter);
    assert!(says(&window, "Effects to fit"));
}

#[test]
fn the_adaptive_division_says_what_it_decided_and_can_be_edited() {
    let mut window = regions();
    press(&mut window, "Adaptive");
    assert!(says(
        &window,
        "where the deviation changes by more than the noise"
    ));
    assert!(says(&window, "They leave"));
    let (_, to) = ends(&window, "1");
    type_into(&mut window, "region 1: to", "-120.5");
    assert_eq!(ends(&window, "1").1, "−120.5");
    assert!(
        !says(&window, "They leave"),
        "it is not what was decided any more"
    );
    keys(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(ends(&window, "1").1, to);
    assert!(says(&window, "They leave"));
}

#[test]
fn a_boundary_that_is_typed_moves_both_regions_and_the_answer_and_is_one_step_of_undo() {
    let mut window = regions();
    type_into(&mut window, "region 2: to", "-45");
    assert_eq!(ends(&window, "2"), pair("−100", "−45"));
    assert_eq!(ends(&window, "3").0, "−45");
    assert!(says(&window, "Correction of each region"));
    keys(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(ends(&window, "2").1, "−50");
    assert!(
        !there(&window, "Undo change regions"),
        "one step back was all"
    );
}

#[test]
fn a_boundary_that_is_typed_stops_at_its_neighbours_and_what_is_no_angle_is_refused() {
    let mut window = regions();
    for (field, text, stands) in [
        ("region 2: to", "20", "−0.5"),
        ("region 3: from", "-100", "−99.5"),
        ("region 6: to", "190", "150"),
        ("region 1: to", "-5o", "−100"),
    ] {
        type_into(&mut window, field, text);
        assert_eq!(value(&window, field), stands, "{field} {text}");
    }
    assert!(says(&window, "the value is kept"));
}

#[test]
fn a_region_that_is_deleted_leaves_a_gap_into_which_nothing_may_overlap() {
    let mut window = regions();
    with_region(&mut window, "3", "Delete");
    assert!(!there(&window, "region 3: from"));
    assert!(says(&window, "−50° … 0°: in no region"));
    type_into(&mut window, "region 2: to", "10");
    assert_eq!(ends(&window, "2").1, ends(&window, "4").0, "they touch");
    // The gap is closed, and the two share their boundary from then on.
    assert!(!says(&window, "in no region"));
    type_into(&mut window, "region 2: to", "5");
    assert_eq!(ends(&window, "4").0, "5");
}

#[test]
fn regions_are_split_merged_and_renamed() {
    let mut window = regions();
    with_region(&mut window, "2", "Split in half");
    assert_eq!(ends(&window, "7"), pair("−75", "−50"));
    with_region(&mut window, "2", "Merge with neighbour");
    assert_eq!(ends(&window, "2"), pair("−100", "−50"));
    assert!(!there(&window, "region 7: from"));

    with_region(&mut window, "6", "Merge with neighbour");
    assert_eq!(
        ends(&window, "5"),
        pair("50", "150"),
        "the last goes to the one before"
    );
    with_region(&mut window, "5", "Delete");
    assert!(!there(&window, "region 5: from"));
    window.get_by_label("region 1: name").focus();
    window.run_steps(2);
    keys(&mut window, Modifiers::COMMAND, Key::A);
    window.get_by_label("region 1: name").type_text("parking");
    window.run_steps(2);
    keys(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(ends(&window, "parking"), pair("−150", "−100"));
}

#[test]
fn two_regions_cannot_have_one_name() {
    let mut window = regions();
    type_into(&mut window, "region 1: name", "2");
    assert!(says(&window, "2 is taken; choose another name"));
    assert_eq!(ends(&window, "1"), pair("−150", "−100"));
}

#[test]
fn the_samples_of_a_region_are_shown_in_plot_and_table() {
    let mut window = regions();
    press(&mut window, "region 1: 40 samples");
    assert!(says(&window, "angle, °"), "the table is there");
    assert!(says(&window, "−150"), "and in it the first of them");
}

#[test]
fn a_region_with_no_sample_or_one_says_so_in_words() {
    let mut window = regions();
    // Samples stand 11.25° apart: what lies between two of them is empty.
    type_into(&mut window, "region 1: to", "-149");
    press(&mut window, "Uniform");
    type_into(&mut window, "Number of regions", "60");
    assert!(says(
        &window,
        "no sample, so no correction: measure here, or merge it"
    ));
}

#[test]
fn a_session_at_one_angle_says_why_there_are_no_regions() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = copy_of("paper-30", folder.path());
    let mut document: serde_json::Value =
        serde_json::from_slice(&std::fs::read(&path).expect("readable")).expect("JSON");
    let document = document.as_object_mut().expect("a session");
    document.remove("regions");
    if let Some(joint) = document["robot"]["joints"][0].as_object_mut() {
        joint.remove("limits");
    }
    std::fs::write(&path, serde_json::to_vec(document).expect("JSON")).expect("written");
    let samples = path.with_extension("csv");
    let text = std::fs::read_to_string(&samples).expect("readable");
    let head = text.lines().next().expect("a header").to_owned();
    let row = text.lines().nth(1).expect("a sample");
    std::fs::write(&samples, format!("{head}\n{row}\n{row}\n")).expect("written");

    let mut window = window(Some(path));
    press(&mut window, "2 Regions");
    assert!(
        says(&window, "because all samples are at one angle"),
        "it says why"
    );
    assert!(
        says(&window, "Give the joint its limits in Session"),
        "and what to do"
    );
    press(&mut window, "Continue to identify");
}

#[test]
fn a_long_name_pushes_nothing_out_of_the_window() {
    let mut window = window(None);
    press(&mut window, "2 Regions");
    press(&mut window, "Manual");
    let name = "left side; a very long name of a region that goes on and on";
    type_into(&mut window, "region 1: name", name);
    press(&mut window, "Identify by region");
    press(&mut window, "2 Regions");
    assert!(there(&window, &format!("region {name}: name")));
    let whole = window.ctx.content_rect();
    let heads = ["region", "Δθ, °", "Δl1, mm", "RMS error, mm"];
    let heads = heads.map(|head| window.get_by_label(head).rect());
    assert!(
        heads
            .windows(2)
            .all(|pair| pair[0].right() < pair[1].left())
    );
    // What has no place is not drawn.
    let drawn = window.root().children_recursive();
    for node in drawn.filter(|node| node.accesskit_node().bounding_box().is_some()) {
        let (rect, label) = (node.rect(), node.accesskit_node().label());
        assert!(rect.right() <= whole.right() + 1.0, "{label:?} at {rect}");
    }
}
