//! A page about a class: who has passed, and where the others fail.

use super::student_page::head;
use super::{Graded, Task};
use crate::sweep_report::escaped;

/// The page of a class. `files` are the names of the pages of its submissions, in the same order.
pub(crate) fn class_page(task: &Task, all: &[Graded], files: &[String]) -> String {
    let passed = all.iter().filter(|one| one.is_passed()).count();
    let share = 100.0 * passed as f64 / all.len().max(1) as f64;
    let mut text = head(&task.title);
    text.push_str(&format!(
        "<h1>{}</h1>\n<p>{passed} of {} passed in each of {} worlds, seed {}</p>\n\
         <div class=\"bar\"><div style=\"width: {share:.1}%\"></div></div>\n",
        escaped(&task.title),
        all.len(),
        task.worlds,
        task.seed
    ));
    text.push_str("<h2>Submissions</h2>\n<div class=\"wide\" tabindex=\"0\"><table><tr><th>who</th><th>worlds</th>");
    for (name, what) in &task.steps {
        text.push_str(&format!(
            "<th title=\"{}\">{}</th>",
            escaped(what),
            escaped(name)
        ));
    }
    text.push_str("<th>style</th><th class=\"words\">most often</th></tr>\n");
    for (one, file) in all.iter().zip(files) {
        let (passed, tried) = one.passed();
        text.push_str(&format!(
            "<tr><td><a href=\"{}\">{}</a></td><td>{passed} of {tried}</td>",
            escaped(file),
            escaped(&one.student)
        ));
        for (name, _) in &task.steps {
            let done = tried.saturating_sub(one.undone(name));
            text.push_str(&format!("<td>{done}</td>"));
        }
        let why = one
            .reasons()
            .first()
            .map(|(why, _)| escaped(why))
            .unwrap_or_default();
        text.push_str(&format!(
            "<td>{}</td><td class=\"words\">{why}</td></tr>\n",
            one.style.len()
        ));
    }
    text.push_str("</table></div>\n");
    let failures = counted(all, |mark| match (&mark.record.class, mark.is_passed()) {
        (_, true) => None,
        (Some(class), false) => Some(format!("{} {class}", mark.record.outcome)),
        (None, false) => Some(mark.record.outcome.to_string()),
    });
    text.push_str(&counts("Which failures", "failure", &failures));
    let lines = counted(all, |mark| mark.line.clone());
    text.push_str(&counts("At which lines", "line", &lines));
    text + "</main></body></html>\n"
}

/// How many worlds and submissions something was said of, the most frequent first.
fn counted(
    all: &[Graded],
    say: impl Fn(&sweep::Mark) -> Option<String>,
) -> Vec<(String, usize, usize)> {
    let mut counts: Vec<(String, usize, usize)> = Vec::new();
    for one in all {
        let mut seen: Vec<String> = Vec::new();
        for said in one.marks.iter().filter_map(&say) {
            let is_new = !seen.contains(&said);
            if is_new {
                seen.push(said.clone());
            }
            match counts.iter_mut().find(|(known, ..)| *known == said) {
                Some((_, worlds, students)) => {
                    *worlds += 1;
                    *students += usize::from(is_new);
                }
                None => counts.push((said, 1, 1)),
            }
        }
    }
    counts.sort_by_key(|(_, worlds, students)| std::cmp::Reverse((*students, *worlds)));
    counts
}

fn counts(title: &str, what: &str, counts: &[(String, usize, usize)]) -> String {
    if counts.is_empty() {
        return String::new();
    }
    let rows: String = counts
        .iter()
        .map(|(said, worlds, students)| {
            format!(
                "<tr><td>{}</td><td>{students}</td><td>{worlds}</td></tr>\n",
                escaped(said)
            )
        })
        .collect();
    format!(
        "<h2>{title}</h2>\n<div class=\"wide\" tabindex=\"0\"><table><tr><th>{what}</th><th>submissions</th>\
         <th>worlds</th></tr>\n{rows}</table></div>\n"
    )
}
