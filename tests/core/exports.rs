//! Tables for controllers: every format is applied by a controller on paper (`support/controllers.rs`)
//! to a robot on paper (`support/rig.rs`, or closed form), none of which shares code with the
//! exporters. The gap has to shrink to what was promised, and to double with the sign turned round.

use crate::controllers::{Controller, load};
use crate::exporting::{
    ONE_SIDED, TWO_SIDED, export, identified, joined, known, one_joint, sidecar, text, try_export,
};
use crate::rig::{Design, Hidden, Random, Rig, Shot};
use proptest::prelude::*;
use truepose::export::gap_after_export;
use truepose::model::Calibration;
use truepose::sessions::{Session, parse};

/// A rotary axis without noise, measured from both sides over a full turn.
fn measured(hidden: Vec<Hidden>) -> (Rig, Session) {
    let mut random = Random(7);
    let design = Design {
        span_deg: 179.9,
        sigma_mm: 1e-7,
        conditions: false,
        ..Design::default()
    };
    let mut rig = Rig::new(&design, &mut random);
    rig.length = 0.0;
    rig.offset = 0.31_f64.to_radians();
    for shot in &mut rig.shots {
        (shot.speed, shot.load, shot.warmth) = (0.0, 0.0, 0.0);
    }
    rig.hidden = hidden;
    rig.measure(&mut random);
    let mut session = parse(rig.json("on paper").as_bytes())
        .expect("a good session")
        .session;
    session.tolerance_mm = Some(0.2);
    (rig, session)
}

fn smooth() -> Vec<Hidden> {
    vec![
        Hidden::Eccentricity(1.1e-3, 0.7),
        Hidden::TwoCycle(3e-4, 2.0),
    ]
}

const SMOOTH: [&str; 4] = [
    "joint-zero-offset",
    "link-length",
    "encoder-eccentricity",
    "encoder-two-cycle",
];

/// Root mean square of the distance to where the axis was told to go, mm, over the rig's poses;
/// `turned` is 1, or −1 for a controller that takes the sign the wrong way round.
fn gap(rig: &Rig, controller: &dyn Controller, turned: f64) -> f64 {
    let square = |shot: &Shot| {
        let command = shot.q.to_degrees();
        let sent = command + turned * (controller.sends(command, shot.dir) - command);
        let told = Shot {
            q: sent.to_radians(),
            ..*shot
        };
        let reached = rig.point(&told, &rig.hidden);
        let wanted = [250.0 * shot.q.cos(), 250.0 * shot.q.sin(), 300.0];
        (0..3)
            .map(|k| (reached[k] - wanted[k]).powi(2))
            .sum::<f64>()
    };
    let sum: f64 = rig.shots.iter().map(square).sum();
    (sum / rig.shots.len() as f64).sqrt()
}

struct Nothing;

impl Controller for Nothing {
    fn sends(&self, command: f64, _: f64) -> f64 {
        command
    }
    fn entries(&self) -> Vec<[f64; 3]> {
        Vec::new()
    }
}

/// What is promised is kept, and the wrong sign doubles the gap.
fn check(rig: &Rig, session: &Session, calibration: &Calibration, format: &str) {
    let made = export(calibration, format, None);
    let controller = load(format, &text(&made));
    let before = gap(rig, &Nothing, 1.0);
    let after = gap(rig, controller.as_ref(), 1.0);
    let left = made.left.as_ref().expect("a table says what it leaves");
    assert!(left.met(), "{format}: {left:?}");
    // A hundredth of the tolerance of 0.2 mm, on an axis that a table can correct wholly.
    assert!(after < 0.002, "{format}: {before} → {after}");
    let promised = gap_after_export(calibration, session, &made)
        .expect("a gap")
        .rms_mm;
    assert!(
        (promised - after).abs() < 2e-6,
        "{format}: promised {promised}, was {after}"
    );
    let wrong = gap(rig, controller.as_ref(), -1.0) / before;
    assert!((1.98..2.02).contains(&wrong), "{format}: {wrong} times");
}

#[test]
fn every_table_leaves_what_it_promises_and_the_wrong_sign_doubles_the_gap() {
    let (rig, session) = measured(smooth());
    let calibration = identified(&session, &SMOOTH);
    for format in TWO_SIDED.iter().chain(&ONE_SIDED) {
        check(&rig, &session, &calibration, format);
    }
}

