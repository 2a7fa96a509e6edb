//! Events as JSON for the page.

use serde_json::{Value, json};

use crate::watch::{Halt, Node, TaskId, WatchEvent};

/// An event with its simulated time (s).
pub(super) fn news((time, event): &(f64, WatchEvent)) -> Value {
    match event {
        WatchEvent::Output(text) => json!({"t": time, "text": text}),
        WatchEvent::Halted(halt) => json!({"t": time, "halted": halt.report}),
        // It is told as the end of a halt, not as news.
        WatchEvent::Resumed => Value::Null,
        WatchEvent::Task(news) => {
            let mut value = json!({
                "t": time,
                "task": news.id.text(),
                "parent": news.parent.map(TaskId::text),
                "name": news.name,
                "state": news.state.name(),
                "failure": news.failure,
            });
            if !news.result.is_empty() {
                value["result"] = json!(news.result);
            }
            if let Some(about) = &news.about {
                value["about"] =
                    json!({"keys": about.keys, "place": about.place, "line": about.line});
                if !about.module.is_empty() {
                    value["about"]["module"] = json!(about.module);
                }
            }
            value
        }
    }
}

/// Why the session does not go on.
pub(super) fn halt(halt: &Halt) -> Value {
    json!({
        "kind": halt.kind.name(),
        "class": halt.class,
        "report": halt.report,
        "place": halt.place,
        "choices": halt.choices,
        "level": halt.level,
    })
}

/// What the page needs to know of a node besides its mesh.
pub(super) fn node(node: &Node) -> Value {
    json!({
        "id": node.id,
        "name": node.name,
        "kind": node.kind.name(),
        "type": node.type_name,
        "parent": node.parent,
        "still": node.still.as_ref().map(crate::watch::live::frame_json::numbers),
        "seen": !node.mesh.triangles.is_empty(),
    })
}
