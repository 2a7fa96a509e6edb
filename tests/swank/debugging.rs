//! The debugger of a client.

use super::client::{Client, Served, shown};

/// Types something that stops; returns the request and the message that tells where.
fn stops(client: &mut Client, text: &str) -> (u32, String) {
    let id = client.type_in(text);
    let messages = client.until("(:debug-activate ");
    (id, messages[messages.len() - 2].clone())
}

/// The number of a restart in a message that tells where something has stopped.
fn restart(debug: &str, name: &str) -> usize {
    let restarts = debug.split_once(" nil) ((").unwrap().1;
    let names = restarts
        .split("(\"")
        .map(|part| part.trim_start_matches('"'));
    let mut names = names.filter(|part| !part.is_empty());
    names
        .position(|part| part.starts_with(&format!("{name}\"")))
        .unwrap_or_else(|| panic!("{name} in {debug}"))
}

#[test]
fn a_restart_goes_on_with_the_evaluation() {
    let served = Served::start();
    let mut client = served.client();
    let (id, debug) = stops(
        &mut client,
        "(progn (restart-case (error \"No ~a.\" 1) (seven () :report \"Use 7.\" 7)))",
    );
    assert!(
        debug.starts_with("(:debug 1 1 (\"No 1.\" \"   [Condition of type SIMPLE-ERROR]\" nil)")
    );
    assert!(debug.contains("(\"SEVEN\" \"Use 7.\")") && debug.ends_with(&format!("({id}))")));
    let chosen = client.request(&format!(
        "(swank:invoke-nth-restart-for-emacs 1 {})",
        restart(&debug, "SEVEN")
    ));
    let messages = client.answer(id);
    assert_eq!(messages[0], format!("(:return (:abort \"NIL\") {chosen})"));
    assert_eq!(messages[1], "(:debug-return 1 1 nil)");
    assert_eq!(shown(&messages[2..]), "7\n");
    assert_eq!(client.shown("*"), "7\n");
}

#[test]
fn a_restart_asks_for_its_value() {
    let served = Served::start();
    let mut client = served.client();
    let (id, debug) = stops(&mut client, "(list no-such)");
    let number = restart(&debug, "USE-VALUE");
    client.request(&format!("(swank:invoke-nth-restart-for-emacs 1 {number})"));
    let asked = client.until("(:read-string 1 ").pop().unwrap();
    let tag = asked.trim_end_matches(')').rsplit(' ').next().unwrap();
    client.send(&format!("(:emacs-return-string 1 {tag} \"(+ 1 2)\n\")"));
    assert!(shown(&client.answer(id)).ends_with("(3)\n"));

    // A question that is taken back, and a value that cannot be computed.
    let (id, _) = stops(&mut client, "(list no-such)");
    let choice = format!("(swank:invoke-nth-restart-for-emacs 1 {number})");
    let first = client.request(&choice);
    let asked = client.until("(:read-string 1 ").pop().unwrap();
    let tag = asked.trim_end_matches(')').rsplit(' ').next().unwrap();
    client.send("(:emacs-interrupt :repl-thread)");
    client.until(&format!("(:read-aborted 1 {tag})"));
    client.answer(first);
    let second = client.request(&choice);
    client.until("(:read-string 1 ");
    client.send(&format!(
        "(:emacs-return-string 1 {} \"(car 7)\n\")",
        tag.parse::<u32>().unwrap() + 1
    ));
    client.answer(second);
    client.until("(:debug-activate 1 2 nil)");
    client.request("(swank:throw-to-toplevel)");
    assert!(shown(&client.answer(id)).contains("aborted on"));
    assert_eq!(client.shown("1"), "1\n");
}

