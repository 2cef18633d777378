//! A table without a robot, opened in the window: looked at, asked about, imported, saved.

use std::fs;
use std::path::{Path, PathBuf};

use crate::window::{Window, gaps, open, press, says, there, type_into, window};
use egui::Key;
use egui_kittest::kittest::Queryable;

/// The bundled run as another program would have written it.
fn foreign(folder: &Path, heading: &str, separator: &str, comma: bool, factor: f64) -> PathBuf {
    let bundled = concat!(env!("CARGO_MANIFEST_DIR"), "/sessions/paper-run.csv");
    let text = fs::read_to_string(bundled).expect("a bundled session");
    let mut out = format!("{heading}\n");
    for line in text.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let mut row = vec![cells[0].to_owned()];
        for cell in &cells[1..3] {
            let mm: f64 = cell.parse().expect("a number");
            row.push(format!("{:.6}", mm * factor));
        }
        let row = row.join(separator);
        out.push_str(&if comma { row.replace('.', ",") } else { row });
        out.push('\n');
    }
    let path = folder.join("tracker.txt");
    fs::write(&path, out).expect("written");
    path
}

#[test]
fn a_table_with_semicolons_and_commas_becomes_a_session() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = foreign(folder.path(), "q1_deg;x_mm;y_mm", ";", true, 1.0);
    let mut window = window(None);
    open(&mut window, &path);
    assert!(says(&window, "Import tracker.txt"));
    assert!(says(&window, "361 rows · separated by semicolons"));
    assert!(
        says(&window, "Choose the robot that was measured"),
        "nothing is guessed"
    );
    press(&mut window, "that of the example The paper's full run");
    press(&mut window, "Import");
    assert!(says(&window, "361 samples · RMS error"));
    assert!(says(&window, "not saved"));
    assert!(says(&window, "the side of approach is not stated"));
    for word in ["--", "sigma_mm"] {
        assert!(!says(&window, word), "{word} is no word of the window");
    }
    let (gap, _) = gaps(&window);
    assert!(gap > 5.0 && gap < 20.0, "{gap}: in mm");
}

#[test]
fn a_unit_that_nobody_says_is_asked_for() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = foreign(folder.path(), "q1_deg,x,y", ",", false, 0.001);
    let mut window = window(None);
    open(&mut window, &path);
    press(&mut window, "that of the example The paper's full run");
    assert!(says(&window, "Answer what is asked above first"));
    press(&mut window, "It is m");
    assert!(!says(&window, "Answer what is asked above first"));
    press(&mut window, "Import");
    assert!(says(&window, "361 samples · RMS error"));
    let (gap, _) = gaps(&window);
    assert!(gap > 5.0 && gap < 20.0, "{gap}: metres were made mm");
}

#[test]
fn a_robot_that_cannot_be_read_is_said_on_the_sheet() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = foreign(folder.path(), "q1_deg,x_mm,y_mm", ",", false, 1.0);
    let mut window = window(None);
    open(&mut window, &path);
    press(&mut window, "from this file");
    assert!(says(&window, "Say which file the robot is in"));
    type_into(&mut window, "File of the robot", "no such robot.json");
    assert!(says(&window, "no such robot.json: no such file"));
    assert!(says(&window, "The robot cannot be read like this"));
    window.get_by_label("Import").click();
    window.run_steps(4);
    assert!(
        says(&window, "Import tracker.txt"),
        "the sheet is there still"
    );
    let unnamed = window.unnamed_widgets();
    assert!(unnamed.is_empty(), "{unnamed:?}");
    press(&mut window, "Cancel");
    assert!(says(&window, "208 samples · RMS error"));
}

/// A file of the walk through a calibration.
fn walk(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("sessions/walk-through")
        .join(name)
}

/// A file of the importers' own tests.
fn quirk(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/data/imports")
        .join(name)
}

fn type_path(window: &mut Window, label: &str, path: &Path) {
    type_into(window, label, path.to_str().expect("a path in UTF-8"));
}

/// Chooses what a column is from its list.
fn take_column_for(window: &mut Window, column: usize, meaning: &str) {
    // The table has a bar of its own, and takes no part in scrolling up and down.
    window.get_by_label("What wrote the file").scroll_to_me();
    window.run_steps(8);
    press(window, &format!("Meaning of column {column}"));
    press(window, meaning);
}

#[test]
fn guessed_columns_have_to_be_confirmed() {
    let mut window = window(None);
    open(&mut window, &walk("tracker.txt"));
    assert!(
        says(&window, "guessed from the values"),
        "a guess is called one"
    );
    press(&mut window, "It is mm");
    assert!(says(&window, "5 of 5 columns are guessed"));
    assert!(says(&window, "Look at the columns above, and confirm them"));
    // What somebody chose is no guess any more; the others still are.
    take_column_for(&mut window, 1, "reflector");
    assert!(says(&window, "as you said"));
    assert!(says(&window, "4 of 5 columns are guessed"));
    press(&mut window, "The columns are right");
    assert!(!says(&window, "columns are guessed"));
    assert!(says(&window, "Choose the robot that was measured"));
    press(&mut window, "Cancel");
    assert!(says(&window, "208 samples · RMS error"));
}

