//! Pictures and texts as notebooks show them.

use std::io;

use serde_json::{Value, json};

use crate::front::sweep_report::{axes, fragment, heat_map};
use crate::picture::Image;
use crate::session::dialogue::Swept;
use crate::watch::base64;

/// Most failing worlds in the table of a sweep.
const MOST_LISTED: usize = 50;

/// What shows a picture: its PNG, and a text for those who cannot show that.
pub(crate) fn of_picture(picture: &Image) -> io::Result<Value> {
    let text = format!("[picture, {} × {}]", picture.width(), picture.height());
    Ok(json!({
        "data": {"image/png": base64(&picture.to_png()?), "text/plain": text},
        "metadata": {},
        "transient": {},
    }))
}

/// What shows a sweep: a table, and where there are two numbers, a picture of where the plan works.
pub(crate) fn of_sweep(swept: &Swept) -> Vec<Value> {
    let Swept { title, records } = swept;
    let html = fragment(title, records, MOST_LISTED);
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
