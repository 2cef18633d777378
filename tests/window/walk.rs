//! Commands at random, on a workbench of which everything can be seen: `tests/support/walk`.

use truepose::gui::walk;

use crate::cases::every_case;

#[test]
fn thousands_of_commands_at_random_leave_a_consistent_workbench() {
    walk::thousands_of_commands(if every_case() { 6 } else { 3 });
}
