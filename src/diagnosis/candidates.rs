//! Everything that the search tries: each testable effect on each joint with each setting, and
//! the anonymous shapes, with their columns at the base model.

use nalgebra::{DMatrix, DVector};

use crate::effects::{CATALOGUE, Effect, Setting, Survey, Term, rank};
use crate::identification::problem::Problem;
use crate::identification::scan;
use crate::kinematics::JointKind;
use crate::model::Model;

use super::anonymous::{Direction, Profile, Shape, Variable};
use super::evidence::Rows;

/// What a candidate is.
#[derive(Debug, Clone, PartialEq)]
pub enum What {
    /// An effect of the catalogue, absent so far.
    Named(Term),
    /// A shape without a name.
    Anonymous(Shape),
}

impl What {
    /// The term of a name.
    pub fn term(&self) -> Option<&Term> {
        match self {
            Self::Named(term) => Some(term),
            Self::Anonymous(_) => None,
        }
    }
}

/// One thing to try.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    /// What it is.
    pub what: What,
    /// Its first column in the table.
    pub first: usize,
    /// Number of its columns.
    pub size: usize,
    /// How many of its kind are tried.
    pub tried: f64,
}

impl Candidate {
    /// Whether it has a name.
    pub fn named(&self) -> bool {
        matches!(self.what, What::Named(_))
    }
}

/// An effect that this session cannot show, and why.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NotTestable {
    /// The effect's name.
    pub effect: &'static str,
    /// Joint, counted from 0; `None` where it belongs to none.
    pub joint: Option<usize>,
    /// Why.
    pub because: String,
}

/// Which names may be used.
#[derive(Debug, Clone, Default)]
pub struct Allowed {
    /// These do not exist for this run.
    pub without: Vec<String>,
    /// Only these are candidates, where given.
    pub only: Option<Vec<String>>,
}

impl Allowed {
    /// Whether a name exists at all.
    pub fn exists(&self, id: &str) -> bool {
        let without = |id: &str| self.without.iter().any(|w| w == id);
        // Lost motion becomes backlash as its fade goes to zero.
        !(without(id) || id == "lost-motion" && without("backlash"))
    }

    /// Whether a name is a candidate.
    pub fn candidate(&self, id: &str) -> bool {
        self.exists(id)
            && self
                .only
                .as_ref()
                .is_none_or(|only| only.iter().any(|o| o == id))
    }
}

/// The candidates and their raw columns, mm per unit of each coefficient.
#[derive(Debug, Clone)]
pub struct Table {
    /// What is tried.
    pub candidates: Vec<Candidate>,
    /// Columns at the base model.
    pub raw: DMatrix<f64>,
    /// Which columns make a rich fit, from which the noise is estimated.
    pub rich: Vec<usize>,
    /// What cannot be tested.
    pub not_testable: Vec<NotTestable>,
    /// The geometry that shapes need, to build more of them.
    pub ground: Ground,
}

/// What shapes are made from: the values of every variable and the directions, row by row.
#[derive(Debug, Clone)]
pub struct Ground {
    samples: usize,
    axes: Vec<usize>,
    variables: Vec<(Variable, Vec<f64>)>,
    tangential: Vec<DVector<f64>>,
    radial: Option<DVector<f64>>,
    axial: Option<DVector<f64>>,
    angle: Vec<f64>,
}

impl Ground {
    /// Values of a variable, one for each sample.
    pub fn values(&self, variable: Variable) -> Option<&[f64]> {
        let found = self.variables.iter().find(|v| v.0 == variable);
        found.map(|v| v.1.as_slice())
    }

    /// Range of a variable in the data.
    pub fn range(&self, variable: Variable) -> (f64, f64) {
        let values = self.values(variable).unwrap_or(&[]);
        let start = (f64::INFINITY, f64::NEG_INFINITY);
        values
            .iter()
            .fold(start, |(a, b), v| (a.min(*v), b.max(*v)))
    }

