//! Records for other programs: a table as CSV, a test report as JUnit XML, a page as HTML.

use sweep::Record;
use sweep::influence::Influence;
use sweep::summary::{Summary, Title};

/// Maximum number of failing worlds that the page lists.
const MAX_LISTED: usize = 500;

/// The records as a table: a row for each world, a column for each draw, expectation and measure.
pub(crate) fn csv(records: &[Record]) -> String {
    let fixed = [
        "world", "outcome", "class", "cause", "bodies", "faults", "time", "steps", "distance",
        "hash",
    ];
    let draws = names(
        records
            .iter()
            .flat_map(|r| r.draws.iter().map(|(name, _)| name)),
    );
    let expected = names(
        records
            .iter()
            .flat_map(|r| r.expectations.iter().map(|(name, _)| name)),
    );
    let measures = names(
        records
            .iter()
            .flat_map(|r| r.measures.iter().map(|(name, _)| name)),
    );
    let mut head: Vec<String> = fixed.map(str::to_owned).to_vec();
    head.extend(draws.iter().map(|name| (*name).to_owned()));
    head.extend(expected.iter().map(|name| format!("expect {name}")));
    head.extend(measures.iter().map(|name| format!("measure {name}")));
    let mut text = row(&head);
    for record in records {
        let mut cells = vec![
            record.world.to_string(),
            record.outcome.to_string(),
            record.class.clone().unwrap_or_default(),
            record.cause.clone().unwrap_or_default(),
            record.bodies.join("/"),
            record.faults.join(" "),
            record.time.to_string(),
            record.steps.to_string(),
            record.distance.to_string(),
            record.hash.clone(),
        ];
        let shown = |value: Option<String>| value.unwrap_or_default();
        cells.extend(
            draws
                .iter()
                .map(|n| shown(record.draws.get(n).map(ToString::to_string))),
        );
        cells.extend(
            expected
                .iter()
                .map(|n| shown(record.expectations.get(n).map(ToString::to_string))),
        );
        cells.extend(
            measures
                .iter()
                .map(|n| shown(record.measures.get(n).map(ToString::to_string))),
        );
        text.push_str(&row(&cells));
    }
    text
}

/// Names in the order in which they first occur.
fn names<'r>(all: impl Iterator<Item = &'r str>) -> Vec<&'r str> {
    let mut names = Vec::new();
    for name in all {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
}

/// A row, as RFC 4180 has it. No cell is a formula: one that a spreadsheet would take for one begins with
/// an apostrophe.
fn row(cells: &[String]) -> String {
    let quoted = |cell: &String| {
        let is_number = cell.parse::<f64>().is_ok();
        let is_formula = !is_number && cell.starts_with(['=', '+', '-', '@', '\t', '\r']);
        let cell = if is_formula {
            format!("'{cell}")
        } else {
            cell.clone()
        };
        match cell.contains([',', '"', '\n', '\r']) {
            true => format!("\"{}\"", cell.replace('"', "\"\"")),
            false => cell,
        }
    };
    let cells: Vec<String> = cells.iter().map(quoted).collect();
    cells.join(",") + "\r\n"
}

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
        cases.push((format!("success at least {} %", 100.0 * goal), failure));
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

