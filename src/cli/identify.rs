//! `truepose identify`: from a session to a model.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use serde::Serialize;

use truepose::effects::JointValues;
use truepose::fit::noise::StatedNoise;
use truepose::fit::{DEFAULT_EFFECTS, Estimate, Gap, IMPLAUSIBLE, Identification};
use truepose::pipeline;
use truepose::present::kinds::{self, KindRow};
use truepose::sessions::Session;
use truepose::sessions::division::RegionChoice;
use truepose::set_up_errors::DataProblem;
use truepose::units::{deg_from_rad, rad_from_deg};

use super::failure::Failure;
use super::{geometry, levels, output};

/// Identify a session's robot: the exact fit, or the paper's method by regions
#[derive(Debug, Args)]
pub(crate) struct Identify {
    /// Session to identify
    session: PathBuf,
    /// How to identify
    #[arg(long, value_enum, default_value = "exact")]
    method: Method,
    /// Effects to fit, separated by commas [default: joint-zero-offset,link-length; with several joints the whole geometry]
    #[arg(long, value_delimiter = ',', value_name = "ID")]
    effects: Vec<String>,
    /// Number of uniform regions, or their boundaries in degrees: 6 | -90,-60,… | adaptive [default: the session's, else 6]
    #[arg(long, allow_hyphen_values = true)]
    regions: Option<String>,
    /// Fit the geometry of several joints without weak priors (tool 50 mm; an aligned frame 20 mm,
    /// 20 mrad; links 1 mm, 2 mrad; zero offsets 50 mrad)
    #[arg(long)]
    no_prior: bool,
    /// Joint values to start from
    #[arg(long, value_enum, default_value = "commanded")]
    joint_values: Values,
    /// Write the model to this file; - is standard output
    #[arg(long, value_name = "MODEL")]
    out: Option<PathBuf>,
    /// Replace the file if it exists
    #[arg(long)]
    force: bool,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Method {
    /// Nonlinear least squares for the named effects
    Exact,
    /// The paper's constant corrections by region
    Regional,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Values {
    /// What the controller was told
    Commanded,
    /// What the controller read back
    Read,
}

impl Identify {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let to_stdout = output::is_standard_output(self.out.as_deref());
        output::one_use_of_standard_output(self.json, to_stdout, "--json", "--out -")?;
        let values = match self.joint_values {
            Values::Commanded => JointValues::Commanded,
            Values::Read => JointValues::Read,
        };
        if self.method == Method::Regional && !self.effects.is_empty() {
            return Err(Failure::WrongInput(
                "--effects belongs to --method exact; the regional method fits angle and radius by region".to_owned(),
            ));
        }
        if self.method == Method::Exact && self.regions.is_some() {
            return Err(Failure::WrongInput(
                "--regions belongs to --method regional; the exact method needs none".to_owned(),
            ));
        }
        let loaded = truepose::sessions::load(&self.session)?;
        output::messages(&loaded.findings);
        let session = &loaded.session;
        let method = match (self.method, &self.regions) {
            (Method::Exact, _) => pipeline::Method::Exact {
                effects: match self.effects {
                    effects if effects.is_empty() => DEFAULT_EFFECTS.map(str::to_owned).to_vec(),
                    effects => effects,
                },
                priors: !self.no_prior,
            },
            (Method::Regional, None) => pipeline::Method::Regional(RegionChoice::FromSession),
            (Method::Regional, Some(text)) => pipeline::Method::Regional(parse_regions(text)?),
        };
        let pipeline::Identified {
            identification: answer,
            calibration,
            data_problems,
        } = pipeline::identify_checked(session, &method, values)?;
        if let Some(out) = &self.out {
            let text = truepose::model::format_v1::write_model(&calibration);
            output::document(out, text.as_bytes(), self.force, &loaded.files)?;
        }
        if self.json {
            output::json(&Answer::new(&answer, &data_problems))
        } else if to_stdout {
            Ok(())
        } else {
            output::text(&in_words(&answer, session, &data_problems))
        }
    }
}

fn parse_regions(text: &str) -> Result<RegionChoice, Failure> {
    let wrong = || {
        Failure::WrongInput(format!(
            "--regions '{text}': expected a number of regions, boundaries in degrees such as -90,-60,-30,0, or adaptive"
        ))
    };
    if text.trim() == "adaptive" {
        return Ok(RegionChoice::Adaptive);
    }
    if let Ok(number) = text.trim().parse::<usize>() {
        return Ok(RegionChoice::Uniform(number));
    }
    let boundary = |part: &str| {
        let degrees: f64 = part.trim().parse().map_err(|_| wrong())?;
        if degrees.is_finite() {
            Ok(rad_from_deg(degrees))
        } else {
            Err(wrong())
        }
    };
    let boundaries: Result<Vec<f64>, Failure> = text.split(',').map(boundary).collect();
    Ok(RegionChoice::Boundaries(boundaries?))
}

/// `truepose-identification/1`.
#[derive(Serialize)]
struct Answer<'a> {
    format: &'static str,
    session: &'a str,
    method: &'static str,
    samples: usize,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    regions: Vec<RegionRow<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    parameters: Option<Vec<ParameterRow>>,
    not_identifiable: Vec<NotIdentifiableRow<'a>>,
    data_problems: Vec<ProblemRow<'a>>,
    gap: GapRow,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    kinds: Vec<KindRow>,
    #[serde(skip_serializing_if = "Option::is_none")]
    held_out: Option<HeldOutRow>,
    /// What each level of correction would bring; of several joints.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    levels: Vec<levels::Row>,
    /// The error to be expected over the joint ranges; of several joints.
    #[serde(skip_serializing_if = "Option::is_none")]
    expected_error: Option<levels::ExpectedRow>,
    outliers: Vec<OutlierRow>,
    left_out: Vec<LeftOutRow>,
    noise_mm: Option<[f64; 3]>,
    solver: SolverRow,
    notes: &'a [String],
}

