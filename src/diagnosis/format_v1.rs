//! `truepose-diagnosis/1`.
