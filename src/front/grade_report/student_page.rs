//! A page about one submission.

use super::{Graded, Task};
use crate::sweep_report::{STYLE, escaped};
use sweep::Ending;

/// The page of a submission: what was done in which world, the run of a world in which it was not, remarks
/// and its text.
pub(crate) fn student_page(task: &Task, one: &Graded) -> String {
    let (passed, tried) = one.passed();
    let share = 100.0 * passed as f64 / tried.max(1) as f64;
    let mut text = head(&format!("{} · {}", one.student, task.title));
    text.push_str(&format!(
        "<h1>{}</h1>\n<p>{}, seed {}: {passed} of {tried} worlds</p>\n\
         <div class=\"bar\"><div style=\"width: {share:.1}%\"></div></div>\n",
        escaped(&one.student),
        escaped(&task.title),
        task.seed
    ));
    text.push_str("<h2>Steps</h2>\n<ul>\n");
    for (name, what) in &task.steps {
        let undone = one.undone(name);
        let said = match undone {
            0 => "done".to_owned(),
            n if n == tried => "never done".to_owned(),
            n => format!("not done in {n} of {tried} worlds"),
        };
        text.push_str(&format!("<li>{} – {said}</li>\n", escaped(what)));
    }
    text.push_str("</ul>\n<h2>Worlds</h2>\n<div class=\"wide\" tabindex=\"0\"><table><tr><th>world</th><th>result</th><th class=\"words\">why</th></tr>\n");
    for mark in &one.marks {
        let result = match mark.record.outcome {
            Ending::Success => "passed".to_owned(),
            other => other.to_string(),
        };
        text.push_str(&format!(
            "<tr><td>{}</td><td>{result}</td><td class=\"words\">{}</td></tr>\n",
            mark.record.world,
            escaped(&mark.why)
        ));
    }
    text.push_str("</table></div>\n");
    if let Some((world, page)) = &one.replay {
        text.push_str(&format!(
            "<h2>What happened in world {world}</h2>\n\
             <iframe title=\"The run in world {world}\" \
             style=\"width: 100%; height: 36em; border: 1px solid var(--line)\" srcdoc=\"{}\"></iframe>\n",
            attribute(page)
        ));
    }
    if !one.style.is_empty() {
        text.push_str("<h2>Remarks on style</h2>\n<ul>\n");
        for remark in &one.style {
            text.push_str(&format!("<li>{}</li>\n", escaped(remark)));
        }
        text.push_str("</ul>\n");
    }
    let failed = one.marks.iter().find(|mark| !mark.is_passed());
    if let Some(mark) = failed.filter(|mark| !mark.printed.is_empty()) {
        text.push_str(&format!(
            "<details><summary>What it printed in world {}</summary><pre tabindex=\"0\">{}</pre></details>\n",
            mark.record.world,
            escaped(&lisp::visible::visible(&mark.printed))
        ));
    }
    text.push_str(&format!(
        "<details><summary>The submission</summary><pre tabindex=\"0\">{}</pre></details>\n",
        numbered(&one.text)
    ));
    text + "</main></body></html>\n"
}

/// The start of a page with a title.
pub(super) fn head(title: &str) -> String {
    format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\
         <meta name=\"color-scheme\" content=\"light dark\"><title>{}</title>\
         <style>\n{STYLE}</style></head><body><main>\n",
        escaped(title)
    )
}

/// A page as the value of an attribute: nothing in it is lost.
fn attribute(page: &str) -> String {
    page.replace('&', "&amp;").replace('"', "&quot;")
}

/// A text with the numbers of its lines.
fn numbered(text: &str) -> String {
    let lines = text.lines().enumerate();
    let lines = lines
        .map(|(at, line)| format!("{:4}  {}\n", at + 1, escaped(&lisp::visible::visible(line))));
    lines.collect()
}
