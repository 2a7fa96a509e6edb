//! A sweep as a page, and as a part of one.

use kitchens::{Division, KitchenTable};
use sweep::influence::Influence;
use sweep::summary::{Kind, Summary, Title};
use sweep::{Drawn, Record};
use view::watch::base64;

use super::escape::escaped;
use super::names::names;
use super::{axes, heat_map};

/// Maximum number of failing worlds that the page lists of each kind.
const MAX_LISTED: usize = 200;
/// Kinds with this many worlds or fewer are unfolded at first.
const MAX_UNFOLDED: usize = 12;

/// How pages about many worlds look.
pub(crate) const STYLE: &str = "\
:root { --paper: #fff; --ink: #1c2127; --soft: #5a646e; --line: #d4d9de; --good: #2c7a3f; --bad: #b3322b; }
@media (prefers-color-scheme: dark) {
  :root { --paper: #15191d; --ink: #e4e8eb; --soft: #9aa5af; --line: #343c44; --good: #4caf6a; --bad: #e0645c; }
}
* { box-sizing: border-box; }
body { font: 15px/1.45 system-ui, sans-serif; margin: 0 auto; padding: 16px; max-width: 1100px; background: var(--paper); color: var(--ink); }
h1 { font-size: 24px; margin: 0 0 8px; overflow-wrap: anywhere; } h2 { font-size: 18px; margin: 24px 0 8px; }
.bar { width: 100%; max-width: 30em; height: 14px; border-radius: 7px; overflow: hidden; background: var(--bad); } .bar div { height: 100%; background: var(--good); }
pre, code { font: 13px/1.5 ui-monospace, Menlo, Consolas, monospace; } pre { overflow-x: auto; }
details { border-top: 1px solid var(--line); padding: 6px 0; } summary { cursor: pointer; overflow-wrap: anywhere; } summary b { display: inline-block; min-width: 3em; }
.wide { overflow-x: auto; } table { border-collapse: collapse; margin: 8px 0; font-size: 13px; font-variant-numeric: tabular-nums; }
td, th { padding: 3px 10px; text-align: right; border-bottom: 1px solid var(--line); white-space: nowrap; } td:first-child, th:first-child { text-align: left; padding-left: 0; }
td.words, th.words { text-align: left; white-space: normal; }
img { max-width: 100%; height: auto; border-radius: 6px; } p { color: var(--soft); margin: 4px 0; }
";

/// A page with the summary, where the plan works, and the worlds that failed, by the kind of failure.
/// `file` is where the sweep is.
pub(crate) fn html(title: &Title, records: &[Record], file: &str) -> String {
    let summary = Summary::new(title, records);
    let name = escaped(&title.name);
    let mut text = format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\
         <meta name=\"color-scheme\" content=\"light dark\"><title>{name}</title>\
         <style>\n{STYLE}</style></head><body><main>\n<h1>{name}</h1>\n\
         <div class=\"bar\"><div style=\"width: {:.1}%\"></div></div>\n<pre tabindex=\"0\">{}{}</pre>\n",
        100.0 * summary.rate(),
        escaped(&summary.to_string()),
        escaped(&Influence::of(records).to_string()),
    );
    text.push_str(&where_it_works(records));
    if let Some(table) = KitchenTable::of(records) {
        text.push_str(&kitchens(&table));
    }
    let kinds = summary.kinds();
    if !kinds.is_empty() {
        text.push_str("<h2>Failures</h2>\n<p>A world is run again, and shown, with the command beside it.</p>\n");
    }
    for kind in &kinds {
        text.push_str(&kind_of_failure(
            title,
            records,
            file,
            kind,
            kinds.len() == 1,
        ));
    }
    text + "</main></body></html>\n"
}

/// A picture of the share of successes over the two draws that explain most.
fn where_it_works(records: &[Record]) -> String {
    let picture = axes(records).and_then(|[x, y]| {
        let png = heat_map(records, [&x, &y])?.to_png().ok()?;
        Some((x, y, base64(&png)))
    });
    match picture {
        Some((x, y, png)) => format!(
            "<h2>Where it works</h2>\n<p>The share of successes by {0} (to the right) and {1} (up): green for \
             all, red for none, hatched for fewer than five worlds.</p>\n\
             <img src=\"data:image/png;base64,{png}\" alt=\"Successes by {0} and {1}\">\n",
            escaped(&x),
            escaped(&y)
        ),
        None => String::new(),
    }
}

/// Which kitchens fail, by what divides them, and which failures are the same in several.
fn kitchens(table: &KitchenTable) -> String {
    let mut text = format!(
        "<h2>Kitchens</h2>\n<p>{} of {} worlds fail, in {} of {} kitchens. What explains most comes first; the \
         interval is that of 95 %.</p>\n",
        table.failed, table.tried, table.failing_kitchens, table.kitchens
    );
    if table.failed == 0 {
        return text;
    }
    if !table.divisions.is_empty() {
        text.push_str(
            "<div class=\"wide\" tabindex=\"0\"><table><tr><td></td><th>fail</th><th>of</th><th>%</th>\
             <th>interval</th></tr>\n",
        );
        table
            .divisions
            .iter()
            .for_each(|division| text.push_str(&division_of_kitchens(division)));
        text.push_str("</table></div>\n");
    }
    text.push_str(
        "<div class=\"wide\" tabindex=\"0\"><table><tr><th>failure</th><th>worlds</th><th>kitchens</th>\
         <th class=\"words\">layouts</th></tr>\n",
    );
    for finding in &table.findings {
        let layouts = finding.layouts.iter();
        let layouts: Vec<String> = layouts
            .map(|(layout, count)| format!("{} {count}", escaped(layout)))
            .collect();
        text.push_str(&format!(
            "<tr><td>{}</td><td>{}</td><td>{}</td><td class=\"words\">{}</td></tr>\n",
            escaped(&finding.words()),
            finding.worlds.len(),
            finding.kitchens,
            layouts.join(", ")
        ));
    }
    text + "</table></div>\n"
}

