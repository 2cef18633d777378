//! Brings measured points into the base frame, and says how well.

use crate::text::{Text, length};
use std::collections::{BTreeMap, BTreeSet};

use nalgebra::Point3;

use crate::diagnostic::{Diagnostic, Place, Rejected};
use crate::document::number::quoted;
use crate::importers::columns::{COORDINATES, Columns};
use crate::importers::companion_file::POINTS;
use crate::importers::job::Job;
use crate::importers::matching::{BEARABLE, Matching, listed_names, listed_rows};
use crate::importers::reference::{Alignment, Landmark, align};

impl Job<'_> {
    /// Where the instrument had lost its reflector it says (0, 0, 0), or one number thrice (-9999) in several rows. Of
    /// zeros a session tells that itself, unless its points are `moved` or averaged.
    pub(crate) fn lost_become_missing(&mut self, columns: &mut Columns, moved: bool) {
        let Some(points) = columns.places() else {
            return;
        };
        let mut alike: BTreeMap<u64, Vec<usize>> = BTreeMap::new();
        for (row, point) in points.iter().enumerate() {
            if point.x == point.y && point.y == point.z {
                alike.entry(point.x.to_bits()).or_default().push(row);
            }
        }
        alike.retain(|bits, rows| match f64::from_bits(*bits) {
            0.0 => moved,
            _ => rows.len() > 1,
        });
        let Some(stands) = alike.keys().next().map(|bits| f64::from_bits(*bits)) else {
            return;
        };
        let mut lost: Vec<usize> = alike.into_values().flatten().collect();
        lost.sort_unstable();
        let mut points = points;
        for &row in &lost {
            points[row] = [f64::NAN; 3].into();
        }
        columns.put_places(&points);
        let found = text!(
            one "the instrument lost the reflector ({point}) in {count} measurement: {which}",
            "the instrument lost the reflector ({point}) in {count} measurements: {which}",
            count = lost.len(),
            point = [stands; 3].map(|value| value.to_string()).join(", "),
            which = listed_rows(columns, &lost)
        );
        self.left_out(self.place.clone(), found);
    }

    /// Brings the points into the base frame, if points are known there.
    pub(crate) fn in_base_frame(
        &mut self,
        columns: Columns,
    ) -> Result<(Columns, Option<Alignment>), Rejected> {
        let Some(companion) = &self.settings.reference else {
            return Ok((columns, None));
        };
        if COORDINATES
            .into_iter()
            .all(|quantity| columns.find(quantity).is_none())
        {
            // Nothing to align: the points are places of anchors, sockets or stations.
            return Ok((columns, None));
        }
        let known = self.named_points(companion)?;
        let place = companion.place();
        let (Some(names), Some(points)) = (columns.points(), columns.places()) else {
            return self.refuse(
                text!("no names, or not all of x, y and z"),
                Text::verbatim(POINTS),
            );
        };
        let is_there = |point: &Point3<f64>| point.coords.iter().all(|v| v.is_finite());
        let landmarks: Vec<Landmark> = names
            .iter()
            .zip(&points)
            .filter(|(_, point)| is_there(point))
            .filter_map(|(name, point)| {
                let known = known.get(*name)?;
                Some(Landmark {
                    name: (*name).to_owned(),
                    measured: *point,
                    in_base: *known,
                })
            })
            .collect();
        let measured: BTreeSet<&str> = landmarks
            .iter()
            .map(|landmark| landmark.name.as_str())
            .collect();
        let missing: Vec<String> = known
            .keys()
            .filter(|name| !measured.contains(name.as_str()))
            .map(|name| quoted(name))
            .collect();
        let alignment = match align(&landmarks, self.settings.scale) {
            Ok(alignment) => alignment,
            Err(error) => {
                let found = if missing.is_empty() {
                    error.describe()
                } else {
                    text!(
                        "{error}; not measured: {missing}",
                        error = error.describe(),
                        missing = listed_names(&missing, BEARABLE)
                    )
                };
                return self.refuse_at(place,
                    found,
                    text!("at least 3 points that are not on one line, with the same names in both files"),
                );
            }
        };
        self.say_alignment(&alignment, &place);
        if !missing.is_empty() {
            let found = text!(
                "excluded reference points that were not measured: {missing}",
                missing = listed_names(&missing, BEARABLE)
            );
            self.left_out(place, found);
        }
        // The points that fix the frame are no poses of the robot, unless a command says so.
        let commanded = self.commanded_names();
        let is_pose = |name: &&str| !known.contains_key(*name) || commanded.contains(*name);
        let rows: Vec<usize> = (0..names.len())
            .filter(|&row| is_pose(&names[row]))
            .collect();
        if rows.is_empty() {
            return self.refuse(
                text!("only reference points"),
                text!("measured poses as well"),
            );
        }
        let dropped = names.len() - rows.len();
        if dropped > 0 {
            self.note(text!(
                one "{count} measurement of a reference point is not a sample",
                "{count} measurements of reference points are not samples",
                count = dropped
            ));
        }
        Ok((
            aligned(columns, &points, &alignment).only(&rows),
            Some(alignment),
        ))
    }

    /// Names in the commands; what is wrong with them is said when they are matched.
    pub(crate) fn commanded_names(&mut self) -> BTreeSet<String> {
        let by_name = matches!(self.settings.matching, None | Some(Matching::Name));
        let Some(companion) = self.settings.commands.as_ref().filter(|_| by_name) else {
            return BTreeSet::new();
        };
        let (findings, said) = (self.findings.len(), self.sentences.len());
        let columns = self.companion(companion, Some("q1_deg"));
        self.findings.truncate(findings);
        self.sentences.truncate(said);
        let names = columns
            .as_ref()
            .ok()
            .and_then(Columns::points)
            .unwrap_or_default();
        names.into_iter().map(str::to_owned).collect()
    }

    pub(crate) fn say_alignment(&mut self, alignment: &Alignment, place: &Place) {
        let kept = alignment.residuals.len() - alignment.outliers().count();
        let mut said = text!(
            "brought into the base frame by {kept} reference points, which fit with {rms_mm} (root mean square)",
            kept,
            rms_mm = length(alignment.rms_mm, 4)
        );
        if self.settings.scale {
            let scaled = text!(
                "scaled by {scale} ({ppm} ppm)",
                scale = format!("{:.6}", alignment.scale),
                ppm = format!("{:+.1}", 1e6 * (alignment.scale - 1.0))
            );
            said = Text::listed([said, scaled], ", ");
        }
        let fitting = alignment.residuals.iter().filter(|own| !own.is_outlier);
        let each =
            fitting.map(|own| format!("{} {:.4} mm", quoted(&own.name), own.vector_mm.norm()));
        let found = text!(
            "{found}: {name}",
            found = &said,
            name = listed_names(each, 40)
        );
        self.findings.push(Diagnostic::note(place.clone(), found));
        self.sentences.push(said);
        for outlier in alignment.outliers() {
            let found = text!(
                "reference point {outlier} has a residual of {norm}: excluded from the alignment",
                outlier = quoted(&outlier.name),
                norm = length(outlier.vector_mm.norm(), 3)
            );
            self.left_out(place.clone(), found);
        }
        if !self.settings.scale && (alignment.best_scale - 1.0).abs() > 1e-3 {
            let found = text!(
                "the reference points would fit better scaled by {best_scale}",
                best_scale = format!("{:.5}", alignment.best_scale)
            );
            let expected = text!("the right unit in both files, or --scale");
            self.findings
                .push(Diagnostic::warning(place.clone(), found, expected));
        }
    }
}

/// The columns with points and orientations in the base frame.
fn aligned(mut columns: Columns, points: &[Point3<f64>], alignment: &Alignment) -> Columns {
    let to_base = |point| alignment.to_base(point);
    columns.put_places(&points.iter().map(to_base).collect::<Vec<_>>());
    if let Some(all) = columns.orientations() {
        let rotation = alignment.base_from_instrument.rotation.into_inner();
        let turned = all.into_iter().map(|own| rotation * own);
        columns.put_orientations(&turned.collect::<Vec<_>>());
    }
    columns
}
