//! The faces that are installed on the machine, and the choice among them; the rule stands in the
//! module above.
//!
//! What the faces are called is read once, and only when a character is missing. Without optimisation
//! that and a search over 55 faces took 36 ms, with 1000 faces it is tenths of a second: what may
//! not wait asks on another thread.

use std::collections::BTreeSet;
use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

use super::face::Face;
use super::is_worth_a_font;
use super::unshown::{is_hangul, is_kana};
use fontdb::{Database, FaceInfo, Source, Style};

/// More faces than this are not taken for one text: each is held in memory.
pub const MOST_FACES: usize = 4;

/// Families with the characters of several languages, those that read best first.
const FAMILIES: [(&str, Language); 30] = [
    ("Noto Sans CJK SC", Language::Chinese),
    ("Source Han Sans SC", Language::Chinese),
    ("Source Han Sans CN", Language::Chinese),
    ("Noto Sans SC", Language::Chinese),
    ("Microsoft YaHei", Language::Chinese),
    ("Microsoft YaHei UI", Language::Chinese),
    ("PingFang SC", Language::Chinese),
    ("Hiragino Sans GB", Language::Chinese),
    ("Heiti SC", Language::Chinese),
    ("SimHei", Language::Chinese),
    ("Noto Sans CJK TC", Language::Chinese),
    ("Microsoft JhengHei", Language::Chinese),
    ("PingFang TC", Language::Chinese),
    ("WenQuanYi Micro Hei", Language::Chinese),
    ("WenQuanYi Zen Hei", Language::Chinese),
    ("Noto Sans CJK JP", Language::Japanese),
    ("Source Han Sans", Language::Japanese),
    ("Noto Sans JP", Language::Japanese),
    ("Yu Gothic", Language::Japanese),
    ("Meiryo", Language::Japanese),
    ("Hiragino Sans", Language::Japanese),
    ("Hiragino Kaku Gothic ProN", Language::Japanese),
    ("MS Gothic", Language::Japanese),
    ("IPAGothic", Language::Japanese),
    ("Noto Sans CJK KR", Language::Korean),
    ("Source Han Sans K", Language::Korean),
    ("Noto Sans KR", Language::Korean),
    ("Malgun Gothic", Language::Korean),
    ("Apple SD Gothic Neo", Language::Korean),
    ("Droid Sans Fallback", Language::Chinese),
];

/// Fonts that have every character, as a box or as nothing.
const WITHOUT_LETTERS: [&str; 4] = ["LastResort", "Last Resort", "Adobe Blank", "Adobe NotDef"];

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Language {
    Chinese,
    Japanese,
    Korean,
}

/// The language whose families come first for these characters.
fn language(missing: &BTreeSet<char>) -> Language {
    if missing.iter().any(|c| is_kana(*c)) {
        Language::Japanese
    } else if missing.iter().any(|c| is_hangul(*c)) {
        Language::Korean
    } else {
        Language::Chinese
    }
}

/// What a face is wanted for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// To draw with: any outlines.
    Screen,
    /// To embed a part of it in a document: outlines of `glyf` or `CFF `, and a licence (`fsType`)
    /// that lets a part be embedded.
    Document,
}

impl Purpose {
    fn takes(self, face: &Face) -> bool {
        match self {
            Self::Screen => face.has_outlines(),
            Self::Document => face.has_plain_outlines() && face.may_be_embedded(),
        }
    }
}

/// A face that was found, with its file.
#[derive(Clone, PartialEq, Eq)]
pub struct SystemFace {
    /// Its `PostScript` name.
    pub name: String,
    /// Where it was found; `None`: it was given as bytes.
    pub path: Option<PathBuf>,
    /// The whole file: one font, or a collection.
    pub data: Arc<Vec<u8>>,
    /// Its number in the file.
    pub index: u32,
}

impl fmt::Debug for SystemFace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, index, .. } = self;
        write!(
            f,
            "{name} #{index} of {:?}, {} bytes",
            self.path,
            self.data.len()
        )
    }
}

impl SystemFace {
    /// Its tables.
    pub(crate) fn parsed(&self) -> Option<Face<'_>> {
        Face::parse(&self.data, self.index)
    }

    /// Whether its outlines are those of the Compact Font Format, which a document embeds as they are.
    pub fn has_compact_outlines(&self) -> bool {
        self.parsed()
            .is_some_and(|face| face.has_compact_outlines())
    }
}

/// Faces for characters, and what none has.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct FaceSelection {
    /// In the order in which they are to be asked.
    pub faces: Vec<SystemFace>,
    /// Characters that no face has, as far as a font is worth looking for.
    pub unshown: BTreeSet<char>,
}

/// The faces that there are.
pub struct Library {
    faces: OnceLock<Database>,
}

