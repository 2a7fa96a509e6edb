//! As much of HTTP as one page needs: the head of a request, and answers that close the
//! connection.

use std::io::{self, Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

use thiserror::Error;

/// Maximum size (bytes) of a request's head and body.
const MAX_HEAD: usize = 8 << 10;
const MAX_BODY: usize = 256;

/// How long a client may take to send its request, and to receive an answer.
const TIMEOUT: Duration = Duration::from_secs(3);

/// Why a request is not served.
#[derive(Debug, Error)]
pub(crate) enum HttpError {
    /// The client left, or was too slow.
    #[error("the client is gone: {0}")]
    Gone(#[from] io::Error),
    /// The data received is not a request.
    #[error("malformed")]
    Malformed,
    /// The request is larger than any valid one.
    #[error("too large")]
    TooLarge,
}

/// A client's request.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct Request {
    pub method: String,
    /// The path without the query.
    pub path: String,
    /// The part after the question mark.
    pub query: String,
    pub host: Option<String>,
    pub origin: Option<String>,
    /// What the browser says about the origin of the request.
    pub site: Option<String>,
    length: usize,
    pub body: String,
}

impl Request {
    /// The number that a parameter of the query has.
    pub(super) fn number(&self, name: &str) -> Option<f64> {
        let mut pairs = self
            .query
            .split('&')
            .filter_map(|pair| pair.split_once('='));
        let (_, text) = pairs.find(|(key, _)| *key == name)?;
        text.parse().ok().filter(|number: &f64| number.is_finite())
    }

    fn of_head(head: &str) -> Result<Self, HttpError> {
        let mut lines = head.split("\r\n");
        let mut words = lines.next().unwrap_or_default().split(' ');
        let (Some(method), Some(target), Some("HTTP/1.1" | "HTTP/1.0"), None) =
            (words.next(), words.next(), words.next(), words.next())
        else {
            return Err(HttpError::Malformed);
        };
        let (path, query) = target.split_once('?').unwrap_or((target, ""));
        let mut request = Self {
            method: method.to_owned(),
            path: path.to_owned(),
            query: query.to_owned(),
            ..Self::default()
        };
        for line in lines {
            let (name, value) = line.split_once(':').ok_or(HttpError::Malformed)?;
            let value = value.trim();
            let place = match name.to_ascii_lowercase().as_str() {
                "host" => &mut request.host,
                "origin" => &mut request.origin,
                "sec-fetch-site" => &mut request.site,
                "content-length" => {
                    request.length = value.parse().map_err(|_| HttpError::Malformed)?;
                    continue;
                }
                "transfer-encoding" => return Err(HttpError::Malformed),
                _ => continue,
            };
            // With two values, different programs would read different ones.
            if place.replace(value.to_owned()).is_some() {
                return Err(HttpError::Malformed);
            }
        }
        Ok(request)
    }
}

/// Reads one request.
pub(crate) fn read_request(stream: &mut TcpStream) -> Result<Request, HttpError> {
    let deadline = Instant::now() + TIMEOUT;
    stream.set_write_timeout(Some(TIMEOUT))?;
    let mut bytes = Vec::new();
    let end = loop {
        if let Some(end) = bytes.windows(4).position(|four| four == b"\r\n\r\n") {
            break end;
        }
        if bytes.len() > MAX_HEAD {
            return Err(HttpError::TooLarge);
        }
        read_some(stream, &mut bytes, deadline)?;
    };
    let head = str::from_utf8(bytes.get(..end).unwrap_or_default());
    let mut request = Request::of_head(head.map_err(|_| HttpError::Malformed)?)?;
    if request.length > MAX_BODY {
        return Err(HttpError::TooLarge);
    }
    let whole = end + 4 + request.length;
    while bytes.len() < whole {
        read_some(stream, &mut bytes, deadline)?;
    }
    let body = str::from_utf8(bytes.get(end + 4..whole).unwrap_or_default());
    body.map_err(|_| HttpError::Malformed)?
        .clone_into(&mut request.body);
    Ok(request)
}

fn read_some(stream: &mut TcpStream, to: &mut Vec<u8>, deadline: Instant) -> io::Result<()> {
    let left = deadline.saturating_duration_since(Instant::now());
    if left.is_zero() {
        return Err(io::ErrorKind::TimedOut.into());
    }
    stream.set_read_timeout(Some(left))?;
    let mut some = [0; 2048];
    match stream.read(&mut some)? {
        0 => Err(io::ErrorKind::UnexpectedEof.into()),
        count => {
            to.extend_from_slice(some.get(..count).unwrap_or_default());
            Ok(())
        }
    }
}

/// Headers of every answer: browsers must not cache it, guess its type, or show it inside another
/// page.
const ALWAYS: &str = "Connection: close\r\n\
     Cache-Control: no-store\r\n\
     X-Content-Type-Options: nosniff\r\n\
     X-Frame-Options: DENY\r\n\
     Referrer-Policy: no-referrer\r\n\
     Cross-Origin-Resource-Policy: same-origin\r\n\
     Cross-Origin-Opener-Policy: same-origin\r\n";

/// Sends an answer with this content and additional header lines.
pub(super) fn answer(
    stream: &mut TcpStream,
    status: &str,
    kind: &str,
    headers: &str,
    content: &[u8],
) -> io::Result<()> {
    let length = content.len();
    let head = format!(
        "HTTP/1.1 {status}\r\nContent-Type: {kind}\r\nContent-Length: {length}\r\n{ALWAYS}{headers}\r\n"
    );
    stream.write_all(head.as_bytes())?;
    stream.write_all(content)
}

/// Begins an answer that is an endless stream of events.
pub(crate) fn begin_events(stream: &mut TcpStream) -> io::Result<()> {
    let head = format!("HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\n{ALWAYS}\r\n");
    stream.write_all(head.as_bytes())
}

#[cfg(test)]
mod tests {
    use crate::watch::live::http::*;

    #[test]
    fn a_request_is_read() {
        let head = "GET /a/b?from=1.5&to=x HTTP/1.1\r\nHost: 127.0.0.1:80\r\nAccept: */*";
        let request = Request::of_head(head).unwrap();
        assert_eq!((&*request.method, &*request.path), ("GET", "/a/b"));
        assert_eq!(request.host.as_deref(), Some("127.0.0.1:80"));
        assert_eq!(request.number("from"), Some(1.5));
        assert_eq!((request.number("to"), request.number("n")), (None, None));
    }

    #[test]
    fn what_is_malformed_is_no_request() {
        for head in [
            "",
            "GET",
            "GET / HTTP/9",
            "GET  / HTTP/1.1",
            "GET / x HTTP/1.1",
            "GET / HTTP/1.1\r\nno colon",
            "GET / HTTP/1.1\r\nHost: a\r\nHost: b",
            "POST / HTTP/1.1\r\nContent-Length: -1",
            "POST / HTTP/1.1\r\nTransfer-Encoding: chunked",
        ] {
            assert!(Request::of_head(head).is_err(), "{head:?}");
        }
    }
}
