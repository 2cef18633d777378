//! The forward map: from the commands of samples to where the target is, with the derivative of every coefficient.

use crate::effects::block::Block;
use crate::effects::{Inputs, JointFrame, Placed, Stage, Term, rank};
use crate::kinematics::Robot;
use crate::lanes::LANES;

/// The nominal robot and its effects with their coefficients: the forward map.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    /// The robot as its controller believes it to be.
    pub robot: Robot,
    /// The effects, in the order in which they act.
    pub(super) terms: Vec<Term>,
}

/// Positions of samples in the measuring frame, as columns, mm.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Positions {
    /// x of every sample.
    pub x_mm: Vec<f64>,
    /// y of every sample.
    pub y_mm: Vec<f64>,
    /// z of every sample.
    pub z_mm: Vec<f64>,
}

impl Positions {
    /// One sample's position; of one that is not there, no numbers.
    pub fn get(&self, sample: usize) -> [f64; 3] {
        [&self.x_mm, &self.y_mm, &self.z_mm]
            .map(|column| column.get(sample).copied().unwrap_or(f64::NAN))
    }
}

impl Model {
    /// The robot as its controller believes it to be, without any effect.
    pub fn nominal(robot: Robot) -> Self {
        Self {
            robot,
            terms: Vec::new(),
        }
    }

    /// A robot with effects, in any order: they are put in the order in which they act.
    pub fn new(robot: Robot, mut terms: Vec<Term>) -> Self {
        terms.sort_by(|a, b| {
            let key = |t: &Term| (rank(t.effect), t.joint);
            key(a).cmp(&key(b)).then(a.setting.total_cmp(&b.setting))
        });
        Self { robot, terms }
    }

    /// The effects, in the order in which they act.
    pub fn terms(&self) -> &[Term] {
        &self.terms
    }

    /// Number of coefficients of all effects.
    pub fn coefficient_count(&self) -> usize {
        self.terms.iter().map(|t| t.coefficients.len()).sum()
    }

    /// All coefficients, effect by effect.
    pub fn coefficients(&self) -> Vec<f64> {
        let all = self
            .terms
            .iter()
            .flat_map(|t| t.coefficients.iter().copied());
        all.collect()
    }

    /// What each column is of: a term, and which of its coefficients.
    pub fn columns(&self) -> impl Iterator<Item = (&Term, usize)> {
        let all = self.terms.iter();
        all.flat_map(|term| (0..term.coefficients.len()).map(move |k| (term, k)))
    }

    /// The same model with other coefficients; those that are missing stay as they are.
    #[must_use]
    pub fn with_coefficients(&self, coefficients: &[f64]) -> Self {
        let mut model = self.clone();
        let own = model.terms.iter_mut().flat_map(|t| &mut t.coefficients);
        for (own, given) in own.zip(coefficients) {
            *own = *given;
        }
        model
    }

    /// The same model after a step of its coefficients; one of a fade is cut to what it may do
    /// at once.
    #[must_use]
    #[doc(hidden)]
    pub fn stepped(&self, step: &[f64]) -> Self {
        let mut model = self.clone();
        let mut rest = step;
        for term in &mut model.terms {
            let (own, others) = rest.split_at(term.coefficients.len());
            term.step(own);
            rest = others;
        }
        model
    }

    /// The same model, bit by bit, with every fade that was solved for as its term's setting.
    #[must_use]
    pub fn settled(&self) -> Self {
        let terms = self.terms.iter().map(Term::settled).collect();
        Self::new(self.robot.clone(), terms)
    }

    /// The same model with one effect more.
    #[must_use]
    pub fn with_term(&self, term: Term) -> Self {
        let terms = self.terms.iter().cloned().chain([term]).collect();
        Self::new(self.robot.clone(), terms)
    }

    /// The same model with its terms changed one by one, each with its place among them.
    #[must_use]
    pub fn with_each(&self, change: impl Fn(usize, &mut Term)) -> Self {
        let mut model = self.clone();
        for (index, term) in model.terms.iter_mut().enumerate() {
            change(index, term);
        }
        model
    }

    /// The same model without some of its effects.
    #[must_use]
    pub fn without(&self, drop: impl Fn(&Term) -> bool) -> Self {
        let kept = self.terms.iter().filter(|t| !drop(t)).cloned().collect();
        Self::new(self.robot.clone(), kept)
    }

    /// The same model with its other effects as they are best without what has no name: for what cannot hold that.
    #[must_use]
    pub fn with_geometry_alone(&self) -> Self {
        let rest = self.terms.iter().find_map(Term::rest);
        match rest {
            Some(rest) if rest.geometry_alone.len() == self.coefficient_count() => {
                self.with_coefficients(&rest.geometry_alone)
            }
            _ => self.clone(),
        }
    }

    /// Sends the samples through the model, block by block; `see` gets the number of a block's
    /// first sample and the block. `differentiate` asks for the columns of every coefficient.
    pub fn visit(&self, inputs: &Inputs, differentiate: bool, mut see: impl FnMut(usize, &Block)) {
        let starts = (0..inputs.len()).step_by(LANES);
        self.visit_blocks(inputs, differentiate, starts, &mut see);
    }

