//! Bad sessions, one of each kind: every one is refused, and the answer says where and why.

#![allow(
    clippy::unwrap_used,
    reason = "a test that cannot prepare its files has failed"
)]

use std::fs;
use std::path::Path;

use truepose::sessions::{load, load_robot, parse};

const JOINT: &str = r#"{"name":"pan","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0],"limits":[-90,90],"mass_kg":4,"centre_mm":[1,2,3]}"#;
const TOOL: &str = r#"{"position_mm":[250,0,300],"quaternion_wxyz":[1,0,0,0]}"#;
const CSV: &str =
    "q1_deg,x_mm,y_mm,z_mm,target,dir1,use\n1,2,3,4,T1,1,fit\n2,3,4,5,T1,-1,held-out\n";

/// A sound session with every key, each on a line of its own.
fn sound() -> String {
    format!(
        "{{\"format\":\"truepose-session/1\",\n\"name\":\"s\",\n\"note\":\"n\",\n\
         \"robot\":{{\"name\":\"r\",\n\"joints\":[{JOINT}],\n\"tool\":{TOOL},\n\"gravity_m_s2\":[0,0,-9.81]}},\n\
         \"targets\":{{\"T1\":[0,0,0]}},\n\"instrument\":{{\"name\":\"tracker\",\"sigma_mm\":0.03}},\n\
         \"tolerance_mm\":0.2,\n\"regions\":[{{\"name\":\"1\",\"from_deg\":0,\"to_deg\":30}}],\n\
         \"compensated_by\":null,\n\"samples\":{{\"file\":\"s.csv\"}}}}\n"
    )
}

/// What `load` says about these two files.
fn answer(document: &[u8], csv: Option<&[u8]>) -> Result<(), String> {
    let folder = tempfile::tempdir().unwrap();
    if let Some(csv) = csv {
        fs::write(folder.path().join("s.csv"), csv).unwrap();
    }
    let path = folder.path().join("s.json");
    fs::write(&path, document).unwrap();
    load(&path)
        .map(|_| ())
        .map_err(|rejected| rejected.to_string())
}

fn assert_says(name: &str, answer: Result<(), String>, says: &[&str]) {
    let message = answer.expect_err(name);
    for part in says {
        assert!(message.contains(part), "{name}: no {part:?} in\n{message}");
    }
}

#[test]
fn the_sound_session_is_accepted() {
    assert_eq!(answer(sound().as_bytes(), Some(CSV.as_bytes())), Ok(()));
}

/// Replaces a part of the sound document.
type BadDocument = (
    &'static str,
    &'static str,
    &'static str,
    &'static [&'static str],
);

