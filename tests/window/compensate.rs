//! Targets and programs in the window, without a display: corrected by the model that is shown, seen side
//! by side, saved with what was changed beside them.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::window::{
    Window, open, press, says, there, type_into, until, window_choosing, window_of,
};
use egui_kittest::kittest::{NodeT, Queryable};
use truepose::gui::Runner;

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/data/programs")
        .join(name)
}

/// A six-joint arm, identified, at the Export step.
fn at_export() -> Window {
    let mut window = window_of([1280.0, 1000.0], Some(data("arm.json")), Runner::AtOnce);
    press(&mut window, "2 Identify");
    press(&mut window, "Identify");
    press(&mut window, "4 Export");
    window
}

fn compensate(window: &mut Window, file: &Path) {
    window.state_mut().compensate(file);
    window.run_steps(4);
}

#[test]
fn a_program_is_corrected_shown_side_by_side_and_saved() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = at_export();
    window.get_by_label("Compensate…");
    compensate(&mut window, &data("cell.mod"));
    assert!(says(&window, "Compensate cell.mod"));
    assert!(says(&window, "RAPID"));
    assert!(says(&window, "Lines that change"));
    let before = std::fs::read_to_string(data("cell.mod")).expect("it is there");
    let target = before
        .lines()
        .find(|l| l.contains("jointtarget j1"))
        .expect("a target");
    window.get_by_label(target.trim());
    press(&mut window, "the measuring frame is the robot's base");
    assert!(says(
        &window,
        "is the frame in which the session was measured"
    ));

    let path = folder.path().join("cell-corrected.mod");
    window.state_mut().type_path("targets", &path);
    window.run_steps(4);
    press(&mut window, "Save");
    window.run_steps(4);
    let after = std::fs::read_to_string(&path).expect("it was saved");
    assert_eq!(before.lines().count(), after.lines().count());
    assert!(!after.contains(target.trim()), "the target is another now");
    let beside = folder.path().join("cell-corrected.mod.meta.json");
    let beside = std::fs::read_to_string(beside).expect("it says what was changed");
    assert!(beside.contains("truepose-compensation/1"), "{beside}");
}

/// Where a robot comes from, and where the program's frame is, is typed as in the terminal: without that no pose is
/// corrected that several joint values reach. What cannot be read is said.
#[test]
fn where_the_robot_comes_from_and_the_frame_of_its_program_are_typed() {
    let mut window = at_export();
    compensate(&mut window, &data("poses.csv"));
    assert!(says(&window, "0 of 12 targets corrected"));
    press(&mut window, "More");
    let start = "41.282,87.387,29.623,-87.934,-47.960,-168.210";
    type_into(
        &mut window,
        "Joint values before the first target: Q1,Q2,…",
        start,
    );
    assert!(says(&window, "12 of 12 targets corrected"));
    // The lines as they were and as they are corrected.
    let lines = |window: &Window| -> Vec<String> {
        let all = window.query_all_by(|node| node.value().is_some());
        let all = all.filter_map(|node| node.accesskit_node().value());
        all.filter(|line| line.matches(',').count() > 4).collect()
    };
    let before = lines(&window);
    let frame = "Frame of the program: X,Y,Z[,A,B,C|,QW,QX,QY,QZ]";
    type_into(&mut window, frame, "0,0,1");
    let after = lines(&window);
    assert!(!after.is_empty() && after != before);
    type_into(&mut window, frame, "0,0");
    assert!(says(
        &window,
        "Frame of the program: 2 numbers; expected X,Y,Z"
    ));
    type_into(&mut window, frame, "0,0,1");
    let tool = "Tool of the program: X,Y,Z[,A,B,C|,QW,QX,QY,QZ]|NAME";
    type_into(&mut window, tool, "0,0,90");
    let with_tool = lines(&window);
    assert!(!with_tool.is_empty() && with_tool != after);
    let on_flange = "Tool of the model on the flange: X,Y,Z[,A,B,C|,QW,QX,QY,QZ]";
    type_into(&mut window, on_flange, "0,0,90,0");
    assert!(says(&window, "Tool of the model on the flange: 4 numbers"));
}

