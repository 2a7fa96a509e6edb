//! One connection: checks who is asking, and answers.

use std::io;
use std::net::TcpStream;
use std::sync::Arc;

use super::door::Stranger;
use super::http::{HttpError, Request, answer, read_request};
use super::mesh_bytes::mesh_bytes;
use super::page::page;
use super::server::Shared;
use super::stream::stream;
use super::token::{is_same, random_word};
use super::updates::past;

const TEXT: &str = "text/plain; charset=utf-8";

/// Names of this machine that lead nowhere else.
const LOCAL_NAMES: [&str; 3] = ["127.0.0.1", "localhost", "[::1]"];

/// Answers one request, or drops it.
pub(super) fn serve(shared: &Arc<Shared>, stranger: Stranger, mut to: TcpStream) {
    // Send frames, which are small, at once.
    let prepared = to.set_nodelay(true);
    // A client that sent something malformed, is too slow or has left gets no answer.
    if prepared.is_ok() {
        let _ = read_and_answer(shared, &stranger, &mut to);
    }
}

fn read_and_answer(
    shared: &Arc<Shared>,
    stranger: &Stranger,
    to: &mut TcpStream,
) -> Result<(), HttpError> {
    let request = read_request(to)?;
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
            let is_known = shared
                .pace
                .as_ref()
                .is_some_and(|pace| pace.change(&request.body));
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

/// Whether the request names this machine as its host, so that no other name leads here, and
/// does not come from another page. The port in the name is another one if the request comes
/// through a tunnel.
fn is_from_own_page(request: &Request) -> bool {
    let Some(host) = request.host.as_deref().filter(|host| is_local(host)) else {
        return false;
    };
    let origin = request.origin.as_deref();
    let is_own = origin.is_none_or(|origin| {
        let origin = origin.strip_prefix("http://");
        origin.is_some_and(|origin| origin.eq_ignore_ascii_case(host))
    });
    let site = request.site.as_deref();
    // A request that no page made: the address was typed, or opened by another program.
    let is_alone = matches!(site, None | Some("same-origin" | "none"));
    let is_safe = request.method == "GET" || origin.is_some();
    is_own && is_alone && is_safe
}

/// Whether a host, with or without a port, is this machine by one of its own names.
fn is_local(host: &str) -> bool {
    LOCAL_NAMES.iter().any(|name| {
        let Some((begin, rest)) = host.split_at_checked(name.len()) else {
            return false;
        };
        let is_port = |port: &str| {
            port.bytes().all(|byte| byte.is_ascii_digit()) && port.parse::<u16>().is_ok()
        };
        begin.eq_ignore_ascii_case(name)
            && (rest.is_empty() || rest.strip_prefix(':').is_some_and(is_port))
    })
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

#[cfg(test)]
mod tests {
    use crate::watch::live::connection::*;

    #[test]
    fn only_names_that_lead_nowhere_else_are_local() {
        for host in [
            "localhost",
            "127.0.0.1:8000",
            "LocalHost:9000",
            "[::1]:1",
            "[::1]",
        ] {
            assert!(is_local(host), "{host}");
        }
        for host in [
            "",
            "localhost:",
            "localhost:http",
            "localhost:65536",
            "localhost:+80",
            "localhost.",
            "localhost.evil.example:8000",
            "localhost@evil.example",
            "127.0.0.1.evil.example",
            "127.1:8000",
            "127.0.0.2:8000",
            "0.0.0.0:8000",
            "::1",
            "[::1]x:1",
            "evil.example",
            "ſocalhost",
        ] {
            assert!(!is_local(host), "{host}");
        }
    }
}
