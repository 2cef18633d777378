//! A plan: the poses, what they decide, make testable and sharpen.

use super::{Block, Detail, Fact, Section, Topic, cleaned, fact};
use crate::design::{Forecast, Geometry, Plan, Separation, Subject, Untestable};
use crate::language::spoken;
use crate::present::limits::{applies, joints_in_words, limits_of};
use crate::present::names::{title, title_of, title_on};
use crate::present::poses::{new_reflectors, table_by_joint};
use crate::present::table::{Column, Table};
use crate::standards::grouping::gathered;

/// The whole answer, in the order in which it is read.
#[doc(hidden)]
pub fn plan(plan: &Plan, detail: Detail) -> Vec<Section> {
    let _speaking = detail.speaking();
    let mut sections = vec![poses(plan, detail)];
    let mut add = |title: &str, facts: Vec<Fact>| {
        if !facts.is_empty() {
            sections.push(Section::new(title, vec![Block::Facts(facts)]));
        }
    };
    add(
        say!("Becomes testable"),
        grouped(&plan.enables, plan, |one| {
            needs(one, say!("by the poses alone"))
        }),
    );
    add(
        say!("Stays untestable"),
        grouped(&plan.cannot, plan, |one| {
            let help = needs(one, say!("no pose helps"));
            format!("{}: {help}", cleaned(&one.because))
        }),
    );
    sections.extend(
        plan.geometry
            .as_ref()
            .map(|one| geometry(one, plan, detail)),
    );
    sections.extend(limits(plan, detail));
    sections
}

fn poses(plan: &Plan, detail: Detail) -> Section {
    let title = match plan.subject {
        Subject::Session => say!(
            one "{session}: to measure next, {count} pose",
            "{session}: to measure next, {count} poses",
            session = plan.name,
            count = plan.poses.len()
        ),
        Subject::Robot => say!(
            one "{robot}: a first measurement, {count} pose",
            "{robot}: a first measurement, {count} poses",
            robot = plan.name,
            count = plan.poses.len()
        ),
    };
    let mut blocks = Vec::new();
    if !plan.open.is_empty() {
        blocks.push(Block::Facts(open(plan)));
    }
    if let Some(separation) = &plan.separation {
        blocks.extend(separated(separation).into_iter().map(Block::Text));
    }
    if plan.poses.is_empty() && plan.separation.is_none() {
        let nothing = say!(
            "Nothing is ambiguous and no pose makes more testable; poses of a number that is asked for sharpen what can be seen"
        );
        blocks.push(Block::Text(nothing.to_owned()));
    }
    if !plan.poses.is_empty() {
        blocks.push(Block::Table(table_by_joint(&plan.poses, &plan.robot)));
    }
    let new = new_reflectors(&plan.poses);
    if !new.is_empty() {
        blocks.push(Block::List(detail.first(new)));
    }
    Section::of(Topic::Answer, title, blocks)
}

/// What the samples cannot tell apart.
fn open(plan: &Plan) -> Vec<Fact> {
    let says = |names: &[String]| {
        let titles = names.iter().map(|name| title_of(name));
        titles.collect::<Vec<_>>().join(" + ")
    };
    let one = |[explanation, instead]: &[Vec<String>; 2]| {
        let or = say!(
            "{first} or {second}",
            first = says(explanation),
            second = says(instead)
        );
        fact(say!("Not decided"), or)
    };
    plan.open.iter().map(one).collect()
}

/// What the poses do for two effects that are to be told apart.
fn separated(separation: &Separation) -> Vec<String> {
    let [a, b] = separation.between.map(|(effect, _)| title_of(effect));
    if let Some(because) = &separation.impossible {
        return vec![say!(
            "No pose distinguishes {a} from {b}: {because}",
            a,
            b,
            because = spoken(because)
        )];
    }
    let percent = |share: f64| format!("{:.1}", 100.0 * share);
    let (before, after) = (&separation.left_before, &separation.left_after);
    let mut says = vec![say!(
        "Share of {a} that {b} cannot explain: {before} % now, {after} % with these poses; of {b} that {a} cannot explain: {back_before} % and {back_after} %",
        b,
        a,
        before = percent(before[0]),
        after = percent(after[0]),
        back_before = percent(before[1]),
        back_after = percent(after[1])
    )];
    if separation.poses.is_empty() {
        says.push(say!("The samples decide already").to_owned());
    } else if !separation.decided {
        let more = say!("An effect that is just seen may stay undecided, more poses would help");
        says.push(more.to_owned());
    }
    says
}