#[test]
fn with_backlash_each_direction_gets_its_own_column() {
    let width = 0.05_f64.to_radians();
    let mut hidden = smooth();
    hidden.push(Hidden::Backlash(width));
    let (rig, session) = measured(hidden);
    let calibration = identified(&session, &[&SMOOTH[..], &["backlash"]].concat());
    for format in TWO_SIDED {
        check(&rig, &session, &calibration, format);
        let made = export(&calibration, format, None);
        let controller = load(format, &text(&made));
        for [_, up, down] in controller.entries() {
            assert!((up - down - 0.05).abs() < 2e-4, "{format}: {up} {down}");
        }
        // Each direction by itself.
        for side in [1.0, -1.0] {
            let mut one = rig.clone();
            one.shots.retain(|shot| shot.dir == side);
            assert!(
                gap(&one, controller.as_ref(), 1.0) < 0.002,
                "{format} {side}"
            );
        }
    }
    for format in ONE_SIDED {
        let refused = try_export(&calibration, format, None).expect_err("it has one direction");
        let says = refused.to_string();
        assert!(
            says.contains("0.0500") && says.contains("backlash"),
            "{says}"
        );
        assert!(says.contains("export a model without"), "{says}");
    }
}

#[test]
fn a_backlash_that_does_not_matter_is_averaged_and_said() {
    let session = one_joint("revolute", [-90.0, 90.0]);
    // 250 mm × 0.0005° / 2 = 0.0011 mm on either side, of 0.002 mm allowed.
    let calibration = known(
        &session,
        &[
            ("joint-zero-offset", &[("offset_deg", 0.1)]),
            ("backlash", &[("width_deg", 0.0005)]),
        ],
    );
    for format in ONE_SIDED {
        let made = export(&calibration, format, None);
        let controller = load(format, &text(&made));
        for [_, up, down] in controller.entries() {
            assert!(up == down && (up + 0.1).abs() < 1e-6, "{up} {down}");
        }
        let says = joined(&made.notes);
        assert!(says.contains("their mean leaves 0.0011 mm"), "{says}");
        assert!(made.left.expect("a table").met());
    }
}

#[test]
fn a_sliding_joint_is_written_in_millimetres() {
    // x = (1 + k) (q + offset) ∓ w/2, in closed form.
    let session = one_joint("prismatic", [0.0, 800.0]);
    for formats in [&TWO_SIDED[..], &ONE_SIDED[..]] {
        let width = if formats == ONE_SIDED { 0.0 } else { 0.02 };
        let calibration = known(
            &session,
            &[
                ("joint-scale", &[("scale_ppm", 150.0)]),
                ("joint-zero-offset", &[("offset_mm", 0.05)]),
                ("backlash", &[("width_mm", width)]),
            ],
        );
        for format in formats {
            let made = export(&calibration, format, None);
            let controller = load(format, &text(&made));
            for q in [0.0, 13.7, 400.0, 799.9] {
                for side in [1.0, -1.0] {
                    let sent = controller.sends(q, side);
                    let reached = sent * (1.0 + 150e-6) + 0.05 - side * width / 2.0;
                    assert!(
                        (reached - q).abs() < 1.1e-4,
                        "{format} {q} {side}: {reached}"
                    );
                }
            }
            let unit = sidecar(&made)["unit_of_the_numbers"].clone();
            assert!(unit == "mm" || unit == "0.1 µm", "{unit}");
        }
    }
}

#[test]
fn a_full_turn_goes_on_where_it_began_and_only_there() {
    let turning = one_joint("revolute", [-180.0, 180.0]);
    let eccentric: (&str, &[(&str, f64)]) = (
        "encoder-eccentricity",
        &[("amplitude_deg", 0.05), ("phase_deg", 33.0)],
    );
    let scaled: (&str, &[(&str, f64)]) = ("joint-scale", &[("scale_ppm", 100.0)]);
    for format in ["twincat-nc", "twincat-cnc", "sinumerik"] {
        let made = export(&known(&turning, &[eccentric]), format, None);
        assert_eq!(sidecar(&made)["repeats_after_a_turn"], true, "{format}");
        let controller = load(format, &text(&made));
        for q in [-170.0, -1.0, 77.7] {
            let (here, there) = (controller.sends(q, 1.0), controller.sends(q + 360.0, 1.0));
            assert!((there - here - 360.0).abs() < 1e-9, "{format} {q}");
            assert!((here - q).abs() > 1e-3, "{format} {q}");
        }
        // An error that grows with the angle does not close, and a part of a turn does not either.
        let open = export(&known(&turning, &[scaled]), format, None);
        assert_eq!(sidecar(&open)["repeats_after_a_turn"], false, "{format}");
        let part = one_joint("revolute", [-170.0, 180.0]);
        let part = export(&known(&part, &[eccentric]), format, None);
        assert_eq!(sidecar(&part)["repeats_after_a_turn"], false, "{format}");
    }
    let made = export(&known(&turning, &[eccentric]), "linuxcnc", None);
    let says = sidecar(&made)["full_turn"].to_string();
    assert!(says.contains("does not repeat"), "{says}");
}

