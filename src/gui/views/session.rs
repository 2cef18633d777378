//! Step 1: what was measured, on what, and what was found while it was read; robot, reflectors and instrument, to be
//! edited: checked as they are typed, with the message at the field, and in the plots at once.

use std::path::PathBuf;

use egui::{Align, CollapsingHeader, DragValue, Layout, Response, RichText, TextEdit, Ui};
use nalgebra::Point3;

use crate::diagnostic::{Diagnostic, Severity};
use crate::gui::core::disk::name_of;
use crate::gui::core::loaded_session::Origin;
use crate::gui::core::quantity::joint_value;
use crate::gui::core::robot_table::Row;
use crate::gui::core::setup::{Field, Problem, SetupForm};
use crate::gui::core::simulate::Form;
use crate::gui::import_draft::in_the_windows_words;
use crate::gui::style::{Palette, size, space, strong};
use crate::gui::view::{Sheet, Step};
use crate::gui::widgets::{self, Does, or_none};
use crate::gui::workbench::Workbench;
use crate::gui::{files, help};
use crate::language;
use crate::present::numbers::grouped;
use crate::present::units::LengthUnit;
use crate::sessions::{Sigma, Target};
use crate::text::{Template, filled};

pub(super) fn state(workbench: &Workbench) -> (String, bool) {
    let says = if workbench.loaded_session().is_empty() {
        say!("a model, nothing measured").to_owned()
    } else {
        say!(one "{count} sample", "{count} samples", count = grouped(workbench.loaded_session().len()))
    };
    (says, true)
}

pub(super) fn show(ui: &mut Ui, workbench: &Workbench) {
    widgets::section(ui, say!("Measured"));
    facts(ui, workbench);
    tolerance(ui, workbench, widgets::number);
    findings(ui, workbench);
    widgets::section(ui, say!("Another session or model"));
    widgets::secondary(ui, say!("Open…")).does(workbench, move |bench| {
        bench.choose_file(files::choose_to_open);
    });
    path_field(ui, workbench);
    widgets::secondary(ui, say!("Simulate session…")).does(workbench, move |bench| {
        bench.show_sheet(Some(Sheet::Simulate(Form::default())));
    });
    widgets::secondary(ui, say!("Robots…")).does(workbench, move |bench| {
        bench.show_sheet(Some(Sheet::ROBOTS));
    });
    recent(ui, workbench);
    setup(ui, workbench);
}

/// Files that were opened before, newest first.
fn recent(ui: &mut Ui, workbench: &Workbench) {
    const MOST: usize = 5;
    let recent: Vec<_> = workbench.recent().take(MOST).collect();
    if recent.is_empty() {
        return;
    }
    widgets::section(ui, say!("Recent files"));
    ui.spacing_mut().item_spacing.y = space::TIGHT;
    for path in recent {
        let link = ui.link(name_of(path).as_ref());
        if link.on_hover_text(path.display().to_string()).clicked() {
            let path = path.clone();
            workbench.then(move |bench| bench.open_file(path));
        }
    }
}

