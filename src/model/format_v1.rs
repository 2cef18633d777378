//! `truepose-model/1` on disk.
