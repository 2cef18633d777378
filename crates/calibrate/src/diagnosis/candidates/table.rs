//! The table of candidates: each testable effect on each joint with each setting, and the anonymous shapes, with their
//! columns at the base model.

use nalgebra::{DMatrix, DVector};

pub(crate) use crate::answers::diagnosis::NotTestable;
use crate::effects::{
    CATALOGUE, FixedMask, Owner, Setting, Survey, Term, find, form_in, rank, stated, stated_orders,
};
use crate::fit::problem::Problem;
use crate::fit::scan;
use crate::kinematics::JointKind;
use crate::lanes::LANES;
use crate::model::Model;

use super::columns::{ColumnBuilder, Columns};
use super::open_frame;
use super::shape_space::{ShapeSpace, shape_space, tangential};
use super::shapes::{Missing, shapes};
use crate::fit::regression::Rows;
use crate::model::shapes::{Direction, Profile, Shape, Variable};

/// The kinds of candidates.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum CandidateKind {
    /// An effect of the catalogue, absent so far.
    Named(Term),
    /// A shape without a name.
    Anonymous(Shape),
}

impl CandidateKind {
    /// The term of a name.
    pub(crate) fn term(&self) -> Option<&Term> {
        match self {
            Self::Named(term) => Some(term),
            Self::Anonymous(_) => None,
        }
    }
}

/// One thing to try.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Candidate {
    /// What kind of candidate it is.
    pub what: CandidateKind,
    /// Its first column in the table.
    pub first: usize,
    /// Number of its columns.
    pub size: usize,
    /// How many of its kind are tried.
    pub tried: f64,
}

