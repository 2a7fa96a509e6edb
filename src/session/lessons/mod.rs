//! Lessons: what a learner has brought about, noted while it happens, and judged where no submission can
//! reach. The rest of lessons is written in Lisp (`plans/lib/lessons.plan`).

mod deeds;
mod grader;
mod lesson_file;

pub(crate) use deeds::{Deed, Deeds, Witness, held};
pub use grader::{Allowance, Grader};
pub use lesson_file::{LessonFile, LessonPlan, LessonStep};
