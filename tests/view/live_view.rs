//! The live view as its page and as strangers meet it, over real connections.

use std::io::{Read, Write};
use std::net::{Shutdown, TcpStream};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, mpsc};
use std::thread;
use std::time::Duration;

use super::viewed::{Viewed, viewed};
use session::dialogue::screen::INTERRUPT;
use session::dialogue::{Evaluate, Event, Outcome};
use session::{Session, SessionOptions};

/// Moves arms and torso for some simulated seconds.
const EXERCISE: &str = "(in-package :pp-tut)
    (init-projection)
    (spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)))
    (with-simulated-robot
      (cpl:par
        (perform (a motion (type moving-torso) (joint-angle 0.3)))
        (park-arms)))";

/// The world that the exercise leaves when nobody looks.
fn unseen() -> u64 {
    let mut session = Session::new(&SessionOptions::default()).unwrap();
    let outcome = session.evaluate("test", EXERCISE, &mut |_| {});
    assert_eq!(outcome, Outcome::Finished);
    session.simulation().world().hash()
}

#[test]
fn the_page_is_whole_and_tells_the_browser_to_trust_nothing_else() {
    let viewed = viewed();
    let (path, host) = (&viewed.path, &viewed.host);
    let request = format!("GET {path} HTTP/1.1\r\nHost: {host}\r\nSec-Fetch-Site: none\r\n\r\n");
    let answer = String::from_utf8(viewed.send(request.as_bytes())).unwrap();
    let (head, page) = answer.split_once("\r\n\r\n").unwrap();
    assert!(head.starts_with("HTTP/1.1 200 OK\r\n"), "{head}");
    assert!(head.contains("Content-Security-Policy: default-src 'none'; script-src 'nonce-"));
    assert!(head.contains("frame-ancestors 'none'") && head.contains("no-store"));
    assert!(page.ends_with("</html>\n"));
    // Nothing comes from elsewhere.
    assert!(!page.contains("https://") && !page.contains("src=") && !page.contains("@import"));
    assert!(page.len() < 160_000, "{} bytes", page.len());
}

#[test]
fn only_the_page_itself_with_the_right_word_is_answered() {
    let viewed = viewed();
    let (path, host) = (&*viewed.path, &*viewed.host);
    let own = format!("Host: {host}\r\n");
    let get = |path: &str, headers: &str| viewed.status("GET", path, headers, "");
    assert_eq!(get(path, &own), "200");
    let local = own.replace("127.0.0.1", "localhost");
    assert_eq!(get(path, &local), "200");
    // Without the word, or with another.
    for wrong in [
        "/",
        "/x/",
        "/events",
        "/../",
        "/00000000000000000000000000000000/",
    ] {
        assert_eq!(get(wrong, &own), "404", "{wrong}");
    }
    assert_eq!(get(&format!("{path}Cargo.toml"), &own), "404");
    assert_eq!(get(&format!("{path}../../etc/passwd"), &own), "404");
    // By another name that leads here, or by none.
    assert_eq!(get(path, "Host: evil.example\r\n"), "403");
    assert_eq!(get(path, &format!("Host: {host}.evil.example\r\n")), "403");
    assert_eq!(get(path, ""), "403");
    // From another page.
    for stranger in [
        "Origin: http://evil.example\r\n",
        "Origin: null\r\n",
        "Origin: http://127.0.0.1:1\r\n",
        "Sec-Fetch-Site: cross-site\r\n",
        "Sec-Fetch-Site: same-site\r\n",
    ] {
        assert_eq!(get(path, &format!("{own}{stranger}")), "403", "{stranger}");
        let pace = format!("{path}pace");
        let headers = format!("{own}{stranger}");
        assert_eq!(viewed.status("POST", &pace, &headers, "pause"), "403");
    }
    // A request that changes something must say where it comes from.
    assert_eq!(
        viewed.status("POST", &format!("{path}pace"), &own, "pause"),
        "403"
    );
}