#[test]
fn alignment_shows_how_far_each_point_is_off() {
    let mut window = window(None);
    open(&mut window, &walk("tracker.txt"));
    press(&mut window, "mm");
    press(&mut window, "The columns are right");
    press(&mut window, "from this file");
    type_path(&mut window, "File of the robot", &walk("robot.json"));
    assert!(says(&window, "inspection column: one joint that turns"));
    assert!(
        says(&window, "Choose the file of the commanded positions"),
        "what is missing is asked for"
    );
    assert!(!says(&window, "To fix"), "nothing has been done wrong yet");
    assert!(!says(&window, "--"), "no option of the command line");
    type_path(&mut window, "File of the commands", &walk("commands.csv"));
    assert!(says(&window, "181 measurements and 168 commands"));
    press(&mut window, "by name");
    assert!(says(&window, "several targets"));
    type_path(
        &mut window,
        "File of the reflectors",
        &walk("reflectors.csv"),
    );
    assert!(says(&window, "168") && says(&window, "RMS error, nominal robot"));
    assert!(says(&window, "13 measured, 0 commanded"));
    type_path(
        &mut window,
        "File of the known points",
        &walk("base-points.csv"),
    );
    assert!(says(&window, "10 points, RMS distance 0.00587 mm"));
    assert!(says(&window, "2 excluded"), "B4 was moved, measured twice");
    for point in ["B1", "B2", "B3", "B4", "B5", "B6"] {
        let measured = window.query_all_by_label(point).count();
        assert!(measured >= 2, "{point} at the start and at the end");
    }
    assert!(says(&window, "0.9034"), "as far as B4 is off");
    assert!(says(&window, "2.58 mm"));
    press(&mut window, "Import");
    assert!(says(&window, "168 samples · RMS error"));
    assert!(says(&window, "not saved"));
}

#[test]
fn two_logs_are_matched_by_their_clocks() {
    let mut window = window(None);
    open(&mut window, &quirk("motive.csv"));
    assert!(there(&window, "y points up: turn it so that z does"));
    press(&mut window, "from this file");
    type_path(&mut window, "File of the robot", &quirk("robot.json"));
    type_path(
        &mut window,
        "File of the commands",
        &quirk("controller-log.csv"),
    );
    press(&mut window, "by time");
    press(&mut window, "y points up: turn it so that z does");
    assert!(says(&window, "What the import brings"));
    assert!(says(&window, "clock offset") && says(&window, "± 0.00"));
    press(&mut window, "typed");
    type_into(&mut window, "Seconds to add to a measured time", "1000");
    assert!(says(
        &window,
        "no measurement falls into the time of the commands"
    ));
    assert!(says(&window, "“Clocks apart by”"), "not an option's name");
    press(&mut window, "found from the motion");
    press(&mut window, "Import");
    assert!(says(&window, "samples · RMS error"));
    assert!(says(&window, "not saved"));
}

#[test]
fn a_table_without_a_header_gets_its_columns_from_a_person() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = foreign(folder.path(), "# nothing said", "\t", false, 1.0);
    let mut window = window(None);
    open(&mut window, &path);
    take_column_for(&mut window, 1, "joint 1 commanded, °");
    take_column_for(&mut window, 2, "x, mm");
    take_column_for(&mut window, 3, "y, mm");
    press(&mut window, "one axis or more, typed here");
    assert!(says(&window, "the tool lies on the axis"));
    type_into(&mut window, "Tool x", "250");
    type_into(&mut window, "Tool z", "300");
    assert!(says(&window, "robot: one joint that turns, tool 391 mm"));
    press(&mut window, "Import");
    assert!(says(&window, "361 samples · RMS error"));
    let (gap, _) = gaps(&window);
    assert!(gap > 5.0 && gap < 20.0, "{gap}: in mm");
}

#[test]
fn a_header_can_be_said_to_be_in_another_line() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("odd.csv");
    let text = "q1_deg,x_mm,y_mm\n1,2,3\nq1_deg,y_mm,x_mm\n10,43,246\n20,85,235\n";
    fs::write(&path, text).expect("written");
    let mut window = window(None);
    open(&mut window, &path);
    assert!(says(&window, "header in line 1"));
    assert!(there(&window, "error"), "a heading among the rows is wrong");
    press(&mut window, "in line");
    type_into(&mut window, "Line of the header", "3");
    assert!(says(&window, "2 rows"));
    assert!(says(&window, "header in line 3"));
    assert!(!there(&window, "error"));
    press(&mut window, "none");
    assert!(says(&window, "no header"));
}

