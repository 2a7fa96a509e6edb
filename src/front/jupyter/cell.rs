//! Evaluating a cell: what its events become on the channels of a notebook.

use std::rc::Rc;
use std::sync::Arc;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use super::display;
use super::interrupter::Interrupter;
use super::message::Request;
use super::publisher::Publisher;
use super::question::Questions;
use super::settings::Settings;
use crate::prompt::pasted::Inputs;
use lisp::image::input::Source;
use lisp::visible::visible;
use session::dialogue::prompt_line::prompt_line;
use session::dialogue::screen::input_name;
use session::dialogue::{Abort, Event, Illustrate, Outcome, Screen, ShownAhead, Stop, Table};

/// Minimum time between two lines of progress.
const BETWEEN_PROGRESS: Duration = Duration::from_millis(250);
/// How many frames an error shows.
const MAX_FRAMES: usize = 12;
/// The last line of an error at which a plan stands still.
const REMARK: &str = "; The plan stands still: the next cell answers. A number goes on with that restart, q abandons\n; the plan, :help tells the rest; other forms are evaluated where it stands.";

/// How a cell ended.
pub(crate) enum Ended {
    /// All of it was evaluated; the values of the last form, if it has any.
    Finished(Option<Yielded>),
    /// A condition was not handled, or the cell was interrupted.
    Failed(Failure),
    /// The program has asked to exit with that status.
    Quit(u8),
}

/// The values of a form.
pub(crate) struct Yielded {
    pub(crate) text: String,
    /// The same as a table, if it can be one.
    pub(crate) table: Option<Table>,
}

/// An error as notebooks show it.
#[derive(Clone, Debug)]
pub(crate) struct Failure {
    /// The name of the condition's class.
    name: String,
    /// The report.
    value: String,
    /// What is shown, in lines.
    traceback: Vec<String>,
}

impl Failure {
    /// An error of the kernel itself.
    pub(crate) fn of_kernel(name: &str, report: &str) -> Failure {
        Failure {
            name: name.to_owned(),
            value: report.to_owned(),
            traceback: vec![report.to_owned()],
        }
    }

    fn new(abort: &Abort, shown: &str) -> Failure {
        let name = match abort.class.as_str() {
            "" => "INTERRUPT",
            class => class,
        };
        Failure {
            name: name.to_owned(),
            value: visible(abort.report.trim_end()).into_owned(),
            traceback: shown.lines().map(str::to_owned).collect(),
        }
    }

    /// As messages have it.
    pub(crate) fn content(&self) -> Value {
        json!({"ename": self.name, "evalue": self.value, "traceback": self.traceback})
    }
}

/// A cell that is being evaluated.
pub(crate) struct Cell<'a> {
    pub(crate) publisher: Arc<Publisher>,
    pub(crate) interrupter: &'a Interrupter,
    pub(crate) questions: Rc<Questions>,
    pub(crate) request: Rc<Request>,
    pub(crate) settings: &'a Settings,
    /// The number of the input, for places in it.
    pub(crate) number: usize,
    /// Whether somebody is there who can be asked.
    pub(crate) can_ask: bool,
    /// Output that was shown with questions of the program.
    pub(crate) ahead: Rc<ShownAhead>,
}

/// What has come of an input so far.
#[derive(Default)]
struct Shown {
    values: Option<String>,
    failure: Option<Failure>,
    stop: Option<Box<Stop>>,
    has_picture: bool,
    /// Whether the output has left a line unfinished.
    is_in_line: bool,
    progress: Option<Progress>,
}

/// A line that is replaced while a plan runs.
struct Progress {
    display_id: String,
    told: Instant,
}

