//! The variables and directions of which shapes are made, row by row.

use nalgebra::{DMatrix, DVector};

use crate::effects::Survey;
use crate::kinematics::JointKind;
use crate::model::Model;
use crate::rounding;

use super::placed::Placed;
use crate::fit::problem::Problem;
use crate::fit::regression::Rows;
use crate::model::shapes::{Direction, Shape, Variable};

/// Samples whose columns are made at once.
const AT_ONCE: usize = 1 << 15;

/// The variables and directions of which shapes are made, row by row.
#[derive(Debug, Clone)]
pub(crate) struct ShapeSpace {
    samples: usize,
    axes: Vec<usize>,
    /// The derivatives of the rows with respect to a move along x, y, z, where they are not those.
    frame: Vec<DVector<f64>>,
    pub(crate) variables: Vec<(Variable, Vec<f64>)>,
    pub(crate) tangential: Vec<DVector<f64>>,
    /// Across the motion of a single joint, and what guides do among several joints, where the rows show it.
    pub(crate) across: Vec<(Direction, DVector<f64>)>,
    angle: Vec<f64>,
    base: Model,
    survey: Survey,
}

impl ShapeSpace {
    /// Values of a variable, one for each sample.
    pub(crate) fn values(&self, variable: Variable) -> Option<&[f64]> {
        let found = self.variables.iter().find(|v| v.0 == variable);
        found.map(|v| v.1.as_slice())
    }

    /// Range of a variable in the data.
    pub(crate) fn range(&self, variable: Variable) -> (f64, f64) {
        let values = self.values(variable).unwrap_or(&[]);
        let start = (f64::INFINITY, f64::NEG_INFINITY);
        values
            .iter()
            .fold(start, |(a, b), v| (a.min(*v), b.max(*v)))
    }

    /// A direction across the motion of a joint.
    fn along(&self, across: Direction) -> Option<&DVector<f64>> {
        let found = self
            .across
            .iter()
            .find(|(direction, _)| *direction == across);
        found.map(|(_, direction)| direction)
    }

    /// Whether it is of a robot with a single joint.
    pub(crate) fn is_of_one_joint(&self) -> bool {
        self.survey.joints.len() == 1
    }

    /// Along the motion of the first joint and, of a single one, across it.
    fn body(&self) -> impl Iterator<Item = &DVector<f64>> {
        let across = self.across.iter().filter(|_| self.is_of_one_joint());
        let across = across.map(|(_, direction)| direction);
        self.tangential.iter().take(1).chain(across)
    }

    /// Number of a shape's columns.
    pub(crate) fn width(&self, shape: &Shape) -> usize {
        let directions = match shape.direction {
            Direction::Tangential(_) => 1,
            Direction::Frame => self.frame_axes(),
            Direction::Along(axis) => usize::from(axis < self.frame_axes()),
            Direction::Body => self.body().count(),
            across => usize::from(self.along(across).is_some()),
        };
        shape.profile.count() * directions
    }

    /// The columns of a shape, mm.
    pub(crate) fn columns(&self, shape: &Shape) -> DMatrix<f64> {
        self.columns_in(shape, self.range(shape.variable))
    }

    /// The same where the variable's range is that of other rows.
    fn columns_in(&self, shape: &Shape, range: (f64, f64)) -> DMatrix<f64> {
        let directions: Vec<DVector<f64>> = match shape.direction {
            Direction::Tangential(j) => vec![self.tangential[j].clone()],
            Direction::Frame => (0..self.frame_axes()).map(|a| self.frame_axis(a)).collect(),
            Direction::Along(axis) => vec![self.frame_axis(axis)],
            Direction::Body => self.body().cloned().collect(),
            across => self.along(across).into_iter().cloned().collect(),
        };
        let origin = shape.variable.origin(range);
        let constant = vec![0.0; self.samples];
        let values = self.values(shape.variable).unwrap_or(&constant);
        let count = shape.profile.count();
        let rows = self.samples * self.axes.len();
        let mut columns = DMatrix::zeros(rows, count * directions.len());
        let n = self.samples;
        let mut of_samples = vec![0.0; count * n];
        for (sample, (value, angle)) in values.iter().zip(&self.angle).enumerate() {
            let put = |k: usize, value| of_samples[k * n + sample] = value;
            shape.profile.each(*value, origin, range, *angle, put);
        }
        let of_profile = of_samples.chunks_exact(n.max(1));
        let each = of_profile.flat_map(|values| directions.iter().map(move |d| (values, d)));
        let all = columns.as_mut_slice().chunks_exact_mut(rows.max(1));
        for (column, (values, direction)) in all.zip(each) {
            let axes = column.chunks_exact_mut(n.max(1));
            for (column, direction) in axes.zip(direction.as_slice().chunks_exact(n.max(1))) {
                for (to, (value, d)) in column.iter_mut().zip(values.iter().zip(direction)) {
                    *to = value * d;
                }
            }
        }
        columns
    }

