//! Where the cells of regular rows begin.

/// Bytes that are taken at once.
pub(super) const LONGEST: usize = 16 << 10;

/// So many ends in 64 bytes are noted down without a look at how many there are.
const AT_ONCE: usize = 12;

/// Marks commas and line feeds (a bit each, the first byte lowest) and quotes.
pub(super) trait Mark: Fn(&[u8; 64]) -> (u64, u64) {}
impl<F: Fn(&[u8; 64]) -> (u64, u64)> Mark for F {}

/// Where the cells of a stretch start.
pub(super) struct Starts {
    /// The first cell's, then what follows each comma and line feed; room for more behind `count`.
    pub(super) list: Vec<u32>,
    pub(super) count: usize,
}

impl Starts {
    pub(super) fn new() -> Self {
        Self {
            list: vec![0; LONGEST + 64 + AT_ONCE],
            count: 0,
        }
    }

    /// Looks through `lines`, at most a stretch; false where it has a quote in it.
    #[inline(always)]
    #[allow(clippy::inline_always, reason = "see Rows::take_with")]
    pub(super) fn find(&mut self, lines: &[u8], mark: &impl Mark) -> bool {
        self.list[0] = 0;
        self.count = 1;
        let (chunks, rest) = lines.as_chunks::<64>();
        let mut last = [0; 64];
        last[..rest.len()].copy_from_slice(rest);
        for (chunk, base) in chunks.iter().chain([&last]).zip((1..).step_by(64)) {
            let (mut ends, quotes) = mark(chunk);
            if quotes != 0 {
                return false;
            }
            let found = ends.count_ones() as usize;
            let Some(room) = self.list[self.count..].first_chunk_mut::<AT_ONCE>() else {
                return false;
            };
            for start in room {
                *start = base + ends.trailing_zeros();
                ends &= ends.wrapping_sub(1);
            }
            for start in self.list[self.count..self.count + found]
                .iter_mut()
                .skip(AT_ONCE)
            {
                *start = base + ends.trailing_zeros();
                ends &= ends.wrapping_sub(1);
            }
            self.count += found;
        }
        true
    }
}
