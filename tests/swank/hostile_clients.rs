//! Clients that send anything, or leave at any time.

use std::time::{Duration, Instant};

use super::client::Served;
use crate::swank::ServerOptions;
use crate::tests::waiting::{file_to_come, wait_for};

#[test]
fn garbage_ends_only_its_own_connection() {
    let served = Served::start();
    let mut bystander = served.client();
    for garbage in [
        &b"GET / HTTP/1.1\r\nHost: localhost\r\n\r\n"[..],
        b"\0\0\0\0\0\0\0\0",
        b"-00001x",
        b"00000g(",
        &[0xff; 64],
    ] {
        let mut client = served.stranger();
        client.send_bytes(garbage);
        while client.receive().is_some() {}
    }
    assert_eq!(bystander.shown("(+ 1 2)"), "3\n");
}

#[test]
fn an_announced_message_takes_no_memory_before_it_comes() {
    let served = Served::start();
    let stalled: Vec<_> = (0..10)
        .map(|_| {
            let mut client = served.stranger();
            client.send_bytes(b"ffffff(:emacs-rex");
            client
        })
        .collect();
    assert_eq!(served.client().shown("(+ 1 2)"), "3\n");
    drop(stalled);
    assert_eq!(served.client().shown("(+ 1 2)"), "3\n");
}

#[test]
fn what_cannot_be_understood_is_answered_or_passed_over() {
    let served = Served::start();
    let mut client = served.client();
    for message in [
        "",
        "()",
        "5",
        "(:emacs-rex)",
        "(:emacs-return-string 1 5 \"nobody asked\")",
        "(:emacs-pong 1 2)",
        "(:no-such-message)",
        "(((((",
        "\"",
    ] {
        client.send(message);
    }
    client.send("(:emacs-rex (swank:interactive-eval \"1\" \"CL-USER\" t 77)");
    let answer = client.receive().unwrap();
    assert!(
        answer.starts_with("(:return (:abort \"The request cannot be read"),
        "{answer}"
    );
    assert!(answer.ends_with(" 77)"), "{answer}");
    for form in [
        "5",
        "nil",
        "\"text\"",
        "(swank:listener-eval)",
        "(swank:listener-eval 5)",
        "(swank:compile-string-for-emacs)",
        "(swank:completions)",
        "(swank:describe-symbol)",
        "(swank:inspect-nth-part -1)",
        "(swank:inspector-range 99999999999 -5)",
        "(swank:set-package nil)",
        "(swank:find-definitions-for-emacs \"::::\")",
        "(swank:completions \"a:b:c\" '\"nowhere\")",
        "(swank:fuzzy-completions \"ü\" nil)",
        "(swank:apropos-list-for-emacs \"\" nil nil '\"nowhere\")",
    ] {
        let answer = client.call(form);
        assert!(
            answer.starts_with("(:ok") || answer.starts_with("(:abort"),
            "{form}: {answer}"
        );
    }
    assert_eq!(client.shown("(+ 1 2)"), "3\n");
}

#[test]
fn a_client_that_leaves_leaves_nothing_running() {
    let served = Served::start();
    let mut bystander = served.client();
    // In the middle of an evaluation that never ends, with and without output.
    for text in ["(loop)", "(loop (print 1))"] {
        let mut client = served.client();
        client.begin(text);
        drop(client);
        assert_eq!(bystander.shown("(+ 1 2)"), "3\n");
    }
    // At a level of the debugger, and with a question open.
    let mut client = served.client();
    client.type_in("(list no-such)");
    client.until("(:debug-activate ");
    client.type_in("(car 5)");
    client.until("(:debug-activate 1 2 nil)");
    drop(client);
    let begin = Instant::now();
    loop {
        let id = bystander.type_in("(error \"mine\")");
        let debug = bystander.until("(:debug-activate ");
        bystander.request("(swank:throw-to-toplevel)");
        bystander.answer(id);
        // Once the levels of the client that has left are gone, ours is the first.
        if debug.iter().any(|m| m.starts_with("(:debug 1 1 ")) {
            break;
        }
        assert!(begin.elapsed() < Duration::from_secs(10), "{debug:?}");
    }
}

#[test]
fn endless_output_nobody_reads_holds_nobody_up() {
    let served = Served::start();
    let mut client = served.client();
    let file = file_to_come("swank-endless-output");
    client.type_in(&format!(
        "(with-open-file (count {file:?} :direction :output :if-exists :supersede)
           (loop (print (make-string 1000 :initial-element #\\x))
                 (write-char #\\x count)
                 (finish-output count)))"
    ));
    // It stands still once there is no room for more.
    let mut before = None;
    wait_for("the output to stand still", || {
        std::thread::sleep(Duration::from_millis(100));
        let lines = std::fs::metadata(&file).ok()?.len();
        (lines > 0 && before.replace(lines) == Some(lines)).then_some(())
    });
    client.send("(:emacs-interrupt :repl-thread)");
    let messages = client.until("(:debug-activate ");
    let bytes: usize = messages.iter().map(String::len).sum();
    assert!(bytes < 64 << 20, "{bytes} bytes");
    client.call("(swank:throw-to-toplevel)");
    assert!(client.shown("(+ 1 2)").ends_with("3\n"));
}

#[test]
fn who_does_not_know_the_secret_learns_nothing() {
    let served = Served::with(ServerOptions {
        secret: Some("s3cret".to_owned()),
        ..ServerOptions::default()
    });
    for said in ["wrong", "s3cre", "s3cretx", "", "(swank:connection-info)"] {
        let mut client = served.stranger();
        client.send(said);
        client.send("(:emacs-rex (swank:connection-info) nil t 1)");
        assert_eq!(client.receive(), None, "{said}");
    }
    let mut client = served.stranger();
    client.send("s3cret");
    assert!(
        client
            .call("(swank:connection-info)")
            .contains("planwright")
    );
}

#[test]
fn a_secret_nobody_has_asked_for_is_passed_over() {
    let served = Served::start();
    let mut client = served.stranger();
    client.send("s3cret");
    assert!(
        client
            .call("(swank:connection-info)")
            .contains("planwright")
    );
}

#[test]
fn half_open_and_half_sent_connections_keep_nobody_out() {
    for secret in [None, Some("s3cret".to_owned())] {
        let served = Served::with(ServerOptions {
            secret: secret.clone(),
            ..ServerOptions::default()
        });
        let idle: Vec<_> = (0..150)
            .map(|number| {
                let mut stranger = served.stranger();
                let begun = [&b""[..], b"00", b"000010(:emacs"][number % 3];
                stranger.send_bytes(begun);
                stranger
            })
            .collect();
        let mut client = served.stranger();
        if let Some(secret) = &secret {
            client.send(secret);
        }
        assert!(
            client
                .call("(swank:connection-info)")
                .contains("planwright")
        );
        drop(idle);
    }
}

#[test]
fn more_connections_than_there_may_be_are_closed() {
    let served = Served::start();
    let mut first = served.client();
    let many: Vec<_> = (0..100).map(|_| served.stranger()).collect();
    assert_eq!(first.shown("(+ 1 2)"), "3\n");
    drop(many);
    let mut late = served.client_once_there_is_room();
    assert_eq!(late.shown("(+ 1 2)"), "3\n");
}