#[test]
fn nothing_but_pause_and_speed_can_be_asked_for() {
    let viewed = viewed();
    for known in ["pause", "go", "speed 0.25", "speed 4", "speed max"] {
        assert_eq!(viewed.ask(known), "204", "{known}");
    }
    for unknown in [
        "",
        "stop",
        "PAUSE",
        "speed",
        "speed -1",
        "speed 0",
        "speed nan",
        "speed 1e300",
        "pause go",
        "(quit)",
        "{\"speed\": 1}",
        "go\n(init-projection)",
    ] {
        assert_eq!(viewed.ask(unknown), "400", "{unknown}");
    }
    assert_eq!(viewed.ask(&"x".repeat(300)), "none");
    let own = format!("Host: {0}\r\nOrigin: http://{0}\r\n", viewed.host);
    for method in ["PUT", "DELETE", "OPTIONS", "HEAD", "EVAL"] {
        let path = format!("{}pace", viewed.path);
        assert_eq!(
            viewed.status(method, &path, &own, "pause"),
            "404",
            "{method}"
        );
    }
}

#[test]
fn garbage_is_dropped() {
    let viewed = viewed();
    let noise: Vec<u8> = (0..20_000u32)
        .map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8)
        .collect();
    let long = format!("GET /{} HTTP/1.1\r\n\r\n", "a".repeat(20_000));
    let unended = vec![b'a'; 100_000];
    let pieces: [&[u8]; 7] = [
        b"\r\n\r\n",
        b"GET\r\n\r\n",
        b"\0\0\0\0\r\n\r\n",
        b"GET / HTTP/1.1\r\nContent-Length: 99999999999999999999\r\n\r\n",
        &noise,
        long.as_bytes(),
        &unended,
    ];
    for piece in pieces {
        assert!(viewed.send(piece).is_empty());
    }
    // Others are answered as before.
    assert!(!viewed.get("past?from=0&to=1").is_empty());
    for query in [
        "",
        "?",
        "?from=x",
        "?from=-1e308&to=1e308",
        "?from=nan&to=inf",
        "?=&&=",
    ] {
        let text = String::from_utf8(viewed.get(&format!("past{query}"))).unwrap();
        assert!(text.starts_with("[{\"t\":0.0000,"), "{text:.40}");
        viewed.get(&format!("meshes{query}"));
    }
    assert!(viewed.get("meshes?from=1e300").is_empty());
}

#[test]
fn who_says_nothing_is_left() {
    let viewed = viewed();
    let mut silent = viewed.connect();
    silent.write_all(b"GET / HT").unwrap();
    // Neither silence nor a byte now and then keeps a connection.
    let mut slow = viewed.connect();
    let dropped = (0..100).any(|_| {
        thread::sleep(Duration::from_millis(100));
        slow.write_all(b"a").is_err()
    });
    assert!(dropped);
    let mut rest = Vec::new();
    assert!(!matches!(silent.read_to_end(&mut rest), Ok(1..)));
}

#[test]
fn a_viewer_gets_the_scene_and_its_changes_and_the_result_is_the_same() {
    let mut viewed = viewed();
    assert_eq!(viewed.ask("speed max"), "204");
    let mut events = viewed.events();
    let mut all = events.until(|name, _| name == "hello");
    let reader = thread::spawn(move || {
        all.extend(events.until(|name, _| name == "over"));
        events.until_its_end();
        all
    });
    viewed.evaluate(EXERCISE);
    assert_eq!(viewed.hash(), unseen());
    let span = viewed.get("past?from=0&to=1000");
    let frames: serde_json::Value = serde_json::from_slice(&span).unwrap();
    assert!(frames.as_array().unwrap().len() > 50);
    drop(viewed);
    // The end of the session is told, then the connection ends.
    let all = reader.join().unwrap();
    for event in ["hello", "nodes", "news", "pace", "frame", "over"] {
        assert!(all.iter().any(|(name, _)| name == event), "{event}");
    }
    let tells = |what: &str| all.iter().any(|(_, data)| data.to_string().contains(what));
    assert!(tells("\"BOTTLE-1\"") && tells("moving-torso"));
}