#[test]
fn files_that_are_no_tables_are_refused_with_what_to_do() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        fs::write(&path, bytes).expect("written");
        path
    };
    let empty = write("empty.txt", b"");
    let picture = write("picture.csv", include_bytes!("../../assets/icon.png"));
    let prose = write("letter.txt", b"Dear Sir,\nno numbers here\n");
    // Longer than anything that is read, and takes no room on the disk.
    let huge = folder.path().join("huge.txt");
    let file = fs::File::create(&huge).expect("made");
    file.set_len(3 << 30).expect("a sparse file");
    let mut window = window(None);
    for (path, because) in [
        (&empty, "an empty file"),
        (&picture, "a zero byte"),
        (&huge, "cut it into parts"),
    ] {
        open(&mut window, path);
        assert!(says(&window, "could not be opened; nothing was changed"));
        assert!(says(&window, because), "{because}");
        assert!(
            says(&window, "208 samples · RMS error"),
            "nothing was changed"
        );
        press(&mut window, "Dismiss");
    }
    open(&mut window, &prose);
    assert!(says(&window, "no table: no line of cells"));
    assert!(says(&window, "The file cannot be read like this"));
}

#[test]
fn a_robot_of_a_urdf_file_is_named_by_its_links() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = foreign(folder.path(), "q1_deg,x_mm,y_mm", ",", false, 1.0);
    let urdf = folder.path().join("column.urdf");
    let text = r#"<robot name="column"><link name="base"/><link name="arm"/>
        <joint name="pan" type="revolute"><parent link="base"/><child link="arm"/>
        <origin xyz="0 0 0.3" rpy="0 0 0"/><axis xyz="0 0 1"/>
        <limit lower="-1.6" upper="1.6" effort="1" velocity="1"/></joint>
        <link name="tool"/><joint name="flange" type="fixed"><parent link="arm"/>
        <child link="tool"/><origin xyz="0.25 0 0" rpy="0 0 0"/></joint></robot>"#;
    fs::write(&urdf, text).expect("written");
    let mut window = window(None);
    open(&mut window, &path);
    press(&mut window, "from this file");
    type_path(&mut window, "File of the robot", &urdf);
    type_into(&mut window, "Link of the base", "base");
    type_into(&mut window, "Link of the tool", "tool");
    assert!(says(&window, "column: one joint that turns, tool 391 mm"));
    press(&mut window, "Import");
    assert!(says(&window, "361 samples · RMS error"));
}

#[test]
fn what_was_said_of_a_file_is_there_when_it_is_opened_again() {
    let mut window = window(None);
    let left = "tracker.txt was not imported";
    open(&mut window, &walk("tracker.txt"));
    press(&mut window, "Cancel");
    assert!(!says(&window, left), "nothing was said that could be lost");
    open(&mut window, &walk("tracker.txt"));
    press(&mut window, "It is mm");
    take_column_for(&mut window, 1, "reflector");
    press(&mut window, "The columns are right");
    window.key_press(Key::Escape);
    window.run_steps(4);
    assert!(says(&window, left) && !says(&window, "Import tracker.txt"));
    // Another file in between takes nothing from it.
    open(&mut window, &quirk("motive.csv"));
    assert!(!says(&window, "as you said"));
    press(&mut window, "Cancel");
    open(&mut window, &walk("tracker.txt"));
    assert!(says(&window, "as you said") && !says(&window, "columns are guessed"));
    assert!(says(&window, "Choose the robot that was measured"));
}

#[test]
fn a_robot_of_the_library_is_found_by_typing() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = foreign(folder.path(), "q1_deg,x_mm,y_mm", ",", false, 1.0);
    let mut window = window(None);
    open(&mut window, &path);
    type_into(&mut window, "Find a robot", "no such thing");
    assert!(says(&window, "No robot has this name"));
    assert!(says(&window, "Choose the robot that was measured"));
    type_into(&mut window, "Find a robot", "ur5e");
    assert!(says(&window, "UR5e: 6 joints, 6 of which turn"));
    // The reason of a refusal stands in its place, and in the foot.
    let reason = "no column 'q2'";
    assert_eq!(window.query_all_by_label_contains(reason).count(), 2);
    press(&mut window, "Find a robot");
    window.get_by_label("Find a robot").type_text("kr 6");
    window.run_steps(4);
    assert!(!says(&window, "UR5e"), "typing looks for another");
    press(&mut window, "KUKA KR 6 R900 sixx");
    assert!(says(&window, "KR 6 R900"));
    press(&mut window, "that of the example The paper's full run");
    assert!(
        !says(&window, "KR 6 R900"),
        "what was typed is gone with it"
    );
}