#[derive(Serialize)]
struct RegionRow<'a> {
    name: &'a str,
    from_deg: f64,
    to_deg: f64,
    samples: usize,
    correction: Correction,
    ci95: Intervals,
    rms_before_mm: f64,
    rms_after_mm: f64,
}

#[derive(Serialize)]
struct Correction {
    theta_rad: f64,
    l1_mm: f64,
}

#[derive(Serialize)]
struct Intervals {
    theta_rad: Option<[f64; 2]>,
    l1_mm: Option<[f64; 2]>,
}

#[derive(Serialize)]
struct ParameterRow {
    effect: &'static str,
    joint: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    setup: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    target: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    place: Option<String>,
    name: &'static str,
    value: f64,
    ci95: Option<[f64; 2]>,
}

#[derive(Serialize)]
struct NotIdentifiableRow<'a> {
    combination: &'a str,
    because: &'a str,
}

#[derive(Serialize)]
struct ProblemRow<'a> {
    what: &'a str,
    evidence: &'a str,
    proposal: &'a str,
}

#[derive(Serialize)]
struct GapRow {
    before_mm: f64,
    after_mm: f64,
    max_before_mm: f64,
    max_after_mm: f64,
}

#[derive(Serialize)]
struct HeldOutRow {
    samples: usize,
    #[serde(flatten)]
    gap: GapRow,
}

#[derive(Serialize)]
struct OutlierRow {
    sample: usize,
    deviation_mm: f64,
}

#[derive(Serialize)]
struct LeftOutRow {
    sample: usize,
    because: &'static str,
}

#[derive(Serialize)]
struct SolverRow {
    converged: bool,
    stopped: &'static str,
    passes: usize,
    coefficients: usize,
    rank: usize,
    condition: f64,
}

impl GapRow {
    fn new(gap: &Gap) -> Self {
        Self {
            before_mm: gap.before.rms_mm,
            after_mm: gap.after.rms_mm,
            max_before_mm: gap.before.max_mm,
            max_after_mm: gap.after.max_mm,
        }
    }
}

