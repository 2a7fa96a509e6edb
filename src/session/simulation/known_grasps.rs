//! The grasps that a session knows.

use std::cell::OnceCell;
use std::ops::Deref;
use std::sync::Arc;

use robotics::motion::fit_grasps;
use robotics::world::Models;
use robotics::world::grasp_library::{GRASPS, GraspLibrary};

/// The built-in grasps, which are read when they are first needed, and those that plans have defined.
/// Copies share them until one changes them.
#[derive(Clone)]
pub(crate) struct KnownGrasps {
    /// The robot, whose hands they fit.
    models: Arc<Models>,
    library: OnceCell<Arc<GraspLibrary>>,
}

/// Reads the built-in grasps. Tests do so too; if there were an error, no grasp would be known.
fn built_in() -> GraspLibrary {
    let read = GraspLibrary::from_sexp(GRASPS, "grasps.sexp");
    read.unwrap_or_else(|_| GraspLibrary::empty())
}

/// The built-in grasps, as the hands of a robot take them.
fn built_in_for(models: &Models) -> Arc<GraspLibrary> {
    let mut library = built_in();
    fit_grasps(&mut library, models);
    Arc::new(library)
}

impl KnownGrasps {
    /// The built-in grasps with the hands of a robot.
    pub(crate) fn of(models: &Arc<Models>) -> Self {
        Self {
            models: Arc::clone(models),
            library: OnceCell::new(),
        }
    }

    /// From now on, the hands are those of another robot.
    pub(crate) fn fit(&mut self, models: &Arc<Models>) {
        self.models = Arc::clone(models);
        if self.library.get().is_some() {
            self.change(|library| fit_grasps(library, models));
        }
    }

    /// The names of the built-in grasps, of all types.
    pub(crate) fn built_in_names() -> Vec<String> {
        built_in().names().map(str::to_owned).collect()
    }

    /// Changes what is known.
    pub(crate) fn change<T>(&mut self, change: impl FnOnce(&mut GraspLibrary) -> T) -> T {
        let known = self.library.take();
        let mut library = known.unwrap_or_else(|| built_in_for(&self.models));
        let result = change(Arc::make_mut(&mut library));
        self.library = OnceCell::from(library);
        result
    }
}

impl Deref for KnownGrasps {
    type Target = GraspLibrary;

    fn deref(&self) -> &GraspLibrary {
        self.library.get_or_init(|| built_in_for(&self.models))
    }
}
