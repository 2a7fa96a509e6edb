//! Clients that do harm, and what the others notice of it.

use std::io::{Read, Write};
use std::net::{Shutdown, TcpStream};

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use serde_json::json;

use super::client::{Client, connect, greeting, receive, start};
use crate::jupyter::zmtp::encoded;
use crate::tests::waiting::{file_to_come, wait_for_file};

#[test]
fn messages_without_the_right_signature_are_not_answered() {
    let kernel = start();
    let mut stranger = Client::with_key(&kernel, "s", "another key");
    stranger.send("(defvar *known* 1)", false);
    let (bytes, _) = stranger.request("shutdown_request", &json!({"restart": false}));
    stranger.control.write_all(&bytes).expect("it is read");
    let mut client = Client::new(&kernel, "a");
    assert_eq!(client.run("(boundp '*known*)").value(), Some("NIL"));
}

#[test]
fn garbage_ends_its_own_connection_only() {
    let kernel = start();
    let mut client = Client::new(&kernel, "a");
    let mut random = Pcg64Mcg::seed_from_u64(3);
    let announced = [&[2][..], &(1_u64 << 60).to_be_bytes()].concat();
    for address in &kernel.addresses {
        for kind in ["DEALER", "SUB", "REQ", "nonsense", ""] {
            let whole = greeting(kind, "x");
            let mut garbage = vec![0; 300];
            random.fill_bytes(&mut garbage);
            let cut = random.next_u32() as usize % whole.len();
            let endless = [1, 0].repeat(10_000);
            for bytes in [
                garbage.clone(),
                whole[..cut].to_vec(),
                [&whole[..], &garbage].concat(),
                [&whole[..], &announced].concat(),
                [&whole[..], &endless].concat(),
                [&whole[..], &encoded(&["<IDS|MSG>", "", "{}", "{}"])].concat(),
            ] {
                let mut stream = TcpStream::connect(address).expect("the kernel listens");
                // The kernel may have closed the connection already.
                let _ = stream.write_all(&bytes);
                let _ = stream.shutdown(Shutdown::Write);
            }
        }
    }
    assert_eq!(client.run("(+ 1 2)").value(), Some("3"));
}

#[test]
fn half_open_and_half_sent_connections_keep_nobody_out() {
    let kernel = start();
    let mut client = Client::new(&kernel, "a");
    assert_eq!(client.run("(+ 1 2)").value(), Some("3"));
    // Shell and iopub.
    let connections: Vec<TcpStream> = (0..160)
        .map(|number| {
            let address = kernel.addresses[number % 2];
            let mut stream = TcpStream::connect(address).expect("the kernel listens");
            let begun = greeting("DEALER", "x");
            stream
                .write_all(&begun[..number * begun.len() / 160])
                .expect("it is read");
            stream
        })
        .collect();
    let mut ended = Vec::new();
    let mut oldest = connections.first().expect("there are some");
    // It may have been greeted before it had to make room.
    let _ = oldest.read_to_end(&mut ended);
    assert_eq!(client.run("(+ 1 2)").value(), Some("3"));
    let mut late = Client::new(&kernel, "b");
    assert_eq!(late.run("(+ 1 2)").value(), Some("3"));
    drop(connections);
}

#[test]
fn a_message_that_comes_twice_is_executed_once() {
    let kernel = start();
    let mut client = Client::new(&kernel, "a");
    client.run("(defvar *count* 0)");
    let cell = json!({"code": "(incf *count*)", "silent": false, "allow_stdin": false});
    let (bytes, name) = client.request("execute_request", &cell);
    client.shell.write_all(&bytes).expect("it is read");
    client.wait(&name);
    let mut other = Client::new(&kernel, "b");
    client.shell.write_all(&bytes).expect("it is read");
    other.shell.write_all(&bytes).expect("it is read");
    client.wait_until_read();
    other.wait_until_read();
    assert_eq!(client.run("*count*").value(), Some("1"));
}

