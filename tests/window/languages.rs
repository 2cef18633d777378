//! The window in every language: one file of texts each, complete; no text outside of them; and
//! nothing that is cut because it is longer.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use egui::accesskit::Role;
use egui::{Key, Modifiers, Rect};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use truepose::gui::{App, Language, Runner};

use crate::record::open_records;
use crate::sizes::{
    Thing, interactive, look, no_text_is_cut, no_text_is_cut_but_at_the_right, things,
};
use crate::touring::texts;
use crate::window::{Window, keys, press, there};

const SHIFTED: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

fn file(language: &str) -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    root.join(format!("assets/languages/{language}.po"))
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// A window that speaks this language from the beginning.
fn window(language: Language, size: [f32; 2], path: Option<PathBuf>) -> Window {
    let mut window = Harness::builder()
        .with_size(size)
        .build_eframe(|cc| App::new(&cc.egui_ctx, path, Runner::AtOnce).speaking(language));
    window.run_steps(6);
    window
}

/// Goes to what is in the window by keys, which are the same in every language, and looks at each.
fn visit(window: &mut Window, see: &mut dyn FnMut(&Window, &str)) {
    steps(window, see);
    keys(window, Modifiers::COMMAND, Key::Num4);
    choose_everything(window, see);
}

/// The same, but for what is to be chosen.
fn steps(window: &mut Window, see: &mut dyn FnMut(&Window, &str)) {
    let numbers = [Key::Num1, Key::Num2, Key::Num3, Key::Num4, Key::Num5];
    let work = [
        ("as opened", None),
        ("identified", Some(Key::I)),
        ("diagnosed", Some(Key::G)),
    ];
    for (stage, key) in work {
        if let Some(key) = key {
            keys(window, Modifiers::COMMAND, key);
            window.run_steps(4);
        }
        for (k, number) in numbers.into_iter().enumerate() {
            keys(window, Modifiers::COMMAND, number);
            see(window, &format!("{stage}, step {}", k + 1));
        }
    }
    for (k, number) in numbers.into_iter().enumerate() {
        keys(window, SHIFTED, number);
        see(window, &format!("view {}", k + 1));
    }
}

/// Presses every choice and check box of the step, once each.
fn choose_everything(window: &mut Window, see: &mut dyn FnMut(&Window, &str)) {
    let mut tried: BTreeSet<String> = BTreeSet::new();
    for _ in 0..80 {
        let next = window.root().children_recursive().find_map(|node| {
            let node = node.accesskit_node();
            let choice = matches!(node.role(), Role::RadioButton | Role::CheckBox);
            let label = node.label()?;
            let fresh = choice && !node.is_disabled() && !tried.contains(&label);
            fresh.then_some(label)
        });
        let Some(label) = next else {
            return;
        };
        let node = window.query_all_by_label(&label).next();
        node.expect("it was there").click();
        window.run_steps(3);
        see(window, &format!("chosen: {label}"));
        tried.insert(label);
    }
    panic!("there is no end to what can be chosen: {tried:?}");
}

/// Opens every sheet that a key opens, and each menu.
fn open_all(window: &mut Window, see: &mut dyn FnMut(&Window, &str)) {
    for (name, modifiers, key) in [
        ("simulation", Modifiers::COMMAND, Key::N),
        ("robots", SHIFTED, Key::N),
        ("path", SHIFTED, Key::P),
        ("preferences", Modifiers::COMMAND, Key::Comma),
        ("glossary", Modifiers::NONE, Key::F1),
        ("about", Modifiers::SHIFT, Key::F1),
    ] {
        keys(window, modifiers, key);
        see(window, name);
        keys(window, Modifiers::NONE, Key::Escape);
    }
    let bar = window.root().children_recursive().filter_map(|node| {
        let inner = node.accesskit_node();
        let button = inner.role() == Role::Button && node.rect().bottom() < 42.0;
        let label = inner.label().filter(|_| button)?;
        Some((node.rect().left(), label))
    });
    let mut bar: Vec<(f32, String)> = bar.collect();
    bar.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (_, menu) in bar.into_iter().take(4) {
        window
            .query_all_by_label(&menu)
            .next()
            .expect("it was there")
            .click();
        window.run_steps(4);
        see(window, &format!("menu {menu}"));
        keys(window, Modifiers::NONE, Key::Escape);
    }
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/programs");
    window.state_mut().compensate(&data.join("cell.mod"));
    window.run_steps(4);
    see(window, "compensation");
    keys(window, Modifiers::NONE, Key::Escape);
    window
        .state_mut()
        .type_path("table", Path::new("table.csv"));
    window.run_steps(4);
    see(window, "export to a path");
    keys(window, Modifiers::NONE, Key::Escape);
}

