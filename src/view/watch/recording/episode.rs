//! What was performed in a recording, as relations: rows as an exported episode has them. Pictures are passed over, and
//! so are poses unless they are wanted.

use std::io::{Read, Seek};

use super::RecordingError;
use super::attachment;
use super::channel::Channel;
use super::message::{Log, Shown, Task};
use super::messages::{Message, walk};
use super::places::Places;
use super::rows::{self, Datum, Rows};
use super::told::told;
use crate::watch::TaskState;
use indexmap::IndexMap;

/// The relations of a recording.
pub struct Episode {
    /// Names and rows.
    pub relations: Vec<(&'static str, Rows)>,
    /// Whether the file ends abruptly, as when the session was killed.
    pub is_cut_off: bool,
}

/// Which relations are wanted of a recording: what is not is passed over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wanted {
    /// What was performed: `task`, `param` and `failure`.
    pub tasks: bool,
    /// What happened: `event` and `contact`.
    pub events: bool,
    /// What was said: `log`.
    pub log: bool,
    /// Where objects and the robot were: `object` and `robot`.
    pub places: bool,
}

impl Wanted {
    /// All of them.
    pub const ALL: Wanted = Wanted {
        tasks: true,
        events: true,
        log: true,
        places: true,
    };

    /// Those for which a test of their names holds.
    pub fn of(is_wanted: impl Fn(&str) -> bool) -> Wanted {
        let any = |names: &[&str]| names.iter().any(|name| is_wanted(name));
        Wanted {
            tasks: any(&["task", "param", "failure"]),
            events: any(&["event", "contact"]),
            log: any(&["log"]),
            places: any(&["object", "robot"]),
        }
    }

    /// Must the messages of a channel be read?
    pub(super) fn needs(self, channel: Channel) -> bool {
        match channel {
            Channel::Tasks => self.tasks || self.places,
            Channel::Shown => self.events || self.places,
            Channel::Log => self.log,
            Channel::Transforms | Channel::Objects => self.places,
            _ => false,
        }
    }

    /// Is a relation wanted?
    pub(super) fn has(self, relation: &str) -> bool {
        match relation {
            "task" | "param" | "failure" => self.tasks,
            "event" | "contact" => self.events,
            "log" => self.log,
            "object" | "robot" => self.places,
            _ => false,
        }
    }
}

/// Reads the relations of a recording as it comes, from its messages.
pub fn read_episode(mut file: impl Read, wanted: Wanted) -> Result<Episode, RecordingError> {
    let mut found = EpisodeBuilder::new(wanted);
    let walked = walk(
        &mut file,
        &|channel| wanted.needs(channel),
        &mut |message| found.take(message),
    )?;
    if !walked.is_ours {
        return Err(RecordingError::Foreign);
    }
    Ok(Episode {
        relations: found.relations(),
        is_cut_off: walked.is_cut_off,
    })
}

/// Reads the relations of a recording from its end, where recordings that have been closed keep them, or else from its
/// messages. Both ways find the same rows.
pub fn read_episode_of_file(
    mut file: impl Read + Seek,
    wanted: Wanted,
) -> Result<Episode, RecordingError> {
    if let Some(relations) = attachment::read(&mut file, wanted) {
        return Ok(Episode {
            relations,
            is_cut_off: false,
        });
    }
    file.rewind()?;
    read_episode(file, wanted)
}

/// Makes relations of the messages of a recording.
pub(super) struct EpisodeBuilder {
    wanted: Wanted,
    rows: Found,
    places: Places,
    last_shown: Vec<u8>,
    /// The size (bytes) of the messages of which texts have been kept.
    kept: usize,
}

/// About how many bytes a row without long texts takes.
const ROW_BYTES: usize = 300;

impl EpisodeBuilder {
    pub(super) fn new(wanted: Wanted) -> Self {
        Self {
            wanted,
            rows: Found::default(),
            places: Places::default(),
            last_shown: Vec::new(),
            kept: 0,
        }
    }