impl Library {
    /// What is installed on this machine; read when the first character is looked for.
    pub fn system() -> Arc<Self> {
        static SYSTEM: OnceLock<Arc<Library>> = OnceLock::new();
        let none_yet = || {
            Arc::new(Self {
                faces: OnceLock::new(),
            })
        };
        Arc::clone(SYSTEM.get_or_init(none_yet))
    }

    /// These font files and nothing else.
    pub fn of(files: impl IntoIterator<Item = Vec<u8>>) -> Self {
        let mut faces = Database::new();
        for file in files {
            faces.load_font_data(file);
        }
        Self {
            faces: OnceLock::from(faces),
        }
    }

    /// These folders and nothing else.
    pub fn in_folders<'p>(folders: impl IntoIterator<Item = &'p Path>) -> Self {
        let mut faces = Database::new();
        for folder in folders {
            faces.load_fonts_dir(folder);
        }
        Self {
            faces: OnceLock::from(faces),
        }
    }

    fn faces(&self) -> &Database {
        self.faces.get_or_init(|| {
            let mut faces = Database::new();
            faces.load_system_fonts();
            faces
        })
    }

    /// The faces for these characters, chosen as the module above says.
    pub fn covering(&self, missing: &BTreeSet<char>, purpose: Purpose) -> FaceSelection {
        let mut left: BTreeSet<char> = missing.iter().copied().collect();
        left.retain(|c| is_worth_a_font(*c));
        let mut found = FaceSelection::default();
        if left.is_empty() {
            return found;
        }
        let classes = self.ranked(language(&left));
        while found.faces.len() < MOST_FACES && !left.is_empty() {
            let best = classes
                .iter()
                .find_map(|class| self.best(class, &left, purpose));
            let Some(face) = best.and_then(|info| self.read(info)) else {
                break;
            };
            // What it was chosen for: a file that has changed meanwhile must not come up again.
            let before = left.len();
            if let Some(parsed) = face.parsed() {
                left.retain(|c| !has(&parsed, *c));
            }
            if left.len() == before {
                break;
            }
            found.faces.push(face);
        }
        found.unshown = left;
        found
    }

    /// All faces by class, each in the order of their rank.
    fn ranked(&self, first: Language) -> [Vec<&FaceInfo>; 3] {
        let mut classes: [Vec<_>; 3] = Default::default();
        for info in self.faces().faces() {
            let named = |names: &[&str]| info.families.iter().any(|(f, _)| names.contains(&&**f));
            if named(&WITHOUT_LETTERS) {
                continue;
            }
            let place = FAMILIES.iter().position(|(family, _)| named(&[family]));
            let noto = info
                .families
                .iter()
                .any(|(f, _)| f.starts_with("Noto Sans"));
            let class = match place {
                Some(_) => 0,
                None if noto => 1,
                None => 2,
            };
            let other = place.is_some_and(|place| FAMILIES[place].1 != first);
            let rank = (
                (other, place),
                info.style != Style::Normal,
                info.weight.0.abs_diff(400),
                path(info),
                info.index,
                info.post_script_name.as_str(),
            );
            classes[class].push((rank, info));
        }
        classes.map(|mut class| {
            class.sort_by(|a, b| a.0.cmp(&b.0));
            class.into_iter().map(|(_, info)| info).collect()
        })
    }

    /// The first of those that have most of the characters; `None`: none has any.
    fn best<'l>(
        &self,
        class: &[&'l FaceInfo],
        missing: &BTreeSet<char>,
        purpose: Purpose,
    ) -> Option<&'l FaceInfo> {
        let mut best = None;
        let mut most = 0;
        for info in class {
            let has = self.how_many(info, missing, purpose);
            if has > most {
                (best, most) = (Some(*info), has);
            }
            if has == missing.len() {
                break;
            }
        }
        best
    }

    fn how_many(&self, info: &FaceInfo, missing: &BTreeSet<char>, purpose: Purpose) -> usize {
        let count = |data: &[u8], index| {
            let face = Face::parse(data, index).filter(|f| purpose.takes(f))?;
            Some(missing.iter().filter(|c| has(&face, **c)).count())
        };
        let counted = self.faces().with_face_data(info.id, count);
        counted.flatten().unwrap_or(0)
    }

    fn read(&self, info: &FaceInfo) -> Option<SystemFace> {
        let data = self
            .faces()
            .with_face_data(info.id, |data, _| data.to_vec())?;
        Some(SystemFace {
            name: info.post_script_name.clone(),
            path: path(info).map(Path::to_path_buf),
            data: Arc::new(data),
            index: info.index,
        })
    }
}

fn has(face: &Face, c: char) -> bool {
    face.glyph(c).is_some()
}

fn path(info: &FaceInfo) -> Option<&Path> {
    match &info.source {
        Source::File(path) | Source::SharedFile(path, _) => Some(path),
        Source::Binary(_) => None,
    }
}
