//! Any bytes as a stream that is recorded: however it is cut, the file is the same, and every row of
//! it has as many cells as its headings.
#![no_main]

use std::io::{BufRead, Read};

use libfuzzer_sys::fuzz_target;
use truepose::recorder::{Recorder, record};

fn recorded(mut stream: impl BufRead) -> Option<Vec<u8>> {
    let mut file = Vec::new();
    let mut put = |row: &str| {
        file.extend_from_slice(row.as_bytes());
        Ok(())
    };
    let mut recorder = Recorder::new(Vec::new());
    record(&mut stream, &mut recorder, u64::MAX, &mut put, &mut |_| ()).ok()?;
    Some(file)
}

fuzz_target!(|data: &[u8]| {
    let Some((&at, stream)) = data.split_first() else {
        return;
    };
    let (first, second) = stream.split_at(usize::from(at).min(stream.len()));
    assert_eq!(recorded(stream), recorded(first.chain(second)));
});
