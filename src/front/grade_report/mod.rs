//! What came of the submissions to a lesson, as text, tables and pages.

mod class_page;
mod csv;
mod junit;
mod student_page;
mod table;

use sweep::{Ending, Mark};

pub(crate) use class_page::class_page;
pub(crate) use csv::csv;
pub(crate) use junit::junit;
pub(crate) use student_page::student_page;
pub(crate) use table::table;

/// What was graded.
#[derive(Clone, Debug)]
pub(crate) struct Task {
    /// The lesson's name.
    pub(crate) name: String,
    /// Its title.
    pub(crate) title: String,
    /// Names and texts of its steps.
    pub(crate) steps: Vec<(String, String)>,
    /// The seed of the worlds.
    pub(crate) seed: u64,
    /// How many there are.
    pub(crate) worlds: u64,
}

/// What came of a submission.
#[derive(Clone, Debug, Default)]
pub(crate) struct Graded {
    /// Who has handed it in: the name of the file, without its folder and its ending.
    pub(crate) student: String,
    /// The file, as it was named.
    pub(crate) file: String,
    /// Its text; empty if it cannot be read.
    pub(crate) text: String,
    /// One for each world, in order.
    pub(crate) marks: Vec<Mark>,
    /// What `check` remarks.
    pub(crate) style: Vec<String>,
    /// The number of a world that was not passed, and the page with its run.
    pub(crate) replay: Option<(u64, String)>,
}

impl Graded {
    /// In how many worlds it was passed, and in how many it could be.
    pub(crate) fn passed(&self) -> (usize, usize) {
        let tried = self
            .marks
            .iter()
            .filter(|mark| mark.record.outcome != Ending::Invalid);
        let passed = self.marks.iter().filter(|mark| mark.is_passed());
        (passed.count(), tried.count())
    }

    /// Whether it was passed in each world.
    pub(crate) fn is_passed(&self) -> bool {
        let (passed, tried) = self.passed();
        passed == tried && tried > 0
    }

    /// Why it was not passed, and in how many worlds, the most frequent reason first.
    pub(crate) fn reasons(&self) -> Vec<(&str, usize)> {
        let mut reasons: Vec<(&str, usize)> = Vec::new();
        for mark in self.marks.iter().filter(|mark| !mark.why.is_empty()) {
            match reasons.iter_mut().find(|(why, _)| *why == mark.why) {
                Some((_, count)) => *count += 1,
                None => reasons.push((&mark.why, 1)),
            }
        }
        reasons.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
        reasons
    }

    /// In how many worlds a step was not done.
    pub(crate) fn undone(&self, step: &str) -> usize {
        let undone = self.marks.iter().filter(|mark| {
            mark.record.outcome != Ending::Invalid
                && mark.record.expectations.get(step) != Some(&true)
        });
        undone.count()
    }
}
