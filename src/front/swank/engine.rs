//! The session's thread: takes requests one after another and has the session answer them.
//!
//! An evaluation that stops leaves its request pending until a later input ends it. So the stack
//! of pending requests is that of the session's levels; [`Engine::settle`] compares the two after
//! every input.

use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use super::answer::{Answer, Yield};
use super::hub::{self, Client, Hub, Job, Next, Request};
use super::keep::Keep;
use super::known_names;
use super::levels::{Ended, Pending};
use super::package_text::package_name;
use super::question::Questions;
use super::sexp::Sexp;
use lisp::image::input::Source;
use session::dialogue::screen::input_name;
use session::dialogue::{Beginning, Event, Names, ObjectNumber, Outcome, Serve};

/// How long the session's thread waits before it brings what is known about names up to date.
const REST: Duration = Duration::from_millis(150);
/// How long it waits then.
const LONG_REST: Duration = Duration::from_secs(3600);

/// What the session's thread works with.
pub(super) struct Engine<'s> {
    pub(super) session: &'s mut dyn Serve,
    /// Who keeps the inputs, if anybody does.
    keeper: Option<&'s mut dyn Keep>,
    pub(super) hub: Arc<Hub>,
    pub(super) clients: BTreeMap<u64, ClientState>,
    /// The requests whose evaluations have stopped, innermost last, one for each level.
    pub(super) pending: Vec<Pending>,
    /// The choice whose value a client has been asked for.
    pub(super) asked: Option<super::debugger::Asked>,
    pub(super) questions: Rc<Questions>,
    /// Whom programs ask for what they read.
    source: Option<Rc<Source>>,
    /// What a client begins with.
    fresh: Beginning,
    /// The package in which it begins.
    fresh_package: String,
    names: Arc<Names>,
    /// Whether something may have changed since `names` were made.
    is_changed: bool,
    inputs: usize,
    interrupt: Arc<AtomicBool>,
}

/// What is kept for a client.
pub(super) struct ClientState {
    pub(super) client: Arc<Client>,
    /// What its next input begins with.
    pub(super) beginning: Beginning,
    /// The package that it knows of.
    pub(super) package: String,
    /// The values that it inspects.
    pub(super) inspected: super::inspector::Path,
    /// Whether it wants values that can be pointed at.
    pub(super) presents: bool,
}

