use proptest::prelude::*;

use super::rows::MOST_COMPLAINTS;
use super::*;
use crate::progress::{Progress, unwatched};

/// A table as it was read.
#[derive(Debug, PartialEq)]
struct Table {
    names: Vec<String>,
    columns: Vec<Cells>,
    line: Lines,
}

impl Table {
    fn rows(&self) -> usize {
        self.columns[0].len()
    }
}

/// What the headings of these tests say.
fn kind(name: &str) -> CellKind {
    match name {
        "setup" | "target" => CellKind::Name,
        "remark" => CellKind::Text,
        _ => CellKind::Number,
    }
}

fn read_text(text: &str) -> (Option<Table>, Vec<String>) {
    read_in_pieces(text.as_bytes(), usize::MAX)
}

/// A reader that hands out a few bytes at a time.
struct Pieces<'a>(&'a [u8], usize);

impl Read for Pieces<'_> {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let count = self.0.len().min(self.1).min(into.len());
        into[..count].copy_from_slice(&self.0[..count]);
        self.0 = &self.0[count..];
        Ok(count)
    }
}

fn read_in_pieces(bytes: &[u8], piece: usize) -> (Option<Table>, Vec<String>) {
    let mut findings = Vec::new();
    let (file, progress) = (Place::file("s.csv"), Progress::new(&unwatched));
    let pieces = Pieces(bytes, piece);
    let table = SampleTable::open(pieces, &file, &mut findings).expect("memory does not fail");
    let table = table.map(|mut table| {
        let names = table.names.clone();
        let kinds = names.iter().map(|name| kind(name));
        let read = table.rows(kinds, None, &file, &mut findings, progress.whole());
        let (columns, line) = read.expect("memory does not fail");
        Table {
            names,
            columns,
            line,
        }
    });
    let findings = findings.iter().map(ToString::to_string).collect();
    (table, findings)
}

fn numbers<'t>(table: &'t Table, name: &str) -> &'t [f64] {
    let at = table.names.iter().position(|other| other == name);
    match &table.columns[at.expect("the column is there")] {
        Cells::Numbers(values) => values,
        _ => panic!("not a column of numbers"),
    }
}

fn lines(table: &Table) -> Vec<u64> {
    (0..).map_while(|row| table.line.get(row)).collect()
}

#[test]
fn a_plain_file_is_read_with_lines() {
    let (table, findings) = read_text("q1_deg,x_mm,y_mm\n1,2.5,-3e2\n\n4,5,6");
    let table = table.unwrap();
    assert_eq!(findings, [""; 0]);
    assert_eq!(numbers(&table, "y_mm"), [-300.0, 6.0]);
    assert_eq!(lines(&table), [2, 4]);
}

#[test]
fn byte_order_mark_crlf_quotes_and_spaces_change_nothing() {
    let plain = read_text(
        "q1_deg,x_mm,y_mm,setup,remark\n1,2,3,a,so\n4,5,6,b,\"a, \"\"b\"\"\n\"\n7,8,9,b,x\n",
    );
    let other = read_text(
        "\u{feff}q1_deg,\"x_mm\",y_mm,setup,remark\r\n 1,\"2\",3 ,a,so\r\n4,5,6,\"b\",\"a, \"\"b\"\"\n\"\r\n7,8,9,b,x\r\n",
    );
    assert_eq!(plain, other);
    let table = plain.0.unwrap();
    assert_eq!(
        lines(&table),
        [2, 3, 5],
        "a line feed in quotes is a line of the file"
    );
    assert_eq!(
        table.columns[4],
        Cells::Text(vec!["so".into(), "a, \"b\"\n".into(), "x".into()])
    );
}

#[test]
fn an_empty_cell_is_missing_and_nothing_else_is() {
    let (table, findings) =
        read_text("q1_deg,x_mm,y_mm,load_kg\n1,,3,\n1,2,nan,inf\n1,2,1e999,NaN\n");
    assert!(numbers(&table.unwrap(), "load_kg")[0].is_nan());
    assert_eq!(findings.len(), 4);
    assert!(
        findings[0].starts_with("s.csv, line 3, column 3, y_mm: 'nan'"),
        "{findings:?}"
    );
    assert!(findings[2].contains("a double can hold"), "{findings:?}");
}