fn facts(ui: &mut Ui, workbench: &Workbench) {
    let loaded_session = workbench.loaded_session();
    let session = &loaded_session.session;
    let units = workbench.units();
    widgets::fact_of(ui, phrase!("robot"), &session.robot.name);
    if let [joint] = session.robot.joints.as_slice() {
        let (from, to) = loaded_session.travel();
        let [from, to] = [from, to].map(|q| joint_value(units, joint.kind, q));
        let says = format!("{}, {from} … {to}", joint.name);
        widgets::fact_of(ui, phrase!("joint"), says);
    } else {
        widgets::fact_of(
            ui,
            phrase!("joints"),
            session.robot.joints.len().to_string(),
        );
    }
    if loaded_session.is_empty() {
        widgets::fact_of(ui, phrase!("samples"), say!("none: this is a model"));
        return;
    }
    let mut samples = grouped(loaded_session.len());
    for (n, what) in [
        (loaded_session.overview.held_out, say!("held out")),
        (loaded_session.overview.excluded, say!("excluded")),
    ] {
        if n > 0 {
            samples += &format!(", {} {what}", grouped(n));
        }
    }
    widgets::fact_of(ui, phrase!("samples"), samples);
    if let Some(kinds) = &loaded_session.overview.kinds {
        widgets::fact_of(ui, phrase!("measured"), language::spoken(kinds));
    }
    if session.targets.len() > 1 {
        widgets::fact_of(ui, phrase!("reflectors"), session.targets.len().to_string());
    }
    if !session.instrument.name.is_empty() {
        widgets::fact_of(ui, phrase!("instrument"), &session.instrument.name);
    }
    let sigma = match session.instrument.sigma_mm {
        None => say!("not given").to_owned(),
        Some(Sigma::Overall(sigma)) => units.length(sigma),
        Some(Sigma::PerAxis([x, y, z])) => units.length(((x * x + y * y + z * z) / 3.0).sqrt()),
    };
    widgets::fact_of(ui, phrase!("noise, one σ"), sigma);
    if session.samples.z_mm.is_none() {
        widgets::fact_of(
            ui,
            phrase!("coordinates"),
            say!("x and y; z was not measured"),
        );
    }
    if session.compensated_by.is_some() {
        widgets::fact_of(
            ui,
            phrase!("compensated"),
            say!("yes: this shows what is left"),
        );
    }
}

/// The tolerance, to be typed.
pub(crate) fn tolerance(
    ui: &mut Ui,
    workbench: &Workbench,
    shown: fn(&mut Ui, &str, &str, DragValue<'_>) -> Response,
) {
    // The largest that makes sense on any robot.
    const LARGEST_MM: f64 = 1000.0;
    let units = workbench.units();
    let one_mm = units.length_value(1.0);
    let unit = units.length_name();
    let now = one_mm * workbench.document().tolerance_mm.unwrap_or(0.0);
    let mut tolerance = now;
    let written = ui.style().number_formatter.clone();
    let field = DragValue::new(&mut tolerance)
        .range(0.0..=one_mm * LARGEST_MM)
        .speed(0.005 * one_mm)
        .max_decimals(match units.length {
            LengthUnit::Millimetre => 4,
            LengthUnit::Micrometre => 1,
            LengthUnit::Inch => 6,
        })
        .custom_formatter(|value, decimals| {
            if value > 0.0 {
                written.format(value, decimals)
            } else {
                say!("none").to_owned()
            }
        })
        .suffix(if now > 0.0 {
            format!(" {unit}")
        } else {
            String::new()
        });
    let name = format!("{unit}{}", or_none());
    shown(ui, say!("tolerance"), &name, field);
    if tolerance != now {
        let tolerance = (tolerance > 0.0).then_some(tolerance / one_mm);
        workbench.then(move |bench| bench.set_tolerance(tolerance));
    }
}

fn findings(ui: &mut Ui, workbench: &Workbench) {
    const MOST: usize = 50;
    let findings = &workbench.loaded_session().findings;
    if findings.is_empty() {
        return;
    }
    widgets::section(ui, &say!("Import log: {count}", count = findings.len()));
    ui.scope(|ui| {
        // Rows are as high as their text, the first of a finding too.
        ui.spacing_mut().interact_size.y = 0.0;
        // What was left out or assumed first.
        let mut sorted: Vec<&Diagnostic> = findings.iter().collect();
        sorted.sort_by_key(|finding| std::cmp::Reverse(finding.severity));
        for finding in sorted.into_iter().take(MOST) {
            finding_line(ui, finding, workbench);
        }
    });
    if findings.len() > MOST {
        widgets::hint(
            ui,
            say!(in "common", "and {more} more", more = findings.len() - MOST),
        );
    }
}

fn finding_line(ui: &mut Ui, finding: &Diagnostic, workbench: &Workbench) {
    let palette = Palette::of(ui);
    let (mark, color) = match finding.severity {
        Severity::Note => (say!("note"), palette.muted),
        Severity::Warning => (say!("warning"), palette.warning),
        Severity::Error => (say!("error"), palette.outside),
    };
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(mark).font(strong(size::SMALL)).color(color));
        let text = in_the_windows_words(&finding.clone().without_folder());
        let text = RichText::new(text).size(size::SMALL);
        if finding.samples.is_empty() {
            ui.label(text);
        } else if ui
            .link(text)
            .on_hover_text(say!("Show these samples"))
            .clicked()
        {
            let samples = finding.samples.clone();
            workbench.then(|bench| bench.view.mark(samples));
        }
    });
}

