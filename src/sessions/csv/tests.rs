use super::*;
use crate::sessions::columns::Quantity;

const ONE: &[JointKind] = &[JointKind::Revolute];

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
    let table = read(
        Pieces(bytes, piece),
        None,
        &Place::file("s.csv"),
        Some(ONE),
        &mut findings,
    );
    let findings = findings.iter().map(ToString::to_string).collect();
    (table.expect("memory does not fail"), findings)
}

fn numbers(table: &Table, quantity: Quantity) -> &[f64] {
    let at = table.layout.headings.iter().position(
        |heading| matches!(heading, crate::sessions::columns::Heading::Known(q, _) if *q == quantity),
    );
    match &table.columns[at.expect("the column is there")] {
        Cells::Numbers(values) => values,
        _ => panic!("not a column of numbers"),
    }
}

#[test]
fn a_plain_file_is_read_with_lines() {
    let (table, findings) = read_text("q1_deg,x_mm,y_mm\n1,2.5,-3e2\n\n4,5,6");
    let table = table.unwrap();
    assert_eq!(findings, [""; 0]);
    assert_eq!(numbers(&table, Quantity::Y), [-300.0, 6.0]);
    assert_eq!(table.line, [2, 4]);
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
        table.line,
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
    assert!(numbers(&table.unwrap(), Quantity::Load)[0].is_nan());
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
    assert_eq!(
        numbers(&table.unwrap(), Quantity::Commanded(0)),
        [1.0, 1.0, 7.0]
    );
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
    for (i, y) in numbers(&table, Quantity::Y).iter().enumerate() {
        assert_eq!(y.to_bits(), (i as f64 * 0.001).cos().to_bits(), "row {i}");
    }
}

#[test]
fn a_quoted_cell_longer_than_a_block_is_read_whole() {
    let long = "line\n".repeat(200_000);
    let (table, findings) = read_text(&format!(
        "q1_deg,x_mm,y_mm,remark\n1,2,3,\"{long}\"\n4,5,6,x\n"
    ));
    assert!(
        findings.len() == 1,
        "only the note on the unknown column: {findings:?}"
    );
    let table = table.unwrap();
    assert_eq!(table.columns[3], Cells::Text(vec![long, "x".into()]));
    assert_eq!(table.line, [2, 200_003]);
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
