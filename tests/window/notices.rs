//! What comes and goes by itself moves nothing: messages and notices of files lie over the results.

use std::path::{Path, PathBuf};

use crate::window::{Window, come_back, copy_of, open, press, says, there, window_of};
use egui::Rect;
use egui::accesskit::Role;
use egui_kittest::kittest::{NodeT, Queryable};
use truepose::gui::Runner;

/// Where the plots are.
fn plots(window: &Window) -> Vec<Rect> {
    let nodes = window.root().children_recursive();
    let figures = nodes.filter(|node| node.accesskit_node().role() == Role::Figure);
    figures.map(|node| node.rect()).collect()
}

fn wrong(folder: &Path) -> PathBuf {
    let path = folder.join("wrong.json");
    std::fs::write(&path, "{\n  \"format\": \"truepose-session/9\"\n}").expect("written");
    path
}

#[test]
fn a_message_and_a_file_that_changed_move_no_plot_and_lie_on_none() {
    let folder = tempfile::tempdir().expect("a folder");
    let session = copy_of("lamp-commissioning", folder.path());
    for size in [[1024.0, 700.0], [1280.0, 800.0], [1920.0, 1080.0]] {
        let mut window = window_of(size, Some(session.clone()), Runner::AtOnce);
        press(&mut window, "1 Session");
        let before = plots(&window);
        assert!(before.len() >= 2, "{before:?}");
        open(&mut window, &wrong(folder.path()));
        assert!(says(&window, "could not be opened; nothing was changed"));
        assert_eq!(plots(&window), before, "{size:?}: a message");
        let rows = session.with_extension("csv");
        let text = std::fs::read_to_string(&rows).expect("a copy");
        std::fs::write(&rows, format!("{text}\n")).expect("written");
        come_back(&mut window);
        assert!(says(&window, "was changed by another program"));
        assert_eq!(plots(&window), before, "{size:?}: a file that changed");
        // Both can be read and answered, and neither is over a plot.
        let right = before.iter().map(Rect::right).fold(0.0, f32::max);
        let whole = window.ctx.content_rect();
        for button in ["Dismiss", "Reload", "Keep this version"] {
            let rect = window.get_by_label(button).rect();
            assert!(whole.contains_rect(rect), "{size:?}: {button} at {rect}");
            assert!(rect.left() > right, "{size:?}: {button} at {rect}");
        }
        press(&mut window, "Keep this version");
        press(&mut window, "Dismiss");
        assert!(!there(&window, "Dismiss") && !there(&window, "Reload"));
        assert_eq!(plots(&window), before, "{size:?}: both are gone");
    }
}
