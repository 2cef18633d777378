//! Columns of measurements other than points, and which
//! rows lack what they need: a distance needs its anchor, a direction both of its angles.

use crate::diagnostic::{Diagnostic, Place};
use crate::sessions::columns::{Heading, Quantity};
use crate::sessions::domain::{Session, has_missing};
use crate::sessions::references::{ObservedColumns, References};
use crate::tables::more_like_these;
use crate::text::Text;

/// Complaints about one column that are worth printing.
const MOST_COMPLAINTS: usize = 10;

/// One column and where to complain about it.
pub(crate) struct PlacedColumn<'a> {
    pub(crate) index: usize,
    pub(crate) locate: Locate<'a>,
    pub(crate) findings: &'a mut Vec<Diagnostic>,
}

impl PlacedColumn<'_> {
    pub(crate) fn complain(self, rows: &[usize], found: &dyn Fn(usize) -> Text, expected: &Text) {
        for &row in rows.iter().take(MOST_COMPLAINTS) {
            let place = (self.locate)(self.index, row);
            self.findings
                .push(Diagnostic::error(place, found(row), expected));
        }
        if let Some(&row) = rows.get(MOST_COMPLAINTS) {
            let place = (self.locate)(self.index, row);
            let more = rows.len() - MOST_COMPLAINTS;
            let found = more_like_these(more);
            self.findings
                .push(Diagnostic::error(place, found, expected));
        }
    }
}

/// The names that a cell may have; the first few of them.
pub(crate) fn one_of(declared: &[&str]) -> Text {
    let shown = &declared[..declared.len().min(MOST_COMPLAINTS)];
    let more = if shown.len() < declared.len() {
        ", …"
    } else {
        ""
    };
    text!(
        "a name that the session declares: {declared}",
        declared = shown.join(", ") + more
    )
}

/// Completes what only one thing can be meant by, and complains of rows that lack something.
pub(crate) fn complete(
    observed: &mut ObservedColumns,
    references: &References,
    headings: &[Heading],
    locate: Locate<'_>,
    findings: &mut Vec<Diagnostic>,
) {
    let mut complain = |quantity: Quantity, rows: &[usize], found: Text, expected: Text| {
        let is = |h: &Heading| matches!(h, Heading::Known(q, _) if *q == quantity);
        let index = headings.iter().position(is).unwrap_or(0);
        let column = PlacedColumn {
            index,
            locate,
            findings: &mut *findings,
        };
        column.complain(rows, &|_| found.clone(), &expected);
    };
    if let Some(distance) = &observed.distance_mm {
        let rows = distance.len();
        let anchor = observed.anchor.get_or_insert_with(|| vec![None; rows]);
        if references.anchors.len() == 1 {
            anchor.fill(Some(0));
        }
        let lacking: Vec<usize> = (0..rows)
            .filter(|i| !distance[*i].is_nan() && anchor[*i].is_none())
            .collect();
        let expected = one_of(&references.named(Quantity::Anchor));
        complain(
            Quantity::Distance,
            &lacking,
            text!("a distance without its anchor"),
            expected,
        );
        let negative: Vec<usize> = (0..rows).filter(|i| distance[*i] < 0.0).collect();
        let expected = text!("a number of at least {least}", least = "0");
        complain(
            Quantity::Distance,
            &negative,
            text!("a negative distance"),
            expected,
        );
    }
    if let (Some(azimuth), Some(elevation)) = (&observed.azimuth, &observed.elevation) {
        let rows = azimuth.len();
        let half: Vec<usize> = (0..rows)
            .filter(|i| azimuth[*i].is_nan() != elevation[*i].is_nan())
            .collect();
        let expected = text!("both azimuth_deg and elevation_deg or none");
        complain(
            Quantity::Azimuth,
            &half,
            text!("one angle of two"),
            expected,
        );
        let steep: Vec<usize> = (0..rows)
            .filter(|i| elevation[*i].abs() > std::f64::consts::FRAC_PI_2 + 1e-9)
            .collect();
        let expected = Text::verbatim("-90° … 90°");
        complain(
            Quantity::Elevation,
            &steep,
            text!("an elevation beyond the zenith"),
            expected,
        );
        let station = observed.station.get_or_insert_with(|| vec![None; rows]);
        if references.stations.len() == 1 {
            station.fill(Some(0));
        }
        if references.pointing.is_none() {
            let lacking: Vec<usize> = (0..rows)
                .filter(|i| !azimuth[*i].is_nan() && station[*i].is_none())
                .collect();
            let expected = one_of(&references.named(Quantity::Station));
            complain(
                Quantity::Azimuth,
                &lacking,
                text!("a direction without its station, or the key pointing"),
                expected,
            );
        }
    }
}