const BAD_DOCUMENTS: &[BadDocument] = &[
    (
        "another format",
        "truepose-session/1",
        "truepose-session/9",
        &["line 1, column 11, format", "another version"],
    ),
    (
        "somebody else's format",
        "truepose-session/1",
        "gltf",
        &["format", "'gltf'", "truepose-session/1"],
    ),
    (
        "a free target that there is not",
        "\"sigma_mm\":0.03",
        "\"sigma_mm\":0.03,\"free_targets\":[\"T7\"]",
        &["instrument.free_targets", "'T7' is not declared", "T1"],
    ),
    (
        "no format",
        "\"format\"",
        "\"fromat\"",
        &["line 1", "no key 'format'"],
    ),
    (
        "a format that is a number",
        "\"truepose-session/1\"",
        "1",
        &["format: 1; expected"],
    ),
    (
        "no name",
        "\"name\":\"s\"",
        "\"title\":\"s\"",
        &["no key 'name'"],
    ),
    (
        "a name that is a number",
        "\"name\":\"s\"",
        "\"name\":5",
        &["line 2, column 8, name: 5; expected a text"],
    ),
    (
        "a note that is an object",
        "\"note\":\"n\"",
        "\"note\":{}",
        &["line 3", "note: an object"],
    ),
    ("no robot", "\"robot\"", "\"robt\"", &["no key 'robot'"]),
    (
        "a robot that is null",
        "\"joints\":[",
        "\"joints\":null,\"x\":[",
        &["a robot without joints"],
    ),
    (
        "a robot without joints",
        "\"joints\":[",
        "\"joint\":[",
        &["line 4", "robot: a robot without joints"],
    ),
    (
        "joints and dh",
        "\"joints\":[",
        "\"dh\":[],\"joints\":[",
        &["joints and dh"],
    ),
    (
        "no joint",
        JOINT,
        "",
        &["line 5, column 10, robot.joints: an array of 0 values"],
    ),
    (
        "a joint that is a number",
        JOINT,
        "7",
        &["robot.joints", "an array of 1 value"],
    ),
    (
        "a joint that is a text",
        JOINT,
        "\"pan\"",
        &["robot.joints[0]: 'pan'"],
    ),
    (
        "a joint without a name",
        "\"name\":\"pan\",",
        "",
        &["robot.joints[0]: no key 'name'"],
    ),
    (
        "an unknown kind",
        "revolute",
        "spherical",
        &[
            "line 5",
            "robot.joints[0].kind: 'spherical'",
            "one of 'revolute', 'prismatic'",
        ],
    ),
    (
        "a kind that is a number",
        "\"revolute\"",
        "1",
        &["robot.joints[0].kind: 1"],
    ),
    ("no kind", "\"kind\":\"revolute\",", "", &["no key 'kind'"]),
    (
        "an axis of zero length",
        "\"axis\":[0,0,1]",
        "\"axis\":[0,0,0]",
        &["robot.joints[0].axis: zero length"],
    ),
    (
        "an axis of two numbers",
        "\"axis\":[0,0,1]",
        "\"axis\":[0,1]",
        &["robot.joints[0].axis: an array of 2 values; expected an array of 3"],
    ),
    (
        "an axis that overflows",
        "\"axis\":[0,0,1]",
        "\"axis\":[0,0,1e999]",
        &["axis: a number that overflows"],
    ),
    (
        "an axis with null",
        "\"axis\":[0,0,1]",
        "\"axis\":[0,0,null]",
        &["axis: an array with null in it"],
    ),
    (
        "an axis that is a text",
        "\"axis\":[0,0,1]",
        "\"axis\":\"z\"",
        &["axis: 'z'"],
    ),
    ("no axis", "\"axis\":[0,0,1],", "", &["no key 'axis'"]),
    (
        "no point",
        "\"point_mm\":[0,0,0],",
        "",
        &["no key 'point_mm'"],
    ),
    (
        "a point of texts",
        "\"point_mm\":[0,0,0]",
        "\"point_mm\":[\"0\",0,0]",
        &["point_mm: an array of 3 values"],
    ),
    (
        "reversed limits",
        "[-90,90]",
        "[90,-90]",
        &[
            "robot.joints[0].limits: limits from 90 to -90",
            "smaller to the larger",
        ],
    ),
    (
        "equal limits",
        "[-90,90]",
        "[90,90]",
        &["limits from 90 to 90"],
    ),
    (
        "one limit",
        "[-90,90]",
        "[90]",
        &["limits: an array of 1 value; expected an array of 2"],
    ),
    (
        "a negative mass",
        "\"mass_kg\":4",
        "\"mass_kg\":-4",
        &["mass_kg: -4; expected a mass of 0 kg or more"],
    ),
    (
        "a mass without a centre",
        ",\"centre_mm\":[1,2,3]",
        "",
        &["no key 'centre_mm'"],
    ),
    (
        "a centre without a mass",
        "\"mass_kg\":4,",
        "",
        &["no key 'mass_kg'"],
    ),
    ("no tool", "\"tool\"", "\"tol\"", &["no key 'tool'"]),
    (
        "a tool that is an array",
        TOOL,
        "[1,2,3]",
        &["robot.tool: an array of 3 values"],
    ),
    (
        "no position",
        "\"position_mm\":[250,0,300],",
        "",
        &["robot.tool: no key 'position_mm'"],
    ),
    (
        "a quaternion of zero length",
        "[1,0,0,0]",
        "[0,0,0,0]",
        &["quaternion_wxyz: zero length"],
    ),
    (
        "a quaternion of three",
        "[1,0,0,0]",
        "[1,0,0]",
        &["quaternion_wxyz: an array of 3 values", "w, x, y, z"],
    ),
    (
        "gravity as a number",
        "[0,0,-9.81]",
        "9.81",
        &["robot.gravity_m_s2: 9.81; expected an array of 3 numbers"],
    ),
    (
        "targets in an array",
        "{\"T1\":[0,0,0]}",
        "[[0,0,0]]",
        &["targets: an array of 1 value"],
    ),
    (
        "a target of two numbers",
        "{\"T1\":[0,0,0]}",
        "{\"T1\":[0,0]}",
        &["targets.T1: an array of 2 values"],
    ),
    (
        "a target twice",
        "{\"T1\":[0,0,0]}",
        "{\"T1\":[0,0,0],\"T1\":[1,0,0]}",
        &["'T1' a second time"],
    ),
    (
        "an instrument that is a text",
        "{\"name\":\"tracker\",\"sigma_mm\":0.03}",
        "\"tracker\"",
        &["instrument: 'tracker'"],
    ),
    (
        "an instrument without a name",
        "\"name\":\"tracker\",",
        "",
        &["instrument: no key 'name'"],
    ),
    (
        "a negative sigma",
        "0.03",
        "-0.03",
        &["instrument.sigma_mm: -0.03; expected a positive number"],
    ),
    ("a sigma of zero", "0.03", "0", &["instrument.sigma_mm: 0"]),
    (
        "a sigma of two",
        "0.03",
        "[0.03,0.03]",
        &["instrument.sigma_mm: an array of 2 values"],
    ),
    (
        "a sigma with a zero",
        "0.03",
        "[0.03,0,0.03]",
        &["instrument.sigma_mm"],
    ),
    (
        "a tolerance of zero",
        "\"tolerance_mm\":0.2",
        "\"tolerance_mm\":0",
        &["line 10, column 16, tolerance_mm: 0; expected a number above 0"],
    ),
    (
        "a tolerance that is a text",
        "\"tolerance_mm\":0.2",
        "\"tolerance_mm\":\"0.2\"",
        &["tolerance_mm: '0.2'"],
    ),
    (
        "a reversed region",
        "\"from_deg\":0,\"to_deg\":30",
        "\"from_deg\":30,\"to_deg\":0",
        &["line 11", "regions[0]: a region from 30 to 0"],
    ),
    (
        "a region without an end",
        ",\"to_deg\":30",
        "",
        &["regions[0]: no key 'to_deg'"],
    ),
    (
        "a region without a name",
        "\"name\":\"1\",",
        "",
        &["regions[0]: no key 'name'"],
    ),
    (
        "regions in an object",
        "[{\"name\":\"1\",\"from_deg\":0,\"to_deg\":30}]",
        "{}",
        &["regions: an object"],
    ),
    (
        "a hash that is a number",
        "\"compensated_by\":null",
        "\"compensated_by\":3",
        &["compensated_by: 3"],
    ),
    (
        "no samples",
        "\"samples\"",
        "\"sample\"",
        &["no key 'samples'"],
    ),
    (
        "samples as a text",
        "{\"file\":\"s.csv\"}",
        "\"s.csv\"",
        &["samples: 's.csv'"],
    ),
    (
        "neither file nor columns",
        "{\"file\":\"s.csv\"}",
        "{}",
        &["samples: an object; expected an object with"],
    ),
    (
        "both file and columns",
        "{\"file\":\"s.csv\"}",
        "{\"file\":\"s.csv\",\"columns\":{}}",
        &["samples: \"file\", \"columns\"; expected one of the two"],
    ),
    (
        "a file name that is a number",
        "\"s.csv\"",
        "4",
        &["samples.file: 4"],
    ),
    (
        "a file that is not there",
        "\"s.csv\"",
        "\"t.csv\"",
        &["line 13, column 19, samples.file: no such file: t.csv"],
    ),
    (
        "an empty file name",
        "\"s.csv\"",
        "\"\"",
        &["samples.file: not a file name"],
    ),
    (
        "a file above the folder",
        "\"s.csv\"",
        "\"../s.csv\"",
        &["samples.file: a path that leads upwards: ../s.csv"],
    ),
    (
        "a detour above the folder",
        "\"s.csv\"",
        "\"a/../../s.csv\"",
        &["leads upwards"],
    ),
    (
        "an absolute path",
        "\"s.csv\"",
        "\"/etc/passwd\"",
        &["an absolute path: /etc/passwd"],
    ),
    (
        "a device",
        "\"s.csv\"",
        "\"/dev/zero\"",
        &["an absolute path"],
    ),
    (
        "the folder itself",
        "\"s.csv\"",
        "\".\"",
        &["samples.file: a directory"],
    ),
    (
        "two keys of one name",
        "\"note\"",
        "\"name\"",
        &["line 3, column 1: 'name' a second time"],
    ),
    (
        "a trailing comma",
        "\"note\":\"n\",",
        "\"note\":\"n\",,",
        &["line 3", "expected a key in double quotes"],
    ),
    (
        "NaN",
        "0.03",
        "NaN",
        &["line 9", "'NaN'; expected a JSON value"],
    ),
    (
        "a comment",
        "\"note\"",
        "// a note\n\"note\"",
        &["line 3, column 1", "expected a key in double quotes"],
    ),
    (
        "single quotes",
        "\"note\":\"n\"",
        "'note':'n'",
        &["line 3, column 1", "expected a key in double quotes"],
    ),
    (
        "no columns inline",
        "{\"file\":\"s.csv\"}",
        "{\"columns\":{}}",
        &["no column 'q1_deg'", "no sample"],
    ),
    (
        "columns of unequal length",
        "{\"file\":\"s.csv\"}",
        "{\"columns\":{\"q1_deg\":[1,2],\"x_mm\":[1],\"y_mm\":[1,2]}}",
        &["samples.columns.x_mm: 1 value; expected 2, as many as samples"],
    ),
    (
        "a text among numbers",
        "{\"file\":\"s.csv\"}",
        "{\"columns\":{\"q1_deg\":[1,\"2\"],\"x_mm\":[1,2],\"y_mm\":[1,2]}}",
        &["samples.columns.q1_deg[1]: '2'"],
    ),
    (
        "an inline overflow",
        "{\"file\":\"s.csv\"}",
        "{\"columns\":{\"q1_deg\":[1],\"x_mm\":[1e999],\"y_mm\":[1]}}",
        &["samples.columns.x_mm[0]: a number that overflows"],
    ),
    (
        "an inline direction of 2",
        "{\"file\":\"s.csv\"}",
        "{\"columns\":{\"q1_deg\":[1,1],\"x_mm\":[1,1],\"y_mm\":[1,1],\"dir1\":[1,2]}}",
        &["line 13", "samples.columns.dir1[1]: 2; expected 1, -1 or 0"],
    ),
    (
        "a urdf that is not there",
        "\"joints\":[",
        "\"urdf\":{\"file\":\"r.urdf\",\"base\":\"a\",\"tip\":\"b\"},\"x\":[",
        &["robot.urdf", "r.urdf"],
    ),
    (
        "a dh row without a convention",
        "\"joints\":[",
        "\"dh\":[{\"a_mm\":1,\"alpha_deg\":0,\"d_mm\":0,\"theta_deg\":0}],\"x\":[",
        &["robot.dh[0]: no key 'convention'"],
    ),
    (
        "a dh row of an unknown convention",
        "\"joints\":[",
        "\"dh\":[{\"a_mm\":1,\"alpha_deg\":0,\"d_mm\":0,\"theta_deg\":0,\"convention\":\"craig\"}],\"x\":[",
        &["robot.dh[0].convention: 'craig'"],
    ),
];

