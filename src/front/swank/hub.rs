//! Where the threads of the connections and the one of the session meet: what waits for the
//! session, whom it works for, and what everybody may know meanwhile.

use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError, Weak};
use std::time::{Duration, Instant};

use super::outbox::Outbox;
use super::sexp::Sexp;
use super::version::Version;
use session::dialogue::Names;

/// How often somebody who waits for a text looks whether the wait is over.
const LOOKING: Duration = Duration::from_millis(10);

/// A client: one connection.
pub(super) struct Client {
    /// No other has had this number.
    pub(super) number: u64,
    /// What is sent to it.
    pub(super) outbox: Arc<Outbox>,
}

/// A request of a client.
#[derive(Clone)]
pub(super) struct Request {
    pub(super) client: Arc<Client>,
    /// The number by which the client knows it.
    pub(super) id: i64,
    /// The name of the operation, without its package.
    pub(super) operation: String,
    pub(super) arguments: Vec<Sexp>,
    /// What the buffer says about its package.
    pub(super) package: Option<String>,
}

impl Request {
    /// The argument with that index, without its quote.
    pub(super) fn argument(&self, index: usize) -> Option<&Sexp> {
        self.arguments.get(index).map(Sexp::unquoted)
    }

    /// The text of an argument.
    pub(super) fn text(&self, index: usize) -> Option<&str> {
        self.argument(index)?.as_str()
    }

    /// Sends its value.
    pub(super) fn ok(&self, value: Sexp) {
        self.answer(Sexp::list([Sexp::symbol(":ok"), value]));
    }

    /// Tells that it has no value, and why.
    pub(super) fn abort(&self, reason: &str) {
        self.answer(Sexp::list([Sexp::symbol(":abort"), reason.into()]));
    }

    fn answer(&self, told: Sexp) {
        let message = [Sexp::symbol(":return"), told, Sexp::Int(self.id)];
        self.client.outbox.send(&Sexp::list(message));
    }
}

/// What the session's thread is to do.
pub(super) enum Job {
    /// Answer a request.
    Request(Request),
    /// A text that was typed for `:read-string` with that tag.
    Typed(Arc<Client>, i64, String),
    /// The client does not want to type what it was asked for.
    NotTyped(Arc<Client>),
    /// The client is gone.
    Gone(Arc<Client>),
}

/// How a server ends.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Ended {
    /// Whoever has begun it has stopped it.
    Stopped,
    /// A client or a program has ended the session, with an exit status.
    Quit(u8),
}

/// What there is for the session's thread.
pub(super) enum Next {
    /// Something to do.
    Job(Job),
    /// Nothing.
    Idle,
    /// The end.
    End(Ended),
}

/// What the threads share.
pub(super) struct Hub {
    state: Mutex<State>,
    changed: Condvar,
    /// Ends what the session evaluates.
    interrupt: Arc<AtomicBool>,
}

#[derive(Default)]
struct State {
    /// Requests that need no evaluation.
    quick: VecDeque<Request>,
    jobs: VecDeque<Job>,
    /// The client for which the session evaluates.
    working_for: Option<u64>,
    names: Arc<Names>,
    version: Version,
    /// Number of clients that there have been.
    count: u64,
    /// Those that may still be connected.
    clients: Vec<Weak<Client>>,
    end: Option<Ended>,
}