/// A kind of measurement that a session has.
pub(crate) struct Measured {
    /// How many samples have it.
    pub(crate) count: usize,
    /// So many of them, in words.
    pub(crate) counted: Text,
    /// The key of its noise in the session's instrument.
    pub(crate) sigma_key: &'static str,
    pub(crate) stated: bool,
}

impl Session {
    /// Whether nothing but points of one noise was measured, each with all of its coordinates or none.
    pub fn has_plain_points(&self) -> bool {
        let samples = &self.samples;
        if !samples.observed.is_empty() || self.instrument.tracker.is_some() {
            return false;
        }
        let turned = samples.orientation_wxyz.as_ref();
        if turned.is_some_and(|q| q[0].iter().any(|v| !v.is_nan())) {
            return false;
        }
        let columns = [&samples.x_mm, &samples.y_mm]
            .into_iter()
            .chain(&samples.z_mm);
        !columns.into_iter().any(|c| has_missing(c)) || samples.partly_measured().is_empty()
    }

    /// How many measurements of each kind there are: "120 points, 40 distances". `None` where plain
    /// points are all there is.
    pub fn kinds_in_words(&self) -> Option<Text> {
        if self.has_plain_points() {
            return None;
        }
        let kinds = self.measured_kinds().into_iter();
        Some(Text::listed(kinds.map(|kind| kind.counted), ", "))
    }

    /// The kinds of measurement that there are.
    pub(crate) fn measured_kinds(&self) -> Vec<Measured> {
        let (samples, own) = (&self.samples, &self.samples.observed);
        let instrument = &self.instrument;
        let count = |has: &dyn Fn(usize) -> bool| (0..samples.len()).filter(|i| has(*i)).count();
        let number = |c: &Option<Vec<f64>>| {
            c.as_ref()
                .map_or(0, |c| c.iter().filter(|v| !v.is_nan()).count())
        };
        let name = |c: &Option<Vec<Option<u32>>>| c.iter().flatten().flatten().count();
        let sigma_mm = instrument.sigma_mm.is_some();
        let point = |i: usize| samples.coordinates(i).iter().any(|v| !v.is_nan());
        let kind = |count, counted, sigma_key, stated| Measured {
            count,
            counted,
            sigma_key,
            stated,
        };
        let points = count(&point);
        let stated = sigma_mm || instrument.tracker.is_some();
        let turned = count(&|i| samples.is_turned(i));
        let (distances, directions) = (number(&own.distance_mm), number(&own.azimuth));
        let (held, touched) = (name(&own.socket), name(&own.plane));
        let all = [
            kind(
                points,
                text!(one "{count} point", "{count} points", count = points),
                "sigma_mm",
                stated,
            ),
            kind(
                turned,
                text!(one "{count} orientation", "{count} orientations", count = turned),
                "sigma_mrad",
                instrument.sigma_orientation.is_some(),
            ),
            kind(
                distances,
                text!(one "{count} distance", "{count} distances", count = distances),
                "sigma_distance_mm",
                instrument.sigma_distance_mm.is_some(),
            ),
            kind(
                directions,
                text!(one "{count} direction", "{count} directions", count = directions),
                "sigma_direction_urad",
                instrument.sigma_direction.is_some(),
            ),
            kind(
                held,
                text!(
                    one "{count} target in a socket",
                    "{count} targets in sockets",
                    count = held
                ),
                "sigma_mm",
                sigma_mm,
            ),
            kind(
                touched,
                text!(one "{count} touch", "{count} touches", count = touched),
                "sigma_touch_mm",
                instrument.sigma_touch_mm.is_some(),
            ),
        ];
        all.into_iter().filter(|kind| kind.count > 0).collect()
    }
}

/// Where a cell is: column, then row, both counted from 0.
pub(crate) type Locate<'a> = &'a dyn Fn(usize, usize) -> Place;