impl<'a> ProblemRow<'a> {
    fn new(problem: &'a DataProblem) -> Self {
        Self {
            what: &problem.what,
            evidence: &problem.evidence,
            proposal: &problem.proposal,
        }
    }
}

impl<'a> Answer<'a> {
    fn new(answer: &'a Identification, data_problems: &'a [DataProblem]) -> Self {
        let parameters = answer.parameters.iter().map(|p| ParameterRow {
            effect: p.effect,
            joint: p.joint,
            setup: p.setup.clone(),
            target: p.target.clone(),
            place: p.place.clone(),
            name: p.name,
            value: p.value,
            ci95: p.ci95,
        });
        let regions = answer.regions.iter().map(|r| RegionRow {
            name: &r.correction.name,
            from_deg: rounded_degrees(r.correction.from_rad),
            to_deg: rounded_degrees(r.correction.to_rad),
            samples: r.correction.samples,
            correction: Correction {
                theta_rad: r.correction.theta_rad,
                l1_mm: r.correction.l1_mm,
            },
            ci95: Intervals {
                theta_rad: r.theta_ci95,
                l1_mm: r.l1_ci95,
            },
            rms_before_mm: r.rms_before_mm,
            rms_after_mm: r.rms_after_mm,
        });
        let not_identifiable = answer.not_identifiable.iter().map(|n| NotIdentifiableRow {
            combination: &n.combination,
            because: &n.because,
        });
        // Samples are counted from 1 where people and other programs read them.
        let outliers = answer.outliers.iter().map(|o| OutlierRow {
            sample: o.sample + 1,
            deviation_mm: o.deviation_mm,
        });
        let left_out = answer.left_out.iter().map(|l| LeftOutRow {
            sample: l.sample + 1,
            because: l.because.says(),
        });
        Self {
            format: "truepose-identification/1",
            session: &answer.session,
            method: answer.method,
            samples: answer.samples,
            regions: regions.collect(),
            parameters: (answer.method == "exact").then(|| parameters.collect()),
            not_identifiable: not_identifiable.collect(),
            data_problems: data_problems.iter().map(ProblemRow::new).collect(),
            gap: GapRow::new(&answer.gap),
            kinds: kinds::rows(&answer.kinds),
            levels: levels::rows(answer),
            expected_error: levels::expected_row(answer),
            held_out: answer.held_out.as_ref().map(|gap| HeldOutRow {
                samples: gap.samples,
                gap: GapRow::new(gap),
            }),
            outliers: outliers.collect(),
            left_out: left_out.collect(),
            noise_mm: answer.noise_mm,
            solver: SolverRow {
                converged: answer.quality.converged,
                stopped: answer.quality.stopped,
                passes: answer.quality.passes,
                coefficients: answer.quality.coefficients,
                rank: answer.quality.rank,
                condition: answer.quality.condition,
            },
            notes: &answer.notes,
        }
    }
}

/// Degrees as a person wrote them: the conversion to radians and back can cost the last bit.
fn rounded_degrees(rad: f64) -> f64 {
    (deg_from_rad(rad) * 1e9).round() / 1e9
}

