//! Random numbers: one stream for each thing that is drawn.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// Which stream of the seed something random comes from.
#[derive(Debug, Clone, Copy)]
pub(super) enum Stream {
    Order = 1,
    Circumstances = 2,
    Noise = 3,
    Outliers = 4,
    Kinds = 5,
}

pub(super) fn random(seed: u64, stream: Stream) -> ChaCha8Rng {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(stream as u64);
    random
}