    /// The columns of a shape, mm.
    pub fn columns(&self, shape: &Shape) -> DMatrix<f64> {
        let directions: Vec<DVector<f64>> = match shape.direction {
            Direction::Tangential(j) => vec![self.tangential[j].clone()],
            Direction::Radial => self.radial.iter().cloned().collect(),
            Direction::Axial => self.axial.iter().cloned().collect(),
            Direction::Frame => (0..self.axes.len()).map(|a| self.frame_axis(a)).collect(),
            Direction::Body => {
                let across = [self.radial.as_ref(), self.axial.as_ref()];
                let mut all: Vec<DVector<f64>> =
                    self.tangential.first().into_iter().cloned().collect();
                all.extend(across.into_iter().flatten().cloned());
                all
            }
        };
        let origin = shape.variable.origin(self.range(shape.variable));
        let constant = vec![0.0; self.samples];
        let values = self.values(shape.variable).unwrap_or(&constant);
        let count = shape.profile.count();
        let rows = self.samples * self.axes.len();
        let mut columns = DMatrix::zeros(rows, count * directions.len());
        for sample in 0..self.samples {
            let of_sample = shape
                .profile
                .values(values[sample], origin, self.angle[sample]);
            for (k, value) in of_sample.into_iter().enumerate() {
                for (d, direction) in directions.iter().enumerate() {
                    for axis in 0..self.axes.len() {
                        let row = axis * self.samples + sample;
                        columns[(row, k * directions.len() + d)] = value * direction[row];
                    }
                }
            }
        }
        columns
    }

    fn frame_axis(&self, axis: usize) -> DVector<f64> {
        let rows = self.samples * self.axes.len();
        let own = axis * self.samples..(axis + 1) * self.samples;
        DVector::from_fn(rows, |row, _| f64::from(u8::from(own.contains(&row))))
    }
}

impl Table {
    /// All candidates beside a base model. `base` names what the base already holds.
    pub fn new(
        problem: &Problem,
        rows: &Rows,
        base: &Model,
        survey: &Survey,
        allowed: &Allowed,
    ) -> Self {
        let (names, not_testable) = names(problem, survey, base, allowed);
        let probes = (0..survey.joints.len()).map(|joint| (probe(joint), None));
        let mut tagged: Vec<(Term, Option<usize>)> = base
            .terms()
            .iter()
            .map(|t| (t.clone(), None))
            .chain(
                names
                    .iter()
                    .enumerate()
                    .map(|(i, c)| (c.0.clone(), Some(i))),
            )
            .chain(probes)
            .collect();
        // The same order in which a model keeps its terms.
        let key = |t: &Term| (rank(t.effect), t.joint);
        tagged.sort_by(|a, b| {
            key(&a.0)
                .cmp(&key(&b.0))
                .then(a.0.setting.total_cmp(&b.0.setting))
        });
        let terms = tagged.iter().map(|t| t.0.clone()).collect();
        let all = Model::new(base.robot.clone(), terms);
        let (_, columns) = rows.extract(&all);
        let mut table = Self {
            candidates: Vec::new(),
            raw: DMatrix::zeros(rows.len(), 0),
            rich: Vec::new(),
            not_testable,
            ground: ground(rows, base, survey),
        };
        let mut pieces: Vec<DMatrix<f64>> = Vec::new();
        let mut width = 0;
        let mut push = |table: &mut Self, what: What, tried: f64, own: DMatrix<f64>| {
            let candidate = Candidate {
                what,
                first: width,
                size: own.ncols(),
                tried,
            };
            width += own.ncols();
            pieces.push(own);
            table.candidates.push(candidate);
        };
        let mut first = 0;
        let mut tangential: Vec<DVector<f64>> = Vec::new();
        for (term, tag) in &tagged {
            let size = term.coefficients.len();
            let seen = term.effect.about().form.coefficients_at_zero();
            let own = columns.columns(first, seen).into_owned();
            first += size;
            if let Some(i) = tag {
                push(
                    &mut table,
                    What::Named(names[*i].0.clone()),
                    names[*i].1,
                    own,
                );
            } else if is_probe(term) && tangential.len() == term.joint {
                tangential.push(own.column(0).into_owned());
            }
        }
        table.ground.tangential = tangential;
        let lacks = |id: &str| !names.iter().any(|c| c.0.effect.about().id == id);
        let missing = Missing {
            gear: lacks("gear-transmission-error"),
            shift: lacks("frame-shift"),
        };
        for shape in shapes(&table.ground, survey, rows, missing) {
            let own = table.ground.columns(&shape);
            push(&mut table, What::Anonymous(shape), shape.tried, own);
        }
        table.raw = DMatrix::zeros(rows.len(), width);
        let mut at = 0;
        for piece in &pieces {
            table.raw.columns_mut(at, piece.ncols()).copy_from(piece);
            at += piece.ncols();
        }
        table.rich = rich(&table, rows.len());
        table
    }
}

