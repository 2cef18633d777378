//! Commands at random, on a workbench of which everything can be seen: `tests/support/walk`.

use truepose::gui::walk;

use crate::cases::every_case;

#[test]
fn commands_at_random_leave_a_consistent_workbench() {
    let (seeds, commands) = if every_case() { (6, 900) } else { (3, 350) };
    walk::commands_at_random(seeds, commands);
}
