//! The kernel: its sockets, and the requests that it answers.

use std::io;
use std::net::SocketAddr;
use std::rc::Rc;
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, SyncSender};
use std::thread;
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use thiserror::Error;

use super::answers;
use super::cell::{Cell, Ended, Failure};
use super::connection::{Connection, ConnectionError};
use super::display;
use super::history::History;
use super::interrupter::Interrupter;
use super::kernel_info::kernel_info;
use super::message::{Author, Request};
use super::publisher::Publisher;
use super::question::Questions;
use super::settings::Settings;
use super::signature::Signer;
use super::zmtp::{Kind, PeerNumber, Socket};
use session::dialogue::Illustrate;

/// How many requests may wait; whoever sends more waits.
const MAX_WAITING: usize = 1024;
/// How long the ports of a kernel that is just ending may be in use.
const PORTS_FREE: Duration = Duration::from_secs(3);
/// How often the kernel looks whether it is to end.
const LOOK: Duration = Duration::from_millis(50);
/// How long the last messages may take.
const FAREWELL: Duration = Duration::from_millis(500);

/// Why a kernel cannot run.
#[derive(Debug, Error)]
pub(crate) enum KernelError {
    /// The connection file is of no use.
    #[error("{0}")]
    Connection(#[from] ConnectionError),
    /// It cannot listen.
    #[error("cannot listen at {address}: {error}")]
    Listen {
        /// Where.
        address: SocketAddr,
        /// The reason.
        error: io::Error,
    },
    /// There are too many threads.
    #[error("cannot start a thread: {0}")]
    Thread(io::Error),
}

/// A kernel that listens.
pub(crate) struct Kernel {
    shell: Socket,
    sockets: Vec<Socket>,
    requests: Receiver<Request>,
    author: Arc<Author>,
    publisher: Arc<Publisher>,
    questions: Rc<Questions>,
    interrupter: Interrupter,
    settings: Settings,
    history: History,
    /// Number of the latest cell that counts.
    count: u64,
    /// Number of the latest input.
    inputs: usize,
    /// Until when the requests of a client are left out, after one of them has failed.
    failed: Option<(PeerNumber, Instant)>,
}

impl Kernel {
    /// Listens as a connection file says, for the evaluator to which an interrupter belongs.
    pub(crate) fn listen(
        connection: &Connection,
        interrupter: Interrupter,
        settings: Settings,
    ) -> Result<Kernel, KernelError> {
        let author = Arc::new(Author::new(Signer::new(connection.key())));
        let (to_shell, requests) = mpsc::sync_channel(MAX_WAITING);
        let (to_questions, replies) = mpsc::sync_channel(MAX_WAITING);

        let welcoming = Arc::clone(&author);
        let iopub = bind(connection, connection.iopub_port, Kind::Publisher, {
            move |socket, peer, _, topics| {
                let topic = topics.into_iter().next().unwrap_or_default();
                let content = json!({"subscription": String::from_utf8_lossy(&topic)});
                let mut frames = vec![topic];
                frames.extend(welcoming.message("iopub_welcome", b"", &content));
                socket.send(peer, &frames);
                true
            }
        })?;
        let publisher = Publisher::start(iopub.clone(), Arc::clone(&author));
        let publisher = publisher.map_err(KernelError::Thread)?;
        publisher.tell_state(b"", "starting");
        let heartbeat = bind(connection, connection.hb_port, Kind::Echo, |_, _, _, _| {
            true
        })?;
        let stdin = bind(connection, connection.stdin_port, Kind::Router, {
            reading(&author, to_questions, |_| {})
        })?;
        let control = bind(connection, connection.control_port, Kind::Router, {
            let control = Control {
                author: Arc::clone(&author),
                publisher: Arc::clone(&publisher),
                interrupter: interrupter.clone(),
            };
            move |socket, peer, identity, frames| {
                let signer = control.author.signer();
                let request = Request::read(signer, peer, identity, frames);
                if let Some(request) = &request {
                    control.answer(socket, request);
                }
                request.is_some()
            }
        })?;
        let shell = bind(connection, connection.shell_port, Kind::Router, {
            let interrupter = interrupter.clone();
            reading(&author, to_shell, move |request| {
                if request.kind == "execute_request" {
                    interrupter.expect();
                }
            })
        })?;
        let questions = Rc::new(Questions {
            stdin: stdin.clone(),
            shell: shell.clone(),
            author: Arc::clone(&author),
            replies,
            interrupter: interrupter.clone(),
        });
        Ok(Kernel {
            sockets: vec![shell.clone(), iopub, stdin, control, heartbeat],
            shell,
            requests,
            author,
            publisher,
            questions,
            interrupter,
            settings,
            history: History::default(),
            count: 0,
            inputs: 0,
            failed: None,
        })
    }

