//! One connection: checks who is asking, and answers.

use std::io;
use std::net::TcpStream;
use std::sync::Arc;

use super::frame_json::frame_json;
use super::http::{HttpError, Request, answer, read_request};
use super::mesh_bytes::mesh_bytes;
use super::pace_control::{PaceControl, Speed};
use super::page::page;
use super::server::Shared;
use super::stream::stream;
use super::token::{is_same, random_word};

/// Greatest number of past frames in one answer.
const MOST_FRAMES: usize = 120;

const TEXT: &str = "text/plain; charset=utf-8";

/// Answers one request, or drops it.
pub(crate) fn serve(shared: &Arc<Shared>, mut to: TcpStream) {
    // Send frames, which are small, at once.
    let prepared = to.set_nodelay(true);
    // A client that sent something malformed, is too slow or has left gets no answer.
    if prepared.is_ok() {
        let _ = read_and_answer(shared, &mut to);
    }
}

fn read_and_answer(shared: &Arc<Shared>, to: &mut TcpStream) -> Result<(), HttpError> {
    let request = read_request(to)?;
    if !is_from_own_page(shared, &request) {
        answer(to, "403 Forbidden", TEXT, "", b"Not for other pages.\n")?;
        return Ok(());
    }
    let mut parts = request.path.splitn(3, '/').skip(1);
    let token = parts.next().unwrap_or_default();
    if !is_same(token.as_bytes(), shared.token.as_bytes()) {
        answer(to, "404 Not Found", TEXT, "", b"There is nothing here.\n")?;
        return Ok(());
    }
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
            let text = past(shared, &request);
            answer(to, "200 OK", "application/json", "", text.as_bytes())?;
        }
        ("POST", Some("pace")) => {
            let is_known = shared
                .pace
                .as_ref()
                .is_some_and(|p| change_pace(p, &request.body));
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

/// Whether the request names this server as its host, so that no other name leads here, and
/// does not come from another page.
fn is_from_own_page(shared: &Shared, request: &Request) -> bool {
    let port = shared.port;
    let hosts = [format!("127.0.0.1:{port}"), format!("localhost:{port}")];
    let Some(host) = hosts.iter().find(|h| request.host.as_ref() == Some(h)) else {
        return false;
    };
    let origin = request.origin.as_deref();
    let is_own = origin.is_none_or(|origin| origin.strip_prefix("http://") == Some(host));
    let site = request.site.as_deref();
    // A request that no page made: the address was typed, or opened by another program.
    let is_alone = matches!(site, None | Some("same-origin" | "none"));
    let is_safe = request.method == "GET" || origin.is_some();
    is_own && is_alone && is_safe
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

/// The frames of the past between two times as a list, each as its difference from the one
/// before.
fn past(shared: &Shared, request: &Request) -> String {
    let from = request.number("from").unwrap_or(0.0);
    let to = request.number("to").unwrap_or(from);
    let frames = shared.history.past(from, to, MOST_FRAMES);
    let mut before = None;
    let frames: Vec<String> = frames
        .iter()
        .map(|frame| frame_json(frame, before.replace(frame.as_ref())))
        .collect();
    format!("[{}]", frames.join(","))
}

/// Carries out a viewer's request: `pause`, `go`, or `speed` and a speed. Returns whether the
/// request is known.
fn change_pace(pace: &PaceControl, wanted: &str) -> bool {
    match wanted.split_once(' ') {
        None if wanted == "pause" => pace.set_paused(true),
        None if wanted == "go" => pace.set_paused(false),
        Some(("speed", speed)) => match Speed::named(speed) {
            Some(speed) => pace.set_speed(speed),
            None => return false,
        },
        _ => return false,
    }
    true
}