impl Candidate {
    /// Whether it has a name.
    pub(crate) fn named(&self) -> bool {
        matches!(self.what, CandidateKind::Named(_))
    }
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
        // An effect that this one becomes in the limit is left out with it.
        let becomes = find(id).and_then(|effect| effect.about().becomes);
        !(without(id) || becomes.is_some_and(without))
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
pub(crate) struct CandidateTable {
    /// The candidates.
    pub candidates: Vec<Candidate>,
    /// Columns at the base model.
    pub columns: Columns,
    /// Which columns make a rich fit, from which the noise is estimated.
    pub rich: Vec<usize>,
    /// The effects that cannot be tested.
    pub not_testable: Vec<NotTestable>,
    /// The geometry that shapes need, to build more of them.
    pub space: ShapeSpace,
}

impl CandidateTable {
    /// All candidates given a base model. `base` names the effects that the base already holds.
    pub(crate) fn new(
        problem: &Problem,
        rows: &Rows,
        base: &Model,
        survey: &Survey,
        allowed: &Allowed,
    ) -> Self {
        let (mut names, not_testable) = names(problem, survey, base, allowed);
        // The same order in which a model keeps its terms.
        let key = |t: &Term| (rank(t.effect), t.joint);
        names.sort_by(|a, b| {
            key(&a.0)
                .cmp(&key(&b.0))
                .then(a.0.setting.total_cmp(&b.0.setting))
        });
        let mut space = shape_space(rows, base, survey, false);
        space.tangential = tangential(rows, base, survey.joints.len());
        let lacks =
            |is: fn(&Setting) -> bool| !names.iter().any(|c| is(&c.0.effect.about().setting));
        let missing = Missing {
            gear: lacks(Setting::takes_fractions),
            shift: lacks(|setting| *setting == Setting::Time),
        };
        let shapes = shapes(&space, survey, rows, missing);
        let of_names = names.iter().map(|(term, tried)| {
            let size = term.effect.about().form.coefficients_at_zero();
            (CandidateKind::Named(term.clone()), size, *tried)
        });
        let of_shapes = shapes.into_iter().map(|shape| {
            let size = space.width(&shape);
            (CandidateKind::Anonymous(shape), size, shape.tried)
        });
        let mut candidates: Vec<Candidate> = of_names
            .chain(of_shapes)
            .map(|(what, size, tried)| Candidate {
                what,
                first: 0,
                size,
                tried,
            })
            .collect();
        let directions: Vec<DVector<f64>> = {
            let across = space.across.iter().map(|(_, direction)| direction);
            space.tangential.iter().chain(across).cloned().collect()
        };
        let mut gathering = ColumnBuilder::new(rows.len(), rows.samples.len(), &directions);
        let mut slots = Vec::new();
        let (named, anonymous) = candidates.split_at(names.len());
        for some in named.chunks(LANES) {
            let columns = columns_of(rows, base, some);
            slots.extend(columns.iter().map(|own| gathering.push(own)));
        }
        gathering.names_end();
        for candidate in anonymous {
            if let CandidateKind::Anonymous(shape) = &candidate.what {
                slots.push(gathering.push(&space.columns(shape)));
            }
        }
        let (columns, first) = gathering.done();
        for (candidate, slot) in candidates.iter_mut().zip(slots) {
            candidate.first = first(slot);
        }
        // Candidates with overflowed columns explain nothing, and their scores could not be ranked.
        candidates.retain(|c| c.size > 0 && columns.are_finite(c.first, c.size));
        let mut table = Self {
            candidates,
            columns,
            rich: Vec::new(),
            not_testable,
            space,
        };
        table.rich = rich(&table, rows.count());
        table
    }
}

impl CandidateTable {
    /// The columns of the rich fit on other rows.
    pub(crate) fn rich_on(&self, rows: &Rows, base: &Model) -> DMatrix<f64> {
        let space = self.space.on(rows, base);
        let mut all = DMatrix::zeros(rows.len(), 0);
        let mut push = |own: &DMatrix<f64>, keep: &[usize]| {
            for k in keep {
                let at = all.ncols();
                let wider = std::mem::replace(&mut all, DMatrix::zeros(0, 0));
                all = wider.resize_horizontally(at + 1, 0.0);
                all.set_column(at, &own.column(*k));
            }
        };
        for candidate in &self.candidates {
            let own = candidate.first..candidate.first + candidate.size;
            let keep: Vec<usize> = own
                .clone()
                .filter(|k| self.rich.contains(k))
                .map(|k| k - own.start)
                .collect();
            if keep.is_empty() {
                continue;
            }
            match &candidate.what {
                CandidateKind::Named(term) => {
                    let first: usize = {
                        let with = base.with_term(term.clone());
                        let before = with.terms().iter().take_while(|t| !t.same_column(term));
                        before.map(|t| t.coefficients.len()).sum()
                    };
                    let (_, columns) = rows.extract(&base.with_term(term.clone()));
                    let size = candidate.size;
                    push(&columns.columns(first, size).into_owned(), &keep);
                }
                CandidateKind::Anonymous(shape) => push(&space.columns(shape), &keep),
            }
        }
        all
    }
}

/// The columns of some names added to the base, of each its own.
fn columns_of(rows: &Rows, base: &Model, names: &[Candidate]) -> Vec<DMatrix<f64>> {
    let own = names.iter().filter_map(|c| c.what.term());
    // Of the base no column is asked for.
    let of_base = base.terms().iter().map(|term| Term {
        held: FixedMask::ALL,
        ..term.clone()
    });
    let terms = of_base.chain(own.cloned()).collect();
    let all = Model::new(base.robot.clone(), terms);
    let (_, columns) = rows.extract(&all);
    let of = |candidate: &Candidate| {
        let is = |term: &&Term| candidate.what.term().is_some_and(|t| t.same_column(term));
        let before = all.terms().iter().take_while(|term| !is(term));
        let first: usize = before.map(|t| t.coefficients.len()).sum();
        columns.columns(first, candidate.size).into_owned()
    };
    names.iter().map(of).collect()
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
    let on_a_line = open_frame::is_open(problem, base);
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
            let there = (effect.exists_on)(joint, survey.joints[joint].kind);
            if !allowed.exists(about.id) || !there || in_base(joint) {
                continue;
            }
            let turns = survey.joints[joint].kind == JointKind::Revolute;
            let turned = (on_a_line && turns && about.owner == Owner::Robot).then(|| {
                text!("the measured points lie on one line: how the instrument is turned about it is open, and with it what moved the robot so")
            });
            if let Some(because) = turned.or_else(|| effect.obstacle(survey, joint)) {
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
            let term = Term::absent(form_in(effect, survey, joint), joint, 0.0);
            let settings = scan::settings(problem, &term);
            // Neighbouring times of a step are nearly the same candidate.
            let tried = match about.setting {
                Setting::Time => (settings.len() as f64).min(40.0),
                _ => settings.len() as f64,
            };
            // An order that follows from the gear ratio is no choice among all orders.
            let robot = &problem.session.robot;
            let of_the_gear = stated_orders(robot, joint).count() as f64;
            names.extend(settings.into_iter().map(|setting| {
                let term = Term {
                    setting,
                    ..term.clone()
                };
                let tried = stated(robot, &term).map_or(tried, |_| of_the_gear);
                (term, tried.max(1.0))
            }));
        }
    }
    (names, not_testable)
}

const MOST_RICH: usize = 120;

/// Columns for a rich fit, the likeliest sources of structure first, at most a quarter of the rows.
fn rich(table: &CandidateTable, rows: usize) -> Vec<usize> {
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
            CandidateKind::Named(term) if low_order(term) => tiers[0].extend(own),
            CandidateKind::Named(term) if term.effect.about().setting == Setting::Time => {
                times += 1;
                if times % 8 == 1 {
                    tiers[2].extend(own);
                }
            }
            CandidateKind::Anonymous(shape) => match (shape.profile, shape.direction) {
                (Profile::Bump { width, .. }, Direction::Tangential(j)) => {
                    let (low, high) = table.space.range(Variable::Joint(j));
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
            CandidateKind::Named(_) => {}
        }
    }
    let mut chosen: Vec<usize> = tiers.into_iter().flatten().collect();
    chosen.truncate((rows / 4).min(MOST_RICH));
    chosen
}