#[test]
fn a_ragged_row_is_named_and_does_not_shift_the_next() {
    let (table, findings) = read_text("q1_deg,x_mm,y_mm\n1,2\n1,2,3,4,5\n7,8,9\n");
    assert_eq!(
        findings,
        [
            "s.csv, line 2, column 2: the line ends after 2 cells; expected 3 cells, one for each heading",
            "s.csv, line 3, column 4: 5 cells; expected 3 cells, one for each heading; a file with \
             decimal commas is read by `truepose import --decimal ,`",
        ]
    );
    assert_eq!(numbers(&table.unwrap(), "q1_deg"), [1.0, 1.0, 7.0]);
}

#[test]
fn a_thousand_complaints_become_a_number() {
    let text = format!("q1_deg,x_mm,y_mm\n{}", "1,2,z\n".repeat(1000));
    let (_, findings) = read_text(&text);
    assert_eq!(findings.len(), MOST_COMPLAINTS + 1);
    assert!(
        findings[MOST_COMPLAINTS].contains("950 more"),
        "{findings:?}"
    );
}

#[test]
fn where_the_blocks_are_cut_does_not_matter() {
    use std::fmt::Write as _;
    let mut text = String::from("q1_deg,x_mm,y_mm,z_mm,target,remark\n");
    for i in 0..20_000 {
        let v = f64::from(i) * 0.001;
        let quote = if i % 97 == 0 { "\"a\n\"\"b\"" } else { "c" };
        writeln!(
            text,
            "{v},{},{},{},T{},{quote}",
            v.sin(),
            v.cos(),
            -v,
            i % 5
        )
        .unwrap();
    }
    let whole = read_in_pieces(text.as_bytes(), usize::MAX);
    assert_eq!(whole.0.as_ref().unwrap().rows(), 20_000);
    assert_eq!(whole, read_in_pieces(text.as_bytes(), 7));
    assert_eq!(whole, read_in_pieces(text.as_bytes(), 65_537));
    let Some(table) = whole.0 else { unreachable!() };
    for (i, y) in numbers(&table, "y_mm").iter().enumerate() {
        assert_eq!(y.to_bits(), (i as f64 * 0.001).cos().to_bits(), "row {i}");
    }
}

#[test]
fn a_quoted_cell_longer_than_a_block_is_read_whole() {
    let long = "line\n".repeat(200_000);
    let (table, findings) = read_text(&format!(
        "q1_deg,x_mm,y_mm,remark\n1,2,3,\"{long}\"\n4,5,6,x\n"
    ));
    assert_eq!(findings, [""; 0]);
    let table = table.unwrap();
    assert_eq!(table.columns[3], Cells::Text(vec![long, "x".into()]));
    assert_eq!(lines(&table), [2, 200_003]);
}

#[test]
fn a_quote_that_never_closes_is_said_once() {
    let (_, findings) = read_text("q1_deg,x_mm,y_mm,target\n1,2,3,\"T1\n4,5,6,T1\n");
    assert_eq!(findings.len(), 1, "{findings:?}");
    assert!(
        findings[0].starts_with("s.csv, line 2, column 4, target: a quote"),
        "{findings:?}"
    );
}

#[test]
fn other_dialects_are_recognised_and_sent_to_import() {
    for (text, says) in [
        ("q1_deg;x_mm;y_mm\n1,0;2,0;3,0\n", "semicolons"),
        ("q1_deg\tx_mm\ty_mm\n1\t2\t3\n", "tabs"),
        ("1.0,2.0,3.0\n4,5,6\n", "without headings"),
    ] {
        let (table, findings) = read_text(text);
        assert!(table.is_none());
        assert!(
            findings[0].contains(says) && findings[0].contains("truepose import"),
            "{findings:?}"
        );
    }
}