#[test]
fn every_bad_document_is_refused_with_its_place() {
    for (name, old, new, says) in BAD_DOCUMENTS {
        let document = sound();
        assert!(
            document.contains(old),
            "{name}: the sound session has no {old}"
        );
        let document = document.replacen(old, new, 1);
        assert_says(
            name,
            answer(document.as_bytes(), Some(CSV.as_bytes())),
            says,
        );
    }
}

const BAD_TABLES: &[(&str, &[u8], &[&str])] = &[
    ("an empty file", b"", &["s.csv, line 1: an empty file"]),
    (
        "nothing but blank lines",
        b"\n\r\n \n",
        &["s.csv, line 1: an empty file"],
    ),
    (
        "no sample",
        b"q1_deg,x_mm,y_mm\n",
        &["s.csv: no sample; expected at least one"],
    ),
    (
        "no commanded value",
        b"x_mm,y_mm\n1,2\n",
        &["s.csv, line 1: no column 'q1_deg'"],
    ),
    ("no x", b"q1_deg,y_mm\n1,2\n", &["no column 'x_mm'"]),
    ("no y", b"q1_deg,x_mm\n1,2\n", &["no column 'y_mm'"]),
    (
        "a heading without a unit",
        b"q1,x,y\n1,2,3\n",
        &["column 'q1' is not known", "q1_deg", "no column 'x_mm'"],
    ),
    (
        "two units of one quantity",
        b"q1_deg,x_mm,y_mm,x_in\n1,2,3,4\n",
        &["s.csv, line 1, column 4, x_in: the same quantity as column 2, 'x_mm'"],
    ),
    (
        "a column twice",
        b"q1_deg,x_mm,y_mm,x_mm\n1,2,3,4\n",
        &["column 4", "the same quantity"],
    ),
    (
        "a length for a turning joint",
        b"q1_mm,x_mm,y_mm\n1,2,3\n",
        &["column 1, q1_mm: a unit that is not one of joint 1; expected _deg, _rad"],
    ),
    (
        "a sliding speed of a turning joint",
        b"q1_deg,x_mm,y_mm,speed1_mm_s\n1,2,3,4\n",
        &["speed1_mm_s: a unit that is not one of joint 1"],
    ),
    (
        "a joint that does not exist",
        b"q1_deg,q2_deg,x_mm,y_mm\n1,2,3,4\n",
        &["column 2, q2_deg: joint 2 does not exist", "from 1 to 1"],
    ),
    (
        "three of four orientation columns",
        b"q1_deg,x_mm,y_mm,qw,qx,qy\n1,2,3,1,0,0\n",
        &["3 of the 4 numbers of an orientation"],
    ),
    (
        "nan",
        b"q1_deg,x_mm,y_mm\n1,nan,3\n",
        &[
            "s.csv, line 2, column 2, x_mm: 'nan'; expected a finite number",
            "an empty cell",
        ],
    ),
    (
        "NaN in capitals",
        b"q1_deg,x_mm,y_mm\n1,2,NaN\n",
        &["line 2, column 3, y_mm: 'NaN'"],
    ),
    (
        "infinity",
        b"q1_deg,x_mm,y_mm\n1,2,-inf\n",
        &["column 3, y_mm: '-inf'"],
    ),
    (
        "overflow",
        b"q1_deg,x_mm,y_mm\n1,1e999,3\n",
        &["column 2, x_mm: '1e999'; expected a number that a double can hold"],
    ),
    (
        "overflow of the unit",
        b"q1_deg,x_m,y_mm\n1,1e307,3\n",
        &["line 2, column 2, x_m: a number that overflows"],
    ),
    (
        "a word among numbers",
        b"q1_deg,x_mm,y_mm\n1,2,3\n1,n/a,3\n",
        &["line 3, column 2, x_mm: 'n/a'; expected a number"],
    ),
    (
        "a unit in the cell",
        b"q1_deg,x_mm,y_mm\n1,2mm,3\n",
        &["'2mm'; expected a number"],
    ),
    (
        "a hexadecimal number",
        b"q1_deg,x_mm,y_mm\n1,0x10,3\n",
        &["'0x10'"],
    ),
    (
        "a thousands separator",
        b"q1_deg,x_mm,y_mm\n1,\"1,000\",3\n",
        &["'1,000'", "truepose import --decimal ,"],
    ),
    (
        "decimal commas",
        b"q1_deg,x_mm,y_mm\n1,5,2,5,3,5\n",
        &[
            "line 2, column 4: 6 cells; expected 3 cells",
            "truepose import --decimal ,",
        ],
    ),
    (
        "semicolons",
        b"q1_deg;x_mm;y_mm\n1;2;3\n",
        &["headings separated by semicolons", "truepose import"],
    ),
    (
        "tabs",
        b"q1_deg\tx_mm\ty_mm\n1\t2\t3\n",
        &["headings separated by tabs", "truepose import"],
    ),
    (
        "no headings",
        b"1,2,3\n4,5,6\n",
        &["line 1: numbers in the first line", "truepose import"],
    ),
    (
        "a short row",
        b"q1_deg,x_mm,y_mm\n1,2,3\n1,2\n",
        &["line 3, column 2: 2 cells; expected 3 cells"],
    ),
    (
        "a long row",
        b"q1_deg,x_mm,y_mm\n1,2,3,4\n",
        &["line 2, column 4: 4 cells; expected 3 cells"],
    ),
    (
        "an open quote",
        b"q1_deg,x_mm,y_mm,target\n1,2,3,\"T1\n",
        &["line 2, column 4, target: a quote that is not closed"],
    ),
    (
        "text behind a quote",
        b"q1_deg,x_mm,y_mm,target\n1,2,3,\"T1\"x\n",
        &["target: something after the closing quote"],
    ),
    (
        "a target that nobody declared",
        b"q1_deg,x_mm,y_mm,target\n1,2,3,T9\n",
        &["line 2, column 4, target: 'T9' is not declared", "T1"],
    ),
    (
        "a direction of 2",
        b"q1_deg,x_mm,y_mm,dir1\n1,2,3,1\n1,2,3,2\n",
        &["line 3, column 4, dir1: 2; expected 1, -1 or 0"],
    ),
    (
        "a direction in words",
        b"q1_deg,x_mm,y_mm,dir1\n1,2,3,up\n",
        &["dir1: 'up'; expected a number"],
    ),
    (
        "a use of another name",
        b"q1_deg,x_mm,y_mm,use\n1,2,3,test\n",
        &["line 2, column 4, use: 'test'; expected fit, held-out or excluded"],
    ),
    (
        "not one complete sample",
        b"q1_deg,x_mm,y_mm\n1,,\n,2,3\n",
        &["no sample has its commanded values and anything measured"],
    ),
    (
        "a picture",
        b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR",
        &["s.csv, line 1: a zero byte"],
    ),
    (
        "NUL bytes far down",
        b"q1_deg,x_mm,y_mm\n1,2,3\n1,\0,3\n",
        &["a zero byte"],
    ),
    (
        "UTF-16 with a mark",
        b"\xff\xfeq\x001\0",
        &["a file in UTF-16", "truepose import"],
    ),
    (
        "UTF-16 without a mark",
        b"q\x001\0_\0d\0",
        &["a file in UTF-16"],
    ),
    (
        "Latin-1 in a heading",
        b"q1_deg,x_mm,y_mm,gr\xf6\xdfe\n1,2,3,4\n",
        &["line 1, column 4: bytes that are not UTF-8"],
    ),
    (
        "Latin-1 in a cell",
        b"q1_deg,x_mm,y_mm,target\n1,2,3,gr\xf6\xdfe\n",
        &["line 2, column 4, target: bytes that are not UTF-8"],
    ),
    (
        "a document instead of a table",
        b"{\"q1_deg\": [1], \"x_mm\": [2]}\n",
        &["line 1, column 2: something after the closing quote"],
    ),
    ("a second sign", b"q1_deg,x_mm,y_mm\n1,--2,3\n", &["'--2'"]),
    (
        "a second point",
        b"q1_deg,x_mm,y_mm\n1,2.3.4,3\n",
        &["'2.3.4'"],
    ),
    (
        "an exponent without digits",
        b"q1_deg,x_mm,y_mm\n1,2e,3\n",
        &["'2e'"],
    ),
];