fn probe(joint: usize) -> Term {
    Term::absent(zero_offset(), joint, 0.0)
}

fn zero_offset() -> &'static dyn Effect {
    CATALOGUE[1]
}

fn is_probe(term: &Term) -> bool {
    term.effect.about().id == zero_offset().about().id
}

/// Every testable name with every setting and how many of its kind there are.
fn names(
    problem: &Problem,
    survey: &Survey,
    base: &Model,
    allowed: &Allowed,
) -> (Vec<(Term, f64)>, Vec<NotTestable>) {
    let mut names = Vec::new();
    let mut not_testable = Vec::new();
    for effect in CATALOGUE {
        let about = effect.about();
        let in_base = |joint: usize| {
            let mut terms = base.terms().iter();
            terms.any(|t| t.effect.about().id == about.id && t.joint == joint)
        };
        let joints = if about.per_joint {
            survey.joints.len()
        } else {
            1
        };
        for joint in 0..joints {
            if !allowed.exists(about.id) || in_base(joint) {
                continue;
            }
            if let Some(because) = effect.obstacle(survey, joint) {
                not_testable.push(NotTestable {
                    effect: about.id,
                    joint: about.per_joint.then_some(joint),
                    because,
                });
                continue;
            }
            if !allowed.candidate(about.id) {
                continue;
            }
            let term = Term::absent(*effect, joint, 0.0);
            let settings = scan::settings(problem, &term);
            // Neighbouring times of a step are nearly the same candidate.
            let tried = match about.setting {
                Setting::Time => (settings.len() as f64).min(40.0),
                _ => settings.len() as f64,
            };
            names.extend(settings.into_iter().map(|setting| {
                (
                    Term {
                        setting,
                        ..term.clone()
                    },
                    tried.max(1.0),
                )
            }));
        }
    }
    (names, not_testable)
}

fn ground(rows: &Rows, base: &Model, survey: &Survey) -> Ground {
    let inputs = &rows.inputs;
    let pick = |column: &[f64]| column.to_vec();
    let mut variables = Vec::new();
    for joint in 0..survey.joints.len() {
        variables.push((Variable::Joint(joint), pick(&inputs.q[joint])));
        if let Some(dir) = inputs.dir[joint].as_deref() {
            variables.push((Variable::Side(joint), pick(dir)));
        }
        if let Some(speed) = inputs.speed[joint].as_deref() {
            variables.push((Variable::Speed(joint), pick(speed)));
        }
    }
    let common = [
        (Variable::Time, inputs.time_s.as_deref()),
        (Variable::Load, inputs.load_kg.as_deref()),
        (Variable::Warmth, inputs.warmth_c.as_deref()),
    ];
    for (variable, column) in common {
        if let Some(column) = column {
            variables.push((variable, pick(column)));
        }
    }
    if let Some(target) = &inputs.target {
        let mut used: Vec<u32> = target.to_vec();
        let of_sample = used.clone();
        used.sort_unstable();
        used.dedup();
        for one in used.into_iter().skip(1) {
            let is = |t: &u32| f64::from(u8::from(*t == one));
            variables.push((Variable::Target(one), of_sample.iter().map(is).collect()));
        }
    }
    let (radial, axial) = across_the_axis(rows, base, survey);
    Ground {
        samples: rows.samples.len(),
        axes: rows.axes.clone(),
        angle: pick(&inputs.q[0]),
        variables,
        tangential: Vec::new(),
        radial,
        axial,
    }
}