/// Joints that lack the same for the same effect together, with what is said of them.
fn grouped(all: &[Untestable], plan: &Plan, says: fn(&Untestable) -> String) -> Vec<Fact> {
    let joints = plan.robot.joints.len();
    let all = all
        .iter()
        .filter(|one| applies(&plan.robot, one.effect, one.joint));
    let groups = gathered(all.map(|one| ((one.effect, &one.because), one))).into_iter();
    let said = groups.map(|((effect, _), group)| {
        let on: Vec<usize> = group.iter().filter_map(|one| one.joint).collect();
        let name = match on[..] {
            [] => title_on(effect, None, joints),
            [one] => title_on(effect, Some(one + 1), joints),
            _ => format!(
                "{}, {}",
                title_on(effect, None, joints),
                joints_in_words(&on)
            ),
        };
        (name, says(group[0]))
    });
    said.collect()
}

/// What would help, else what is said where nothing would.
fn needs(one: &Untestable, nothing: &str) -> String {
    if one.needs.is_empty() {
        return nothing.to_owned();
    }
    let says = one.needs.iter().map(|need| spoken(need.describe()));
    says.collect::<Vec<_>>().join("; ")
}

fn geometry(geometry: &Geometry, plan: &Plan, detail: Detail) -> Section {
    let so_far = match plan.subject {
        Subject::Session => say!("session alone").to_owned(),
        Subject::Robot => say!("{poses} random poses", poses = plan.poses.len()),
    };
    let mut table = Table::of([
        Column::words(""),
        Column::numbers(so_far),
        Column::numbers(say!("with these poses")),
    ]);
    let mut row = |name: &str, of: fn(&Forecast) -> f64| {
        let [before, after] = [&geometry.before, &geometry.after].map(|f| detail.length(of(f)));
        table.row([name.to_owned(), before, after]);
    };
    row(say!("Observability index"), |f| f.observability);
    let rms = say!("Expected error over the joint ranges, RMS");
    row(rms, |f| f.error.rms_mm);
    let p95 = say!("Expected error at 95 % of the places");
    row(p95, |f| f.error.p95_mm);
    let mut blocks = vec![Block::Table(table)];
    if let Some((mm, poses)) = geometry.enough {
        blocks.push(Block::Text(say!(
            "{poses} poses are enough for {mm} at 95 % of the places",
            poses,
            mm = detail.length(mm)
        )));
    }
    let each = geometry.curve.iter().map(|(poses, error)| {
        say!(
            "{count} poses {error}",
            count = poses,
            error = detail.length(error.p95_mm)
        )
    });
    let each = each.collect::<Vec<_>>().join(", ");
    blocks.push(Block::Text(format!("{p95}: {each}")));
    let surroundings = say!(
        "Only the joint limits are known of the surroundings: check where the way between the poses leads"
    );
    blocks.push(Block::Warning(surroundings.to_owned()));
    let title = say!(
        "Geometry, {parameters} parameters",
        parameters = geometry.parameters
    );
    Section::new(title, blocks)
}

/// From which sizes on effects will be seen, and which will look alike.
fn limits(plan: &Plan, detail: Detail) -> Option<Section> {
    let seen = &plan.expected.limits;
    if plan.poses.is_empty() || seen.is_empty() {
        return None;
    }
    let joints = plan.robot.joints.len();
    let lines = limits_of(&plan.robot, seen, |effect| title(effect).to_owned());
    let facts = lines.into_iter().map(|line| (line.names, line.text));
    let mut blocks = vec![Block::Facts(facts.collect())];
    let alike = plan.expected.alike.iter().map(|pair| {
        let name = |(effect, joint): (&str, Option<usize>)| {
            title_on(effect, joint.map(|joint| joint + 1), joints)
        };
        say!(
            "{one} and {other} will look alike (correlation {correlation})",
            one = name(pair.one),
            other = name(pair.other),
            correlation = format!("{:.3}", pair.correlation)
        )
    });
    let alike: Vec<String> = alike.collect();
    if !alike.is_empty() {
        blocks.push(Block::List(alike));
    }
    let title = say!(
        "Will be seen with these poses (95 %), noise {sigma}",
        sigma = detail.length(plan.sigma_mm)
    );
    Some(Section::of(Topic::Limits, title, blocks))
}
