//! Robot, reflectors and instrument, to be edited: checked as they are typed, with the message at
//! the field, and in the plots at once.

use crate::text::{Template, filled};
use egui::{CollapsingHeader, DragValue, RichText, TextEdit, Ui};

use crate::gui::core::setup::{Field, JointForm, Problem, SetupForm};
use crate::gui::style::{size, space};
use crate::gui::workbench::Workbench;
use crate::gui::{help, widgets};
use crate::kinematics::JointKind;
use crate::sessions::{Sigma, Target};
use nalgebra::Point3;

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
            for (part, value) in parts.iter().zip(values) {
                let name = format!("{label} {part}");
                let field = DragValue::new(value).speed(speed).max_decimals(6);
                widgets::cell_number(ui, name.trim_end(), unit, width, field);
            }
        });
    }
}

/// Shows the parts of the form, folded.
pub(super) fn show(ui: &mut Ui, workbench: &Workbench) {
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
        workbench.then(move |bench| match sound {
            true => bench.edit(phrase!("edit robot and instrument"), |document| {
                document.set_up(&form)
            }),
            false => bench.view.setup = Some(Box::new(form)),
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
    let id = ui.scope_id().with(("text", label));
    // A name is taken over when it is complete: one step back takes the whole of it back.
    let mut typed: String = ui.data(|d| d.get_temp(id)).unwrap_or_else(|| text.clone());
    let field = TextEdit::singleline(&mut typed).desired_width(f32::INFINITY);
    let field = ui.add(field.min_size(egui::vec2(0.0, 24.0)));
    widgets::label(&field, label);
    if field.has_focus() {
        ui.data_mut(|d| d.insert_temp(id, typed));
    } else {
        if field.lost_focus() {
            *text = typed;
        }
        ui.data_mut(|d| d.remove_temp::<String>(id));
    }
}

const XYZ: [&str; 3] = ["x", "y", "z"];

fn joint(ui: &mut Ui, joint: &mut JointForm, k: usize, fields: &mut Fields) {
    let n = k + 1;
    fields.n = n;
    text(ui, &say!("Name of joint {n}", n), &mut joint.name);
    fields.message(ui, Field::JointName(k));
    let kinds = [
        (JointKind::Revolute, say!("turns")),
        (JointKind::Prismatic, say!("slides")),
    ];
    widgets::choice(ui, &kinds, &mut joint.kind);
    ui.horizontal(|ui| {
        widgets::caption(ui, say!("axis, direction at home"));
        widgets::question(ui, help::AXIS);
    });
    fields.numbers(ui, phrase!("Axis {n}"; n), "", &XYZ, &mut joint.axis, 0.01);
    fields.message(ui, Field::Axis(k));
    widgets::caption(ui, say!("a point on it, mm"));
    fields.numbers(
        ui,
        phrase!("Point {n}"; n),
        "mm",
        &XYZ,
        &mut joint.point_mm,
        0.1,
    );
    let unit = joint.kind.sign().trim();
    let mut limited = joint.limits.is_some();
    if ui
        .checkbox(&mut limited, say!("limits of joint {n}, {unit}", n, unit))
        .changed()
    {
        joint.limits = limited.then_some([-90.0, 90.0]);
    }
    if let Some(limits) = &mut joint.limits {
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
        joint.link = heavy.then_some((1.0, joint.point_mm));
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
