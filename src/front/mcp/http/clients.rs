//! The clients and their worlds: each has a thread of its own, in which its session lives.

use std::sync::mpsc::{self, Receiver, SyncSender, TrySendError};
use std::thread;

use super::job::{Asked, Job, Reply};
use crate::mcp::server::{Server, is_initialize, unread};
use crate::tools::World;
use view::watch::live::{is_same, random_word};

/// Maximum number of clients with a world.
const MAX_CLIENTS: usize = 4;
/// Maximum number of requests of one client that wait.
const MAX_WAITING: usize = 8;
/// The header that names a client's session.
const SESSION: &str = "Mcp-Session-Id";
/// What a client learns that asks too much.
pub(super) const TOO_MANY: &str = "Too many requests wait: ask again later.";

/// Hands what is asked to the clients' threads.
pub(super) fn answer_jobs(
    jobs: &Receiver<Job>,
    open: impl Fn() -> Result<World, String> + Clone + Send + 'static,
) {
    let mut clients = Clients {
        open,
        all: Vec::new(),
    };
    for job in jobs {
        if !job.client.has_gone() {
            clients.hand_over(job);
        }
    }
}

/// A client that has initialized.
struct Client {
    /// The name of its session.
    name: String,
    jobs: SyncSender<Job>,
}

/// All of them; the one heard of last is the last.
struct Clients<O> {
    open: O,
    all: Vec<Client>,
}

impl<O: Fn() -> Result<World, String> + Clone + Send + 'static> Clients<O> {
    fn hand_over(&mut self, job: Job) {
        let session = job.session.as_deref();
        let at = session.and_then(|name| {
            let mut names = self.all.iter().map(|client| &client.name);
            names.position(|known| is_same(known.as_bytes(), name.as_bytes()))
        });
        let reply = match (&job.what, at) {
            (Asked::Message(message), _) if is_initialize(message) => return self.begin(job),
            (Asked::Message(_), Some(at)) => {
                let client = self.all.remove(at);
                let refused = client.jobs.try_send(job);
                self.all.push(client);
                match refused {
                    Ok(()) => return,
                    Err(TrySendError::Full(job) | TrySendError::Disconnected(job)) => {
                        job.answer(Reply::text("503 Service Unavailable", TOO_MANY));
                        return;
                    }
                }
            }
            (Asked::End, Some(at)) => {
                // Its thread ends once it has answered what waits.
                self.all.remove(at);
                Reply::nothing("200 OK")
            }
            (Asked::Message(message), None) if session.is_none() => match unread(message) {
                Some(error) => Reply::json("400 Bad Request", &error),
                None => Reply::text(
                    "400 Bad Request",
                    "The session has not begun: \"initialize\" comes first, and Mcp-Session-Id names it.",
                ),
            },
            (_, None) => Reply::text(
                "404 Not Found",
                "There is no such session (any more): \"initialize\" begins one.",
            ),
        };
        job.answer(reply);
    }

    /// A client begins a session, in a thread of its own.
    fn begin(&mut self, job: Job) {
        if self.all.len() >= MAX_CLIENTS {
            self.all.remove(0);
        }
        let (to, jobs) = mpsc::sync_channel(MAX_WAITING);
        let (open, name) = (self.open.clone(), random_word());
        let named = name.clone();
        let thread = thread::Builder::new().name("mcp-client".to_owned());
        let begun = thread.spawn(move || serve(&open, &named, job, &jobs));
        // Otherwise the job has gone with its thread: the connection learns that there is no answer.
        if begun.is_ok() {
            self.all.push(Client { name, jobs: to });
        }
    }
}

/// Answers a client until nobody can ask any more.
fn serve(open: &impl Fn() -> Result<World, String>, name: &str, first: Job, jobs: &Receiver<Job>) {
    let world = match open() {
        Ok(world) => world,
        Err(why) => {
            first.answer(Reply::text("500 Internal Server Error", &why));
            return;
        }
    };
    let mut server = Server::new(world);
    let headers = format!("{SESSION}: {name}\r\n");
    let mut answered = |message: &[u8]| server.answer(message);
    let begun = first.message().and_then(&mut answered);
    first.answer(match begun {
        Some(answer) => Reply {
            headers,
            ..Reply::json("200 OK", &answer)
        },
        None => Reply::text("400 Bad Request", "\"initialize\" has an id."),
    });
    for job in jobs {
        if job.client.has_gone() {
            continue;
        }
        let answer = job.message().and_then(&mut answered);
        job.answer(match answer {
            Some(answer) => Reply::json("200 OK", &answer),
            None => Reply::nothing("202 Accepted"),
        });
    }
}
