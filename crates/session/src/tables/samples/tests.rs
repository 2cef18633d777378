use proptest::prelude::*;

use super::*;
use crate::progress::{Progress, unwatched};

/// A table as it was read.
#[derive(Debug, PartialEq)]
struct Table {
    names: Vec<String>,
    columns: Vec<Cells>,
    line: Lines,
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
    let mut findings = Vec::new();
    let (file, progress) = (Place::file("s.csv"), Progress::new(&unwatched));
    let table = SampleTable::open(text.as_bytes(), &file, &mut findings);
    let table = table.map(|table| {
        let names = table.names.clone();
        let kinds = names.iter().map(|name| kind(name));
        let read = table.rows(kinds, &file, &mut findings, progress.whole());
        let (columns, line) = read.unwrap();
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
            "s.csv, line 2, column 2: 2 cells; expected 3 cells, one for each heading",
            "s.csv, line 3, column 4: 5 cells; expected 3 cells, one for each heading; a decimal point; \
             decimal commas are read by `truepose import --decimal ,`",
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
fn a_long_quoted_cell_is_read_whole() {
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

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn every_number_equals_the_standard_library_to_the_last_bit(
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