    /// Like [`Model::visit`] for some blocks only, given by their first samples.
    pub fn visit_blocks(
        &self,
        inputs: &Inputs,
        differentiate: bool,
        starts: impl Iterator<Item = usize>,
        mut see: impl FnMut(usize, &Block),
    ) {
        let block = Block::new(&self.robot, self.coefficient_count(), differentiate);
        self.send(block, inputs, starts, &mut see);
    }

    /// Like [`Model::visit`] with the columns of every coefficient, of which those that turn a joint
    /// [stay apart](Block::apart).
    pub(crate) fn visit_apart(&self, inputs: &Inputs, mut see: impl FnMut(usize, &Block)) {
        let starts = (0..inputs.len()).step_by(LANES);
        let block = Block::apart(&self.robot, self.coefficient_count());
        self.send(block, inputs, starts, &mut see);
    }

    fn send(
        &self,
        mut block: Block,
        inputs: &Inputs,
        starts: impl Iterator<Item = usize>,
        see: &mut impl FnMut(usize, &Block),
    ) {
        let placed = self.placed(inputs);
        block.hold(self.held_columns());
        for start in starts {
            block.load(inputs, start);
            self.flow(&placed, &mut block);
            see(start, &block);
        }
    }

    /// Sends the samples through the model with the exact derivatives of the points by the joints'
    /// commands: column j of a block is mm per rad, or mm per mm, of joint j's command. Sides,
    /// speeds and travels are conditions of their own and stay what they are.
    pub fn visit_by_commands(&self, inputs: &Inputs, mut see: impl FnMut(usize, &Block)) {
        let placed = self.placed(inputs);
        let mut block = Block::by_commands(&self.robot);
        for start in (0..inputs.len()).step_by(LANES) {
            block.load(inputs, start);
            self.flow(&placed, &mut block);
            see(start, &block);
        }
    }

    /// The predicted places of the samples' reflectors.
    pub fn predict(&self, inputs: &Inputs) -> Positions {
        let n = inputs.len();
        let mut positions = Positions {
            x_mm: Vec::with_capacity(n),
            y_mm: Vec::with_capacity(n),
            z_mm: Vec::with_capacity(n),
        };
        self.visit(inputs, false, |_, block| {
            let [x, y, z] = &block.point;
            positions.x_mm.extend_from_slice(&x[..block.len]);
            positions.y_mm.extend_from_slice(&y[..block.len]);
            positions.z_mm.extend_from_slice(&z[..block.len]);
        });
        positions
    }

    /// Columns of the coefficients that no fit moves.
    pub(crate) fn held_columns(&self) -> impl Iterator<Item = usize> {
        let mut first = 0;
        self.terms.iter().flat_map(move |term| {
            let own = first;
            first += term.coefficients.len();
            let all = 0..term.coefficients.len();
            all.filter(|k| term.held.contains(*k)).map(move |k| own + k)
        })
    }

    /// A term of a joint that the robot has not, or without its coefficients, does nothing.
    fn flow(&self, placed: &[Placed], block: &mut Block) {
        let joints = self.robot.joints.len();
        let act = |block: &mut Block, stage: Stage, joint: Option<usize>| {
            for (term, me) in self.terms.iter().zip(placed) {
                let form = term.effect.about().form;
                if term.joint >= joints || term.coefficients.len() < form.coefficients() {
                    continue;
                }
                let here = joint.is_none_or(|joint| joint == term.joint);
                if term.effect.about().stage == stage && here {
                    (term.effect.act)(me, block);
                }
            }
        };
        act(block, Stage::Joint, None);
        act(block, Stage::Tool, None);
        for joint in (0..self.robot.joints.len()).rev() {
            act(block, Stage::Link, Some(joint));
            block.move_joint(joint);
            act(block, Stage::Bearing, Some(joint));
        }
        act(block, Stage::World, None);
        block.settle();
    }

    /// Figures of an effect in a session in addition to its parameters; see [`crate::effects::Effect::figures`].
    pub fn figures_of(&self, term: &Term, inputs: &Inputs) -> Vec<(&'static str, Option<f64>)> {
        let joints = self.robot.joints.len();
        let inputs = &*inputs.fitted_to(joints);
        let mut placed = self.terms.iter().zip(self.placed(inputs));
        let found = placed.find(|(own, _)| own.same_column(term) && own.joint < joints);
        found.map_or_else(Vec::new, |(term, me)| {
            (term.effect.figures)(&me, &self.robot, inputs)
        })
    }

    fn placed(&self, inputs: &Inputs) -> Vec<Placed> {
        let down = self.robot.gravity_m_s2.and_then(|g| {
            let norm = g.norm();
            (norm > 0.0).then(|| (g / norm).into())
        });
        let mut first_column = 0;
        let mut place = |term: &Term| {
            let placed = Placed {
                joint: term.joint,
                setting: term.setting,
                coefficients: term.coefficients.clone(),
                curve: term.curve.clone(),
                rest: term.rest.clone(),
                first_column,
                frame: JointFrame::new(&self.robot, term.joint),
                down,
                start_s: inputs.start_s(),
            };
            first_column += term.coefficients.len();
            placed
        };
        self.terms.iter().map(&mut place).collect()
    }
}
