//! Events as JSON for the page.

use serde_json::{Value, json};

use crate::watch::{Node, TaskId, WatchEvent};

/// An event with its simulated time (s).
pub(crate) fn news((time, event): &(f64, WatchEvent)) -> Value {
    match event {
        WatchEvent::Output(text) => json!({"t": time, "text": text}),
        WatchEvent::Aborted(text) => json!({"t": time, "aborted": text}),
        WatchEvent::Task(news) => json!({
            "t": time,
            "task": id(news.id),
            "parent": news.parent.map(id),
            "name": news.name,
            "state": news.state.name(),
            "failure": news.failure,
        }),
    }
}

/// What the page needs to know of a node besides its mesh.
pub(crate) fn node(node: &Node) -> Value {
    json!({
        "id": node.id,
        "name": node.name,
        "kind": node.kind.name(),
        "type": node.type_name,
        "still": node.still.as_ref().map(crate::watch::live::frame_json::numbers),
        "seen": !node.mesh.triangles.is_empty(),
    })
}

fn id(id: TaskId) -> String {
    match id {
        TaskId::Task(number) => format!("t{number}"),
        TaskId::Motion(number) => format!("m{number}"),
    }
}