/// A path can always be typed: not every system has a dialog.
fn path_field(ui: &mut Ui, workbench: &Workbench) {
    let id = ui.scope_id().with("typed path");
    let mut typed: String = ui.data_mut(|data| data.get_temp(id)).unwrap_or_default();
    let room = egui::vec2(ui.available_width(), space::CONTROL);
    let from_the_right = Layout::right_to_left(Align::Center);
    ui.allocate_ui_with_layout(room, from_the_right, |ui| {
        let button = egui::Button::new(say!("Open"));
        let pressed = ui.add_enabled(!typed.trim().is_empty(), button).clicked();
        let field = TextEdit::singleline(&mut typed)
            .hint_text(say!("type a path, or drop a file"))
            .align(egui::Align2::LEFT_CENTER);
        let field = ui.add_sized(ui.available_size(), field);
        widgets::label(&field, say!("Path of a session or model"));
        let entered = field.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter));
        let path = typed.trim();
        if (entered || pressed) && !path.is_empty() {
            let path = PathBuf::from(path);
            workbench.then(move |bench| bench.open_file(path));
        }
    });
    ui.data_mut(|data| data.insert_temp(id, typed));
}

pub(super) fn next(ui: &mut Ui, workbench: &Workbench) {
    let loaded_session = workbench.loaded_session();
    if loaded_session.origin == Origin::Bundled {
        widgets::hint(ui, say!("This is an example that comes with the program"));
    }
    let (step, text) = if workbench.document().loaded_model.is_some() {
        (Step::Export, say!("Continue to export"))
    } else if loaded_session.single_revolute() {
        (Step::Regions, say!("Continue to regions"))
    } else {
        (Step::Identify, say!("Continue to identify"))
    };
    widgets::primary(ui, text).does(workbench, move |bench| bench.view.step = step);
}

/// The fields: what is wrong with them, and what happened to them.
struct Fields {
    problems: Vec<Problem>,
    /// The number of the joint or of the reflector whose fields they are.
    n: usize,
}

impl Fields {
    fn message(&self, ui: &mut Ui, field: Field) {
        for (_, says) in self.problems.iter().filter(|(f, _)| *f == field) {
            widgets::wrong(ui, says);
        }
    }

    /// So many numbers in a row, and their name.
    fn numbers(
        &mut self,
        ui: &mut Ui,
        key: Template,
        unit: &str,
        parts: &[&str],
        values: &mut [f64],
        speed: f64,
    ) {
        let label = filled(key, &[("n", &self.n)]);
        let gap = 6.0;
        let width = (ui.available_width() - gap * (parts.len() as f32 - 1.0)) / parts.len() as f32;
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = gap;
            widgets::numbers(ui, (&label, unit), parts, values, (width, speed));
        });
    }
}