impl Hub {
    pub(super) fn new(interrupt: Arc<AtomicBool>, version: Version, names: Arc<Names>) -> Hub {
        Hub {
            state: Mutex::new(State {
                version,
                names,
                ..State::default()
            }),
            changed: Condvar::new(),
            interrupt,
        }
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Makes a client of a connection.
    pub(super) fn connect(&self, outbox: Arc<Outbox>) -> Arc<Client> {
        let mut state = self.lock();
        state.count += 1;
        if state.end.is_some() {
            outbox.end();
        }
        let number = state.count;
        let client = Arc::new(Client { number, outbox });
        state.clients.retain(|known| known.strong_count() > 0);
        state.clients.push(Arc::downgrade(&client));
        client
    }

    /// The clients that are connected.
    pub(super) fn clients(&self) -> Vec<Arc<Client>> {
        let state = self.lock();
        state.clients.iter().filter_map(Weak::upgrade).collect()
    }

    /// The version of SLIME that clients are thought to have.
    pub(super) fn version(&self) -> Version {
        self.lock().version.clone()
    }

    /// Sets that version.
    pub(super) fn set_version(&self, version: Version) {
        self.lock().version = version;
    }

    /// Gives the session's thread something to do, after all that it already has.
    pub(super) fn add(&self, job: Job) {
        self.lock().jobs.push_back(job);
        self.changed.notify_all();
    }

    /// Has a request answered that needs no evaluation: by the session's thread, with what is
    /// known now, or, if that evaluates something, by the caller, who then gets the request back,
    /// with what was known when the evaluation began.
    pub(super) fn add_quick(&self, request: Request) -> Option<(Request, Arc<Names>)> {
        let mut state = self.lock();
        if state.working_for.is_some() {
            return Some((request, Arc::clone(&state.names)));
        }
        state.quick.push_back(request);
        self.changed.notify_all();
        None
    }

    /// What the session's thread does next; it waits for that as long as given.
    pub(super) fn next(&self, longest: Duration) -> Next {
        let until = Instant::now() + longest;
        let mut state = self.lock();
        loop {
            if let Some(ended) = state.end {
                return Next::End(ended);
            }
            if let Some(request) = state.quick.pop_front() {
                return Next::Job(Job::Request(request));
            }
            if let Some(job) = state.jobs.pop_front() {
                return Next::Job(job);
            }
            let left = until.saturating_duration_since(Instant::now());
            if left.is_zero() {
                return Next::Idle;
            }
            let waited = self.changed.wait_timeout(state, left);
            state = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
    }

    /// Makes known what is known about names.
    pub(super) fn publish(&self, names: Arc<Names>) {
        self.lock().names = names;
    }

    /// The session's thread begins to evaluate something for a client. Requests that need no
    /// evaluation and have come before are returned: they are answered first.
    pub(super) fn begin_work(&self, client: u64) -> Vec<Request> {
        let mut state = self.lock();
        state.working_for = Some(client);
        self.interrupt.store(state.end.is_some(), Ordering::Relaxed);
        state.quick.drain(..).collect()
    }

    /// It has ended.
    pub(super) fn end_work(&self) {
        let mut state = self.lock();
        state.working_for = None;
        self.interrupt.store(false, Ordering::Relaxed);
    }

    /// Interrupts what the session evaluates for a client; requests of that client that still wait
    /// are not begun at all.
    pub(super) fn interrupt(&self, client: &Arc<Client>) {
        let mut state = self.lock();
        if state.working_for == Some(client.number) {
            self.interrupt.store(true, Ordering::Relaxed);
            self.changed.notify_all();
            return;
        }
        let jobs = std::mem::take(&mut state.jobs);
        for job in jobs {
            match job {
                Job::Request(request) if request.client.number == client.number => {
                    request.abort("NIL");
                }
                job => state.jobs.push_back(job),
            }
        }
        state.jobs.push_back(Job::NotTyped(Arc::clone(client)));
        self.changed.notify_all();
    }

    /// A client has left: what is evaluated for it is interrupted.
    pub(super) fn leave(&self, client: &Arc<Client>) {
        let mut state = self.lock();
        if state.working_for == Some(client.number) {
            self.interrupt.store(true, Ordering::Relaxed);
        }
        state.jobs.retain(|job| match job {
            Job::Request(request) => request.client.number != client.number,
            _ => true,
        });
        state.jobs.push_back(Job::Gone(Arc::clone(client)));
        self.changed.notify_all();
    }

    /// Waits for the text that a client was asked for, on the session's thread, while that evaluates
    /// for the client. `None` if the evaluation is interrupted.
    pub(super) fn wait_for_text(&self, client: u64, tag: i64) -> Option<String> {
        let mut state = self.lock();
        loop {
            let typed = state.jobs.iter().position(
                |job| matches!(job, Job::Typed(from, of, _) if from.number == client && *of == tag),
            );
            if let Some(Job::Typed(_, _, text)) = typed.and_then(|at| state.jobs.remove(at)) {
                return Some(text);
            }
            if self.interrupt.load(Ordering::Relaxed) {
                return None;
            }
            let waited = self.changed.wait_timeout(state, LOOKING);
            state = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
    }

    /// Ends the server; what is evaluated is interrupted.
    pub(super) fn end(&self, ended: Ended) {
        let mut state = self.lock();
        state.end.get_or_insert(ended);
        self.interrupt.store(true, Ordering::Relaxed);
        self.changed.notify_all();
    }

    /// Whether the server is about to end.
    pub(super) fn is_ending(&self) -> bool {
        self.lock().end.is_some()
    }
}
