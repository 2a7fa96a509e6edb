//! Questions to the camera.

use std::time::Duration;

use super::super::super::robot::pose;
use super::super::end::shown;
use super::{Desk, lock, seconds};
use robotics::motion::RobotTrouble;
use ros::Value;
use ros::wire::{Answer, Sequence};
use session::outside::SeenObject;

/// How long the camera may take to answer.
const SIGHT: Duration = Duration::from_secs(10);

/// A question to the camera.
pub(super) struct Question {
    pub(super) ticket: u64,
    pub(super) request: Value,
    pub(super) since: Duration,
    /// When it was asked, and as which request.
    pub(super) asked: Option<(Duration, Sequence)>,
}

impl Desk {
    /// Asks the camera, and hears what it sees.
    pub(super) fn ask_camera(&mut self, now: Duration) {
        let mut answers = Vec::new();
        while let Some(answer) = self.ends.perception.take() {
            match answer {
                Answer::To(sequence, value) => answers.push((sequence, Some(value))),
                Answer::Unreadable(sequence) => answers.push((sequence, None)),
                Answer::ToNobody => self.oddities_of_camera += 1,
            }
        }
        let is_served = self.ends.perception.is_served();
        let mut questions = std::mem::take(&mut self.questions);
        questions.retain_mut(|question| {
            let name = || self.interface.perception.clone();
            let end = match question.asked {
                None => {
                    if is_served {
                        let sequence = self.ends.perception.ask(&question.request);
                        question.asked = sequence.map(|sequence| (now, sequence));
                    }
                    let waited = now.saturating_sub(question.since).as_secs_f64();
                    let is_over =
                        question.asked.is_none() && waited >= self.interface.server_time_out;
                    is_over.then(|| {
                        Err(RobotTrouble::Unserved {
                            name: name(),
                            waited,
                        })
                    })
                }
                Some((asked, sequence)) => {
                    let answer = answers.iter().find(|(to, _)| *to == sequence);
                    let waited = now.saturating_sub(asked);
                    match answer {
                        Some((_, answer)) => Some(self.seen(answer.as_ref(), now)),
                        None if waited >= SIGHT => Some(Err(RobotTrouble::NoAnswer {
                            name: name(),
                            waited: waited.as_secs_f64(),
                        })),
                        None => None,
                    }
                }
            };
            match end {
                None => true,
                Some(end) => {
                    lock(&self.shared).seen.insert(question.ticket, end);
                    false
                }
            }
        });
        self.questions = questions;
    }

    /// The objects of an answer of the camera.
    pub(super) fn seen(
        &self,
        answer: Option<&Value>,
        now: Duration,
    ) -> Result<Vec<SeenObject>, RobotTrouble> {
        let blind = |text: String| RobotTrouble::Blind {
            name: self.interface.perception.clone(),
            text,
        };
        let answer = answer.ok_or_else(|| blind("its answer cannot be read".to_owned()))?;
        let error = answer.get("error").and_then(Value::as_text);
        if let Some(error) = error.filter(|error| !error.trim().is_empty()) {
            return Err(blind(shown(error)));
        }
        let objects = answer.get("objects").and_then(Value::as_list);
        let objects = objects.unwrap_or_default().iter().map(|object| {
            let text = |name| {
                object
                    .get(name)
                    .and_then(Value::as_text)
                    .unwrap_or_default()
            };
            let frame = object
                .at(&["pose", "header", "frame_id"])
                .and_then(Value::as_text);
            let frame = frame.unwrap_or_default();
            let pose = pose(object.at(&["pose", "pose"]));
            let pose = pose
                .ok_or_else(|| blind(format!("the pose of a {} is none", shown(text("type")))))?;
            let max_age = seconds(self.interface.max_frame_age);
            let frames = &lock(&self.shared).frames;
            let carrier = frames.pose(frame, &self.interface.map, max_age, now);
            let carrier = carrier.map_err(|error| blind(error.to_string()))?;
            Ok(SeenObject {
                type_name: text("type").to_owned(),
                name: text("name").to_owned(),
                pose: carrier * pose,
            })
        });
        objects.collect()
    }
}
