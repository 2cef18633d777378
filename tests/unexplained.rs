//! What no name explains, corrected without a name. The independent rig (`support/rig.rs`) hides a
//! bump, a sawtooth or a plateau that no catalogue has.

#[path = "support/rig.rs"]
mod rig;

use rig::{Design, Hidden, Random, Rig};
use truepose::diagnosis::{Diagnosis, Options, diagnose};
use truepose::sessions::{Session, parse};

fn session(rig: &Rig) -> Session {
    parse(rig.json("hidden").as_bytes())
        .expect("the rig writes a good session")
        .session
}

fn corrected(session: &Session) -> Diagnosis {
    let options = Options {
        correct_unexplained: true,
        ..Options::default()
    };
    diagnose(session, &options, &|_| true).expect("a diagnosis")
}

fn measured(design: &Design, ids: &[&str], lambda: f64, seed: u64) -> Rig {
    let mut random = Random(seed);
    let mut rig = Rig::new(design, &mut random);
    for id in ids {
        let hidden = Hidden::random(id, &mut random, design);
        let hidden = rig.sized(&hidden, lambda);
        rig.hidden.push(hidden);
    }
    rig.measure(&mut random);
    rig
}

#[test]
fn try_it() {
    let design = Design {
        samples: 240,
        ..Design::default()
    };
    for id in ["bump", "plateau", "sawtooth"] {
        for lambda in [400.0, 4000.0] {
            for seed in 11..15 {
                let rig = measured(&design, &[id, "backlash"], lambda, seed);
                let d = corrected(&session(&rig));
                eprintln!(
                    "{id} {lambda} {seed}: {:?} present {} floor {:.4}",
                    rig.hidden[0], d.unexplained.present, d.floor.mm
                );
                match &d.unexplained.correction {
                    Some(Ok(c)) => eprintln!(
                        "   gap {:?} held out {:?} {}",
                        c.gap_mm, c.held_out_mm, c.says
                    ),
                    other => eprintln!("   {other:?}"),
                }
            }
        }
    }
}