/// What stands outside of ⟦ ⟧, with · between.
fn outside(text: &str) -> String {
    let mut depth = 0_u32;
    let mut outside = String::new();
    for c in text.chars() {
        match c {
            '⟦' => {
                outside.push('·');
                depth += 1;
            }
            '⟧' => {
                outside.push('·');
                depth = depth.saturating_sub(1);
            }
            _ if depth == 0 => outside.push(c),
            _ => {}
        }
    }
    outside
}

/// Texts that are in no table, and why: what the core says, names of files and data, units.
fn exceptions() -> Vec<String> {
    let list = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/untranslated.txt");
    let lines = read(&list);
    let lines = lines
        .lines()
        .filter(|l| !l.is_empty() && !l.starts_with('#'));
    // Whatever a system calls the folders of this test.
    let here = std::path::absolute(env!("CARGO_MANIFEST_DIR")).expect("a folder");
    let paths = [std::env::temp_dir(), here].map(|folder| format!("{}…", folder.display()));
    lines.map(str::to_owned).chain(paths).collect()
}

/// Adds the words of these texts that are in no table.
fn untranslated(
    window: &Window,
    at: &str,
    allowed: &[String],
    found: &mut BTreeMap<String, String>,
) {
    let nodes = window.root().children_recursive();
    // What is painted line by line is named as a whole.
    let whole = nodes.filter(|node| node.accesskit_node().role() != Role::TextRun);
    let named = whole.flat_map(|node| {
        let node = node.accesskit_node();
        [node.label(), node.value(), node.description()]
    });
    let named: Vec<String> = named.flatten().collect();
    let lines = window.root().children_recursive();
    let lines = lines.filter(|node| node.accesskit_node().role() == Role::TextRun);
    let lines: BTreeSet<String> = lines.filter_map(|n| n.accesskit_node().value()).collect();
    let painted = texts(window).into_iter();
    let painted = painted
        .filter(|line| !lines.contains(line) && !named.iter().any(|whole| whole.contains(line)));
    for text in painted.chain(named.iter().cloned()) {
        let rest = outside(&text);
        let units = [
            "mm", "µm", "in", "deg", "rad", "mrad", "kg", "min", "arcsec", "ppm",
        ];
        let foreign = |part: &str| {
            let part = part.trim_matches([' ', ':', ',', '(', ')', '·']);
            // A line that ends with … allows whatever begins like it.
            let allows = |line: &String| match line.strip_suffix('…') {
                Some(begin) => part.starts_with(begin),
                None => part == line,
            };
            let mut words = part.split(|c: char| !c.is_alphabetic());
            words.any(|word| word.chars().count() > 1 && !units.contains(&word))
                && !allowed.iter().any(allows)
        };
        if rest.split('·').any(foreign) {
            found.entry(text).or_insert_with(|| at.to_owned());
        }
    }
}

#[test]
fn no_text_of_the_window_is_outside_of_the_table() {
    let allowed = exceptions();
    let mut found = BTreeMap::new();
    let mut window = window(Language::Marked, [1280.0, 800.0], None);
    let mut see = |window: &Window, at: &str| untranslated(window, at, &allowed, &mut found);
    visit(&mut window, &mut see);
    open_all(&mut window, &mut see);
    open_records(&mut window, &mut see);
    for other in ["sessions/arm/arm.json", "tests/data/arms/six-60.json"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(other);
        let mut window = self::window(Language::Marked, [1280.0, 800.0], Some(path));
        steps(&mut window, &mut |window, at| {
            see(window, &format!("{other}, {at}"));
        });
    }
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("messung.csv");
    std::fs::write(&path, "winkel;x;y\n0;250;0\n10;246;43\n20;235;85\n").expect("written");
    let import = self::window(Language::Marked, [1280.0, 800.0], Some(path));
    see(&import, "import");
    let wrong = folder.path().join("wrong.json");
    let document = r#"{"format":"truepose-session/1","name":3,"robot":{"dh":[]},"targets":[],
        "instrument":{"name":"tracker","sigma_mm":-1},"tolerance_mm":"small",
        "samples":{"columns":{"commanded_deg":[1e999]}},"more":1}"#;
    std::fs::write(&wrong, document).expect("written");
    let refused = self::window(Language::Marked, [1280.0, 800.0], Some(wrong));
    see(&refused, "a wrong file from the start");
    let list: Vec<String> = found
        .iter()
        .map(|(text, at)| format!("{at}: {text}"))
        .collect();
    assert!(
        list.is_empty(),
        "{} texts are in no table:\n{}",
        list.len(),
        list.join("\n")
    );
}

