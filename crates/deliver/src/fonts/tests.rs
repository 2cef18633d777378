//! Which face is chosen, of fonts that are made here.

use std::collections::BTreeSet;

use super::tiny_font::{Tiny, collection};
use super::{FaceSelection, Library, Purpose};

fn set(text: &str) -> BTreeSet<char> {
    text.chars().collect()
}

fn among(fonts: &[Tiny], text: &str, purpose: Purpose) -> FaceSelection {
    Library::of(fonts.iter().map(Tiny::file)).covering(&set(text), purpose)
}

fn names(found: &FaceSelection) -> Vec<&str> {
    found.faces.iter().map(|face| &*face.name).collect()
}

fn chosen(fonts: &[Tiny], text: &str) -> Vec<String> {
    let found = among(fonts, text, Purpose::Screen);
    names(&found).into_iter().map(str::to_owned).collect()
}

#[test]
fn the_face_with_most_of_the_characters_is_taken_and_then_one_for_the_rest() {
    let fonts = [
        Tiny::new("A", "中"),
        Tiny::new("B", "中国机"),
        Tiny::new("C", "器机"),
        Tiny::new("D", "x"),
    ];
    let found = among(&fonts, "中国机器人", Purpose::Screen);
    assert_eq!(names(&found), ["B", "C"]);
    assert_eq!(found.unshown, set("人"));
}

#[test]
fn a_family_that_is_known_goes_before_one_that_is_not() {
    let fonts = [
        Tiny::new("Everything", "中国ก"),
        Tiny::new("Noto Sans Thai", "ก"),
        Tiny::new("WenQuanYi Zen Hei", "中国"),
        Tiny::new("Noto Sans CJK SC", "中国"),
        Tiny::new("Noto Sans CJK JP", "中国"),
    ];
    assert_eq!(
        chosen(&fonts, "中国ก"),
        ["Noto Sans CJK SC", "Noto Sans Thai"]
    );
    assert_eq!(chosen(&fonts[..3], "中"), ["WenQuanYi Zen Hei"]);
}

#[test]
fn kana_and_hangul_let_their_language_come_first() {
    let letters = "東京タワー한국";
    let fonts = ["SC", "JP", "KR"].map(|end| match end {
        "SC" => Tiny::new("Noto Sans CJK SC", letters),
        "JP" => Tiny::new("Noto Sans CJK JP", letters),
        _ => Tiny::new("Noto Sans CJK KR", letters),
    });
    assert_eq!(chosen(&fonts, "東京"), ["Noto Sans CJK SC"]);
    assert_eq!(chosen(&fonts, "東京タワー"), ["Noto Sans CJK JP"]);
    assert_eq!(chosen(&fonts, "東京한국"), ["Noto Sans CJK KR"]);
}

#[test]
fn the_weight_nearest_to_the_regular_one_is_taken_whatever_the_order() {
    let of = |weight, family| Tiny {
        weight,
        ..Tiny::new(family, "中")
    };
    // One family under three names of its faces, as files have it.
    let mut fonts = [of(700, "SimHei"), of(400, "SimHei"), of(300, "SimHei")];
    for turn in 0..3 {
        fonts.rotate_left(1);
        let found = among(&fonts, "中", Purpose::Screen);
        let face = found.faces[0].parsed().expect("it can be read");
        assert_eq!(face.weight(), Some(400), "turn {turn}");
    }
}

#[test]
fn among_equals_the_path_decides() {
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["c.ttf", "a.ttf", "b.TTF"] {
        let file = Tiny::new("Same", "中").file();
        std::fs::write(folder.path().join(name), file).expect("it can be written");
    }
    std::fs::write(folder.path().join("0.ttf"), b"\0\x01\0\0 no font").expect("written");
    let library = Library::in_folders([folder.path()]);
    let found = library.covering(&set("中"), Purpose::Document);
    assert_eq!(found.faces.len(), 1);
    let path = found.faces[0].path.clone().expect("it is a file");
    assert_eq!(path, folder.path().join("a.ttf"));

    // What has gone since is as if it had never been there.
    for name in ["a.ttf", "b.TTF", "c.ttf"] {
        std::fs::remove_file(folder.path().join(name)).expect("it was there");
    }
    let found = library.covering(&set("中"), Purpose::Document);
    assert_eq!((found.faces.len(), found.unshown), (0, set("中")));
}

#[test]
fn a_face_in_a_collection_is_named_by_its_number() {
    let file = collection(&[Tiny::new("First", "a"), Tiny::new("Second", "中")]);
    let found = Library::of([file]).covering(&set("中"), Purpose::Document);
    assert_eq!(names(&found), ["Second"]);
    assert_eq!(found.faces[0].index, 1);
    let face = found.faces[0].parsed().expect("it can be read");
    assert!(face.glyph('中').is_some() && face.glyph('a').is_none());
}

#[test]
fn a_licence_against_embedding_is_kept() {
    for (fs_type, embedded) in [
        (0, true),
        (4, true),
        (8, true),
        (2, false),
        (0x100, false),
        (0x200, false),
    ] {
        let font = Tiny {
            fs_type,
            ..Tiny::new("Noto Sans CJK SC", "中")
        };
        let faces = |purpose| {
            among(std::slice::from_ref(&font), "中", purpose)
                .faces
                .len()
        };
        assert_eq!(faces(Purpose::Screen), 1, "{fs_type:#x}");
        assert_eq!(faces(Purpose::Document) == 1, embedded, "{fs_type:#x}");
    }
}

#[test]
fn fonts_of_placeholders_and_characters_without_a_shape_are_left_alone() {
    let found = among(&[Tiny::new("LastResort", "中")], "中", Purpose::Screen);
    assert_eq!((found.faces.len(), found.unshown), (0, set("中")));
    let found = among(
        &[Tiny::new("A", "\u{E000}中")],
        "\u{E000}\u{FE0F}\n",
        Purpose::Screen,
    );
    assert_eq!(found, FaceSelection::default());
}

#[test]
fn no_more_faces_are_taken_than_may_be() {
    let letters = ["中", "国", "机", "器", "人", "手"];
    let fonts = letters.map(|letters| Tiny::new("One letter", letters));
    let found = among(&fonts, "中国机器人手", Purpose::Screen);
    assert_eq!(found.faces.len(), super::MOST_FACES);
    assert_eq!(found.unshown.len(), 2);
}

#[test]
fn without_any_font_everything_is_unshown() {
    let found = Library::of([]).covering(&set("中国"), Purpose::Screen);
    assert_eq!((found.faces.len(), found.unshown), (0, set("中国")));
}