/// A page with the summary and the worlds that failed.
pub(crate) fn html(title: &Title, records: &[Record]) -> String {
    let summary = Summary::new(title, records);
    let name = escaped(&title.name);
    let mut text = format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{name}</title><style>\n\
         body {{ font: 15px/1.4 system-ui, sans-serif; margin: 2em; }}\n\
         table {{ border-collapse: collapse; }} td, th {{ padding: .2em .8em; text-align: left; \
         border-bottom: 1px solid #ccc; }}\n.bar {{ width: 30em; background: #b33; }} .bar div {{ \
         background: #383; height: 1em; }}\n</style></head><body>\n<h1>{name}</h1>\n\
         <div class=\"bar\"><div style=\"width: {:.1}%\"></div></div>\n<pre>{}{}</pre>\n",
        100.0 * summary.rate(),
        escaped(&summary.to_string()),
        escaped(&Influence::of(records).to_string()),
    );
    text.push_str(&table(records, MAX_LISTED));
    text + "</body></html>\n"
}

/// The rate as a bar, and a table of the worlds that failed, `most` at most, for a page that has more
/// on it; the summary is told elsewhere.
pub(crate) fn fragment(title: &Title, records: &[Record], most: usize) -> String {
    let summary = Summary::new(title, records);
    let share = 100.0 * summary.rate();
    let name = escaped(&title.name);
    let bar = format!(
        "<p><b>{name}</b>: {share:.1} % of {}</p>\n\
         <div style=\"width: 30em; background: #b33\">\
         <div style=\"width: {share:.1}%; height: 1em; background: #383\"></div></div>\n",
        summary.tried
    );
    match failed(records).next() {
        Some(_) => bar + &table(records, most),
        None => bar,
    }
}

/// The worlds in which the plan did not work, and those that planwright could not run.
fn failed(records: &[Record]) -> impl Iterator<Item = &Record> {
    let known = |r: &&Record| r.outcome.counts() || r.outcome.is_defect();
    records.iter().filter(known).filter(|r| !r.is_success())
}

/// A table of the worlds that failed.
fn table(records: &[Record], most: usize) -> String {
    let mut text = "<table><tr><th>world</th><th>outcome</th><th>class</th><th>cause</th>\
                    <th>draws</th></tr>\n"
        .to_owned();
    for record in failed(records).take(most) {
        let draws = record.draws.iter().map(|(n, v)| format!("{n} {v}"));
        let draws: Vec<String> = draws.collect();
        let cause = record.cause.clone().unwrap_or_default();
        let cells = [
            record.world.to_string(),
            record.outcome.to_string(),
            record.class.clone().unwrap_or_default(),
            [cause, record.bodies.join("/")].join(" "),
            draws.join(", "),
        ];
        let cells = cells.iter().map(|c| format!("<td>{}</td>", escaped(c)));
        let cells: Vec<String> = cells.collect();
        text.push_str(&format!("<tr>{}</tr>\n", cells.concat()));
    }
    text + "</table>\n"
}

/// A text as XML and HTML have it.
pub(crate) fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            // XML has no other control characters.
            c if c.is_control() && !matches!(c, '\n' | '\t') => escaped.push(' '),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;
    use sweep::{Drawn, Ending};

    fn records() -> Vec<Record> {
        let mut records: Vec<Record> = (0..3).map(|i| Record::new(i, Ending::Success)).collect();
        records[1].outcome = Ending::Expectation;
        records[1].class = Some("a < \"b\"".to_owned());
        records[1]
            .draws
            .set("kind", Drawn::Text("A, \"B\"".to_owned()));
        for record in &mut records {
            record.expectations.set("a < \"b\"", record.world != 1);
        }
        records
    }

    #[test]
    fn cells_are_quoted() {
        let text = csv(&records());
        assert!(text.starts_with("world,outcome,class,"), "{text}");
        assert!(
            text.contains("\r\n1,expectation,\"a < \"\"b\"\"\","),
            "{text}"
        );
        assert!(text.contains(",\"A, \"\"B\"\"\",false\r\n"), "{text}");
    }

    #[test]
    fn no_cell_is_a_formula() {
        let cells = [
            "=1+2",
            "-1.5e3",
            "+cmd|' /C calc'!A0",
            "-x",
            "@sum(a)",
            "a=b",
            "-",
            "",
        ];
        let cells = cells.map(str::to_owned);
        assert_eq!(
            row(&cells),
            "'=1+2,-1.5e3,'+cmd|' /C calc'!A0,'-x,'@sum(a),a=b,'-,\r\n"
        );
    }

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
}