/// Nothing that can be pressed sticks out of the window at its sides.
fn within(window: &Window, at: &str) {
    let whole = window.ctx.content_rect();
    for node in window.root().children_recursive() {
        let inner = node.accesskit_node();
        let pressed = [Role::Button, Role::Tab, Role::RadioButton, Role::CheckBox];
        if pressed.contains(&inner.role()) && inner.bounding_box().is_some() {
            let (rect, label) = (node.rect(), inner.label());
            let inside = rect.left() >= whole.left() && rect.right() <= whole.right();
            assert!(inside, "{at}: {label:?} at {rect}");
        }
    }
}

#[test]
fn every_step_fits_in_german_in_chinese_and_in_what_is_longer_still() {
    for language in [Language::German, Language::Chinese, Language::Long] {
        let mut window = window(language, [1024.0, 700.0], None);
        let stages = [None, Some(Key::I), Some(Key::G)];
        for (stage, key) in ["opened", "identified", "diagnosed"].iter().zip(stages) {
            if let Some(key) = key {
                keys(&mut window, Modifiers::COMMAND, key);
            }
            for number in [Key::Num1, Key::Num2, Key::Num3, Key::Num4, Key::Num5] {
                keys(&mut window, Modifiers::COMMAND, number);
                window.run_steps(4);
                let at = format!("{language:?}, {stage}, {number:?}");
                within(&window, &at);
                if language != Language::Long {
                    look(&window, &at);
                }
            }
        }
    }
}

/// What a sentence is in this language.
fn said_in(language: Language, english: &str) -> String {
    if language == Language::English {
        return english.to_owned();
    }
    let catalogue = read(&file(language.code()));
    let (_, rest) = catalogue
        .split_once(&format!("\nmsgid \"{english}\"\nmsgstr \""))
        .unwrap_or_else(|| panic!("{english} is not in the table"));
    let (said, _) = rest.split_once("\"\n").expect("it ends");
    // A button keeps its dots beside its last word.
    said.replace(" …", "\u{a0}…")
}

/// Opens the sheets that [`open_all`] leaves out: those that need a file or a form.
fn open_the_others(
    window: &mut Window,
    language: Language,
    folder: &Path,
    see: &mut dyn FnMut(&Window, &str),
) {
    let escape = |window: &mut Window| keys(window, Modifiers::NONE, Key::Escape);
    keys(window, Modifiers::COMMAND.plus(Modifiers::ALT), Key::R);
    see(window, "report details");
    escape(window);
    keys(window, SHIFTED, Key::N);
    let table = said_in(language, "Robot as a table");
    press(
        window,
        &said_in(language, "{name}…").replace("{name}", &table),
    );
    see(window, "a robot as a table");
    escape(window);
    keys(window, Modifiers::NONE, Key::Enter);
    see(window, "simulation of a robot");
    escape(window);
    escape(window);
    for what in ["model", "poses", "report", "workspace"] {
        window.state_mut().type_path(what, Path::new("file"));
        window.run_steps(4);
        see(window, &format!("path of {what}"));
        escape(window);
    }
    let targets = folder.join("targets.csv");
    std::fs::write(&targets, "name;q1_deg\nP0;a\n").expect("written");
    window.state_mut().compensate(&targets);
    window.run_steps(4);
    see(window, "targets that are refused");
    escape(window);
    keys(window, Modifiers::NONE, Key::F3);
    see(window, "what is lost");
    escape(window);
}

