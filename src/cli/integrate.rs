//! What the system shows of the program: `truepose integrate`, `completions` and `man`.
//!
//! All of it is in the binary, so that an installation by `cargo install` has it too; the Debian
//! package is made by the same command.

use std::path::{Path, PathBuf};

use anyhow::{Context, anyhow};
use clap::Args;
use clap_complete::Shell;
use clap_mangen::Man as Page;

use super::failure::Failure;
use super::output;
use crate::sessions::files::bundled::BUNDLED;

/// Put truepose into the menus: desktop entry, icons, file type, man pages, shell completions, sessions to try
#[derive(Debug, Args)]
pub(crate) struct Integrate {
    /// Folder in whose `share` the files go [default: .local in the home folder]
    #[arg(long, value_name = "FOLDER")]
    prefix: Option<PathBuf>,
    /// Remove these files
    #[arg(long)]
    remove: bool,
    /// Replace files that exist
    #[arg(long)]
    force: bool,
}

/// Print the completions of a shell
#[derive(Debug, Args)]
pub(crate) struct Completions {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

/// Print a man page
#[derive(Debug, Args)]
pub(crate) struct Man {
    /// A command; without it the page of the program
    command: Option<String>,
}

const DESKTOP_ENTRY: &str = include_str!("../../assets/truepose.desktop");
const FILE_TYPE: &str = include_str!("../../assets/truepose.mime.xml");
/// Folder below `icons/hicolor`, ending and bytes.
const ICONS: [(&str, &str, &[u8]); 5] = [
    ("16x16", "png", include_bytes!("../../assets/icon-16.png")),
    ("32x32", "png", include_bytes!("../../assets/icon-32.png")),
    ("48x48", "png", include_bytes!("../../assets/icon-48.png")),
    ("256x256", "png", include_bytes!("../../assets/icon.png")),
    ("scalable", "svg", include_bytes!("../../assets/icon.svg")),
];

fn built(mut program: clap::Command) -> clap::Command {
    program.build();
    program
}

fn completions(shell: Shell, mut program: clap::Command) -> Vec<u8> {
    let mut bytes = Vec::new();
    clap_complete::generate(shell, &mut program, "truepose", &mut bytes);
    bytes
}

fn page(command: &clap::Command) -> Result<Vec<u8>, Failure> {
    let mut bytes = Vec::new();
    let page = Page::new(command.clone().version(env!("CARGO_PKG_VERSION")));
    page.render(&mut bytes)
        .context(text!("cannot write the page"))?;
    Ok(bytes)
}

/// The commands that have a page of their own.
fn shown(program: &clap::Command) -> impl Iterator<Item = &clap::Command> {
    let commands = program.get_subcommands();
    commands.filter(|command| !command.is_hide_set() && command.get_name() != "help")
}

impl Completions {
    pub(crate) fn run(self, program: clap::Command) -> Result<(), Failure> {
        output::bytes(&completions(self.shell, program))
    }
}

impl Man {
    pub(crate) fn run(self, program: clap::Command) -> Result<(), Failure> {
        let program = built(program);
        let Some(name) = self.command else {
            return output::bytes(&page(&program)?);
        };
        let mut commands = shown(&program);
        if let Some(command) = commands.find(|command| command.get_name() == name) {
            return output::bytes(&page(command)?);
        }
        let names: Vec<&str> = shown(&program).map(clap::Command::get_name).collect();
        Err(Failure::WrongInput(text!(
            "no command is called '{name}'; expected one of {names}",
            name,
            names = names.join(", ")
        )))
    }
}

/// How a desktop starts the program: by its name where it lies in the prefix, otherwise by its path.
fn start_of(prefix: &Path) -> String {
    let own = std::env::current_exe().and_then(|path| path.canonicalize());
    let Ok(own) = own else {
        return "truepose".to_owned();
    };
    if prefix.join("bin").canonicalize().ok().as_deref() == own.parent() {
        return "truepose".to_owned();
    }
    let path = own.display().to_string();
    let escaped = path.replace('\\', "\\\\\\\\").replace('"', "\\\\\"");
    let escaped = escaped.replace('$', "\\\\$").replace('`', "\\\\`");
    format!("\"{}\"", escaped.replace('%', "%%"))
}

/// Every file, below the folder `share` of the prefix, with its bytes.
fn files(prefix: &Path, program: clap::Command) -> Result<Vec<(PathBuf, Vec<u8>)>, Failure> {
    let mut files: Vec<(String, Vec<u8>)> = vec![
        (
            "bash-completion/completions/truepose".to_owned(),
            completions(Shell::Bash, program.clone()),
        ),
        (
            "zsh/site-functions/_truepose".to_owned(),
            completions(Shell::Zsh, program.clone()),
        ),
        (
            "fish/vendor_completions.d/truepose.fish".to_owned(),
            completions(Shell::Fish, program.clone()),
        ),
    ];
    let program = built(program);
    files.push(("man/man1/truepose.1".to_owned(), page(&program)?));
    for command in shown(&program) {
        let name = command.get_name();
        files.push((format!("man/man1/truepose-{name}.1"), page(command)?));
    }
    for session in &BUNDLED {
        for (ending, bytes) in [("json", session.document), ("csv", session.samples)] {
            let path = format!("truepose/sessions/{}.{ending}", session.name);
            files.push((path, bytes.to_vec()));
        }
    }
    // Without a window there is nothing to open from a menu.
    if cfg!(feature = "gui") {
        let start = format!("Exec={} %f", start_of(prefix));
        let entry = DESKTOP_ENTRY.replace("Exec=truepose %f", &start);
        files.push((
            "applications/truepose.desktop".to_owned(),
            entry.into_bytes(),
        ));
        files.push(("mime/packages/truepose.xml".to_owned(), FILE_TYPE.into()));
        for (folder, ending, bytes) in ICONS {
            let path = format!("icons/hicolor/{folder}/apps/truepose.{ending}");
            files.push((path, bytes.to_vec()));
        }
    }
    let share = prefix.join("share");
    let files = files.into_iter();
    Ok(files
        .map(|(path, bytes)| (share.join(path), bytes))
        .collect())
}

impl Integrate {
    pub(crate) fn run(self, program: clap::Command) -> Result<(), Failure> {
        if self.prefix.is_none() && cfg!(any(windows, target_os = "macos")) {
            return Err(Failure::WrongInput(text!(
                "this puts truepose into the menus of a Linux desktop, which this system does not have; expected \
                 --prefix FOLDER to write its files all the same"
            )));
        }
        let home = || std::env::var_os("HOME").map(|home| Path::new(&home).join(".local"));
        let Some(prefix) = self.prefix.or_else(home) else {
            return Err(Failure::WrongInput(text!(
                "the home folder is not known; expected --prefix FOLDER"
            )));
        };
        let files = files(&prefix, program)?;
        let share = prefix.join("share");
        let done = if self.remove {
            for (path, _) in &files {
                if let Err(error) = std::fs::remove_file(path)
                    && error.kind() != std::io::ErrorKind::NotFound
                {
                    return Err(anyhow!("{}: {error}", path.display()).into());
                }
            }
            say!(
                one "{count} file removed in {folder}", "{count} files removed in {folder}",
                count = files.len(),
                folder = share.display()
            )
        } else {
            for (path, _) in &files {
                output::can_be_written(path, self.force)?;
            }
            for (path, bytes) in &files {
                let folder = path.parent().unwrap_or(&prefix);
                let made = std::fs::create_dir_all(folder);
                made.with_context(|| folder.display().to_string())?;
                output::document(path, bytes, self.force, &[])?;
            }
            say!(
                one "{count} file written in {folder}", "{count} files written in {folder}",
                count = files.len(),
                folder = share.display()
            )
        };
        let mut lines = vec![done];
        if cfg!(feature = "gui") {
            let (mime, menus) = (share.join("mime"), share.join("applications"));
            lines.push(say!(
                "if the menus are not updated: update-mime-database {mime}; update-desktop-database {menus}",
                mime = mime.display(),
                menus = menus.display()
            ));
        }
        output::messages(&lines);
        Ok(())
    }
}