/// Shows the parts of the form, folded.
fn setup(ui: &mut Ui, workbench: &Workbench) {
    let session = &workbench.loaded_session().session;
    let now = match &workbench.view.setup {
        Some(draft) => SetupForm::clone(draft),
        None => SetupForm::of(session),
    };
    let problems = match &workbench.view.setup {
        Some(draft) => draft.session(session).err().unwrap_or_default(),
        None => Vec::new(),
    };
    let mut form = now.clone();
    let mut fields = Fields { problems, n: 1 };
    let is_open = |fields: &Fields, wrong: &dyn Fn(Field) -> bool| {
        fields.problems.iter().any(|(field, _)| wrong(*field))
    };
    widgets::section(ui, say!("Robot and instrument"));
    ui.spacing_mut().item_spacing.y = space::TIGHT;
    for k in 0..form.joints.len() {
        let title = say!(
            "Joint {k}, {joints}",
            k = k + 1,
            joints = now.joints[k].name
        );
        let wrong = |f: Field| matches!(f, Field::JointName(j) | Field::Axis(j) | Field::Limits(j) | Field::Mass(j) if j == k);
        let open = is_open(&fields, &|f| wrong(f) || f == Field::Joints);
        folded(ui, &title, (say!("joint"), k), open, |ui| {
            joint(ui, &mut form.joints[k], k, &mut fields);
        });
    }
    let open = is_open(&fields, &|f| f == Field::Tool);
    folded(ui, say!("Tool and gravity"), "tool", open, |ui| {
        tool(ui, &mut form, &mut fields);
    });
    let open = is_open(&fields, &|f| matches!(f, Field::Target(_)));
    folded(ui, say!("Reflectors"), "targets", open, |ui| {
        let free = now.last_target_is_free(session);
        targets(ui, &mut form, free, &mut fields);
    });
    if !workbench.loaded_session().is_empty() {
        let open = is_open(&fields, &|f| f == Field::Sigma);
        folded(ui, say!("Instrument"), "instrument", open, |ui| {
            instrument(ui, &mut form, &mut fields);
        });
    }
    if workbench.view.setup.is_some() {
        fields.message(ui, Field::Joints);
        widgets::hint(ui, say!("Not taken over while something is wrong"));
        if ui.link(say!("Back to what was there")).clicked() {
            workbench.then(move |bench| bench.view.setup = None);
            return;
        }
    }
    if form != now {
        let sound = form.session(session).is_ok();
        workbench.then(move |bench| {
            if sound {
                bench.edit(phrase!("edit robot and instrument"), |document| {
                    document.set_up(&form)
                });
            } else {
                bench.view.setup = Some(Box::new(form));
            }
        });
    }
}

fn folded(
    ui: &mut Ui,
    title: &str,
    salt: impl std::hash::Hash + std::fmt::Debug,
    open: bool,
    contents: impl FnOnce(&mut Ui),
) {
    let header = CollapsingHeader::new(RichText::new(title).size(size::BODY)).id_salt(salt);
    // What is wrong is not folded away.
    let header = if open {
        header.open(Some(true))
    } else {
        header
    };
    header.show(ui, |ui| {
        ui.spacing_mut().item_spacing.y = space::TIGHT;
        contents(ui);
    });
}

fn text(ui: &mut Ui, label: &str, text: &mut String) {
    let size = egui::vec2(ui.available_width(), 24.0);
    if let Some(typed) = widgets::text_when_complete(ui, label, text, size) {
        *text = typed;
    }
}

const XYZ: [&str; 3] = ["x", "y", "z"];

fn joint(ui: &mut Ui, joint: &mut Row, k: usize, fields: &mut Fields) {
    let n = k + 1;
    fields.n = n;
    text(ui, &say!("Name of joint {n}", n), &mut joint.name);
    fields.message(ui, Field::JointName(k));
    let kinds = [(false, say!("turns")), (true, say!("slides"))];
    widgets::choice(ui, &kinds, &mut joint.slides);
    ui.horizontal(|ui| {
        widgets::caption(ui, say!("axis, direction at home"));
        widgets::question(ui, help::AXIS);
    });
    let (axis, point) = joint.numbers.split_at_mut(3);
    fields.numbers(ui, phrase!("Axis {n}"; n), "", &XYZ, axis, 0.01);
    fields.message(ui, Field::Axis(k));
    widgets::caption(ui, say!("a point on it, mm"));
    fields.numbers(ui, phrase!("Point {n}"; n), "mm", &XYZ, point, 0.1);
    let unit = joint.unit();
    let mut limited = joint.travel.is_some();
    if ui
        .checkbox(&mut limited, say!("limits of joint {n}, {unit}", n, unit))
        .changed()
    {
        joint.travel = limited.then_some([-90.0, 90.0]);
    }
    if let Some(limits) = &mut joint.travel {
        fields.numbers(
            ui,
            phrase!("Limit {n}"; n),
            unit,
            &[say!("from"), say!("to")],
            limits,
            0.5,
        );
        fields.message(ui, Field::Limits(k));
    }
    let mut heavy = joint.link.is_some();
    if ui
        .checkbox(&mut heavy, say!("mass of link {n}, kg", n))
        .changed()
    {
        let [.., x, y, z] = joint.numbers;
        joint.link = heavy.then_some((1.0, [x, y, z]));
    }
    if let Some((mass, centre_mm)) = &mut joint.link {
        let mass = std::slice::from_mut(mass);
        fields.numbers(ui, phrase!("Mass {n}"; n), "kg", &[""], mass, 0.05);
        fields.message(ui, Field::Mass(k));
        widgets::caption(ui, say!("its centre at home, mm"));
        fields.numbers(ui, phrase!("Centre {n}"; n), "mm", &XYZ, centre_mm, 0.5);
    }
}