/// Radial and axial unit directions of every row, for a robot with a single revolute joint.
fn across_the_axis(
    rows: &Rows,
    base: &Model,
    survey: &Survey,
) -> (Option<DVector<f64>>, Option<DVector<f64>>) {
    let [joint] = survey.joints.as_slice() else {
        return (None, None);
    };
    if joint.kind != JointKind::Revolute {
        return (None, None);
    }
    let points = rows.points(base);
    let (origin, along) = (joint.frame.origin_mm, joint.frame.along);
    let outward = |p: &[f64; 3]| {
        let arm: [f64; 3] = std::array::from_fn(|k| p[k] - origin[k]);
        let height: f64 = (0..3).map(|k| arm[k] * along[k]).sum();
        let across: [f64; 3] = std::array::from_fn(|k| arm[k] - height * along[k]);
        let radius = across.iter().map(|v| v * v).sum::<f64>().sqrt();
        across.map(|v| v / radius.max(1e-9))
    };
    let outward: Vec<[f64; 3]> = points.iter().map(outward).collect();
    let radial = rows.column(|sample, axis| outward[sample][axis]);
    let axial = rows.column(|_, axis| along[axis]);
    let seen = |v: DVector<f64>| (v.norm() > 1e-9).then_some(v);
    (seen(radial), seen(axial))
}

const HIGHEST_ORDER: u32 = 360;
/// A shape must act on at least so many samples.
const FEWEST: usize = 4;

/// Names that are not candidates and whose shapes nothing else would look for.
#[derive(Debug, Clone, Copy)]
struct Missing {
    gear: bool,
    shift: bool,
}

fn shapes(ground: &Ground, survey: &Survey, rows: &Rows, missing: Missing) -> Vec<Shape> {
    let mut all = Vec::new();
    if rows.samples.len() < 2 * FEWEST {
        return all;
    }
    for joint in 0..survey.joints.len() {
        if survey.joints[joint].values >= 6 {
            over_angle(ground, joint, missing.gear, &mut all);
        }
    }
    if ground.values(Variable::Time).is_some() {
        over_time(ground, missing.shift, &mut all);
    }
    over_conditions(ground, survey, &mut all);
    all
}

fn over_angle(ground: &Ground, joint: usize, waves: bool, all: &mut Vec<Shape>) {
    let variable = Variable::Joint(joint);
    let (low, high) = ground.range(variable);
    let span = high - low;
    let tangential = Direction::Tangential(joint);
    for width in [0.022, 0.045, 0.09] {
        bumps(ground, variable, tangential, width * span, 1.0, all);
    }
    plateaus(ground, variable, tangential, 20, true, all);
    let values = ground.values(variable).map_or(0, <[f64]>::len) as f64;
    let turn = std::f64::consts::TAU;
    // Half a cycle over the range is as fine as the data can tell cycles apart.
    let step = 0.5 * turn / span;
    let highest = (values / 8.0 * turn / span).min(40.0);
    let fundamentals: Vec<f64> = (2..)
        .map(|k| step * f64::from(k))
        .take_while(|c| *c < highest)
        .take(90)
        .collect();
    for cycles in &fundamentals {
        for harmonics in [1, 3] {
            all.push(Shape {
                variable,
                direction: tangential,
                profile: Profile::Periodic {
                    cycles: *cycles,
                    harmonics,
                },
                tried: fundamentals.len() as f64,
            });
        }
    }
    if waves {
        let from = highest.ceil().max(1.0) as u32;
        all.extend((from..=HIGHEST_ORDER).map(|order| Shape {
            variable,
            direction: tangential,
            profile: Profile::Periodic {
                cycles: f64::from(order),
                harmonics: 1,
            },
            tried: f64::from(HIGHEST_ORDER),
        }));
    }
    let mut smooth = vec![(tangential, Profile::Ramp), (tangential, Profile::Square)];
    let directions = [
        Direction::Tangential(joint),
        Direction::Radial,
        Direction::Axial,
    ];
    for direction in directions {
        let missing = match direction {
            Direction::Radial => ground.radial.is_none(),
            Direction::Axial => ground.axial.is_none(),
            _ => false,
        };
        if missing {
            continue;
        }
        let periodic = |cycles: f64| Profile::Periodic {
            cycles,
            harmonics: 1,
        };
        smooth.extend((1..=6).map(|k| (direction, periodic(f64::from(k)))));
        if direction != tangential {
            smooth.push((direction, Profile::Ramp));
            bumps(ground, variable, direction, 0.06 * span, 1.0, all);
            plateaus(ground, variable, direction, 8, false, all);
        }
    }
    let tried = smooth.len() as f64;
    all.extend(smooth.into_iter().map(|(direction, profile)| Shape {
        variable,
        direction,
        profile,
        tried,
    }));
}

