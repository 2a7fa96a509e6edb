//! Pictures and texts as notebooks show them.

use std::io;

use serde_json::{Value, json};

use super::cell::Yielded;
use crate::sweep_report::{axes, escaped, fragment, heat_map};
use session::dialogue::{Swept, Table};
use view::picture::Image;
use view::watch::base64;

/// Maximum number of failing worlds in the table of a sweep.
const MAX_LISTED: usize = 50;

/// What shows a picture: its PNG, and a text for those who cannot show that.
pub(crate) fn of_picture(picture: &Image) -> io::Result<Value> {
    let text = format!("[picture, {} × {}]", picture.width(), picture.height());
    Ok(json!({
        "data": {"image/png": base64(&picture.to_png()?), "text/plain": text},
        "metadata": {},
        "transient": {},
    }))
}

/// What shows values: their text, and a table if they can be one.
pub(crate) fn of_values(values: &Yielded) -> Value {
    let mut data = json!({"text/plain": values.text});
    if let Some(Table { head, rows }) = &values.table {
        let line = |kind: &str, cells: &[String]| {
            let cells = cells.iter();
            let cells = cells.map(|text| format!("<{kind}>{}</{kind}>", escaped(text)));
            format!("<tr>{}</tr>", cells.collect::<String>())
        };
        let rows: String = rows.iter().map(|row| line("td", row)).collect();
        data["text/html"] = json!(format!("<table>{}{rows}</table>", line("th", head)));
    }
    data
}

/// What shows a sweep: a table, and where there are two numbers, a picture of where the plan works.
pub(crate) fn of_sweep(swept: &Swept) -> Vec<Value> {
    let Swept { title, records } = swept;
    let html = fragment(title, records, MAX_LISTED);
    let text = format!("[table, {} worlds]", records.len());
    let table = json!({
        "data": {"text/html": html, "text/plain": text},
        "metadata": {},
        "transient": {},
    });
    let picture = axes(records).and_then(|[x, y]| heat_map(records, [&x, &y]));
    let picture = picture.and_then(|picture| of_picture(&picture).ok());
    std::iter::once(table).chain(picture).collect()
}

/// What shows a text that will be replaced.
pub(crate) fn of_progress(line: &str, display_id: &str) -> Value {
    json!({
        "data": {"text/plain": line},
        "metadata": {},
        "transient": {"display_id": display_id},
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_shown_beside_their_text() {
        let mut values = Yielded {
            text: "(1 2)".to_owned(),
            table: None,
        };
        assert_eq!(of_values(&values), json!({"text/plain": "(1 2)"}));
        values.table = Some(Table {
            head: vec!["a".to_owned(), "b".to_owned()],
            rows: vec![vec!["<b>".to_owned(), String::new()]],
        });
        assert_eq!(
            of_values(&values)["text/html"],
            json!(
                "<table><tr><th>a</th><th>b</th></tr><tr><td>&lt;b&gt;</td><td></td></tr></table>"
            )
        );
    }
}