    /// Takes the next message of a channel that is needed.
    pub(super) fn take(&mut self, message: &Message<'_>) -> Result<(), RecordingError> {
        let (channel, time) = (message.channel, message.time);
        let (encoding, data) = (message.encoding, message.data);
        match channel {
            Channel::Transforms => self.places.transforms(message)?,
            Channel::Shown => {
                let shown = without_time(data);
                if shown == self.last_shown {
                    return Ok(());
                }
                self.last_shown.clear();
                self.last_shown.extend_from_slice(shown);
                if let Some(shown) = told(channel, encoding, data)? {
                    if self.wanted.events {
                        self.rows.shown(time, &shown);
                    }
                    self.places.shown(&shown);
                }
            }
            Channel::Tasks => {
                self.kept += data.len();
                if let Some(task) = told(channel, encoding, data)? {
                    self.places.note();
                    if self.wanted.tasks {
                        self.rows.task(time, task);
                    }
                }
            }
            Channel::Objects => {
                if let Some(objects) = told(channel, encoding, data)? {
                    self.places.objects(&objects);
                }
            }
            Channel::Log => {
                self.kept += data.len();
                if let Some(log) = told(channel, encoding, data)? {
                    self.rows.log(time, log);
                }
            }
            _ => {}
        }
        Ok(())
    }

    /// How much memory (bytes) the rows take, roughly.
    pub(super) fn bytes(&self) -> usize {
        let rows = self.rows.events.len() + self.rows.contacts.len() + self.places.len();
        self.kept + ROW_BYTES * rows
    }

    pub(super) fn relations(self) -> Vec<(&'static str, Rows)> {
        let mut relations = self.rows.relations();
        relations.extend(self.places.relations());
        relations
    }
}

/// A message in Protobuf without the time stamp at its beginning.
fn without_time(data: &[u8]) -> &[u8] {
    match data {
        [0x0a, length, ..] if *length < 0x80 => {
            data.get(2 + usize::from(*length)..).unwrap_or(data)
        }
        _ => data,
    }
}

/// A task, as far as it is known.
struct TaskRow {
    /// The row as it was when the task began, up to its creation.
    row: Vec<Datum>,
    started: Option<f64>,
    ended: Option<f64>,
    status: String,
    result: Datum,
    /// How many tasks it has started so far.
    parts: usize,
    path: String,
}

/// Something that touches something else.
struct Contact {
    pair: (String, String),
    began: f64,
    ended: Option<f64>,
    /// The greatest (N).
    force: f64,
}

/// What has been read so far.
#[derive(Default)]
struct Found {
    /// Tasks by the writer's names; their numbers count from 0.
    tasks: IndexMap<String, TaskRow>,
    params: Vec<Vec<Datum>>,
    failures: Vec<Vec<Datum>>,
    events: Vec<Vec<Datum>>,
    contacts: Vec<Contact>,
    logs: Vec<Vec<Datum>>,
    /// What is held, with the link that holds it.
    held: IndexMap<String, String>,
    /// What touches now: object and link, with the row of the contact.
    touching: IndexMap<(String, String), usize>,
}

/// The name of an object, from that of its frame.
pub(super) fn object_name(frame: &str) -> String {
    frame.trim_start_matches("object/").to_lowercase()
}

/// The name of a task as users give it: `pick-up` for `[PICK-UP]-401`, `top-level` for a plan at top level.
fn task_name(name: &str) -> String {
    let inside = name
        .strip_prefix('[')
        .and_then(|name| name.rsplit_once(']'));
    let name = inside.map_or(name, |(name, _)| name);
    match name {
        "" => "top-level".to_owned(),
        name => name
            .strip_prefix("TOP-LEVEL-")
            .unwrap_or(name)
            .to_lowercase(),
    }
}

impl Found {
    fn task(&mut self, time: f64, task: Task) {
        let Some(state) = TaskState::named(&task.state) else {
            return;
        };
        if !self.tasks.contains_key(&task.id) {
            self.begin(time, &task);
        }
        let number = self.tasks.get_index_of(&task.id);
        let Some(known) = self.tasks.get_mut(&task.id) else {
            return;
        };
        if state == TaskState::Running && known.started.is_none() {
            known.started = Some(time);
        }
        known.status = state.name().to_lowercase();
        let has_ended = matches!(
            state,
            TaskState::Succeeded | TaskState::Failed | TaskState::Evaporated
        );
        if has_ended {
            known.ended = Some(time);
            known.result = Datum::text(&task.result);
        }
        if state == TaskState::Failed {
            self.failures.push(vec![
                number.into(),
                time.into(),
                Datum::text(&task.class.to_lowercase()),
                Datum::text(&task.failure),
            ]);
        }
    }

