//! The marks of a class as a table for other programs (CSV, RFC 4180).

use super::{Graded, Task};
use crate::sweep_report::row;

/// A row for each submission and world, a column for each step.
pub(crate) fn csv(task: &Task, all: &[Graded]) -> String {
    let fixed = [
        "student", "file", "world", "passed", "outcome", "class", "cause", "line", "why", "time",
        "distance", "style",
    ];
    let mut head = fixed.map(str::to_owned).to_vec();
    head.extend(task.steps.iter().map(|(name, _)| format!("step {name}")));
    let mut text = row(&head);
    for one in all {
        for mark in &one.marks {
            let record = &mark.record;
            let mut cells = vec![
                one.student.clone(),
                one.file.clone(),
                record.world.to_string(),
                mark.is_passed().to_string(),
                record.outcome.to_string(),
                record.class.clone().unwrap_or_default(),
                record.cause.clone().unwrap_or_default(),
                mark.line.clone().unwrap_or_default(),
                mark.why.clone(),
                record.time.to_string(),
                record.distance.to_string(),
                one.style.len().to_string(),
            ];
            cells.extend(task.steps.iter().map(|(name, _)| {
                let done = record.expectations.get(name);
                done.map(ToString::to_string).unwrap_or_default()
            }));
            text.push_str(&row(&cells));
        }
    }
    text
}