/// As it is where the system has no dialog for files: the program's path is typed, or it is dropped.
#[test]
fn a_program_that_is_opened_is_corrected() {
    let mut window = at_export();
    press(&mut window, "1 Session");
    let path = data("cell.mod").display().to_string();
    type_into(&mut window, "Path of a session or model", &path);
    assert!(says(&window, "Compensate cell.mod"));
    assert!(says(&window, "RAPID"));
}

/// Never over the program that it was made of, not even where replacing is allowed.
#[test]
fn the_program_itself_is_not_replaced() {
    let folder = tempfile::tempdir().expect("a folder");
    let program = folder.path().join("cell.mod");
    std::fs::copy(data("cell.mod"), &program).expect("copied");
    let mut window = at_export();
    compensate(&mut window, &program);
    window.state_mut().type_path("targets", &program);
    window.run_steps(4);
    press(&mut window, "replace the file if it exists");
    press(&mut window, "Save");
    window.run_steps(4);
    let before = std::fs::read(data("cell.mod")).expect("read");
    assert_eq!(std::fs::read(&program).expect("read"), before);
    assert!(
        says(&window, "would replace") || says(&window, "input"),
        "the refusal is shown"
    );
}

#[test]
fn a_file_without_targets_is_refused_with_its_place() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("targets.csv");
    std::fs::write(
        &file,
        "name;q1_deg;q2_deg;q3_deg;q4_deg;q5_deg;q6_deg\nP0;a;1;2;3;4;5\n",
    )
    .expect("written");
    let mut window = at_export();
    compensate(&mut window, &file);
    assert!(says(&window, "Compensate targets.csv"));
    assert!(
        says(&window, "line 2"),
        "the place of the wrong cell is said"
    );
    // Nothing is done: the next step is another file.
    assert!(!there(&window, "Done"));
    window.get_by_label("Choose another file…");
    press(&mut window, "Cancel");
    assert!(!says(&window, "Compensate targets.csv"));
}

/// Tools and bases that a program uses stand in a file of its controller; it is read with it from then on.
#[test]
fn a_file_of_the_controller_is_read_with_the_program() {
    let folder = tempfile::tempdir().expect("a folder");
    let (program, list) = (
        folder.path().join("m.src"),
        folder.path().join("$config.dat"),
    );
    let target = "X 62.222,Y 61.710,Z 536.163,A -141.3534,B -26.4136,C -46.7269,S 0,T 18";
    let lines = format!("DEF m()\nBAS(#TOOL,2)\nBAS(#BASE,1)\nLIN {{{target}}}\nEND\n");
    std::fs::write(&program, lines).expect("written");
    let frames = "BASE_DATA[1]={x 100.0,y 0.0,z 50.0,a 0.0,b 0.0,c 0.0}\n\
                  TOOL_DATA[2]={x 0.0,y 0.0,z 0.0,a 0.0,b 0.0,c 0.0}\n";
    std::fs::write(&list, format!("DEFDAT $CONFIG\n{frames}ENDDAT\n")).expect("written");
    let chosen = list.clone();
    let mut window = window_choosing(Arc::new(move || Some(chosen.clone())));
    open(&mut window, &data("arm.json"));
    until(&mut window, "2 Identify");
    press(&mut window, "2 Identify");
    press(&mut window, "Identify");
    until(&mut window, " → ");
    compensate(&mut window, &program);
    until(&mut window, "Compensate m.src");
    press(&mut window, "Choose…: Files of the controller");
    until(&mut window, "$config.dat");
    for of in ["Tool", "Frame"] {
        let says = format!("{of} of the program: as the program writes it");
        if there(&window, &says) {
            press(&mut window, &says);
        }
    }
    until(&mut window, "Lines that change");
    // The same program once more has it still; it can be taken away again.
    press(&mut window, "Cancel");
    compensate(&mut window, &program);
    until(&mut window, "Lines that change");
    press(&mut window, "Without $config.dat");
    for _ in 0..500 {
        std::thread::sleep(std::time::Duration::from_millis(2));
        window.step();
    }
    assert!(!there(&window, "Without $config.dat"));
}