#[test]
fn every_bad_table_is_refused_with_its_place() {
    for (name, csv, says) in BAD_TABLES {
        assert_says(name, answer(sound().as_bytes(), Some(csv)), says);
    }
}

#[test]
fn documents_that_are_no_text_are_refused() {
    let truncated = sound();
    let nested = "[".repeat(100_000);
    let cases: [(&str, &[u8], &[&str]); 7] = [
        ("an empty file", b"", &["s.json: an empty file"]),
        (
            "a truncated document",
            &truncated.as_bytes()[..200],
            &["s.json, line 5", "the end of the file"],
        ),
        (
            "a document truncated between keys",
            &truncated.as_bytes()[..42],
            &["the end of the file; expected"],
        ),
        (
            "deep nesting",
            nested.as_bytes(),
            &["line 1, column 65: more than 64 levels"],
        ),
        (
            "an array",
            b"[1,2]",
            &["an array of 2 values; expected a session"],
        ),
        ("UTF-16", b"\xff\xfe{\0}\0", &["a file in UTF-16"]),
        (
            "Latin-1",
            b"{\n \"name\": \"gr\xf6\xdfe\"}",
            &["line 2, column 13: bytes that are not UTF-8"],
        ),
    ];
    for (name, document, says) in cases {
        assert_says(name, answer(document, None), says);
    }
}