#[test]
fn a_step_beyond_a_controllers_limit_is_refused_and_without_one_it_is_chosen() {
    let session = one_joint("revolute", [-180.0, 180.0]);
    let calibration = known(
        &session,
        &[(
            "encoder-eccentricity",
            &[("amplitude_deg", 0.3), ("phase_deg", 0.0)],
        )],
    );
    for (format, most, too_fine) in [
        ("linuxcnc", 256, 1.0),
        ("twincat-cnc", 1500, 0.2),
        ("sinumerik", 5000, 0.05),
    ] {
        let refused = try_export(&calibration, format, Some(too_fine)).expect_err("too many");
        let says = refused.to_string();
        assert!(says.contains(&format!("takes at most {most}")), "{says}");
        let made = export(&calibration, format, None);
        assert!(load(format, &text(&made)).entries().len() <= most);
        assert!(made.left.expect("a table").met(), "{format}");
    }
    let says = try_export(&calibration, "twincat-cnc", Some(f64::NAN));
    assert!(says.is_err(), "{says:?}");
}

#[test]
fn a_format_with_one_column_needs_hardly_more_entries_because_the_directions_differ() {
    let session = one_joint("revolute", [-180.0, 180.0]);
    let eccentricity: (&str, &[(&str, f64)]) = (
        "encoder-eccentricity",
        &[("amplitude_deg", 0.3), ("phase_deg", 0.0)],
    );
    // Half of it is 0.0004 mm at the reflector, of which the mean of both directions may leave 0.002.
    let backlash: (&str, &[(&str, f64)]) = ("backlash", &[("width_deg", 0.0002)]);
    for format in ONE_SIDED {
        let entries = |effects: &[(&str, &[(&str, f64)])]| {
            let made = export(&known(&session, effects), format, None);
            load(format, &text(&made)).entries().len()
        };
        let alike = entries(&[eccentricity]);
        let apart = entries(&[eccentricity, backlash]);
        assert!((20..1000).contains(&alike), "{format}: {alike}");
        assert!(apart * 10 <= alike * 12, "{format}: {alike} and {apart}");
    }
}

#[test]
fn where_the_limit_is_too_small_the_entries_go_where_they_help_and_that_is_said() {
    let session = one_joint("revolute", [-180.0, 180.0]);
    // 120 waves in 256 entries.
    let calibration = known(
        &session,
        &[(
            "gear-transmission-error",
            &[
                ("order", 120.0),
                ("amplitude_deg", 0.01),
                ("phase_deg", 0.0),
            ],
        )],
    );
    let made = export(&calibration, "linuxcnc", None);
    let entries = load("linuxcnc", &text(&made)).entries();
    assert!(entries.len() <= 256);
    assert_eq!(
        (entries[0][0], entries[entries.len() - 1][0]),
        (-180.0, 180.0)
    );
    let left = made.left.clone().expect("a table");
    assert!(!left.met(), "{left:?}");
    assert!(
        joined(&made.notes).contains("takes at most 256 entries"),
        "{:?}",
        made.notes
    );
    // The wave's own size is 250 mm × 0.01° / √2 = 0.031 mm: the table still takes most of it.
    assert!(left.added_rms_mm < 0.012, "{left:?}");
    // A format without that limit has enough.
    assert!(
        export(&calibration, "csv", None)
            .left
            .expect("a table")
            .met()
    );
}

#[test]
fn without_a_tolerance_the_models_own_gap_stands_in() {
    let mut calibration = known(
        &one_joint("revolute", [-90.0, 90.0]),
        &[(
            "encoder-eccentricity",
            &[("amplitude_deg", 0.3), ("phase_deg", 0.0)],
        )],
    );
    calibration.tolerance_mm = None;
    calibration.history = vec![truepose::model::ResidualStep {
        what: "model".to_owned(),
        gap_mm: 0.5,
        held_out_mm: None,
        runs_held_out_mm: None,
        values_held_out_mm: None,
    }];
    let left = export(&calibration, "linuxcnc", None)
        .left
        .expect("a table");
    assert!((left.allowance.mm - 0.005).abs() < 1e-15);
    assert!(left.allowance.is.contains("RMS error") && left.met());
    calibration.history.clear();
    let left = export(&calibration, "linuxcnc", None)
        .left
        .expect("a table");
    assert!((left.allowance.mm - 1e-4).abs() < 1e-15 && left.met());
}

