//! Those who know the address are served, whoever else is there.

use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use super::viewed::{Viewed, viewed};
use session::{Session, SessionOptions};

/// The page and its streams, as one who knows the address gets them. A browser would try again
/// if a connection were lost; this does not.
fn is_served(viewed: &Viewed) {
    let begin = Instant::now();
    assert!(viewed.get("").ends_with(b"</html>\n"));
    assert_eq!(viewed.ask("speed max"), "204");
    viewed.events().until(|name, _| name == "frame");
    // Nobody had to be waited for.
    assert!(
        begin.elapsed() < Duration::from_secs(20),
        "{:?}",
        begin.elapsed()
    );
}

/// Sets a flag when it is dropped, by a failed assertion, too.
struct SetAtEnd<'a>(&'a AtomicBool);

impl Drop for SetAtEnd<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

#[test]
fn strangers_that_stay_take_no_place_from_the_page() {
    let viewed = viewed();
    let mut strangers: Vec<TcpStream> = (0..300).map(|_| viewed.connect()).collect();
    is_served(&viewed);
    for stranger in &mut strangers {
        // Those that had to leave cannot be written to.
        let _ = stranger.write_all(b"GET / HT");
    }
    is_served(&viewed);
    drop(strangers);
    is_served(&viewed);
}

#[test]
fn thousands_of_connects_take_no_place_from_the_page() {
    let viewed = viewed();
    let (host, done) = (viewed.host.as_str(), AtomicBool::new(false));
    thread::scope(|scope| {
        let flood = scope.spawn(|| {
            let mut count = 0;
            while !done.load(Ordering::Relaxed) || count < 3000 {
                if let Ok(mut stream) = TcpStream::connect(host) {
                    let _ = stream.write_all(b"GET /word/ HTTP/1.1\r\nHost: localhost\r\n");
                }
                count += 1;
            }
            count
        });
        let ends = SetAtEnd(&done);
        (0..10).for_each(|_| is_served(&viewed));
        drop(ends);
        assert!(flood.join().unwrap() >= 3000);
    });
}

#[test]
fn clients_that_send_byte_by_byte_take_no_place_from_the_page() {
    let viewed = viewed();
    let (host, done) = (viewed.host.as_str(), AtomicBool::new(false));
    thread::scope(|scope| {
        let _ends = SetAtEnd(&done);
        scope.spawn(|| {
            let mut slow: Vec<TcpStream> = Vec::new();
            while !done.load(Ordering::Relaxed) {
                slow.retain_mut(|stream| stream.write_all(b"a").is_ok());
                while slow.len() < 200 {
                    slow.extend(TcpStream::connect(host));
                }
                thread::sleep(Duration::from_millis(20));
            }
        });
        (0..5).for_each(|_| is_served(&viewed));
    });
}

#[test]
fn too_many_pages_are_told_so() {
    let viewed = viewed();
    let mut streams: Vec<_> = (0..96).map(|_| viewed.events()).collect();
    streams.iter_mut().for_each(|stream| {
        stream.until(|name, _| name == "hello");
    });
    let own = format!("Host: {}\r\n", viewed.host);
    assert_eq!(viewed.status("GET", &viewed.path, &own, ""), "503");
    drop(streams);
    let begin = Instant::now();
    while viewed.status("GET", &viewed.path, &own, "") != "200" {
        assert!(begin.elapsed() < Duration::from_secs(20));
        thread::sleep(Duration::from_millis(50));
    }
}

#[test]
fn a_tunnel_may_have_another_port_but_no_other_name() {
    let viewed = viewed();
    let get = |host: &str| viewed.status("GET", &viewed.path, &format!("Host: {host}\r\n"), "");
    for host in [
        "localhost:9000",
        "127.0.0.1:9000",
        "[::1]:9000",
        "localhost",
    ] {
        assert_eq!(get(host), "200", "{host}");
    }
    let port = viewed.host.split(':').nth(1).unwrap();
    for name in [
        "evil.example",
        "localhost.evil.example",
        "127.0.0.1.nip.io",
        "0.0.0.0",
        "[::]",
    ] {
        assert_eq!(get(&format!("{name}:{port}")), "403", "{name}");
    }
    let ask = |host: &str, origin: &str| {
        let headers = format!("Host: {host}\r\nOrigin: {origin}\r\n");
        let path = format!("{}pace", viewed.path);
        viewed.status("POST", &path, &headers, "speed max")
    };
    assert_eq!(ask("localhost:9000", "http://localhost:9000"), "204");
    for origin in [
        "http://localhost:8000",
        "http://localhost",
        "http://127.0.0.1:9000",
        "https://localhost:9000",
        "http://evil.example",
        "null",
    ] {
        assert_eq!(ask("localhost:9000", origin), "403", "{origin}");
    }
}

#[test]
fn the_view_has_the_port_that_is_asked_for_or_says_why_not() {
    let free = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = free.local_addr().unwrap().port();
    let options = SessionOptions {
        view_port: Some(port),
        ..SessionOptions::default()
    };
    let mut session = Session::new(&options).unwrap();
    let told = session.open_view().unwrap_err().to_string();
    assert_eq!(
        told,
        format!(
            "the live view cannot be opened: port {port} is in use; give --view-port another one, \
             or leave it out to use any that is free"
        )
    );
    drop(free);
    let address = session.open_view().unwrap();
    assert!(
        address.starts_with(&format!("http://127.0.0.1:{port}/")),
        "{address}"
    );
}

#[test]
fn a_view_that_is_opened_again_has_the_same_address() {
    let mut viewed = viewed();
    let address = format!("http://{}{}", viewed.host, viewed.path);
    let mut events = viewed.events();
    events.until(|name, _| name == "frame");
    viewed.evaluate("(pw:view nil)");
    events.until(|name, _| name == "over");
    let mut rest = Vec::new();
    assert!(TcpStream::connect(&viewed.host).map_or(true, |mut stream| {
        stream
            .read_to_end(&mut rest)
            .map_or(true, |count| count == 0)
    }));
    assert_eq!(viewed.session.open_view().unwrap(), address);
    is_served(&viewed);
}