/// On the smallest screen that it is made for no label of a sheet is cut, and what ends it is in sight.
#[test]
fn every_sheet_fits_on_a_small_screen_in_every_language() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut outside = Vec::new();
    for language in [Language::English, Language::German, Language::Chinese] {
        let folder = tempfile::tempdir().expect("a folder");
        let mut window = window(language, [1024.0, 700.0], None);
        keys(&mut window, Modifiers::COMMAND, Key::I);
        keys(&mut window, Modifiers::COMMAND, Key::G);
        let behind = shown(&window);
        let mut see = |window: &Window, at: &str| {
            let at = format!("{language:?}, {at}");
            no_text_is_cut(window, &at);
            outside.extend(out_of_sight(window, &behind, &at));
        };
        open_all(&mut window, &mut see);
        open_the_others(&mut window, language, folder.path(), &mut see);
        for raw in ["walk-through/tracker.txt", "arm/tracker.csv"] {
            let raw = root.join("sessions").join(raw);
            let import = self::window(language, [1024.0, 700.0], Some(raw));
            let at = format!("{language:?}, import");
            no_text_is_cut_but_at_the_right(&import, &at, true);
            // Columns of the file scroll sideways.
            let beside = out_of_sight(&import, &behind, &at).into_iter();
            outside.extend(beside.filter(|thing| !thing.contains("ComboBox")));
        }
    }
    assert!(outside.is_empty(), "{outside:#?}");
}

/// What can be pressed or filled in, and where.
fn shown(window: &Window) -> BTreeSet<String> {
    let all = things(window).into_iter();
    let all = all.filter(|thing| interactive(thing.role));
    all.map(|thing| format!("{:?} {} {}", thing.role, thing.says, thing.rect))
        .collect()
}

/// What of a sheet is beside the window, and which of the buttons at its end is not in sight.
fn out_of_sight(window: &Window, behind: &BTreeSet<String>, at: &str) -> Vec<String> {
    const END: f32 = 36.0;
    let whole = window.ctx.content_rect().expand(1.0);
    let of_the_sheet = |thing: &Thing| {
        let name = format!("{:?} {} {}", thing.role, thing.says, thing.rect);
        interactive(thing.role) && !behind.contains(&name)
    };
    let wrong = |thing: &Thing| {
        let Rect { min, max } = thing.rect;
        let beside = min.x < whole.left() || max.x > whole.right();
        let ends = thing.role == Role::Button && thing.rect.height() >= END;
        beside || (ends && !whole.contains_rect(thing.rect))
    };
    let all = things(window).into_iter();
    all.filter(|thing| of_the_sheet(thing) && wrong(thing))
        .map(|thing| format!("{at}: {:?} {} at {}", thing.role, thing.says, thing.rect))
        .collect()
}

/// What stands over the results is not wider than their panel: the cards would be with it, and cut.
#[test]
fn results_are_as_wide_as_their_panel_where_words_are_long() {
    let mut window = window(Language::German, [1024.0, 700.0], None);
    keys(&mut window, Modifiers::COMMAND, Key::Comma);
    press(&mut window, "Zoll");
    press(&mut window, "Fertig");
    keys(&mut window, Modifiers::COMMAND, Key::I);
    keys(&mut window, Modifiers::COMMAND, Key::Num3);
    let sides = window.get_by_role_and_label(Role::RadioButton, "Messpunkte");
    // Of what stands in cards, the largest deviation.
    let facts = window.query_all_by_label_contains(" → ");
    let largest = facts.filter(|fact| fact.rect().left() > 736.0);
    let right: Vec<f32> = largest
        .chain([sides])
        .map(|node| node.rect().right())
        .collect();
    assert!(right.len() > 1);
    assert!(
        right.iter().all(|right| *right <= 1024.0 - 16.0),
        "{right:?}"
    );
}

#[test]
fn the_language_is_chosen_in_the_preferences_and_the_next_frame_speaks_it() {
    let mut window = window(Language::English, [1280.0, 800.0], None);
    keys(&mut window, Modifiers::COMMAND, Key::Comma);
    press(&mut window, "Deutsch");
    assert!(there(&window, "Einstellungen") && !there(&window, "Preferences"));
    press(&mut window, "中文");
    assert!(there(&window, "首选项"));
    press(&mut window, "English");
    assert!(there(&window, "Preferences"));
    press(&mut window, "Deutsch");
    press(&mut window, "Fertig");
    assert!(there(&window, "1 Messung") && !there(&window, "1 Session"));
    keys(&mut window, Modifiers::COMMAND, Key::I);
    assert!(there(&window, "Identifizierte Parameter"));
}