#[test]
fn a_client_may_vanish_in_the_middle_of_a_cell_or_of_a_question() {
    let kernel = start();
    let mut gone = Client::new(&kernel, "gone");
    let name = gone.send("(restart-case (error \"no\") (use-value (v) v))", true);
    gone.wait(&name);
    gone.send("0", true);
    receive(&mut gone.stdin).expect("a question");
    drop(gone);
    let mut gone = Client::new(&kernel, "gone, too");
    gone.send("(loop repeat 1000000 do (format t \"~a\" :much))", false);
    drop(gone);
    let mut client = Client::new(&kernel, "a");
    client.run("q");
    assert_eq!(client.run("(+ 1 2)").value(), Some("3"));
}

#[test]
fn nothing_is_dropped_for_a_client_that_reads_slowly() {
    let kernel = start();
    let mut slow = Client::new(&kernel, "slow");
    let file = file_to_come("jupyter-slow-client");
    let cell = format!(
        "(dotimes (i 300000)
           (format t \"line ~d of the output~%\" i)
           (when (= i 100000) (close (open {file:?} :direction :output))))"
    );
    let name = slow.send(&cell, false);
    wait_for_file(&file);
    let text = slow.wait(&name).text();
    let lines = text.lines().enumerate();
    for (number, line) in lines {
        assert_eq!(line, format!("line {number} of the output"));
    }
    assert_eq!(text.lines().count(), 300_000);
}

#[test]
fn a_client_that_never_reads_is_disconnected_and_the_others_miss_nothing() {
    let kernel = start();
    let mut silent = connect(kernel.addresses[1], "SUB", "");
    silent.write_all(&encoded(&[b"\x01"])).expect("it is read");
    let mut client = Client::new(&kernel, "a");
    let cell = "(let ((line (make-string 100000 :initial-element #\\x)))
                  (dotimes (i 400) (write-line line)))";
    assert_eq!(client.run(cell).text().len(), 400 * 100_001);
    while receive(&mut silent).is_ok() {}
    assert_eq!(client.run("(+ 1 2)").value(), Some("3"));
}

#[test]
fn an_interrupt_ends_a_flood_that_nobody_reads() {
    let kernel = start();
    let mut client = Client::new(&kernel, "a");
    let file = file_to_come("jupyter-flood");
    let cell = format!(
        "(loop for i from 0
               do (write-line (make-string 100000 :initial-element #\\x))
                  (when (= i 30) (close (open {file:?} :direction :output))))"
    );
    let name = client.send(&cell, false);
    wait_for_file(&file);
    client.control("interrupt_request");
    let answer = client.wait(&name);
    assert_eq!(answer.of("error")[0]["ename"], json!("INTERRUPT"));
}

#[test]
fn the_heartbeat_goes_on_while_a_cell_runs() {
    let kernel = start();
    let mut client = Client::new(&kernel, "a");
    let name = client.send("(loop)", false);
    // An interrupt may otherwise come before the cell.
    client.wait_for(&name, "status");
    let mut heart = connect(kernel.addresses[4], "REQ", "");
    for beat in [&b"one"[..], b"", &[7; 1000]] {
        heart
            .write_all(&encoded(&[&b""[..], beat]))
            .expect("it is read");
        assert_eq!(receive(&mut heart).expect("an echo"), [&b""[..], beat]);
    }
    client.control("interrupt_request");
    client.wait(&name);
}

#[test]
fn unknown_requests_leave_the_kernel_idle() {
    let kernel = start();
    let mut client = Client::new(&kernel, "a");
    let (bytes, name) = client.request("comm_open", &json!({"comm_id": 1}));
    client.shell.write_all(&bytes).expect("it is read");
    let state = client.wait_for(&name, "status");
    assert_eq!(state, json!({"execution_state": "busy"}));
    let state = client.wait_for(&name, "status");
    assert_eq!(state, json!({"execution_state": "idle"}));
    for content in [
        json!({}),
        json!([]),
        json!({"code": 1}),
        json!({"code": null}),
    ] {
        for kind in [
            "execute_request",
            "complete_request",
            "history_request",
            "is_complete_request",
        ] {
            let (bytes, name) = client.request(kind, &content);
            client.shell.write_all(&bytes).expect("it is read");
            client.wait(&name);
        }
    }
    assert_eq!(client.run("(+ 1 2)").value(), Some("3"));
}