/// A file that has everything in it that ends a stretch, each a few hundred rows from the next.
fn regular_rows_with_exceptions(line_end: &str) -> String {
    let mut text = format!("q1_deg,x_mm,y_mm,load_kg,target,remark{line_end}");
    for i in 0..30_000_usize {
        let v = i as f64 * 0.37;
        let load = ["3", "", "2.50", "1e-5", "-0", ".5", " 7 "][i % 7];
        let row = match i {
            700 => "1,2,3".to_owned(),
            1_400 => "1,2,3,4,T1,a,b".to_owned(),
            2_100 => String::new(),
            2_800 => "1,2,3,4,\"T,1\",a".to_owned(),
            3_500 => "1,2,3,4,T1,\"a\nb\"".to_owned(),
            4_200 => "1,2,nan,4,T1,a".to_owned(),
            4_900 => "1,2,-,4,T1,a".to_owned(),
            5_600 => "1,2,3,.,T1,a".to_owned(),
            6_300 => "1,2,1.2.3,4,T1,a".to_owned(),
            7_000 => "1,2,1-2,4,T1,a".to_owned(),
            7_700 => "1,123456789012345,1234567890.12345,4,T1,a".to_owned(),
            8_400 => "1,9007199254740993,0.12345678901234567,1e300,T1,a".to_owned(),
            _ => format!("{v:.5},{},{:.3},{load}, T{},{i}", v.sin(), -v, i % 3),
        };
        text += &row;
        text += line_end;
    }
    text
}

#[test]
fn stretches_and_single_rows_say_the_same() {
    for line_end in ["\n", "\r\n"] {
        let text = regular_rows_with_exceptions(line_end);
        let at_once = read_text(&text);
        let findings = at_once.1.join("\n");
        for part in [
            "line 702",
            "line 1402",
            "line 4203",
            "line 4903",
            "1.2.3",
            "1-2",
        ] {
            assert!(findings.contains(part), "{part}: {findings}");
        }
        let file = Place::file("s.csv");
        let names: Vec<String> = at_once.0.as_ref().unwrap().names.clone();
        let take = |portable: bool, one_by_one: bool| {
            let table = at_once.0.as_ref().unwrap();
            let mut rows = Rows {
                columns: table
                    .names
                    .iter()
                    .map(|name| Cells::of(kind(name), 0))
                    .collect(),
                line: Lines::default(),
                next_line: 2,
                starts: Starts::new(),
                complaints: CellComplaints::new(&file, &names),
            };
            let mut bytes = text.as_bytes()[text.find('\n').unwrap() + 1..].to_vec();
            let end = bytes.len();
            bytes.resize(end + crate::document::number::PADDING, 0);
            let mut at = 0;
            while one_by_one && at < end {
                at = rows.take_line(&bytes, at, end, true).unwrap();
            }
            if !one_by_one && portable {
                assert_eq!(rows.take_with(&bytes, end, true, &stretch::PORTABLE), end);
            } else if !one_by_one {
                assert_eq!(rows.take(&bytes, end, true), end);
            }
            let bits: Vec<Vec<u64>> = rows
                .columns
                .iter()
                .filter_map(|column| match column {
                    Cells::Numbers(values) => Some(values.iter().map(|v| v.to_bits()).collect()),
                    _ => None,
                })
                .collect();
            let others: Vec<Cells> = rows.columns.drain(..).skip(4).collect();
            let mut findings = Vec::new();
            rows.complaints.into(&mut findings);
            (bits, others, rows.line, findings)
        };
        let single = take(false, true);
        assert_eq!(single.0[0].len(), 29_999);
        assert_eq!(take(true, false), single);
        assert_eq!(take(false, false), single);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn every_cell_of_a_stretch_equals_the_standard_library_to_the_last_bit(
        cells in prop::collection::vec("-?[0-9]{1,9}(\\.[0-9]{0,9})?|-?\\.[0-9]{1,16}|[0-9]{14,17}", 3..300),
    ) {
        let mut text = "q1_deg,x_mm,y_mm\n".to_owned();
        for row in cells.chunks_exact(3) {
            text += &row.join(",");
            text.push('\n');
        }
        let (table, findings) = read_text(&text);
        prop_assert_eq!(findings, [""; 0]);
        let table = table.unwrap();
        for (column, name) in ["q1_deg", "x_mm", "y_mm"].into_iter().enumerate() {
            let bits: Vec<u64> = numbers(&table, name).iter().map(|v| v.to_bits()).collect();
            let expected: Vec<u64> = cells
                .chunks_exact(3)
                .map(|row| row[column].parse::<f64>().unwrap().to_bits())
                .collect();
            prop_assert_eq!(bits, expected);
        }
    }
}