    fn begin(&mut self, time: f64, task: &Task) {
        let number = self.tasks.len();
        let name = task_name(&task.name);
        let parent = self.tasks.get_index_of(&task.parent);
        let (nth, outer) = match self.tasks.get_mut(&task.parent) {
            Some(parent) => {
                parent.parts += 1;
                (Some(parent.parts - 1), parent.path.as_str())
            }
            None => (None, ""),
        };
        let path = format!("{name} {outer}").trim_end().to_owned();
        let kind = match task.id.as_bytes().first() {
            Some(b'a' | b'm') => "performed",
            _ if parent.is_none() => "top-level",
            _ => "task",
        };
        let row = vec![
            number.into(),
            parent.into(),
            nth.into(),
            kind.into(),
            name.into(),
            path.as_str().into(),
            Datum::text(&task.place),
            time.into(),
        ];
        for pair in &task.parameters {
            let value = pair.value.parse::<f64>();
            self.params.push(vec![
                number.into(),
                pair.key.to_lowercase().into(),
                pair.value.as_str().into(),
                value.ok().filter(|n| n.is_finite()).into(),
            ]);
        }
        let row = TaskRow {
            row,
            started: None,
            ended: None,
            status: "created".to_owned(),
            result: Datum::Null,
            parts: 0,
            path,
        };
        self.tasks.insert(task.id.clone(), row);
    }

    fn shown(&mut self, time: f64, shown: &Shown) {
        let held = shown.held.iter();
        let held: IndexMap<String, String> = held
            .map(|held| (object_name(&held.object), held.link.clone()))
            .collect();
        let mut event = |kind: &str, object: &str, link: &str| {
            self.events
                .push(vec![time.into(), kind.into(), object.into(), link.into()]);
        };
        for (object, link) in &self.held {
            if !held.contains_key(object) {
                event("detached", object, link);
            }
        }
        for (object, link) in &held {
            if !self.held.contains_key(object) {
                event("attached", object, link);
            }
        }
        self.held = held;
        let mut touching = IndexMap::new();
        for touch in &shown.touching {
            let link = match touch.link.as_str() {
                "" => "floor".to_owned(),
                link => link.to_owned(),
            };
            let pair = (object_name(&touch.object), link);
            let row = match self.touching.get(&pair) {
                Some(row) => *row,
                None => {
                    self.contacts.push(Contact {
                        pair: pair.clone(),
                        began: time,
                        ended: None,
                        force: 0.0,
                    });
                    self.contacts.len() - 1
                }
            };
            let force = [touch.force.x, touch.force.y, touch.force.z];
            let force = f64::from(force.iter().map(|f| f * f).sum::<f32>().sqrt());
            if let Some(contact) = self.contacts.get_mut(row)
                && contact.force < force
            {
                contact.force = force;
            }
            touching.insert(pair, row);
        }
        for (pair, row) in &self.touching {
            if !touching.contains_key(pair)
                && let Some(contact) = self.contacts.get_mut(*row)
            {
                contact.ended = Some(time);
            }
        }
        self.touching = touching;
    }

    fn log(&mut self, time: f64, log: Log) {
        let level = ["", "debug", "info", "warn", "error"].get(usize::from(log.level));
        self.logs.push(vec![
            time.into(),
            Datum::text(level.copied().unwrap_or_default()),
            Datum::text(&log.name),
            log.message.into(),
        ]);
    }

    fn relations(self) -> Vec<(&'static str, Rows)> {
        let tasks = self.tasks.into_values().map(|task| {
            let mut row = task.row;
            row.extend([task.started.into(), task.ended.into()]);
            row.extend([task.status.into(), task.result]);
            row
        });
        let contacts = self.contacts.into_iter().map(|contact| {
            let Contact {
                pair: (a, b),
                began,
                ended,
                force,
            } = contact;
            vec![a.into(), b.into(), began.into(), ended.into(), force.into()]
        });
        vec![
            rows::of("task", tasks.collect()),
            rows::of("param", self.params),
            rows::of("failure", self.failures),
            rows::of("event", self.events),
            rows::of("contact", contacts.collect()),
            rows::of("log", self.logs),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tasks_have_the_names_that_users_give() {
        for (name, shown) in [
            ("[PICK-UP]-401", "pick-up"),
            ("[TOP-LEVEL-TOP-LEVEL]-391", "top-level"),
            ("[TOP-LEVEL]-392", "top-level"),
            ("PICKING-UP", "picking-up"),
            ("", "top-level"),
        ] {
            assert_eq!(task_name(name), shown, "{name}");
        }
    }

    #[test]
    fn what_is_no_recording_is_refused() {
        for bytes in [&b""[..], b"hello", b"\x89MCAP0\r\n", &[0; 4096]] {
            assert!(read_episode(bytes, Wanted::ALL).is_err(), "{bytes:?}");
        }
    }
}
