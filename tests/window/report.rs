//! What the window writes and copies about a session, without a display: the report as HTML and as
//! PDF, plots as SVG, the standards' figures, tables for a spreadsheet.

use std::path::Path;
use std::time::Duration;

use crate::window::{Window, press, says, window_of};
use egui::OutputCommand;
use egui_kittest::kittest::Queryable;
use truepose::gui::Runner;
use truepose::report::ExportedTable;
use truepose::sessions::load;
use truepose::standards::standards;

/// The dialog of the system cannot be driven; the path is typed.
fn save(window: &mut Window, replace: bool) {
    window.run_steps(4);
    if replace {
        press(window, "replace the file if it exists");
    }
    press(window, "Save");
    window.run_steps(4);
}

fn identified(window: &mut Window) {
    press(window, "3 Identify");
    press(window, "Identify");
}

fn is_said(window: &Window, text: &str) {
    assert!(says(window, text), "nothing says: {text}");
}

/// What the button puts on the clipboard.
fn copied(window: &mut Window, label: &str) -> String {
    window.get_by_label(label).click();
    for _ in 0..4 {
        window.step();
        let commands = &window.output().platform_output.commands;
        let text = commands.iter().find_map(|command| match command {
            OutputCommand::CopyText(text) => Some(text.clone()),
            _ => None,
        });
        if let Some(text) = text {
            return text;
        }
    }
    panic!("{label} copies nothing");
}

fn files_in(folder: &Path) -> usize {
    std::fs::read_dir(folder)
        .expect("the folder can be listed")
        .count()
}

#[test]
fn the_report_is_written_as_html_and_as_pdf_and_names_the_tables_of_this_session() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window_of([1280.0, 2000.0], None, Runner::AtOnce);
    identified(&mut window);
    press(&mut window, "5 Export");
    window.get_by_label("Report…");
    window.get_by_label("Report of the model…");
    let table = folder.path().join("pan.csv");
    window.state_mut().type_path("table", &table);
    save(&mut window, false);
    let hash = ExportedTable::read(&table)
        .expect("the table is there")
        .hash;

    let html = folder.path().join("Prüfung.html");
    window.state_mut().type_path("report", &html);
    save(&mut window, false);
    is_said(&window, "Saved ");
    is_said(&window, "Names the table pan.csv with its hash");
    let text = std::fs::read_to_string(&html).expect("the report is there");
    assert!(text.starts_with("<!doctype html>") && text.trim_end().ends_with("</html>"));
    assert!(text.contains("RMS error, model") && text.contains("Signatures"));
    assert!(text.contains(&hash), "the table stands in it with its hash");

    let pdf = folder.path().join("report.PDF");
    window.state_mut().type_path("report", &pdf);
    save(&mut window, false);
    let bytes = std::fs::read(&pdf).expect("the report is there");
    assert!(bytes.starts_with(b"%PDF-") && bytes.len() > 10_000);

    let model = folder.path().join("model.html");
    window.state_mut().type_path("report of the model", &model);
    save(&mut window, false);
    let text = std::fs::read_to_string(&model).expect("the report is there");
    assert!(text.contains("Calibration report of a model") && text.contains(&hash));
    assert!(text.contains("made from the model of this report"));
}

#[test]
fn a_wrong_ending_is_said_and_nothing_is_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window_of([1280.0, 2000.0], None, Runner::AtOnce);
    press(&mut window, "5 Export");
    for name in ["report.docx", "report"] {
        let path = folder.path().join(name);
        window.state_mut().type_path("report", &path);
        save(&mut window, false);
        is_said(&window, "ends in .html or .pdf");
        press(&mut window, "Dismiss");
    }
    let picture = folder.path().join("picture.gif");
    window.state_mut().type_path("deviation", &picture);
    save(&mut window, false);
    is_said(&window, "expected a file name that ends in .svg");
    assert_eq!(files_in(folder.path()), 0);
}

#[test]
fn a_report_replaces_neither_another_file_unasked_nor_a_table_of_this_session() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window_of([1280.0, 2000.0], None, Runner::AtOnce);
    identified(&mut window);
    press(&mut window, "5 Export");
    // A table may have any name, this one too.
    let table = folder.path().join("table.html");
    window.state_mut().type_path("table", &table);
    save(&mut window, false);
    let before = std::fs::read(&table).expect("the table is there");
    window.state_mut().type_path("report of the model", &table);
    save(&mut window, true);
    is_said(&window, "would replace the input");
    assert_eq!(std::fs::read(&table).expect("it is there still"), before);

    let other = folder.path().join("other.pdf");
    std::fs::write(&other, "mine").expect("it can be written");
    window.state_mut().type_path("report of the model", &other);
    save(&mut window, false);
    is_said(&window, "exists already");
    assert_eq!(std::fs::read(&other).expect("it is there still"), b"mine");
    window.state_mut().type_path("report of the model", &other);
    save(&mut window, true);
    let written = std::fs::read(&other).expect("it is there");
    assert!(written.starts_with(b"%PDF-"));
}