/// Sends nonsense on ever new connections until it is enough.
fn flood(host: &str, is_enough: &AtomicBool) {
    while !is_enough.load(Ordering::Relaxed) {
        if let Ok(mut stream) = TcpStream::connect(host) {
            let _ = stream.write_all(b"GET /flood HTTP/1.1\r\nHost: x\r\n\r\n\0\xff garbage");
            let _ = stream.shutdown(Shutdown::Both);
        }
        thread::sleep(Duration::from_micros(200));
    }
}

#[test]
fn stalling_and_flooding_clients_change_nothing() {
    let mut viewed = viewed();
    assert_eq!(viewed.ask("speed max"), "204");
    let mut stalled = Vec::new();
    for _ in 0..20 {
        let mut stream = viewed.connect();
        let (path, host) = (&viewed.path, &viewed.host);
        let request = format!("GET {path}events HTTP/1.1\r\nHost: {host}\r\n\r\n");
        stream.write_all(request.as_bytes()).unwrap();
        // Nothing is ever read from it.
        stalled.push(stream);
    }
    let done = AtomicBool::new(false);
    let (host, session) = (&viewed.host, &mut viewed.session);
    thread::scope(|scope| {
        scope.spawn(|| flood(host, &done));
        let outcome = session.evaluate("test", EXERCISE, &mut |_| {});
        done.store(true, Ordering::Relaxed);
        assert_eq!(outcome, Outcome::Finished);
    });
    assert_eq!(viewed.hash(), unseen());
}

impl Viewed {
    /// Evaluates the exercise and tells when that has begun; how it ends, and the condition that
    /// has aborted it.
    fn evaluate_telling(&mut self, tell: &mpsc::Sender<()>) -> (Outcome, String) {
        let mut condition = String::new();
        let text = format!("(princ :begun) {EXERCISE}");
        let outcome = self
            .session
            .evaluate("test", &text, &mut |event| match event {
                // Nobody may wait for it any more.
                Event::Output(text) if text.contains("BEGUN") => drop(tell.send(())),
                Event::Aborted(abort) => condition = abort.condition,
                _ => {}
            });
        (outcome, condition)
    }
}

#[test]
fn a_pause_ends_when_everybody_has_left() {
    let mut viewed = viewed();
    let mut events = viewed.events();
    events.until(|name, _| name == "hello");
    assert_eq!(viewed.ask("speed max"), "204");
    assert_eq!(viewed.ask("pause"), "204");
    let is_gone = Arc::new(AtomicBool::new(false));
    let leaves = Arc::clone(&is_gone);
    let (tell, told) = mpsc::channel();
    let viewer = thread::spawn(move || {
        told.recv().unwrap();
        // Were there no pause, the evaluation would soon be over.
        thread::sleep(Duration::from_millis(300));
        leaves.store(true, Ordering::Relaxed);
        drop(events);
    });
    let (outcome, _) = viewed.evaluate_telling(&tell);
    assert_eq!(outcome, Outcome::Finished);
    assert!(is_gone.load(Ordering::Relaxed));
    viewer.join().unwrap();
}

#[test]
fn an_interrupt_ends_what_is_paused() {
    let mut viewed = viewed();
    assert_eq!(viewed.ask("pause"), "204");
    let interrupt = viewed.session.interrupt_handle();
    let (tell, told) = mpsc::channel();
    let user = thread::spawn(move || {
        told.recv().unwrap();
        // If it comes before the pause, the same is to happen.
        thread::sleep(Duration::from_millis(50));
        interrupt.store(true, Ordering::Relaxed);
    });
    let (outcome, condition) = viewed.evaluate_telling(&tell);
    assert_eq!(outcome, Outcome::Aborted);
    assert_eq!(condition, INTERRUPT);
    user.join().unwrap();
}