fn tool(ui: &mut Ui, form: &mut SetupForm, fields: &mut Fields) {
    ui.horizontal(|ui| {
        widgets::caption(ui, say!("tool at home, mm"));
        widgets::question(ui, help::TOOL);
    });
    fields.numbers(ui, phrase!("Tool"), "mm", &XYZ, &mut form.tool_mm, 0.1);
    widgets::caption(ui, say!("orientation, quaternion w x y z"));
    let wxyz = ["w", "x", "y", "z"];
    fields.numbers(
        ui,
        phrase!("Orientation"),
        "",
        &wxyz,
        &mut form.tool_wxyz,
        0.005,
    );
    fields.message(ui, Field::Tool);
    let mut known = form.gravity.is_some();
    if ui
        .checkbox(&mut known, say!("gravity is known, m/s²"))
        .changed()
    {
        form.gravity = known.then_some([0.0, 0.0, -9.81]);
    }
    if let Some(gravity) = &mut form.gravity {
        fields.numbers(ui, phrase!("Gravity"), "", &XYZ, gravity, 0.01);
    }
}

fn targets(ui: &mut Ui, form: &mut SetupForm, last_is_free: bool, fields: &mut Fields) {
    widgets::caption(ui, say!("in the tool frame, mm"));
    let mut gone = false;
    let count = form.targets.len();
    for (k, target) in form.targets.iter_mut().enumerate() {
        let n = k + 1;
        fields.n = n;
        text(ui, &say!("Name of reflector {n}", n), &mut target.name);
        fields.numbers(
            ui,
            phrase!("Reflector {n}"; n),
            "mm",
            &XYZ,
            target.position_mm.coords.as_mut_slice(),
            0.1,
        );
        fields.message(ui, Field::Target(k));
        if n == count && last_is_free {
            gone = ui.link(say!("Remove this reflector")).clicked();
        }
    }
    if gone {
        form.targets.pop();
    } else if ui.link(say!("Add a reflector")).clicked() {
        form.targets.push(Target {
            name: format!("T{}", count + 1),
            position_mm: Point3::origin(),
        });
    }
}

fn instrument(ui: &mut Ui, form: &mut SetupForm, fields: &mut Fields) {
    text(ui, say!("Name of the instrument"), &mut form.instrument);
    ui.horizontal(|ui| {
        widgets::caption(ui, say!("noise, one σ, mm"));
        widgets::question(ui, help::NOISE);
    });
    let kind = match form.sigma {
        None => 0,
        Some(Sigma::Overall(_)) => 1,
        Some(Sigma::PerAxis(_)) => 3,
    };
    let kinds = [
        (0, say!("unknown")),
        (1, say!("one number")),
        (3, "x, y, z"),
    ];
    if let Some(kind) = widgets::segmented(ui, &kinds, kind) {
        let size = match form.sigma {
            None => 0.03,
            Some(Sigma::Overall(sigma)) => sigma,
            Some(Sigma::PerAxis([x, y, z])) => ((x * x + y * y + z * z) / 3.0).sqrt(),
        };
        form.sigma = match kind {
            0 => None,
            1 => Some(Sigma::Overall(size)),
            _ => Some(Sigma::PerAxis([size; 3])),
        };
    }
    match &mut form.sigma {
        None => {}
        Some(Sigma::Overall(sigma)) => {
            let sigma = std::slice::from_mut(sigma);
            fields.numbers(ui, phrase!("Noise"), "mm", &[""], sigma, 0.001);
        }
        Some(Sigma::PerAxis(sigma)) => {
            fields.numbers(ui, phrase!("Noise"), "mm", &XYZ, sigma, 0.001);
        }
    }
    fields.message(ui, Field::Sigma);
}
