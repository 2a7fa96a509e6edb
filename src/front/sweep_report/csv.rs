//! Records as a table for other programs (CSV, RFC 4180).

use sweep::Record;

use super::names::names;

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

/// A row, as RFC 4180 has it. No cell is a formula: one that a spreadsheet would take for one begins with
/// an apostrophe.
pub(crate) fn row(cells: &[String]) -> String {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sweep_report::names::records;

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
}