impl Cell<'_> {
    /// Evaluates the text of the cell; shows everything but the values of the last form.
    pub(crate) fn evaluate(&self, session: &mut impl Illustrate, text: &str) -> Ended {
        let hash = session.world_hash();
        let mut shown = Shown::default();
        let Inputs {
            inputs,
            left_out,
            unfinished,
        } = Inputs::of(text);
        for (reason, lines) in [
            ("it is not finished", unfinished),
            ("it looks like output", left_out),
        ] {
            if !lines.is_empty() {
                let count = lines.len();
                let text = format!("; Not evaluated, since {reason}: {count} lines\n");
                self.write(&mut shown, &text);
            }
        }
        session.set_source(self.can_ask.then(|| self.source()));
        let mut outcome = Outcome::Finished;
        for input in &inputs {
            outcome = self.evaluate_input(session, input.trim_end(), &mut shown);
            if outcome != Outcome::Finished {
                break;
            }
        }
        session.set_source(None);
        self.end_progress(session, &mut shown);
        if let Some(swept) = session.take_swept() {
            for content in display::of_sweep(&swept) {
                self.publish("display_data", &content);
            }
        }
        if let Some(view) = self.settings.view
            && !shown.has_picture
            && session.world_hash() != hash
        {
            let [width, height] = self.settings.size;
            let picture = session.depicted(view, width, height);
            if let Some(Ok(content)) = picture.as_ref().map(display::of_picture) {
                self.publish("display_data", &content);
            }
        }
        match (outcome, shown.failure) {
            (Outcome::Quit(status), _) => Ended::Quit(status),
            (_, Some(failure)) => Ended::Failed(failure),
            (_, None) => Ended::Finished(shown.values.map(|text| Yielded {
                text,
                table: session.table(),
            })),
        }
    }

    /// Asks for what the program reads. What it has just written on its last line is the question.
    fn source(&self) -> Rc<Source> {
        let (publisher, questions) = (Arc::clone(&self.publisher), Rc::clone(&self.questions));
        let (request, ahead) = (Rc::clone(&self.request), Rc::clone(&self.ahead));
        Rc::new(move |written| {
            publisher.write("stdout", &request.header, ahead.show(written));
            let question = publisher.take_unfinished_line(&request.header);
            publisher.flush();
            let typed = questions.ask(&request, &question)?;
            Some(typed + "\n")
        })
    }

    /// Evaluates an input, and what is answered to questions that it leads to.
    fn evaluate_input(
        &self,
        session: &mut impl Illustrate,
        input: &str,
        shown: &mut Shown,
    ) -> Outcome {
        let stops = self.can_ask && self.settings.has_debugger;
        session.set_interactive(stops || session.level() > 0);
        let mut outcome = self.pass(session, input, shown);
        while self.can_ask && asks_for_value(session) {
            self.publisher.flush();
            let answer = self.questions.ask(&self.request, "value: ");
            outcome = self.pass(session, answer.as_deref().unwrap_or_default(), shown);
            if answer.is_none() {
                shown.failure = Some(Failure::of_kernel("INTERRUPT", "Interrupted."));
                break;
            }
        }
        if let Some(stop) = shown.stop.take() {
            outcome = self.stopped(session, *stop, outcome, shown);
        }
        outcome
    }

    /// A plan has stopped: at an interrupt it is given up, at a condition it waits for an answer.
    fn stopped(
        &self,
        session: &mut impl Illustrate,
        mut stop: Stop,
        outcome: Outcome,
        shown: &mut Shown,
    ) -> Outcome {
        if let Some(answer) = session.answer_to_interrupt() {
            let outcome = session.evaluate(&input_name(self.number), answer, &mut |event| {
                // That it has ended is told below.
                if !matches!(event, Event::Left(_) | Event::Stopped(_)) {
                    self.take(event, shown);
                }
            });
            let text = self.on_screen(false, &Event::Aborted(Box::new(stop.abort.clone())));
            shown.failure = Some(Failure::new(&stop.abort, &text));
            return outcome;
        }
        stop.remark = "";
        let abort = stop.abort.clone();
        let mut text = self.on_screen(true, &Event::Stopped(Box::new(stop)));
        text.push_str("Frames:\n");
        text.push_str(&session.backtrace(MAX_FRAMES));
        text.push_str(REMARK);
        shown.failure = Some(Failure::new(&abort, &text));
        outcome
    }

    fn pass(&self, session: &mut impl Illustrate, input: &str, shown: &mut Shown) -> Outcome {
        shown.values = None;
        shown.stop = None;
        session.evaluate(&input_name(self.number), input, &mut |event| {
            self.take(event, shown);
        })
    }

    fn take(&self, event: Event, shown: &mut Shown) {
        match event {
            Event::Output(text) => self.write(shown, self.ahead.unseen(&text)),
            Event::ErrorOutput(text) => {
                self.write_to("stderr", shown, self.ahead.unseen(&text));
            }
            Event::Values(values) => {
                shown.values = (!values.is_empty()).then(|| values.join("\n"));
            }
            Event::Picture(picture) => {
                if let Ok(content) = display::of_picture(&picture) {
                    shown.has_picture = true;
                    self.publish("display_data", &content);
                }
            }
            Event::Aborted(abort) => {
                let event = Event::Aborted(abort);
                let text = self.on_screen(false, &event);
                if let Event::Aborted(abort) = event {
                    shown.failure = Some(Failure::new(&abort, &text));
                }
            }
            Event::Stopped(stop) => shown.stop = Some(stop),
            Event::Left(condition) => {
                let begin = if shown.is_in_line { "\n" } else { "" };
                self.write(
                    shown,
                    &format!("{begin}; Evaluation aborted on {condition}.\n"),
                );
            }
            Event::Progress(line) => self.progress(shown, &line),
        }
    }

    /// What the prompt would show.
    fn on_screen(&self, is_detailed: bool, event: &Event) -> String {
        let mut screen = Screen::new(Vec::new());
        screen.set_detailed(is_detailed);
        screen.begin_input(&input_name(self.number), self.request.text("code"));
        // Writing to memory does not fail.
        let _ = screen.show(event);
        String::from_utf8_lossy(&screen.into_inner()).into_owned()
    }

    fn write(&self, shown: &mut Shown, text: &str) {
        self.write_to("stdout", shown, text);
    }

    fn write_to(&self, stream: &'static str, shown: &mut Shown, text: &str) {
        if !text.is_empty() {
            shown.is_in_line = !text.ends_with('\n');
        }
        let is_hurried = || self.interrupter.is_interrupted();
        self.publisher.wait_for_room(is_hurried);
        self.publisher.write(stream, &self.request.header, text);
    }

    fn publish(&self, kind: &str, content: &Value) {
        let is_hurried = || self.interrupter.is_interrupted();
        self.publisher.wait_for_room(is_hurried);
        self.publisher.publish(kind, &self.request.header, content);
    }

    fn progress(&self, shown: &mut Shown, line: &str) {
        let now = Instant::now();
        let (kind, display_id) = match &mut shown.progress {
            Some(progress) if now - progress.told < BETWEEN_PROGRESS => return,
            Some(progress) => {
                progress.told = now;
                ("update_display_data", progress.display_id.clone())
            }
            none => {
                let display_id = self.publisher.display_id();
                *none = Some(Progress {
                    display_id: display_id.clone(),
                    told: now,
                });
                ("display_data", display_id)
            }
        };
        self.publish(kind, &display::of_progress(line, &display_id));
    }

    /// What is left of the progress says when the plan ended.
    fn end_progress(&self, session: &impl Illustrate, shown: &mut Shown) {
        if let Some(progress) = shown.progress.take() {
            let line = format!("; {:.1} s", session.now());
            let content = display::of_progress(&line, &progress.display_id);
            self.publish("update_display_data", &content);
        }
    }
}

/// Whether the next input is the value that a restart needs.
fn asks_for_value(session: &impl Illustrate) -> bool {
    let line = session.prompt() + "> ";
    prompt_line(&line).is_some_and(|prompt| prompt.state.ends_with("value"))
}