    /// Where the channels are: shell, iopub, stdin, control and heartbeat.
    #[cfg(any(test, fuzzing))]
    pub(crate) fn addresses(&self) -> Vec<SocketAddr> {
        self.sockets.iter().map(Socket::address).collect()
    }

    /// Answers requests until a client or a program ends the kernel; returns the exit status.
    pub(crate) fn serve(mut self, session: &mut impl Illustrate) -> u8 {
        session.show_errors_apart();
        let mut status = None;
        while status.is_none() && !self.interrupter.is_ending() {
            match self.requests.recv_timeout(LOOK) {
                Ok(request) => status = self.answer(session, &Rc::new(request)),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => break,
            }
        }
        // A recording is ended as well as it can be.
        let _ = session.finish();
        let until = Instant::now() + FAREWELL;
        self.publisher.end(until);
        self.sockets.iter().for_each(|socket| socket.drain(until));
        self.sockets.iter().for_each(Socket::close);
        status.unwrap_or(0)
    }

    /// Answers a request; returns the exit status if the program has asked to exit.
    fn answer(&mut self, session: &mut impl Illustrate, request: &Rc<Request>) -> Option<u8> {
        self.publisher.tell_state(&request.header, "busy");
        let mut status = None;
        let answer = match request.kind.as_str() {
            "execute_request" => {
                let content = self.execute(session, request, &mut status);
                self.interrupter.finish();
                Some(content)
            }
            "kernel_info_request" => Some(kernel_info()),
            "complete_request" => Some(answers::complete(session, &request.content)),
            "inspect_request" => Some(answers::inspect(session, &request.content)),
            "is_complete_request" => Some(answers::whole(&request.content)),
            "history_request" => Some(self.history.answer(&request.content)),
            "comm_info_request" => Some(json!({"status": "ok", "comms": {}})),
            "shutdown_request" => {
                self.interrupter.end();
                Some(farewell(request))
            }
            _ => None,
        };
        if let (Some(content), Some(name)) = (answer, request.kind.strip_suffix("_request")) {
            let frames = self
                .author
                .answer(request, &format!("{name}_reply"), &content);
            self.shell.send(request.peer, &frames);
        }
        self.publisher.tell_state(&request.header, "idle");
        status
    }

    /// Evaluates a cell; the content of the answer.
    fn execute(
        &mut self,
        session: &mut impl Illustrate,
        request: &Rc<Request>,
        status: &mut Option<u8>,
    ) -> Value {
        if self.is_left_out(request) {
            return json!({"status": "aborted", "execution_count": self.count});
        }
        let is_silent = request.flag("silent", false);
        let is_counted = !is_silent && request.flag("store_history", true);
        if is_counted {
            self.count += 1;
        }
        self.inputs += 1;
        let code = request.text("code");
        let publish = |kind: &str, content: &Value| {
            self.publisher.publish(kind, &request.header, content);
        };
        if !is_silent {
            let content = json!({"code": code, "execution_count": self.count});
            publish("execute_input", &content);
        }
        let ended = match self.settings.take(code) {
            Ok(text) => {
                let cell = Cell {
                    publisher: Arc::clone(&self.publisher),
                    interrupter: &self.interrupter,
                    questions: Rc::clone(&self.questions),
                    request: Rc::clone(request),
                    settings: &self.settings,
                    number: self.inputs,
                    can_ask: request.flag("allow_stdin", true),
                    ahead: Rc::default(),
                };
                cell.evaluate(session, &text)
            }
            Err(wrong) => Ended::Failed(Failure::of_kernel("SETTING-ERROR", &wrong)),
        };
        let mut payload = Vec::new();
        if let Some(draft) = session.take_draft() {
            payload.push(json!({"source": "set_next_input", "text": draft, "replace": false}));
        }
        let mut answer = json!({"status": "ok", "user_expressions": {}});
        let mut values = None;
        match ended {
            Ended::Finished(found) => {
                if let Some(found) = found.as_ref().filter(|_| !is_silent) {
                    let content = json!({
                        "execution_count": self.count,
                        "data": display::of_values(found),
                        "metadata": {},
                    });
                    publish("execute_result", &content);
                }
                values = found.map(|found| found.text);
            }
            Ended::Failed(failure) => {
                answer = failure.content();
                publish("error", &answer);
                answer["status"] = json!("error");
                answer["user_expressions"] = json!({});
                if request.flag("stop_on_error", true) {
                    self.failed = Some((request.peer, Instant::now()));
                }
            }
            Ended::Quit(code) => {
                payload.push(json!({"source": "ask_exit", "keepkernel": false}));
                *status = Some(code);
            }
        }
        if is_counted {
            self.history.add(self.count, code, values);
        }
        answer["execution_count"] = json!(self.count);
        answer["payload"] = json!(payload);
        answer
    }