#[test]
fn every_truncation_of_a_session_is_refused_and_none_panics() {
    let document = sound();
    let whole = document.trim_end().len();
    for end in 0..whole {
        assert!(
            answer(&document.as_bytes()[..end], Some(CSV.as_bytes())).is_err(),
            "{end} bytes"
        );
    }
}

#[test]
fn all_problems_are_said_at_once() {
    let document = sound()
        .replace("revolute", "spherical")
        .replace("[-90,90]", "[90,-90]")
        .replace("0.03", "-1")
        .replace("\"tolerance_mm\":0.2", "\"tolerance_mm\":null")
        .replace("\"to_deg\":30", "\"to_deg\":-30");
    let csv = "q1_deg,x_mm,y_mm\n1,a,3\n1,2,nan\n";
    assert_says(
        "five at once",
        answer(document.as_bytes(), Some(csv.as_bytes())),
        &[
            "kind: 'spherical'",
            "limits from 90 to -90",
            "sigma_mm: -1",
            "regions[0]",
            "line 2, column 2, x_mm: 'a'",
            "line 3, column 3, y_mm: 'nan'",
        ],
    );
}

#[test]
fn what_is_no_file_is_not_opened() {
    let folder = tempfile::tempdir().unwrap();
    let says = |path: &Path| load(path).expect_err("it is no file").to_string();
    assert!(says(folder.path()).contains("a directory; expected a regular file"));
    assert!(says(&folder.path().join("none.json")).contains("none.json: no such file"));
    assert!(load_robot(folder.path()).is_err());
    assert!(
        parse(sound().as_bytes())
            .unwrap_err()
            .to_string()
            .contains("samples in a file")
    );
}

