//! The grasps that a session knows.

use std::cell::OnceCell;
use std::ops::Deref;
use std::sync::Arc;

use robotics::world::grasp_library::{GRASPS, GraspLibrary};

/// The built-in grasps, which are read when they are first needed, and those that plans have defined.
/// Copies share them until one changes them.
#[derive(Clone, Default)]
pub(crate) struct KnownGrasps(OnceCell<Arc<GraspLibrary>>);

/// Reads the built-in grasps. Tests do so too; if there were an error, no grasp would be known.
fn built_in() -> Arc<GraspLibrary> {
    let read = GraspLibrary::from_sexp(GRASPS, "grasps.sexp");
    Arc::new(read.unwrap_or_else(|_| GraspLibrary::empty()))
}

impl KnownGrasps {
    /// The names of the built-in grasps, of all types.
    pub(crate) fn built_in_names() -> Vec<String> {
        built_in().names().map(str::to_owned).collect()
    }

    /// Changes what is known.
    pub(crate) fn change<T>(&mut self, change: impl FnOnce(&mut GraspLibrary) -> T) -> T {
        let mut library = self.0.take().unwrap_or_else(built_in);
        let result = change(Arc::make_mut(&mut library));
        self.0 = OnceCell::from(library);
        result
    }
}

impl Deref for KnownGrasps {
    type Target = GraspLibrary;

    fn deref(&self) -> &GraspLibrary {
        self.0.get_or_init(built_in)
    }
}
