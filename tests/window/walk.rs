//! Commands at random, on a workbench of which everything can be seen: `tests/support/walk`.

use truepose::gui::walk;

#[test]
fn thousands_of_commands_at_random_leave_a_consistent_workbench() {
    walk::thousands_of_commands();
}

#[test]
fn lines_that_come_meanwhile_become_samples_and_none_is_lost() {
    walk::live::lines_that_come_meanwhile();
}
