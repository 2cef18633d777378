//! One language that targets are written in: how its files are known, and how they are read.

use super::axes::Axes;
use super::pose::Orientation;
use super::program::Program;
use super::target::Problem;
use super::text::Text;

/// One language that targets are written in.
pub struct Language {
    /// Its name on the command line.
    pub id: &'static str,
    /// Its name for people.
    pub title: &'static str,
    /// Endings of its files, in small letters, without the dot.
    pub extensions: &'static [&'static str],
    /// How it writes an orientation, and how six numbers of a tool or a frame are meant for it.
    pub orientation: Orientation,
    /// Whether a file looks like it.
    pub(super) looks_like: fn(&[u8]) -> bool,
    pub(super) read: fn(&Text, &Axes) -> Result<Program, Vec<Problem>>,
}

impl Language {
    /// The targets of a file, for a robot with these axes.
    ///
    /// # Errors
    /// Every target that is broken, with line, column and what was expected.
    pub fn read(
        &self,
        bytes: &[u8],
        axes: &Axes,
        file: Option<&std::path::Path>,
    ) -> Result<Program, crate::diagnostic::Rejected> {
        let text = Text::new(bytes);
        if let Some(problem) = text.unreadable() {
            return Err(text.rejected(vec![problem], file));
        }
        let program = (self.read)(&text, axes).map_err(|mut problems| {
            problems.sort_by_key(|problem| problem.at);
            text.rejected(problems, file)
        })?;
        Ok(program)
    }
}

impl std::fmt::Debug for Language {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.id)
    }
}
