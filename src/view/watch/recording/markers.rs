//! What the robot does, as a text above it in the scene, for viewers that do not know our tasks.

use indexmap::IndexMap;

use super::message::{Color, PoseMessage, SceneEntity, SceneUpdate, TextPrimitive, Time};
use super::write::all_deleted;
use crate::watch::{TaskId, TaskNews, TaskState};

/// Height (m) of the text above the floor, and of its letters.
const HEIGHT: f32 = 1.75;
const LETTERS: f32 = 0.12;

/// How long (s) a failure is shown.
const FAILURE_SECONDS: u32 = 3;

/// Maximum number of characters of a failure.
const LONGEST: usize = 120;

/// The actions that are performed, outermost first.
#[derive(Default)]
pub(super) struct Markers {
    running: IndexMap<TaskId, String>,
    failures: u32,
}

impl Markers {
    /// What is to be shown anew after a change in the state of a task.
    ///
    /// `carrier` is the frame above whose origin the text is.
    pub(super) fn hear(
        &mut self,
        time: f64,
        news: &TaskNews,
        carrier: &str,
    ) -> Option<SceneUpdate> {
        if !matches!(news.id, TaskId::Action(_)) {
            return None;
        }
        let mut entities = Vec::new();
        let marker = |id: &str, text, is_bad| marker(time, carrier, id, text, is_bad);
        match news.state {
            TaskState::Running => {
                self.running.insert(news.id, news.name.clone());
            }
            TaskState::Suspended | TaskState::Stopped => return None,
            TaskState::Succeeded | TaskState::Evaporated => {
                self.running.shift_remove(&news.id);
            }
            TaskState::Failed => {
                self.running.shift_remove(&news.id);
                self.failures += 1;
                let first = news.failure.lines().next().unwrap_or_default();
                let why: String = first.chars().take(LONGEST).collect();
                let text = format!("{} failed: {why}", news.name);
                let mut entity = marker(&format!("failure {}", self.failures), text, true);
                entity.lifetime = Time {
                    sec: FAILURE_SECONDS,
                    nsec: 0,
                };
                entities.push(entity);
            }
        }
        let names: Vec<&str> = self.running.values().map(String::as_str).collect();
        if !names.is_empty() {
            entities.push(marker("actions", names.join(" › "), false));
        }
        // Failures go by themselves; without an action there is nothing else.
        let deletions = match (self.running.is_empty(), news.state) {
            (true, TaskState::Succeeded | TaskState::Evaporated) => vec![all_deleted(time)],
            _ => Vec::new(),
        };
        Some(SceneUpdate {
            deletions,
            entities,
        })
    }
}

fn marker(time: f64, carrier: &str, id: &str, text: String, is_bad: bool) -> SceneEntity {
    let (color, height) = match is_bad {
        true => ([0.86, 0.15, 0.1], HEIGHT + 2.0 * LETTERS),
        false => ([0.1, 0.45, 0.8], HEIGHT),
    };
    let [r, g, b] = color;
    let text = TextPrimitive {
        pose: PoseMessage {
            position: [0.0, 0.0, height].into(),
            ..PoseMessage::default()
        },
        billboard: true,
        font_size: LETTERS,
        color: Color { r, g, b, a: 1.0 },
        text,
        ..TextPrimitive::default()
    };
    SceneEntity {
        timestamp: Time::new(time),
        frame_id: carrier.to_owned(),
        id: id.to_owned(),
        frame_locked: true,
        texts: vec![text],
        ..SceneEntity::default()
    }
}