fn over_time(ground: &Ground, shifts: bool, all: &mut Vec<Shape>) {
    let (low, high) = ground.range(Variable::Time);
    let span = high - low;
    if span <= 0.0 {
        return;
    }
    for width in [0.04, 0.1] {
        bumps(
            ground,
            Variable::Time,
            Direction::Frame,
            width * span,
            1.0,
            all,
        );
    }
    if shifts {
        plateaus(ground, Variable::Time, Direction::Frame, 24, false, all);
    }
    for joint in 0..ground.tangential.len() {
        let direction = Direction::Tangential(joint);
        bumps(ground, Variable::Time, direction, 0.06 * span, 1.0, all);
        plateaus(ground, Variable::Time, direction, 16, false, all);
    }
}

fn over_conditions(ground: &Ground, survey: &Survey, all: &mut Vec<Shape>) {
    let mut own = Vec::new();
    let mut push = |variable, direction, profile| {
        own.push(Shape {
            variable,
            direction,
            profile,
            tried: 1.0,
        });
    };
    push(Variable::Joint(0), Direction::Frame, Profile::Constant);
    if ground.axial.is_some() {
        push(Variable::Joint(0), Direction::Body, Profile::Constant);
    }
    for (variable, values) in &ground.variables {
        let (low, high) = ground.range(*variable);
        if low >= high || matches!(variable, Variable::Joint(_)) {
            continue;
        }
        if matches!(variable, Variable::Target(_)) {
            push(*variable, Direction::Body, Profile::Ramp);
            continue;
        }
        let joints: Vec<usize> = match variable {
            Variable::Side(j) | Variable::Speed(j) => vec![*j],
            _ => (0..survey.joints.len()).collect(),
        };
        let mut distinct: Vec<f64> = values.clone();
        distinct.sort_by(f64::total_cmp);
        distinct.dedup();
        for joint in joints {
            push(*variable, Direction::Tangential(joint), Profile::Ramp);
            push(*variable, Direction::Tangential(joint), Profile::TimesTurn);
            if distinct.len() > 2 {
                push(*variable, Direction::Tangential(joint), Profile::Square);
                push(*variable, Direction::Tangential(joint), Profile::Absolute);
            }
        }
        if ground.radial.is_some() {
            push(*variable, Direction::Radial, Profile::Ramp);
        }
        if ground.axial.is_some() {
            push(*variable, Direction::Axial, Profile::Ramp);
        }
        push(*variable, Direction::Frame, Profile::Ramp);
    }
    let tried = own.len() as f64;
    all.extend(own.into_iter().map(|shape| Shape { tried, ..shape }));
}

