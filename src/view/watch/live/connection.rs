//! One connection: checks who is asking, and answers.

use std::io;
use std::net::TcpStream;
use std::sync::Arc;
use std::time::Duration;

use super::door::Stranger;
use super::mesh_bytes::mesh_bytes;
use super::page::page;
use super::server::Shared;
use super::stream::stream;
use super::token::{is_same, random_word};
use super::updates::past;
use crate::watch::http::{HttpError, Request, answer, read_request};

const TEXT: &str = "text/plain; charset=utf-8";

/// Maximum size (bytes) of a request's body, and the time that a client may take to send it.
const MAX_BODY: usize = 256;
const TIMEOUT: Duration = Duration::from_secs(3);

/// Answers one request, or drops it.
pub(super) fn serve(shared: &Arc<Shared>, stranger: &Stranger, mut to: TcpStream) {
    // Send frames, which are small, at once.
    let prepared = to.set_nodelay(true);
    // A client that sent something malformed, is too slow or has left gets no answer.
    if prepared.is_ok() {
        let _ = read_and_answer(shared, stranger, &mut to);
    }
}

fn read_and_answer(
    shared: &Arc<Shared>,
    stranger: &Stranger,
    to: &mut TcpStream,
) -> Result<(), HttpError> {
    let mut request = read_request(to)?;
    if !is_from_own_page(&request) {
        answer(to, "403 Forbidden", TEXT, "", b"Not for other pages.\n")?;
        return Ok(());
    }
    let mut parts = request.path.splitn(3, '/').skip(1);
    let token = parts.next().unwrap_or_default();
    if !is_same(token.as_bytes(), shared.token.as_bytes()) {
        answer(to, "404 Not Found", TEXT, "", b"There is nothing here.\n")?;
        return Ok(());
    }
    let Some(_guest) = stranger.welcome() else {
        answer(to, "503 Service Unavailable", TEXT, "", b"Too many.\n")?;
        return Ok(());
    };
    match (request.method.as_str(), parts.next()) {
        ("GET", Some("")) => send_page(to)?,
        ("GET", Some("events")) => {
            let _viewing = shared.begin_viewing();
            stream(shared, to)?;
        }
        ("GET", Some("meshes")) => {
            // The cast saturates.
            let first = request.number("from").unwrap_or(0.0) as usize;
            let bytes = mesh_bytes(&shared.history.nodes_from(first));
            answer(to, "200 OK", "application/octet-stream", "", &bytes)?;
        }
        ("GET", Some("past")) => {
            let from = request.number("from").unwrap_or(0.0);
            let to_time = request.number("to").unwrap_or(from);
            let text = past(&shared.history, from, to_time);
            answer(to, "200 OK", "application/json", "", text.as_bytes())?;
        }
        ("POST", Some("pace")) => {
            let body = request.read_body(to, MAX_BODY, TIMEOUT)?;
            let body = str::from_utf8(&body).map_err(|_| HttpError::Malformed)?;
            let pace = shared.pace.as_ref();
            let is_known = pace.is_some_and(|pace| pace.change(body));
            let status = if is_known {
                "204 No Content"
            } else {
                "400 Bad Request"
            };
            answer(to, status, TEXT, "", b"")?;
        }
        _ => answer(to, "404 Not Found", TEXT, "", b"There is nothing here.\n")?,
    }
    Ok(())
}

/// Whether the request is for this machine and does not come from another page; what changes something comes
/// from the page itself.
fn is_from_own_page(request: &Request) -> bool {
    let is_safe = request.method == "GET" || request.origin.is_some();
    request.is_from_this_machine() && is_safe
}

fn send_page(to: &mut TcpStream) -> io::Result<()> {
    let word = random_word();
    let policy = format!(
        "Content-Security-Policy: default-src 'none'; script-src 'nonce-{word}'; \
         style-src 'nonce-{word}'; connect-src 'self'; img-src data:; base-uri 'none'; \
         form-action 'none'; frame-ancestors 'none'\r\n"
    );
    answer(
        to,
        "200 OK",
        "text/html; charset=utf-8",
        &policy,
        page(&word).as_bytes(),
    )
}
