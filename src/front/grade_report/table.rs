//! The table of a class, as text.

use super::{Graded, Task};
use lisp::visible::visible;

/// A line for each submission, then which steps were missed how often.
pub(crate) fn table(task: &Task, all: &[Graded]) -> String {
    let mut text = format!(
        "{}   seed {}   {} worlds\n",
        visible(&task.title),
        task.seed,
        task.worlds
    );
    let names: Vec<String> = all
        .iter()
        .map(|one| visible(&one.student).into_owned())
        .collect();
    let width = names
        .iter()
        .map(|name| name.chars().count())
        .max()
        .unwrap_or(0);
    for (one, name) in all.iter().zip(&names) {
        let (passed, tried) = one.passed();
        let mut line = format!("{name:width$}  {passed:>3} of {tried}");
        if let Some((why, count)) = one.reasons().first() {
            line.push_str(&format!("  {count} × {}", visible(why)));
        }
        match one.style.len() {
            0 => {}
            1 => line.push_str("  (1 remark on style)"),
            n => line.push_str(&format!("  ({n} remarks on style)")),
        }
        text.push_str(&line);
        text.push('\n');
    }
    let passed = all.iter().filter(|one| one.is_passed()).count();
    text.push_str(&format!("{passed} of {} passed\n", all.len()));
    for (step, _) in &task.steps {
        let missed = all.iter().filter(|one| one.undone(step) > 0).count();
        if missed > 0 {
            text.push_str(&format!(
                "  {}: not done in each world by {missed}\n",
                visible(step)
            ));
        }
    }
    text
}