    /// Whether a request came before one of the same client had failed that came before it.
    fn is_left_out(&self, request: &Request) -> bool {
        let failed = self.failed.as_ref();
        failed.is_some_and(|(peer, at)| *peer == request.peer && request.received < *at)
    }
}

/// A socket at a port of the connection.
fn bind(
    connection: &Connection,
    port: u16,
    kind: Kind,
    handler: impl Fn(&Socket, PeerNumber, &[u8], Vec<Vec<u8>>) -> bool + Send + Sync + 'static,
) -> Result<Socket, KernelError> {
    let address = connection.address(port)?;
    let handler = Arc::new(handler);
    let begin = Instant::now();
    loop {
        let handler = Arc::clone(&handler);
        let handle = move |socket: &Socket, peer, identity: &[u8], frames| {
            handler(socket, peer, identity, frames)
        };
        match Socket::bind(address, kind, handle) {
            Ok(socket) => return Ok(socket),
            Err(error)
                if error.kind() == io::ErrorKind::AddrInUse && begin.elapsed() < PORTS_FREE =>
            {
                thread::sleep(LOOK);
            }
            Err(error) => return Err(KernelError::Listen { address, error }),
        }
    }
}

/// Passes on the messages that have the right signature.
fn reading(
    author: &Arc<Author>,
    to: SyncSender<Request>,
    note: impl Fn(&Request) + Send + Sync + 'static,
) -> impl Fn(&Socket, PeerNumber, &[u8], Vec<Vec<u8>>) -> bool + Send + Sync + 'static {
    let author = Arc::clone(author);
    move |_, peer, identity, frames| {
        let Some(request) = Request::read(author.signer(), peer, identity, frames) else {
            return false;
        };
        note(&request);
        // The kernel may just end.
        let _ = to.send(request);
        true
    }
}

/// What answers the control channel.
struct Control {
    author: Arc<Author>,
    publisher: Arc<Publisher>,
    interrupter: Interrupter,
}

impl Control {
    fn answer(&self, socket: &Socket, request: &Request) {
        self.publisher.tell_state(&request.header, "busy");
        let content = match request.kind.as_str() {
            "kernel_info_request" => Some(kernel_info()),
            "interrupt_request" => {
                self.interrupter.interrupt();
                Some(json!({"status": "ok"}))
            }
            "shutdown_request" => Some(farewell(request)),
            _ => None,
        };
        if let (Some(content), Some(name)) = (content, request.kind.strip_suffix("_request")) {
            let kind = format!("{name}_reply");
            let frames = self.author.answer(request, &kind, &content);
            socket.send(request.peer, &frames);
            if name == "shutdown" {
                // The others learn it, too.
                self.publisher.publish(&kind, &request.header, &content);
            }
        }
        self.publisher.tell_state(&request.header, "idle");
        if request.kind == "shutdown_request" {
            self.interrupter.end();
        }
    }
}

/// The answer to a `shutdown_request`.
fn farewell(request: &Request) -> Value {
    json!({"status": "ok", "restart": request.flag("restart", false)})
}
