//! What others work out about something and keep with it, so that it lives as long: what is drawn
//! of a session stays with the session, which need not know what that is.

use std::any::Any;
use std::sync::{Arc, OnceLock};

/// See the module. Holds things of one type.
#[derive(Debug, Clone, Default)]
pub(crate) struct Attached(OnceLock<Arc<dyn Any + Send + Sync>>);

impl Attached {
    /// What is attached; made now if nothing is.
    ///
    /// # Panics
    /// Something of another type is attached.
    pub(crate) fn get_or_make<T: Any + Send + Sync>(&self, make: impl FnOnce() -> T) -> Arc<T> {
        let there = self.0.get_or_init(|| Arc::new(make()));
        let there = Arc::clone(there).downcast::<T>();
        there.expect("one type of thing is attached")
    }
}
