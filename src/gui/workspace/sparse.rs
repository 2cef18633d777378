//! Which vectors of an arm are drawn: they point anywhere, and hundreds of them are a tangle.

use crate::gui::cache::cloud::Cloud;
use crate::gui::core::scale::FEW;
use crate::gui::workbench::Workbench;

/// Vectors of a robot with several joints at once: those that are largest, and others spread evenly over the session.
const LARGEST: usize = 16;
const EVENLY: usize = 48;
/// They are drawn so much longer than those of a crowd.
const LONGER: f64 = 1.6;

/// Whether only some vectors are drawn: those of one joint stand in a row, and of thousands the layout chooses.
pub(super) fn sparse(workbench: &Workbench) -> bool {
    let loaded_session = workbench.loaded_session();
    let several = loaded_session.session.robot.joints.len() > 1;
    let samples = loaded_session.overview.usable.len();
    several && (LARGEST + EVENLY + 1..=FEW).contains(&samples)
}

/// The samples with the largest deviations of those that are shown, and some of the others.
pub(super) fn most_telling(workbench: &Workbench) -> Vec<u32> {
    let loaded_session = workbench.loaded_session();
    let after = workbench.answer().filter(|_| workbench.view.blend > 0.0);
    let lengths = after.map_or(&loaded_session.before.length_mm, |a| &a.lengths_mm);
    let mut largest = loaded_session.overview.usable.clone();
    largest.retain(|sample| lengths[*sample as usize].is_finite());
    largest.sort_by(|a, b| lengths[*b as usize].total_cmp(&lengths[*a as usize]));
    largest.truncate(LARGEST);
    let cloud = Cloud::of(loaded_session);
    let others = cloud.samples.iter().copied();
    let others = others.filter(|sample| !largest.contains(sample));
    let others: Vec<u32> = others.take(EVENLY).collect();
    largest.extend(others);
    largest
}

/// Over how many points vectors are made for, see [`Readable::magnification`]: fewer make them longer.
///
/// [`Readable::magnification`]: crate::gui::core::scale::Readable::magnification
pub(super) fn room(workbench: &Workbench) -> f64 {
    let longer = if sparse(workbench) { LONGER } else { 1.0 };
    workbench.view.plot_size / longer
}