#[test]
fn frames_tell_their_variables() {
    let served = Served::start();
    let mut client = served.client();
    client.shown("(defun fails (number) (let ((twice (* 2 number))) (list (car twice))))");
    let (id, debug) = stops(&mut client, "(fails 21)");
    assert!(debug.contains("\"(FAILS 21)\""), "{debug}");
    let frames = client.call("(swank:backtrace 0 20)");
    let frame = frames.split("\"(FAILS 21)\"").next().unwrap();
    let frame: u32 = frame
        .trim()
        .rsplit('(')
        .next()
        .unwrap()
        .trim()
        .parse()
        .unwrap();
    assert_eq!(
        client.call(&format!("(swank:frame-locals-and-catch-tags {frame})")),
        "(:ok (((:name \"NUMBER\" :id 0 :value \"21\") (:name \"TWICE\" :id 0 :value \"42\")) nil))"
    );
    assert_eq!(
        client.call(&format!(
            "(swank:eval-string-in-frame \"(+ number twice)\" {frame} \"CL-USER\")"
        )),
        "(:ok \"=> 63\")"
    );
    let inspected = client.call(&format!("(swank:inspect-frame-var {frame} 1)"));
    assert!(inspected.contains(":title \"42, of type"), "{inspected}");
    let condition = client.call("(swank:inspect-current-condition)");
    assert!(condition.contains("TYPE-ERROR"), "{condition}");
    let place = client.call(&format!("(swank:frame-source-location {frame})"));
    assert!(place.contains(":location"), "{place}");
    assert_eq!(
        client.call(&format!("(swank:frame-package-name {frame})")),
        "(:ok \"COMMON-LISP-USER\")"
    );
    client.request(&format!(
        "(swank:sldb-return-from-frame {frame} \"(list twice)\")"
    ));
    assert!(shown(&client.answer(id)).ends_with("(42)\n"));
}

#[test]
fn levels_are_left_one_by_one() {
    let served = Served::start();
    let mut client = served.client();
    let (first, _) = stops(&mut client, "(car 1)");
    let (second, debug) = stops(&mut client, "(car 2)");
    assert!(debug.starts_with("(:debug 1 2 ") && debug.ends_with(&format!("({second} {first}))")));
    // What looks like a command of the debugger is a form here.
    assert_eq!(client.shown("1"), "1\n");
    assert_eq!(client.shown(":a"), ":A\n");
    let left = client.request("(swank:sldb-abort)");
    let messages = client.until("(:debug-activate 1 1 nil)");
    assert_eq!(messages[0], format!("(:return (:abort \"NIL\") {left})"));
    assert_eq!(messages[1], "(:debug-return 1 2 nil)");
    assert_eq!(messages[2], format!("(:return (:abort \"NIL\") {second})"));
    assert!(messages[3].starts_with("(:debug 1 1 "));
    let (third, _) = stops(&mut client, "(car 3)");
    client.request("(swank:throw-to-toplevel)");
    let messages = client.answer(first);
    let answered = |id: u32| messages.iter().any(|m| m.ends_with(&format!(" {id})")));
    assert!(answered(third), "{messages:?}");
    assert!(
        messages.contains(&"(:debug-return 1 1 nil)".to_owned()),
        "{messages:?}"
    );
    assert_eq!(client.shown("(+ 1 1)"), "2\n");
}

#[test]
fn what_cannot_be_decided_is_refused() {
    let served = Served::start();
    let mut client = served.client();
    for form in [
        "(swank:throw-to-toplevel)",
        "(swank:sldb-abort)",
        "(swank:sldb-continue)",
        "(swank:invoke-nth-restart-for-emacs 1 0)",
        "(swank:sldb-return-from-frame 0 \"1\")",
        "(swank:inspect-current-condition)",
        "(swank:eval-string-in-frame \"1\" 0 \"CL-USER\")",
    ] {
        assert!(client.call(form).starts_with("(:abort "), "{form}");
    }
    stops(&mut client, "(car 1)");
    for form in [
        "(swank:sldb-continue)",
        "(swank:invoke-nth-restart-for-emacs 2 0)",
        "(swank:invoke-nth-restart-for-emacs 1 99)",
        "(swank:invoke-nth-restart-for-emacs)",
        "(swank:restart-frame 0)",
        "(swank:restart-frame 99)",
        "(swank:inspect-frame-var 99 99)",
    ] {
        assert!(client.call(form).starts_with("(:abort "), "{form}");
    }
    assert_eq!(
        client.call("(swank:frame-locals-and-catch-tags 99)"),
        "(:ok (nil nil))"
    );
    assert_eq!(client.shown("(+ 1 1)"), "2\n");
}
