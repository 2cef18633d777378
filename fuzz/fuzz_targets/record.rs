//! Any bytes as a stream that is recorded: however it is cut, the file is the same, and every row of
//! it has as many cells as its headings.
#![no_main]

use libfuzzer_sys::fuzz_target;
use truepose::recorder::Recorder;

fn recorded(pieces: &[&[u8]]) -> Option<Vec<u8>> {
    let mut recorder = Recorder::new(|| Ok(Vec::new()), Vec::new());
    for piece in pieces {
        recorder.take(piece, u64::MAX).ok()?;
    }
    recorder.end_of_stream();
    recorder.out().cloned()
}

fuzz_target!(|data: &[u8]| {
    let Some((&at, stream)) = data.split_first() else {
        return;
    };
    let (first, second) = stream.split_at(usize::from(at).min(stream.len()));
    assert_eq!(recorded(&[stream]), recorded(&[first, second]));
});