/// The rows of a division of kitchens.
fn division_of_kitchens(division: &Division) -> String {
    let name = escaped(&division.name);
    let mut rows = format!(
        "<tr><th>{name}</th><td class=\"words\" colspan=\"4\">{}</td></tr>\n",
        division.verdict()
    );
    for row in &division.rows {
        let [low, high] = row.interval().map(|bound| 100.0 * bound);
        rows.push_str(&format!(
            "<tr><td>{}</td><td>{}</td><td>{}</td><td>{:.1}</td><td>{low:.1} – {high:.1}</td></tr>\n",
            escaped(&row.class),
            row.failed,
            row.tried,
            100.0 * row.rate()
        ));
    }
    rows
}

/// The worlds that failed in the same way, in columns of what was drawn.
fn kind_of_failure(
    title: &Title,
    records: &[Record],
    file: &str,
    kind: &Kind,
    is_only: bool,
) -> String {
    let [class, cause, bodies] = &kind.kind;
    let what: Vec<String> = [class, cause, bodies]
        .into_iter()
        .filter(|part| !part.is_empty())
        .map(|part| escaped(part))
        .collect();
    let of_kind = |record: &&Record| kind.worlds.binary_search(&record.world).is_ok();
    let shown: Vec<&Record> = records.iter().filter(of_kind).take(MAX_LISTED).collect();
    let columns = names(
        shown
            .iter()
            .flat_map(|r| r.draws.iter().map(|(name, _)| name)),
    );
    let head: String = columns
        .iter()
        .map(|name| cell("th", &escaped(name)))
        .collect();
    let rows: String = shown
        .iter()
        .map(|record| {
            let again = format!(
                "planwright sweep {file} {} --seed {} --replay {}",
                title.name, title.seed, record.world
            );
            let drawn: String = columns
                .iter()
                .map(|name| cell("td", &record.draws.get(name).map(short).unwrap_or_default()))
                .collect();
            format!(
                "<tr><td>{}</td>{drawn}<td><code>{}</code></td></tr>\n",
                record.world,
                escaped(&again)
            )
        })
        .collect();
    let more = kind.worlds.len().saturating_sub(shown.len());
    let more = match more {
        0 => String::new(),
        more => format!("<p>And {more} more.</p>\n"),
    };
    let open = match is_only || kind.worlds.len() <= MAX_UNFOLDED {
        true => " open",
        false => "",
    };
    format!(
        "<details{open}><summary><b>{}</b> {}</summary>\n<div class=\"wide\" tabindex=\"0\"><table><tr><th>world</th>{head}<td></td></tr>\n\
         {rows}</table></div>\n{more}</details>\n",
        kind.worlds.len(),
        what.join(" · ")
    )
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

/// A table of the worlds that failed, with a column for each draw.
fn table(records: &[Record], most: usize) -> String {
    let shown: Vec<&Record> = failed(records).take(most).collect();
    let columns = names(
        shown
            .iter()
            .flat_map(|r| r.draws.iter().map(|(name, _)| name)),
    );
    let head: String = ["world", "outcome", "class", "cause"]
        .iter()
        .chain(&columns)
        .map(|name| cell("th", &escaped(name)))
        .collect();
    let mut text = format!("<table><tr>{head}</tr>\n");
    for record in shown {
        let cause = record.cause.clone().unwrap_or_default();
        let cells = [
            record.world.to_string(),
            record.outcome.to_string(),
            record.class.clone().unwrap_or_default(),
            [cause, record.bodies.join("/")].join(" "),
        ];
        let drawn = columns.iter().map(|name| record.draws.get(name));
        let drawn = drawn.map(|drawn| drawn.map(short).unwrap_or_default());
        let cells = cells.iter().map(|text| escaped(text)).chain(drawn);
        let cells: String = cells.map(|text| cell("td", &text)).collect();
        text.push_str(&format!("<tr>{cells}</tr>\n"));
    }
    text + "</table>\n"
}

fn cell(kind: &str, text: &str) -> String {
    format!("<{kind}>{text}</{kind}>")
}

/// What was drawn, as HTML: numbers with three digits after the point.
fn short(drawn: &Drawn) -> String {
    match drawn {
        Drawn::Number(number) => format!("{number:.3}"),
        other => escaped(&other.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sweep_report::names::records;

    #[test]
    fn worlds_are_listed_by_their_kind_with_short_numbers_and_a_command() {
        let title = Title {
            name: "s".to_owned(),
            seed: 4,
            goal: None,
        };
        let mut records = records();
        records[1].draws.set("x", Drawn::Number(0.123_456_789));
        let text = html(&title, &records, "a<b.plan");
        assert!(text.contains("<th>kind</th><th>x</th>"), "{text}");
        assert!(
            text.contains("<td>A, &quot;B&quot;</td><td>0.123</td>"),
            "{text}"
        );
        let command = "<code>planwright sweep a&lt;b.plan s --seed 4 --replay 1</code>";
        assert!(text.contains(command), "{text}");
        let part = fragment(&title, &records, 9);
        assert!(part.contains("<td>0.123</td>"), "{part}");
    }
}