impl<'s> Engine<'s> {
    pub(super) fn new(
        session: &'s mut dyn Serve,
        keeper: Option<&'s mut dyn Keep>,
        hub: Arc<Hub>,
    ) -> Engine<'s> {
        session.set_served(true);
        session.set_interactive(true);
        let interrupt = session.interrupt_handle();
        let questions = Questions::new(Arc::clone(&hub), Arc::clone(&interrupt));
        let questions = Rc::new(questions);
        let asking = Rc::clone(&questions);
        let source: Rc<Source> = Rc::new(move |written| asking.ask(written));
        Engine {
            interrupt,
            questions,
            // What is typed for a program is no input, and is not kept.
            source: keeper.is_none().then_some(source),
            fresh: session.beginning(),
            fresh_package: session.package_names().0,
            names: session.names(),
            session,
            keeper,
            hub,
            clients: BTreeMap::new(),
            pending: Vec::new(),
            asked: None,
            is_changed: false,
            inputs: 0,
        }
    }

    /// Works until the server is to end.
    pub(super) fn run(&mut self) -> hub::Ended {
        loop {
            let rest = if self.is_changed { REST } else { LONG_REST };
            match self.hub.next(rest) {
                Next::End(ended) => {
                    self.end();
                    return ended;
                }
                Next::Idle => self.refresh_names(),
                Next::Job(job) => {
                    if let Err(defect) = defect::caught(|| self.take(&job)) {
                        self.tell_defect(&job, &defect.to_string());
                    }
                }
            }
            self.leave_for_the_gone();
        }
    }

    /// Does what there is for the session's thread now, without waiting. Returns the exit status
    /// if the server is to end.
    fn take(&mut self, job: &Job) {
        match job {
            Job::Request(request) if known_names::is_quick(&request.operation) => {
                self.answer_quick(request);
            }
            Job::Request(request) => self.dispatch(request),
            Job::Typed(client, tag, text) => self.typed(client, *tag, text),
            Job::NotTyped(client) => self.not_typed(client),
            Job::Gone(client) => {
                if let Some(gone) = self.clients.remove(&client.number) {
                    self.session.forget_objects(&gone.inspected.all());
                }
            }
        }
    }

    fn tell_defect(&mut self, job: &Job, defect: &str) {
        self.hub.end_work();
        if let Job::Request(request) = job {
            request.abort(&format!("planwright failed: {defect}."));
        }
    }

    /// Tells the clients that it is over.
    fn end(&mut self) {
        self.session.set_served(false);
        self.session.set_source(None);
        let clients = self.hub.clients();
        for client in &clients {
            client.outbox.end();
        }
        for client in &clients {
            client.outbox.wait_for_end(Duration::from_millis(500));
        }
    }

    /// Brings what is known about names up to date.
    fn refresh_names(&mut self) {
        if std::mem::take(&mut self.is_changed) {
            self.names = self.session.names();
            self.hub.publish(Arc::clone(&self.names));
        }
    }

    fn answer_quick(&mut self, request: &Request) {
        self.refresh_names();
        if request.operation == "init-presentations" {
            self.client(request).presents = true;
        }
        let version = self.hub.version();
        let value = known_names::answer(&self.names, &version, request);
        request.ok(value.unwrap_or(Sexp::NIL));
    }

    /// What is kept for the client of a request.
    pub(super) fn client(&mut self, request: &Request) -> &mut ClientState {
        let (fresh, package) = (&self.fresh, &self.fresh_package);
        let client = &request.client;
        self.clients
            .entry(client.number)
            .or_insert_with(|| ClientState {
                client: Arc::clone(client),
                beginning: fresh.clone(),
                package: package.clone(),
                inspected: super::inspector::Path::default(),
                presents: false,
            })
    }

    /// Makes the session begin as the client's last input has left it, in the package that the
    /// request names, if it is to.
    pub(super) fn begin(&mut self, request: &Request, is_of_prompt: bool) {
        let state = self.client(request);
        let (beginning, package) = (state.beginning.clone(), state.package.clone());
        let named = request.package.as_deref().filter(|_| !is_of_prompt);
        if self.keeper.is_some() {
            return self.change_package(named.map(package_name), &package);
        }
        self.session.begin_with(&beginning);
        if let Some(named) = named {
            self.session.enter_package(package_name(named));
        }
    }

    /// Changes the package by an input, so that the kept inputs lead to the same state.
    fn change_package(&mut self, named: Option<&str>, usual: &str) {
        self.refresh_names();
        let is_known = |name: &&str| self.names.package(name).is_some();
        let wanted = named.filter(is_known).unwrap_or(usual);
        let (present, _) = self.session.package_names();
        let same = self.names.package(wanted) == self.names.package(&present);
        if same || self.names.package(wanted).is_none() {
            return;
        }
        let form = format!("(cl:in-package {:?})", wanted.to_uppercase());
        let text = match self.pending.is_empty() {
            true => form,
            false => format!(":eval {form}"),
        };
        self.give("package", &text, &mut |_| {});
    }

    /// Makes a package the current one; returns false if there is none of that name.
    pub(super) fn enter(&mut self, name: &str) -> bool {
        if self.keeper.is_none() {
            return self.session.enter_package(name);
        }
        self.refresh_names();
        let is_known = self.names.package(name).is_some();
        if is_known {
            self.change_package(Some(name), name);
        }
        is_known
    }

    /// Gives the session an input.
    pub(super) fn give(
        &mut self,
        source: &str,
        text: &str,
        sink: &mut dyn FnMut(Event),
    ) -> Outcome {
        if let Some(keeper) = &mut self.keeper {
            keeper.begins(text);
        }
        let outcome = self.session.evaluate(source, text, sink);
        if let Some(keeper) = &mut self.keeper {
            keeper.ends(self.session);
        }
        outcome
    }

    /// A name for the next input.
    pub(super) fn next_input(&mut self) -> String {
        self.inputs += 1;
        input_name(self.inputs)
    }

    /// Does something with the session that may take long and can be interrupted.
    pub(super) fn working<T>(
        &mut self,
        client: u64,
        work: impl FnOnce(&mut Engine<'s>) -> T,
    ) -> Result<T, defect::Defect> {
        for request in self.hub.begin_work(client) {
            self.answer_quick(&request);
        }
        let done = defect::caught(|| work(self));
        self.hub.end_work();
        self.is_changed = true;
        done
    }

    /// Evaluates a text for a request.
    pub(super) fn evaluate(&mut self, request: &Request, source: &str, text: &str, answer: Answer) {
        self.begin(request, answer.is_of_prompt());
        let text = match self.pending.is_empty() {
            true => text.to_owned(),
            false => format!(":eval {text}"),
        };
        let pending = Pending {
            number: 0,
            request: request.clone(),
            waits: true,
            is_shown: false,
            answer,
            yielded: Yield::default(),
        };
        self.input(pending, source, &text);
    }

    /// Gives the session an input, the yield of which belongs to a request, and settles what comes
    /// of it.
    fn input(&mut self, mut pending: Pending, source: &str, text: &str) {
        if self.pending.is_empty() {
            // What an earlier program has not read was not meant for this one.
            self.session.set_source(self.source.clone());
        }
        let client = pending.request.client.number;
        let ended = self.working(client, |engine| {
            engine.run_input(&mut pending, source, text)
        });
        self.settle(Some(pending), &ended.unwrap_or_else(Ended::by_defect));
    }

    /// Gives the session an input that decides about the evaluation that has stopped last, and
    /// settles what comes of it; what is yielded belongs to that evaluation.
    pub(super) fn decide(&mut self, text: &str) {
        let Some(mut top) = self.pending.pop() else {
            return;
        };
        if let Some(state) = self.clients.get(&top.request.client.number)
            && self.keeper.is_none()
        {
            let beginning = state.beginning.clone();
            self.session.begin_with(&beginning);
        }
        let client = top.request.client.number;
        let ended = self.working(client, |engine| {
            engine.run_input(&mut top, "decision", text)
        });
        self.pending.push(top);
        self.settle(None, &ended.unwrap_or_else(Ended::by_defect));
    }

    fn run_input(&mut self, pending: &mut Pending, source: &str, text: &str) -> Ended {
        let Pending {
            request,
            answer,
            yielded,
            ..
        } = pending;
        let outbox = &request.client.outbox;
        let interrupt = Arc::clone(&self.interrupt);
        let questions = Rc::clone(&self.questions);
        questions.set_client(Some(Arc::clone(&request.client)));
        let mut object: ObjectNumber = self.session.next_object();
        let mut aborted = None;
        let mut is_in_line = false;
        let outcome = self.give(source, text, &mut |event| match event {
            Event::Output(text) | Event::ErrorOutput(text) if answer.takes_output() => {
                yielded.printed.push_str(&text);
            }
            Event::Output(text) | Event::ErrorOutput(text) => {
                let unseen = questions.unseen(&text);
                // After a question, the client has ended the line.
                if let Some(last) = unseen.chars().last() {
                    is_in_line = last != '\n';
                }
                outbox.write(unseen, &interrupt);
            }
            Event::Values(values) => {
                yielded.object = (!values.is_empty()).then_some(object);
                if let Answer::Prompt { presents } = answer {
                    if std::mem::take(&mut is_in_line) {
                        outbox.write("\n", &interrupt);
                    }
                    super::repl::show_values(outbox, &values, presents.then_some(object));
                }
                object += values.len() as ObjectNumber;
                yielded.values = values;
            }
            Event::Aborted(abort) => {
                let place = abort.main_place();
                let place = place.map_or_else(String::new, |place| format!("; at {place}\n"));
                let report = abort.report.trim_end();
                outbox.write(&format!("{report}\n{place}"), &interrupt);
                aborted = Some(abort.condition);
            }
            Event::Left(condition) => aborted = Some(condition),
            Event::Stopped(_) | Event::Picture(_) | Event::Progress(_) => {}
        });
        self.questions.set_client(None);
        Ended { outcome, aborted }
    }
}
