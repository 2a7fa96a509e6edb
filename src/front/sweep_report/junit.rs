//! Records as a test report for other programs (JUnit XML).

use sweep::Record;
use sweep::summary::{Summary, Title};

use super::escape::escaped;
use super::names::names;

/// A test report: a case for the plan, for each expectation and for the goal, not for each world. Where
/// there is a goal, only that can fail: some worlds may.
pub(crate) fn junit(title: &Title, records: &[Record]) -> String {
    let summary = Summary::new(title, records);
    let tried = || records.iter().filter(|r| r.outcome.counts());
    let replay = |worlds: &[u64]| {
        let worlds: Vec<String> = worlds.iter().take(5).map(u64::to_string).collect();
        format!(
            "planwright sweep … --seed {} --replay {}",
            title.seed,
            worlds.join(" | ")
        )
    };
    let mut cases: Vec<(String, Option<String>)> = Vec::new();
    let mut case = |name: String, failing: Vec<u64>| {
        let count = failing.len();
        let failure = (count > 0)
            .then(|| format!("{count} of {} worlds: {}", summary.tried, replay(&failing)));
        cases.push((name, failure));
    };
    let worlds = |fails: &dyn Fn(&Record) -> bool| -> Vec<u64> {
        tried().filter(|r| fails(r)).map(|r| r.world).collect()
    };
    case(
        "the plan ends without a condition".to_owned(),
        worlds(&|r| !r.is_success() && r.outcome != sweep::Ending::Expectation),
    );
    for name in names(tried().flat_map(|r| r.expectations.iter().map(|(name, _)| name))) {
        let failing = worlds(&|r| r.expectations.get(name) == Some(&false));
        case(format!("expectation {name}"), failing);
    }
    if let Some(goal) = title.goal {
        // The goal says how many may fail.
        for (_, failure) in &mut cases {
            *failure = None;
        }
        let failure = (!summary.meets_goal()).then(|| {
            let failing = worlds(&|r| !r.is_success());
            format!(
                "{:.1} % of {} worlds: {}",
                100.0 * summary.rate(),
                summary.tried,
                replay(&failing)
            )
        });
        cases.push((format!("success at least {} %", percent(goal)), failure));
    }
    if summary.defects() > 0 {
        let defective = records.iter().filter(|r| r.outcome.is_defect());
        let defective: Vec<u64> = defective.map(|r| r.world).collect();
        let count = defective.len();
        let why = format!("{count} worlds not counted: {}", replay(&defective));
        cases.push(("planwright can run all worlds".to_owned(), Some(why)));
    }
    let failures = cases
        .iter()
        .filter(|(_, failure)| failure.is_some())
        .count();
    let mut text = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n  <testsuite name=\"{}\" tests=\"{}\" failures=\"{failures}\">\n",
        escaped(&title.name),
        cases.len()
    );
    for (name, failure) in &cases {
        let start = format!(
            "    <testcase classname=\"{}\" name=\"{}\"",
            escaped(&title.name),
            escaped(name)
        );
        text.push_str(&match failure {
            None => format!("{start}/>\n"),
            Some(why) => format!(
                "{start}>\n      <failure message=\"{0}\">{0}</failure>\n    </testcase>\n",
                escaped(why)
            ),
        });
    }
    text + "  </testsuite>\n</testsuites>\n"
}

/// A share in percent, without what a number of single precision adds to it.
fn percent(share: f64) -> String {
    let text = format!("{:.2}", 100.0 * share);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sweep_report::names::records;

    #[test]
    fn a_case_stands_for_an_expectation_of_all_worlds() {
        let mut title = Title {
            name: "s".to_owned(),
            seed: 4,
            goal: None,
        };
        let text = junit(&title, &records());
        assert!(text.contains("tests=\"2\" failures=\"1\""), "{text}");
        assert!(
            text.contains("1 of 3 worlds: planwright sweep … --seed 4 --replay 1"),
            "{text}"
        );
        title.goal = Some(0.5);
        let text = junit(&title, &records());
        assert!(text.contains("tests=\"3\" failures=\"0\""), "{text}");
    }

    #[test]
    fn a_goal_has_no_digits_that_nobody_wrote() {
        assert_eq!(percent(f64::from(0.95_f32)), "95");
        assert_eq!(percent(0.9875), "98.75");
    }
}