    /// The same over other rows of the same session.
    pub(crate) fn on(&self, rows: &Rows, base: &Model) -> Self {
        let mut other = shape_space(rows, base, &self.survey, true);
        other.tangential = tangential(rows, base, self.survey.joints.len());
        other
    }

    /// The columns of placed shapes for every sample of a problem, as extra columns of a fit.
    pub(crate) fn on_all(&self, problem: &Problem, shapes: &[Placed]) -> Vec<[Vec<f64>; 3]> {
        // Along x, y, z: observations have other rows.
        if shapes.is_empty() || problem.observed.is_some() {
            return Vec::new();
        }
        let shapes: Vec<&Shape> = shapes.iter().map(|placed| &placed.shape).collect();
        self.by_parts(problem, &shapes, AT_ONCE)
    }

    /// The same of shapes, made of so many samples at once. What a space holds of a sample is a few hundred bytes: of
    /// ten million it would be gigabytes.
    pub(crate) fn by_parts(
        &self,
        problem: &Problem,
        shapes: &[&Shape],
        at_once: usize,
    ) -> Vec<[Vec<f64>; 3]> {
        let count = problem.used.len();
        let width = shapes.iter().map(|shape| self.width(shape)).sum();
        let mut columns: Vec<[Vec<f64>; 3]> = (0..width)
            .map(|_| std::array::from_fn(|_| vec![0.0; count]))
            .collect();
        let usable: Vec<usize> = (0..count).filter(|i| problem.usable[*i]).collect();
        for part in usable.chunks(at_once) {
            let rows = Rows::of_samples(problem, part.to_vec());
            let space = self.on(&rows, &self.base).with_directions_of(self);
            let n = rows.samples.len();
            let mut column = columns.iter_mut();
            for shape in shapes {
                let own = space.columns_in(shape, self.range(shape.variable));
                for (own, column) in own.column_iter().zip(&mut column) {
                    for (a, axis) in rows.axes.iter().enumerate() {
                        for (i, sample) in rows.samples.iter().enumerate() {
                            column[*axis][*sample] = own[a * n + i];
                        }
                    }
                }
            }
        }
        columns
    }

    /// With the directions that another space has: a few samples may show nothing along one of them.
    fn with_directions_of(mut self, other: &Self) -> Self {
        let none = DVector::zeros(self.samples * self.axes.len());
        let own = other.across.iter().map(|(direction, _)| {
            let own = self.along(*direction).unwrap_or(&none);
            (*direction, own.clone())
        });
        self.across = own.collect();
        self
    }

    pub(crate) fn frame_axes(&self) -> usize {
        if self.frame.is_empty() {
            self.axes.len()
        } else {
            self.frame.len()
        }
    }

    fn frame_axis(&self, axis: usize) -> DVector<f64> {
        if let Some(own) = self.frame.get(axis) {
            return own.clone();
        }
        let rows = self.samples * self.axes.len();
        let own = axis * self.samples..(axis + 1) * self.samples;
        DVector::from_fn(rows, |row, _| f64::from(u8::from(own.contains(&row))))
    }
}

