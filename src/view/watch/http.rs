//! As much of HTTP as a page or a program of this machine needs: the head of a request, a body of bounded
//! length, and answers that close the connection.

use std::io::{self, Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

use thiserror::Error;

/// Maximum size (bytes) of a request's head.
const MAX_HEAD: usize = 8 << 10;

/// How long a client may take to send its request, and to receive an answer.
const TIMEOUT: Duration = Duration::from_secs(3);

/// Names of this machine that lead nowhere else.
const LOCAL_NAMES: [&str; 3] = ["127.0.0.1", "localhost", "[::1]"];

/// Why a request is not served.
#[derive(Debug, Error)]
pub enum HttpError {
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

/// The head of a client's request.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Request {
    /// `GET`, `POST` or another one.
    pub method: String,
    /// The path without the query.
    pub path: String,
    /// The part after the question mark.
    pub query: String,
    /// The name of the machine that the client asks.
    pub host: Option<String>,
    /// The page that makes the request.
    pub origin: Option<String>,
    /// What the browser says about the origin of the request.
    pub site: Option<String>,
    /// Number of bytes of the body.
    length: usize,
    /// Names, in lower case, and values of the other headers.
    headers: Vec<(String, String)>,
    /// The bytes of the body that have come with the head.
    begun: Vec<u8>,
}

impl Request {
    /// The number that a parameter of the query has.
    pub(crate) fn number(&self, name: &str) -> Option<f64> {
        let mut pairs = self
            .query
            .split('&')
            .filter_map(|pair| pair.split_once('='));
        let (_, text) = pairs.find(|(key, _)| *key == name)?;
        text.parse().ok().filter(|number: &f64| number.is_finite())
    }

    /// The value of a header, by its name in lower case; the first if there are several.
    pub fn header(&self, name: &str) -> Option<&str> {
        let found = self.headers.iter().find(|(known, _)| known == name);
        found.map(|(_, value)| value.as_str())
    }

    /// Whether the request names this machine as its host, so that no other name leads here, and
    /// does not come from a page of another server. The port in the name is another one if the request comes
    /// through a tunnel.
    pub fn is_from_this_machine(&self) -> bool {
        let Some(host) = self.host.as_deref().filter(|host| is_local(host)) else {
            return false;
        };
        let is_own = self.origin.as_deref().is_none_or(|origin| {
            let origin = origin.strip_prefix("http://");
            origin.is_some_and(|origin| origin.eq_ignore_ascii_case(host))
        });
        // A request that no page made: the address was typed, or opened by another program.
        let is_alone = matches!(self.site.as_deref(), None | Some("same-origin" | "none"));
        is_own && is_alone
    }

    /// Reads the body, which may have so many bytes, in so much time.
    pub fn read_body(
        &mut self,
        stream: &mut TcpStream,
        max: usize,
        time: Duration,
    ) -> Result<Vec<u8>, HttpError> {
        if self.length > max {
            return Err(HttpError::TooLarge);
        }
        let deadline = Instant::now() + time;
        let mut bytes = std::mem::take(&mut self.begun);
        while bytes.len() < self.length {
            read_some(stream, &mut bytes, deadline)?;
        }
        bytes.truncate(self.length);
        Ok(bytes)
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
                    let is_number = !value.is_empty() && value.bytes().all(|b| b.is_ascii_digit());
                    let length = value
                        .parse()
                        .ok()
                        .filter(|_| is_number && request.length == 0);
                    request.length = length.ok_or(HttpError::Malformed)?;
                    continue;
                }
                "transfer-encoding" => return Err(HttpError::Malformed),
                other => {
                    request.headers.push((other.to_owned(), value.to_owned()));
                    continue;
                }
            };
            // With two values, different programs would read different ones.
            if place.replace(value.to_owned()).is_some() {
                return Err(HttpError::Malformed);
            }
        }
        Ok(request)
    }
}

/// Reads the head of a request.
pub fn read_request(stream: &mut TcpStream) -> Result<Request, HttpError> {
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
    let begun = bytes.split_off(end + 4);
    let head = str::from_utf8(bytes.get(..end).unwrap_or_default());
    let request = Request::of_head(head.map_err(|_| HttpError::Malformed)?)?;
    Ok(Request { begun, ..request })
}

fn read_some(stream: &mut TcpStream, to: &mut Vec<u8>, deadline: Instant) -> io::Result<()> {
    let left = deadline.saturating_duration_since(Instant::now());
    if left.is_zero() {
        return Err(io::ErrorKind::TimedOut.into());
    }
    stream.set_read_timeout(Some(left))?;
    let mut some = [0; 8192];
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
pub fn answer(
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
pub(super) fn begin_events(stream: &mut TcpStream) -> io::Result<()> {
    let head = format!("HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\n{ALWAYS}\r\n");
    stream.write_all(head.as_bytes())
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

#[cfg(test)]
mod tests {
    use crate::watch::http::*;

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
            "POST / HTTP/1.1\r\nContent-Length: 18446744073709551616",
            "POST / HTTP/1.1\r\nContent-Length: 1\r\nContent-Length: 2",
            "POST / HTTP/1.1\r\nTransfer-Encoding: chunked",
        ] {
            assert!(Request::of_head(head).is_err(), "{head:?}");
        }
    }

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
