//! Sliders that pose the robot by hand.

use egui::{RichText, ScrollArea, Slider, Ui};

use crate::gui::core::scale::stride;
use crate::gui::style::tokens::size;
use crate::gui::widgets::{self, caption, fine};
use crate::gui::workbench::{Command, ViewChange, Workbench};
use crate::kinematics::JointKind;
use crate::present::units::Units;

/// Smallest and largest value of a joint's slider, rad or mm: its limits; where it has none, what
/// was measured; where nothing was, a turn to either side or 500 mm.
pub(super) fn range(workbench: &Workbench, joint: usize) -> [f64; 2] {
    /// Samples that are looked at: a frame must not look at all.
    const SOME: usize = 2_000;
    let session = &workbench.loaded_session().session;
    let one = &session.robot.joints[joint];
    let whole = match one.kind {
        JointKind::Revolute => std::f64::consts::PI,
        JointKind::Prismatic => 500.0,
    };
    if let Some(limits) = one.limits.filter(|l| l.from < l.to) {
        return [limits.from, limits.to];
    }
    let q = &session.samples.q[joint];
    let some = q.iter().step_by(stride(q.len(), SOME));
    let finite = some.copied().filter(|v| v.is_finite());
    let [low, high] = finite.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| {
        [a.min(v), b.max(v)]
    });
    if low < high {
        [low, high]
    } else {
        [-whole, whole]
    }
}

/// A slider for each joint; `now` is where the robot is drawn.
pub(super) fn show(ui: &mut Ui, workbench: &Workbench, now: &[f64], commands: &mut Vec<Command>) {
    let units = workbench.units();
    let joints = &workbench.loaded_session().session.robot.joints;
    ui.horizontal(|ui| {
        widgets::title(ui, say!("Pose"));
        if workbench.view().pose.is_some() && ui.button(say!("Back to sample")).clicked() {
            commands.push(Command::View(ViewChange::Pose(None)));
        }
    });
    ScrollArea::vertical().id_salt("joints").show(ui, |ui| {
        ui.spacing_mut().item_spacing.y = 2.0;
        ui.spacing_mut().interact_size.y = 16.0;
        for (k, (joint, q)) in joints.iter().zip(now).enumerate() {
            caption(
                ui,
                &format!("{}  {}", joint.name, value(units, joint.kind, *q)),
            );
            let [low, high] = range(workbench, k);
            let mut next = *q;
            fine(ui, ui.available_width());
            let slider = Slider::new(&mut next, low.min(*q)..=high.max(*q)).show_value(false);
            let slider = ui.add(slider);
            let name = say!("Pose of joint {k}, {joint}", k = k + 1, joint = joint.name);
            ui.ctx()
                .accesskit_node_builder(slider.id, |node| node.set_label(name));
            if slider.changed() && next != *q {
                let mut pose = now.to_vec();
                pose[k] = next;
                commands.push(Command::View(ViewChange::Pose(Some(pose))));
            }
        }
        if workbench.view().pose.is_none() {
            ui.label(RichText::new(say!("from the sample that is shown")).size(size::NOTE));
        }
        widgets::focus_in_sight(ui);
    });
}

fn value(units: Units, kind: JointKind, q: f64) -> String {
    match kind {
        JointKind::Revolute => units.angle(q),
        JointKind::Prismatic => units.length(q),
    }
}
