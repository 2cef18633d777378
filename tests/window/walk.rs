//! Commands at random, on a workbench of which everything can be seen: `tests/support/walk`.

use truepose::gui::walk;

#[test]
fn thousands_of_commands_at_random_leave_a_consistent_workbench() {
    walk::thousands_of_commands();
}