#[test]
fn the_worked_line_is_the_one_of_the_manual() {
    let session = one_joint("revolute", [0.0, 90.0]);
    let calibration = known(
        &session,
        &[("joint-scale", &[("scale_ppm", 2500.0 / 90.0)])],
    );
    for (format, number) in [
        ("csv", "table says -0.0025"),
        ("linuxcnc", "table says -0.0025"),
        ("twincat-nc", "table says -0.0025"),
        ("twincat-cnc", "table says +25 (in 0.0001°)"),
        ("sinumerik", "table says +0.0025"),
    ] {
        let made = export(&calibration, format, Some(90.0));
        let says = sidecar(&made)["example"]["says"]
            .as_str()
            .expect("a line")
            .to_owned();
        assert!(
            says.starts_with("commanded 90°, robot reached 90.002500°"),
            "{says}"
        );
        assert!(says.contains(number), "{format}: {says}");
        let sign = sidecar(&made)["sign"]
            .as_str()
            .expect("a sentence")
            .to_owned();
        let deviation = sign.contains("actual − commanded");
        assert_eq!(deviation, number.contains('+'), "{format}: {sign}");
    }
}

#[test]
fn the_files_of_a_small_robot() {
    let session = one_joint("revolute", [-90.0, 90.0]);
    let smooth: [(&str, &[(&str, f64)]); 2] = [
        ("joint-zero-offset", &[("offset_deg", 0.0025)]),
        (
            "encoder-eccentricity",
            &[("amplitude_deg", 0.01), ("phase_deg", 40.0)],
        ),
    ];
    let play: (&str, &[(&str, f64)]) = ("backlash", &[("width_deg", 0.02)]);
    for format in TWO_SIDED.iter().chain(&ONE_SIDED).chain(&["c-header"]) {
        let mut effects = smooth.to_vec();
        if !ONE_SIDED.contains(format) {
            effects.push(play);
        }
        let made = export(&known(&session, &effects), format, Some(45.0));
        insta::assert_snapshot!(format!("{format}"), text(&made));
    }
    let geometry: [(&str, &[(&str, f64)]); 4] = [
        ("joint-zero-offset", &[("offset_deg", 0.0025)]),
        ("link-length", &[("delta_mm", -1.25)]),
        ("base-offset", &[("x_mm", 0.5), ("z_mm", -0.25)]),
        ("backlash", &[("width_deg", 0.02)]),
    ];
    let made = export(&known(&session, &geometry), "urdf", None);
    insta::assert_snapshot!("urdf", text(&made));
    insta::assert_snapshot!("urdf notes", joined(&made.notes));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Whatever is exported, its controller reads the numbers that the program read.
    #[test]
    fn a_controller_reads_what_was_written(
        sizes in prop::array::uniform4(-1.0..1.0f64),
        from in -400.0..0.0f64,
        span in 1.0..720.0f64,
        at in prop::collection::vec(-0.2..1.2f64, 8),
        format in prop::sample::select(vec!["csv", "linuxcnc", "twincat-cnc", "twincat-nc", "sinumerik"]),
        own_step in prop::bool::ANY,
    ) {
        let session = one_joint("revolute", [from, from + span]);
        let width = if ONE_SIDED.contains(&format) { 0.0 } else { 0.05 * sizes[3].abs() };
        let calibration = known(&session, &[
            ("joint-zero-offset", &[("offset_deg", sizes[0])]),
            ("joint-scale", &[("scale_ppm", 300.0 * sizes[1])]),
            ("encoder-two-cycle", &[("amplitude_deg", 0.1 * sizes[2].abs()), ("phase_deg", 70.0)]),
            ("backlash", &[("width_deg", width)]),
        ]);
        let made = export(&calibration, format, own_step.then_some(span / 50.0));
        let bytes = &made.documents[0].bytes;
        prop_assert!(bytes.ends_with(b"\n") && !bytes.contains(&b'\r'));
        prop_assert!(!bytes.starts_with(b"\xef\xbb\xbf"));
        let file = text(&made);
        let code: String = file.lines().filter(|l| !l.starts_with("//")).collect();
        let lower = code.to_lowercase();
        prop_assert!(code.is_ascii() && !lower.contains("nan") && !lower.contains("inf"));
        let controller = load(format, &file);
        let read = made.reads_as.as_ref().expect("a table");
        for share in at {
            let q = from + share * span;
            for side in [1.0, -1.0] {
                let added = controller.sends(q, side) - q;
                let own = read.correction_outer(q, side);
                prop_assert!((added - own).abs() < 1e-9, "{format} at {q}: {added} {own}");
            }
        }
        prop_assert_eq!(controller.entries().len(), read.forward.places().len());
    }
}