/// The space of some rows; with every target among the variables, or all but the first, which follows from the others.
pub(crate) fn shape_space(
    rows: &Rows,
    base: &Model,
    survey: &Survey,
    every_target: bool,
) -> ShapeSpace {
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
        (Variable::Warmth, inputs.above_20_c.as_deref()),
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
        for one in used.into_iter().skip(usize::from(!every_target)) {
            let is = |t: &u32| f64::from(u8::from(*t == one));
            variables.push((Variable::Target(one), of_sample.iter().map(is).collect()));
        }
    }
    ShapeSpace {
        samples: rows.samples.len(),
        axes: rows.axes.clone(),
        frame: frame(rows, base),
        angle: pick(&inputs.q[0]),
        variables,
        tangential: Vec::new(),
        base: base.clone(),
        survey: survey.clone(),
        across: across_the_motion(rows, base, survey),
    }
}

/// The derivatives of observations with respect to a target's place along x, y, z; empty for plain points, whose rows
/// are just that.
fn frame(rows: &Rows, base: &Model) -> Vec<DVector<f64>> {
    if rows.observed().is_none() {
        return Vec::new();
    }
    let along = |axis: usize| [0, 1, 2].map(|k| f64::from(u8::from(k == axis)));
    let columns = (0..3).map(|axis| rows.displaced(base, |_| along(axis)));
    columns.filter(|column| column.norm() > 0.0).collect()
}

/// Derivatives of the rows by each joint's angle.
pub(crate) fn tangential(rows: &Rows, base: &Model, joints: usize) -> Vec<DVector<f64>> {
    let effect = crate::effects::joint_zero();
    let one = |joint: usize| {
        let probe = crate::effects::Term::absent(effect, joint, f64::MAX);
        let model = base.with_term(probe.clone());
        let before = model.terms().iter().take_while(|t| !t.same_column(&probe));
        let first: usize = before.map(|t| t.coefficients.len()).sum();
        rows.extract(&model).1.column(first).into_owned()
    };
    (0..joints).map(one).collect()
}

/// Unit directions of every row across the motion of a robot's single joint: radial and axial where it turns, two
/// across its guide where it slides. Of several joints what the guide of each that slides does. What the rows do not
/// show is left out.
fn across_the_motion(rows: &Rows, base: &Model, survey: &Survey) -> Vec<(Direction, DVector<f64>)> {
    let [joint] = survey.joints.as_slice() else {
        return of_guides(rows, base, survey);
    };
    let (origin, along) = (joint.frame.origin_mm, joint.frame.along);
    let constant = |direction: [f64; 3]| rows.displaced(base, |_| direction);
    let mut all = match joint.kind {
        JointKind::Prismatic => vec![
            (Direction::Guide(0, 1), constant(joint.frame.across_1)),
            (Direction::Guide(0, 2), constant(joint.frame.across_2)),
        ],
        JointKind::Revolute => {
            let points = rows.points(base);
            let outward = |p: &[f64; 3]| {
                let arm: [f64; 3] = std::array::from_fn(|k| p[k] - origin[k]);
                let height: f64 = (0..3).map(|k| arm[k] * along[k]).sum();
                let across: [f64; 3] = std::array::from_fn(|k| arm[k] - height * along[k]);
                let radius = across.iter().map(|v| v * v).sum::<f64>().sqrt();
                across.map(|v| v / radius.max(rounding::COMPUTED))
            };
            let outward: Vec<[f64; 3]> = points.iter().map(outward).collect();
            vec![
                (
                    Direction::Radial,
                    rows.displaced(base, |sample| outward[sample]),
                ),
                (Direction::Axial, constant(along)),
            ]
        }
    };
    all.retain(|(_, direction)| direction.norm() > rounding::COMPUTED);
    all
}

/// What the guide of each joint that slides does to its carriage, per mm and rad.
fn of_guides(rows: &Rows, base: &Model, survey: &Survey) -> Vec<(Direction, DVector<f64>)> {
    let slides = |joint: &usize| survey.joints[*joint].kind == JointKind::Prismatic;
    let mut all = Vec::new();
    for joint in (0..survey.joints.len()).filter(slides) {
        let moves = rows.moves_of(base, joint);
        let across = moves.into_iter().enumerate().skip(1);
        all.extend(across.map(|(k, column)| (Direction::Guide(joint, k), column)));
    }
    all.retain(|(_, direction)| direction.norm() > rounding::COMPUTED);
    all
}