fn bumps(
    ground: &Ground,
    variable: Variable,
    direction: Direction,
    width: f64,
    spacing: f64,
    all: &mut Vec<Shape>,
) {
    let Some(values) = ground.values(variable) else {
        return;
    };
    let (low, high) = ground.range(variable);
    let count = ((high - low) / (spacing * width)).round().max(1.0) as usize;
    let centre = |k: usize| low + (high - low) * (k as f64 + 0.5) / count as f64;
    let enough = |centre: f64| {
        let near = values
            .iter()
            .filter(|v| (**v - centre).abs() <= 1.5 * width);
        near.count() >= FEWEST
    };
    all.extend(
        (0..count)
            .map(centre)
            .filter(|c| enough(*c))
            .map(|centre| Shape {
                variable,
                direction,
                profile: Profile::Bump { centre, width },
                tried: 2.0 * count as f64,
            }),
    );
}

/// Steps at up to `count` edges between values, and plateaus between pairs of them.
fn plateaus(
    ground: &Ground,
    variable: Variable,
    direction: Direction,
    count: usize,
    pairs: bool,
    all: &mut Vec<Shape>,
) {
    let Some(values) = ground.values(variable) else {
        return;
    };
    let edges = edges(values, count);
    let mut profiles: Vec<Profile> = edges
        .iter()
        .map(|from| Profile::Plateau {
            from: *from,
            to: f64::INFINITY,
        })
        .collect();
    if pairs {
        for (i, from) in edges.iter().enumerate() {
            profiles.extend(edges[i + 1..].iter().map(|to| Profile::Plateau {
                from: *from,
                to: *to,
            }));
        }
    }
    let tried = profiles.len() as f64;
    all.extend(profiles.into_iter().map(|profile| Shape {
        variable,
        direction,
        profile,
        tried,
    }));
}

/// Up to `count` values midway between neighbours, with at least [`FEWEST`] samples between them.
pub(super) fn edges(values: &[f64], count: usize) -> Vec<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let n = sorted.len();
    let stride = (n / (count + 1)).max(FEWEST);
    let mut edges: Vec<f64> = (stride..=n.saturating_sub(FEWEST))
        .step_by(stride)
        .filter_map(|i| {
            // The next place where the value changes.
            let next = sorted[i..].iter().find(|v| **v > sorted[i - 1])?;
            Some(0.5 * (sorted[i - 1] + next))
        })
        .collect();
    edges.dedup();
    edges
}

const MOST_RICH: usize = 120;

/// Columns for a rich fit, the likeliest sources of structure first, at most a quarter of the rows.
fn rich(table: &Table, rows: usize) -> Vec<usize> {
    let low_order = |t: &Term| match t.effect.about().setting {
        Setting::None => true,
        Setting::Order { .. } => t.setting <= 8.0,
        _ => false,
    };
    let mut tiers: [Vec<usize>; 3] = Default::default();
    let mut times = 0;
    for candidate in &table.candidates {
        let own = candidate.first..candidate.first + candidate.size;
        match &candidate.what {
            What::Named(term) if low_order(term) => tiers[0].extend(own),
            What::Named(term) if term.effect.about().setting == Setting::Time => {
                times += 1;
                if times % 8 == 1 {
                    tiers[2].extend(own);
                }
            }
            What::Anonymous(shape) => match (shape.profile, shape.direction) {
                (Profile::Bump { width, .. }, Direction::Tangential(j)) => {
                    let (low, high) = table.ground.range(Variable::Joint(j));
                    let fine = (0.03..0.06).contains(&(width / (high - low)));
                    if shape.variable == Variable::Joint(j) && fine {
                        tiers[1].extend(own);
                    }
                }
                (
                    Profile::Periodic {
                        harmonics: 1,
                        cycles,
                    },
                    Direction::Radial | Direction::Axial,
                ) if cycles < 7.0 => {
                    tiers[2].extend(own);
                }
                _ => {}
            },
            What::Named(_) => {}
        }
    }
    let mut chosen: Vec<usize> = tiers.into_iter().flatten().collect();
    chosen.truncate((rows / 4).min(MOST_RICH));
    chosen
}