#[test]
fn a_report_that_is_cancelled_leaves_nothing_behind() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window_of([1280.0, 2000.0], None, Runner::Threads);
    press(&mut window, "5 Export");
    let path = folder.path().join("report.html");
    // How long one takes that nobody cancels.
    window.state_mut().type_path("report", &path);
    save(&mut window, false);
    let mut takes = 0;
    while !path.exists() && takes < 6000 {
        std::thread::sleep(Duration::from_millis(20));
        window.step();
        takes += 1;
    }
    assert!(path.exists(), "it can be written");
    std::fs::remove_file(&path).expect("it can be removed");
    window.run_steps(4);

    window.state_mut().type_path("report", &path);
    save(&mut window, false);
    let cancels = window.query_by_label("Cancel").is_some();
    assert!(cancels, "it is made in the background");
    press(&mut window, "Cancel");
    for _ in 0..takes + 25 {
        std::thread::sleep(Duration::from_millis(20));
        window.step();
    }
    assert_eq!(files_in(folder.path()), 0);
    assert!(window.query_by_label("Cancel").is_none());
}

#[test]
fn every_chart_is_saved_as_svg() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window_of([1280.0, 2000.0], None, Runner::AtOnce);
    window.get_by_label("Save picture: workspace…");
    {
        let plot = "deviation";
        window.get_by_label("Save picture: deviation over angle…");
        let path = folder.path().join(format!("{plot}-before.svg"));
        window.state_mut().type_path(plot, &path);
        save(&mut window, false);
        let svg = std::fs::read_to_string(&path).expect("the picture is there");
        assert!(
            svg.starts_with("<svg ") && svg.to_lowercase().contains("as measured"),
            "{svg}"
        );
        assert!(
            !svg.contains("Model residuals") && !svg.contains(">after<"),
            "nothing is identified yet"
        );
    }
    identified(&mut window);
    press(&mut window, "4 Diagnose");
    window.get_by_label("Save picture: gap by step…");
    for plot in ["deviation", "gap by step"] {
        let path = folder.path().join(format!("{plot}.svg"));
        window.state_mut().type_path(plot, &path);
        save(&mut window, false);
        is_said(&window, "Saved ");
        let svg = std::fs::read_to_string(&path).expect("the picture is there");
        assert!(svg.contains("http://www.w3.org/2000/svg") && svg.ends_with("</svg>\n"));
        let says = match plot {
            "gap by step" => ">full model<",
            _ => "Model residuals",
        };
        assert!(svg.contains(says), "{plot}: {svg}");
    }
}

#[test]
fn the_standards_figures_stand_beside_the_table_and_can_be_copied() {
    let mut window = window_of([1280.0, 2000.0], None, Runner::AtOnce);
    identified(&mut window);
    press(&mut window, "5 Export");
    is_said(&window, "ISO 230-2");
    is_said(&window, "ISO 9283");
    is_said(&window, "not every position was approached from both sides");
    let text = copied(&mut window, "Copy table of figures");
    let rows: Vec<Vec<&str>> = text.lines().map(|l| l.split('\t').collect()).collect();
    assert!(rows.iter().all(|row| row.len() == 4), "{text}");
    let one = rows.iter().find(|row| row[0] == "AP");
    let one = one.expect("the pose accuracy is there");
    let number = |k: usize| one[k].parse::<f64>().expect("a number");
    let session = Path::new(env!("CARGO_MANIFEST_DIR")).join("sessions/lamp-commissioning.json");
    let session = load(session).expect("a bundled session").session;
    let figures = standards(&session, None).expect("it has figures");
    assert_eq!(Some(number(2)), figures.poses.largest(false).accuracy);
    assert!(number(3) < number(2), "the table helps: {text}");
}

#[test]
fn the_tables_of_the_results_are_copied_for_a_spreadsheet() {
    let mut window = window_of([1280.0, 2000.0], None, Runner::AtOnce);
    identified(&mut window);
    let text = copied(&mut window, "Copy table of parameters");
    let offset = text
        .lines()
        .find(|line| line.contains("\toffset\t"))
        .expect("the zero offset is there");
    let cells: Vec<&str> = offset.split('\t').collect();
    let [value, from, to] = [3, 4, 5].map(|k| cells[k].parse::<f64>().expect("a number"));
    assert!(from < value && value < to && cells[6] == "°", "{offset}");

    press(&mut window, "2 Regions");
    press(&mut window, "Identify by region");
    let text = copied(&mut window, "Copy table of regions");
    let columns = |line: &str| line.split('\t').count();
    assert!(text.lines().count() > 2, "{text}");
    assert!(text.lines().all(|line| columns(line) == 12), "{text}");
}
