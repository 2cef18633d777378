//! Letters that the bundled fonts lack: egui asks for them when it lays a text out, a task finds a
//! face that has them ([`crate::fonts`]), and from then on every family falls back on it.
//!
//! egui asks for each character once, on the window's thread and in the middle of a frame; there it
//! is only noted. So whatever is shown counts (titles, file names, columns of a table, what is being
//! typed), nothing else is ever looked for, and nothing waits: until the face is there, and where there
//! is none, the character is a box.
//!
//! The file of a face is held in memory as long as the window is open: Noto Sans CJK is 19 MB.

use std::collections::BTreeSet;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use egui::epaint::text::{FontPriority, InsertFontFamily, VariationCoords};
use egui::{Context, FallbackRequest, FontData, FontFamily, FontInsert, FontProvider};

use crate::fonts::{FaceSelection, Library, SystemFace, is_worth_a_font};

/// What is known of letters, at the workbench.
pub(crate) struct Characters {
    /// Where faces are found.
    pub(crate) library: Arc<Library>,
    /// Faces that were found.
    pub(crate) faces: Vec<SystemFace>,
    /// So many of them egui has had since the last frame: with these it draws.
    pub(crate) drawn: usize,
    /// Characters that were looked for.
    asked: BTreeSet<char>,
    /// Characters that no face has.
    lacking: BTreeSet<char>,
    /// Characters that no face has, and that were not reported yet.
    pub(crate) unshown: BTreeSet<char>,
}

impl Default for Characters {
    fn default() -> Self {
        Self {
            library: Library::system(),
            faces: Vec::new(),
            drawn: 0,
            asked: BTreeSet::new(),
            lacking: BTreeSet::new(),
            unshown: BTreeSet::new(),
        }
    }
}

impl Characters {
    /// Those of them that have not been looked for, and are from now on.
    pub(crate) fn new_among(&mut self, wanted: BTreeSet<char>) -> BTreeSet<char> {
        let wanted = wanted.into_iter();
        wanted.filter(|c| self.asked.insert(*c)).collect()
    }

    /// Whether some of these were looked for, and no face has them.
    pub(crate) fn lack(&self, text: &str) -> bool {
        text.chars().any(|c| self.lacking.contains(&c))
    }

    /// Whether those of them that are no plain letters were looked for.
    pub(crate) fn were_asked_for(&self, text: &str) -> bool {
        text.chars()
            .all(|c| c.is_ascii() || self.asked.contains(&c))
    }

    /// Whether egui draws all of these with faces beside the bundled ones.
    pub(crate) fn have(&self, text: &str) -> bool {
        let drawn = self.drawn > 0 && self.drawn == self.faces.len();
        self.were_asked_for(text) && drawn && !self.lack(text)
    }

    /// Takes what a search brought.
    pub(crate) fn take(&mut self, found: FaceSelection, aloud: bool) {
        for face in found.faces {
            // Two searches at a time may find the same.
            if !self.faces.contains(&face) {
                self.faces.push(face);
            }
        }
        self.lacking.extend(&found.unshown);
        if aloud {
            self.unshown.extend(found.unshown);
        }
    }
}

/// What egui asks, on behalf of one window.
pub(crate) struct Alphabet {
    shared: Arc<Shared>,
    installed: usize,
}

#[derive(Default)]
struct Shared {
    wanted: Mutex<BTreeSet<char>>,
    faces: Mutex<Vec<(String, FontData)>>,
}

/// What is in it is whole whatever became of the thread that held it.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl FontProvider for Shared {
    fn fonts_for_family(&self, family: &FontFamily) -> Vec<FontInsert> {
        let insert = |(name, data): &(String, FontData)| FontInsert {
            name: name.clone(),
            data: data.clone(),
            families: vec![InsertFontFamily {
                family: family.clone(),
                priority: FontPriority::Lowest,
            }],
        };
        lock(&self.faces).iter().map(insert).collect()
    }

    fn font_for(&self, request: &FallbackRequest<'_>) -> Option<FontInsert> {
        let worth = request.cluster.chars().filter(|c| is_worth_a_font(*c));
        lock(&self.wanted).extend(worth);
        None
    }
}

impl Alphabet {
    /// Makes this the one that egui asks.
    pub(crate) fn asked_by(ctx: &Context) -> Self {
        let shared = Arc::<Shared>::default();
        ctx.set_font_providers(vec![Arc::clone(&shared) as Arc<dyn FontProvider>]);
        Self {
            shared,
            installed: 0,
        }
    }

    /// What egui has asked for since the last time.
    pub(crate) fn wanted(&self) -> BTreeSet<char> {
        std::mem::take(&mut *lock(&self.shared.wanted))
    }

    /// Gives egui the faces that were found since the last time; returns with how many it draws by now.
    pub(crate) fn install(&mut self, ctx: &Context, faces: &[SystemFace]) -> usize {
        let drawn = self.installed;
        if faces.len() == drawn {
            return drawn;
        }
        self.installed = faces.len();
        *lock(&self.shared.faces) = faces.iter().map(for_egui).collect();
        // It asks again from the beginning.
        ctx.set_font_providers(vec![Arc::clone(&self.shared) as Arc<dyn FontProvider>]);
        drawn
    }
}

fn for_egui(face: &SystemFace) -> (String, FontData) {
    let mut data = FontData::from_blob(Arc::clone(&face.data) as _, face.index);
    // A font of all weights may begin at the thinnest.
    let weights = |axis: &egui::epaint::text::FontVariationAxis| {
        axis.tag == egui::epaint::text::Tag::new(b"wght") && axis.range.contains(400.0)
    };
    if data.variation_axes().iter().any(weights) {
        data.tweak.coords = VariationCoords::new([(b"wght", 400.0)]);
    }
    (format!("{} #{}", face.name, face.index), data)
}
