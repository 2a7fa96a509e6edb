//! The marks of a class as a test report for other programs (JUnit XML).

use super::{Graded, Task};
use crate::sweep_report::escaped;

/// A suite for each submission, with a case for each world.
pub(crate) fn junit(task: &Task, all: &[Graded]) -> String {
    let mut text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n".to_owned();
    for one in all {
        let failures = one.marks.iter().filter(|mark| !mark.is_passed()).count();
        text.push_str(&format!(
            "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{failures}\">\n",
            escaped(&one.student),
            one.marks.len()
        ));
        for mark in &one.marks {
            let start = format!(
                "    <testcase classname=\"{}\" name=\"{} world {}\"",
                escaped(&one.student),
                escaped(&task.name),
                mark.record.world
            );
            text.push_str(&match mark.is_passed() {
                true => format!("{start}/>\n"),
                false => format!(
                    "{start}>\n      <failure message=\"{0}\">{0}</failure>\n    </testcase>\n",
                    escaped(&mark.why)
                ),
            });
        }
        text.push_str("  </testsuite>\n");
    }
    text + "</testsuites>\n"
}