fn in_words(answer: &Identification, session: &Session, data_problems: &[DataProblem]) -> String {
    let gap = &answer.gap;
    let mut text = format!(
        "{}: {} identification of {} samples\n",
        answer.session, answer.method, answer.samples
    );
    for problem in data_problems {
        text += &format!(
            "data: {}\n  {}\n  {}\n",
            problem.what, problem.evidence, problem.proposal
        );
    }
    text += &format!(
        "RMS error    nominal {:.6} mm, identified {:.6} mm (largest {:.6} and {:.6})\n",
        gap.before.rms_mm, gap.after.rms_mm, gap.before.max_mm, gap.after.max_mm
    );
    if let Some(held_out) = &answer.held_out {
        text += &format!(
            "held out     {:.6} mm before, {:.6} mm after, on {} samples that the fit has not seen\n",
            held_out.before.rms_mm, held_out.after.rms_mm, held_out.samples
        );
    }
    text += &kinds::in_words(&answer.kinds);
    let arm = geometry::is_of_an_arm(&answer.parameters);
    if arm {
        text += &format!("\n{}", geometry::table(&answer.parameters));
    }
    text += &levels::in_words(answer);
    let in_table = |p: &&Estimate| !(arm && geometry::is_in_table(p));
    let rows: Vec<&Estimate> = answer.parameters.iter().filter(in_table).collect();
    if !rows.is_empty() {
        text += &format!(
            "\n{:<24} {:>5}  {:<22} {:>14}   95 % interval\n",
            "effect", "joint", "parameter", "value"
        );
    }
    for p in rows {
        text += &parameter_row(p);
    }
    if !answer.regions.is_empty() {
        text += &format!(
            "\n{:<8} {:>9} {:>9} {:>8} {:>14} {:>12} {:>12} {:>12}\n",
            "region", "from °", "to °", "samples", "Δθ rad", "Δl1 mm", "before mm", "after mm"
        );
    }
    for r in &answer.regions {
        let c = &r.correction;
        text += &format!(
            "{:<8} {:>9.3} {:>9.3} {:>8} {:>14.7} {:>12.7} {:>12.4} {:>12.4}\n",
            c.name,
            rounded_degrees(c.from_rad),
            rounded_degrees(c.to_rad),
            c.samples,
            c.theta_rad,
            c.l1_mm,
            r.rms_before_mm,
            r.rms_after_mm
        );
    }
    for n in &answer.not_identifiable {
        text += &format!("\nnot identifiable: {}: {}", n.combination, n.because);
    }
    text += &noise_in_words(answer, session);
    if !answer.outliers.is_empty() {
        text += &format!(
            "\nexcluded outliers: {} of {} samples",
            answer.outliers.len(),
            answer.samples
        );
    }
    for o in &answer.outliers {
        text += &format!(
            "\n  sample {}: {:.4} mm from the model",
            o.sample + 1,
            o.deviation_mm
        );
    }
    for l in &answer.left_out {
        text += &format!("\nexcluded: sample {}: {}", l.sample + 1, l.because.says());
    }
    let quality = &answer.quality;
    if !quality.converged {
        text += "\nthe fit did not converge";
    }
    text += &format!(
        "\nsolver: {}; {} of {} coefficients determined, condition {:.1}",
        quality.stopped, quality.rank, quality.coefficients, quality.condition
    );
    for note in &answer.notes {
        text += &format!("\nnote: {note}");
    }
    if !text.ends_with('\n') {
        text.push('\n');
    }
    text
}

/// A row of the table of parameters.
fn parameter_row(p: &Estimate) -> String {
    let joint = match (p.setup.as_ref().or(p.place.as_ref()), p.joint) {
        (Some(setup), _) => setup.clone(),
        (None, Some(joint)) => joint.to_string(),
        (None, None) => "-".to_owned(),
    };
    let whole = p.is_whole_number();
    let value = if whole {
        p.value.to_string()
    } else {
        format!("{:.6}", p.value)
    };
    let interval = match p.ci95 {
        Some([a, b]) => format!("{a:.6} … {b:.6}"),
        None if whole => String::new(),
        None => "not determined".to_owned(),
    };
    let remark = if p.is_implausible() {
        format!("   {IMPLAUSIBLE}")
    } else {
        String::new()
    };
    let row = format!(
        "{:<24} {joint:>5}  {:<22} {value:>14}   {interval}{remark}",
        p.effect, p.name
    );
    format!("{}\n", row.trim_end())
}

/// What there is to say of the noise that the fit allows for.
fn noise_in_words(answer: &Identification, session: &Session) -> String {
    let mut text = String::new();
    let Some(noise) = &answer.noise else {
        return text;
    };
    if let Some(stated) = noise.against_stated(session).filter(StatedNoise::differs) {
        text += &format!("\nmeasurement noise: {}", stated.says());
    }
    if let Some(slow) = &noise.slow {
        text += &format!("\nslow noise: {}", slow.says_of_remaining_error());
    }
    text
}