#[cfg(unix)]
#[test]
fn links_pipes_and_devices_are_not_followed_opened_or_waited_for() {
    use std::os::unix::fs::symlink;

    let outside = tempfile::tempdir().unwrap();
    fs::write(outside.path().join("secret.csv"), CSV).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("s.json");
    fs::write(&path, sound()).unwrap();
    let csv = folder.path().join("s.csv");
    let says = || load(&path).expect_err("it is no file of ours").to_string();

    symlink(outside.path().join("secret.csv"), &csv).unwrap();
    assert!(
        says().contains("a link that leaves the session's folder"),
        "{}",
        says()
    );
    fs::remove_file(&csv).unwrap();

    symlink("/dev/zero", &csv).unwrap();
    assert!(says().contains("leaves the session's folder"), "{}", says());
    fs::remove_file(&csv).unwrap();

    symlink("s.csv", &csv).unwrap();
    assert!(
        says().contains("samples.file"),
        "a link to itself: {}",
        says()
    );
    fs::remove_file(&csv).unwrap();

    fs::create_dir(&csv).unwrap();
    assert!(says().contains("samples.file: a directory"), "{}", says());
    fs::remove_dir(&csv).unwrap();

    let made = std::process::Command::new("mkfifo").arg(&csv).status();
    if made.is_ok_and(|status| status.success()) {
        assert!(says().contains("a device or a pipe"), "{}", says());
        fs::remove_file(&csv).unwrap();
    }

    fs::create_dir(folder.path().join("data")).unwrap();
    fs::write(folder.path().join("data/real.csv"), CSV).unwrap();
    symlink("data/real.csv", &csv).unwrap();
    assert!(
        load(&path).is_ok(),
        "a link within the folder is a file of the folder"
    );
    assert!(
        load("/dev/zero")
            .unwrap_err()
            .to_string()
            .contains("a device or a pipe")
    );
}

#[cfg(unix)]
#[test]
fn a_file_without_permission_is_refused() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("s.json");
    fs::write(&path, sound()).unwrap();
    fs::set_permissions(&path, fs::Permissions::from_mode(0o000)).unwrap();
    if fs::read(&path).is_ok() {
        eprintln!("skipped: this user may read everything");
        return;
    }
    assert!(
        load(&path)
            .unwrap_err()
            .to_string()
            .contains("no permission to read it")
    );
}
