//! The protocol over HTTP on this machine, as far as a server needs that asks its clients nothing ("streamable
//! HTTP"): a request is POSTed and answered by JSON; there is no stream of events.
//!
//! - Only requests that contain the word of the address, name this machine as their host and do not come from a
//!   page of another server are read. Others cannot use up the connections of these.
//! - A connection is a thread that reads and writes. Each client that initializes has a world of its own, and a thread in
//!   which that lives: what it asks is answered in order, beside what others ask. What waits is bounded.
//! - One client too many takes the place of the one that has been silent longest, which then learns that its session has
//!   ended and begins another one.

mod clients;
mod job;

use std::io;
use std::net::{TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::mpsc::{self, RecvTimeoutError, SyncSender, TrySendError};
use std::thread;
use std::time::Duration;

use super::server::VERSIONS;
use crate::tools::{MAX_REQUEST, World};
use clients::{TOO_MANY, answer_jobs};
use job::{Asked, Client, JSON, Job, Reply};
use view::watch::http::{HttpError, Request, answer, read_request};
use view::watch::live::{Door, Stranger, is_same};

/// Maximum number of connections that have not shown the word, and of those that have.
const MAX_STRANGERS: usize = 64;
const MAX_GUESTS: usize = 16;
/// Maximum number of requests that wait to be handed to their clients' threads.
const MAX_WAITING: usize = 8;
/// How long a client may take to send the body of a request.
const BODY_TIME: Duration = Duration::from_secs(10);
/// How often it is looked whether a client that waits is still there.
const LOOK: Duration = Duration::from_millis(200);
/// Bytes of stack for a connection's thread.
const STACK_BYTES: usize = 512 << 10;

/// Serves clients for ever; `open` makes a world for each.
pub(crate) fn serve(
    listener: TcpListener,
    word: &str,
    open: impl Fn() -> Result<World, String> + Clone + Send + 'static,
) -> io::Result<()> {
    let (to, jobs) = mpsc::sync_channel(MAX_WAITING);
    let path = format!("/{word}/mcp");
    thread::Builder::new()
        .name("mcp".to_owned())
        .spawn(move || accept(&listener, path, to))?;
    answer_jobs(&jobs, open);
    Ok(())
}

fn accept(listener: &TcpListener, path: String, to: SyncSender<Job>) {
    let serve = move |stranger: &Stranger, mut stream| {
        // A client that sent something malformed, is too slow or has left gets no answer.
        let _ = read_and_answer(&path, &to, stranger, &mut stream);
    };
    let kind = ("mcp client", STACK_BYTES);
    Door::new(MAX_STRANGERS, MAX_GUESTS).serve(listener, kind, || true, serve);
}

fn read_and_answer(
    path: &str,
    to: &SyncSender<Job>,
    stranger: &Stranger,
    stream: &mut TcpStream,
) -> Result<(), HttpError> {
    let mut request = read_request(stream)?;
    let is_known = is_same(request.path.as_bytes(), path.as_bytes());
    let reply = if !request.is_from_this_machine() {
        Reply::text("403 Forbidden", "Not for other pages or machines.")
    } else if !is_known {
        Reply::text("404 Not Found", "There is nothing here.")
    } else {
        let Some(_guest) = stranger.welcome() else {
            return send(stream, &Reply::text("503 Service Unavailable", "Too many."));
        };
        let reply = match asked(&mut request, stream) {
            Ok(what) => waited(to, stream, request.header("mcp-session-id"), what),
            Err(refused) => refused,
        };
        return send(stream, &reply);
    };
    send(stream, &reply)
}

fn send(stream: &mut TcpStream, reply: &Reply) -> Result<(), HttpError> {
    stream.set_write_timeout(Some(BODY_TIME))?;
    answer(
        stream,
        reply.status,
        reply.kind,
        &reply.headers,
        reply.content.as_bytes(),
    )?;
    Ok(())
}

/// What a request asks for, or why it is refused.
fn asked(request: &mut Request, stream: &mut TcpStream) -> Result<Asked, Reply> {
    if let Some(version) = request.header("mcp-protocol-version")
        && !VERSIONS.contains(&version)
    {
        let known = VERSIONS.join(", ");
        let why = format!("This version of the protocol is not spoken; these are: {known}.");
        return Err(Reply::text("400 Bad Request", &why));
    }
    match request.method.as_str() {
        "POST" => {}
        "DELETE" => return Ok(Asked::End),
        _ => {
            return Err(Reply {
                headers: "Allow: POST, DELETE\r\n".to_owned(),
                ..Reply::text(
                    "405 Method Not Allowed",
                    "Requests are POSTed; there is no stream of events.",
                )
            });
        }
    }
    let kind = request.header("content-type").unwrap_or_default();
    let kind = kind.split(';').next().unwrap_or_default().trim();
    if !kind.eq_ignore_ascii_case(JSON) {
        let why = "Content-Type: application/json was expected.";
        return Err(Reply::text("415 Unsupported Media Type", why));
    }
    let is_taken = |accepted: &str| {
        [JSON, "application/*", "*/*"]
            .iter()
            .any(|k| accepted.contains(k))
    };
    if request
        .header("accept")
        .is_some_and(|accepted| !is_taken(accepted))
    {
        let why = "Answers are application/json: Accept has to name it.";
        return Err(Reply::text("406 Not Acceptable", why));
    }
    match request.read_body(stream, MAX_REQUEST, BODY_TIME) {
        Ok(body) => Ok(Asked::Message(body)),
        Err(HttpError::TooLarge) => Err(Reply::text(
            "413 Content Too Large",
            &format!("A request has {MAX_REQUEST} bytes at most."),
        )),
        Err(_) => Err(Reply::text("408 Request Timeout", "The body did not come.")),
    }
}

/// The answer of the thread that has the client's session.
fn waited(to: &SyncSender<Job>, stream: &TcpStream, session: Option<&str>, what: Asked) -> Reply {
    let (reply, replies) = mpsc::sync_channel(1);
    let Ok(client) = Client::of(stream).map(Arc::new) else {
        return Reply::nothing("408 Request Timeout");
    };
    let job = Job {
        session: session.map(str::to_owned),
        what,
        client: Arc::clone(&client),
        reply,
    };
    match to.try_send(job) {
        Ok(()) => {}
        Err(TrySendError::Full(_) | TrySendError::Disconnected(_)) => {
            return Reply::text("503 Service Unavailable", TOO_MANY);
        }
    }
    loop {
        match replies.recv_timeout(LOOK) {
            Ok(reply) => return reply,
            Err(RecvTimeoutError::Timeout) => {
                if client.has_gone() {
                    return Reply::nothing("408 Request Timeout");
                }
            }
            Err(RecvTimeoutError::Disconnected) => {
                return Reply::text("500 Internal Server Error", "There is no answer.");
            }
        }
    }
}
