//! The clients and their worlds, in one thread.

use std::sync::mpsc::Receiver;

use super::job::{Asked, Job, Reply};
use crate::mcp::server::{Server, is_initialize, unread};
use crate::tools::World;
use view::watch::live::{is_same, random_word};

/// Maximum number of clients with a world.
const MAX_CLIENTS: usize = 4;
/// The header that names a client's session.
const SESSION: &str = "Mcp-Session-Id";

/// Answers what is asked, one after the other.
pub(super) fn answer_jobs(jobs: &Receiver<Job>, open: impl Fn() -> Result<World, String>) {
    let mut clients = Clients {
        open,
        all: Vec::new(),
    };
    for job in jobs {
        if job.client.has_gone() {
            continue;
        }
        let reply = clients.reply(job.session.as_deref(), &job.what);
        // Who has gone meanwhile gets none.
        let _ = job.reply.send(reply);
    }
}

/// The clients that have initialized, by the names of their sessions; the one heard of last is the last.
struct Clients<O> {
    open: O,
    all: Vec<(String, Server)>,
}

impl<O: Fn() -> Result<World, String>> Clients<O> {
    fn reply(&mut self, session: Option<&str>, what: &Asked) -> Reply {
        let at = session.and_then(|name| {
            let mut names = self.all.iter().map(|(known, _)| known);
            names.position(|known| is_same(known.as_bytes(), name.as_bytes()))
        });
        match (what, at) {
            (Asked::Message(message), _) if is_initialize(message) => self.begin(message),
            (Asked::Message(message), Some(at)) => {
                let client = self.all.remove(at);
                self.all.push(client);
                match self
                    .all
                    .last_mut()
                    .and_then(|(_, server)| server.answer(message))
                {
                    Some(answer) => Reply::json("200 OK", &answer),
                    None => Reply::nothing("202 Accepted"),
                }
            }
            (Asked::End, Some(at)) => {
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
        }
    }

    /// A client begins a session.
    fn begin(&mut self, message: &[u8]) -> Reply {
        if self.all.len() >= MAX_CLIENTS {
            self.all.remove(0);
        }
        let world = match (self.open)() {
            Ok(world) => world,
            Err(why) => return Reply::text("500 Internal Server Error", &why),
        };
        let mut server = Server::new(world);
        let Some(answer) = server.answer(message) else {
            return Reply::text("400 Bad Request", "\"initialize\" has an id.");
        };
        let name = random_word();
        let headers = format!("{SESSION}: {name}\r\n");
        self.all.push((name, server));
        Reply {
            headers,
            ..Reply::json("200 OK", &answer)
        }
    }
}
