use std::sync::Mutex;

use lisp::files::Files;

use super::*;

/// Keeps what is sent.
#[derive(Clone, Default)]
struct Kept(Arc<Mutex<Vec<String>>>);

impl Outbox for Kept {
    fn text(&self, text: &str) {
        self.0.lock().unwrap().push(text.to_owned());
    }

    fn bytes(&self, what: &str, bytes: &[u8]) {
        let message = format!("{what}: {}", bytes.len());
        self.0.lock().unwrap().push(message);
    }
}

impl Kept {
    fn take(&self) -> Vec<String> {
        std::mem::take(&mut self.0.lock().unwrap())
    }

    /// The messages with a key, and their values.
    fn named(&self, key: &str) -> Vec<Value> {
        let messages = self.take();
        let values = messages.iter().filter_map(|message| {
            let mut value: Value = serde_json::from_str(message).ok()?;
            value.get_mut(key).map(Value::take)
        });
        values.collect()
    }
}

fn page() -> (Page, Kept) {
    let kept = Kept::default();
    let files = MemoryFiles::new(|_, _| {});
    let outside = Outside {
        files: Arc::new(files.clone()),
        ..Outside::default()
    };
    let page = Page::new(Box::new(kept.clone()), outside, files);
    page.hear(r#"{"open": {"files": {"mine.plan": "(defun five () 5)"}}}"#);
    (page, kept)
}

#[test]
fn an_input_is_answered_with_its_values_and_the_next_prompt() {
    let (page, kept) = page();
    assert_eq!(kept.named("open")[0]["prompt"], "CL-USER");
    page.hear(r#"{"evaluate": {"text": "(in-package :pp-tut) (+ 1 2)"}}"#);
    let messages = kept.take().join("\n");
    assert!(
        messages.contains(r#"{"kind":"values","text":"3\n"}"#),
        "{messages}"
    );
    assert!(messages.contains(r#""prompt":"PP-TUT""#), "{messages}");
}

#[test]
fn a_stop_comes_with_its_restarts_and_the_next_input_chooses() {
    let (page, kept) = page();
    kept.take();
    page.hear(r#"{"evaluate": {"text": "(car 5)"}}"#);
    let stopped = kept.named("stopped");
    assert_eq!(stopped[0]["class"], "TYPE-ERROR");
    let last = stopped[0]["choices"].as_array().unwrap().len() - 1;
    page.hear(&format!("{{\"evaluate\": {{\"text\": \"{last}\"}}}}"));
    assert_eq!(kept.named("done")[0]["level"], 0);
}

#[test]
fn a_lesson_goes_on_from_input_to_input() {
    let (page, kept) = page();
    kept.take();
    page.hear(r#"{"evaluate": {"text": "(tour)"}}"#);
    let messages = kept.take().join("\n");
    assert!(messages.contains("Step 1 of 6: Put a bottle"), "{messages}");
    page.hear(r#"{"evaluate": {"text": "(spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)))"}}"#);
    let messages = kept.take().join("\n");
    assert!(
        messages.contains("; Done: Put a bottle on the table."),
        "{messages}"
    );
    assert!(
        messages.contains("Step 2 of 6: Drive to the table."),
        "{messages}"
    );
    // It is remembered in a file, which the page keeps for the next session.
    let contents = page.files.read_plan(".lessons").unwrap();
    assert_eq!(contents, b"tour 1 6\n");
    page.hear(r#"{"open": {"files": {}}}"#);
    kept.take();
    page.hear(r#"{"evaluate": {"text": "(lesson)"}}"#);
    let messages = kept.take().join("\n");
    assert!(messages.contains("(1 of 6 steps)"), "{messages}");
}

#[test]
fn files_of_the_page_can_be_loaded_and_those_that_are_written_come_back() {
    let (page, kept) = page();
    kept.take();
    page.hear(r#"{"file": {"name": "a/b.plan", "text": "(load \"../mine.plan\") (defun six () (1+ (five)))"}}"#);
    page.hear(r#"{"evaluate": {"text": "(load \"a/b.plan\") (six)"}}"#);
    let messages = kept.take().join("\n");
    assert!(messages.contains(r#""text":"6\n""#), "{messages}");
}

#[test]
fn what_the_live_view_needs_is_there_while_the_session_is_at_work() {
    let (page, kept) = page();
    let messages = kept.take().join("\n");
    for name in ["hello", "nodes", "pace", "frame"] {
        assert!(messages.contains(&format!("[\"{name}\",")), "{name}");
    }
    let _at_work = page.session.borrow_mut();
    page.hear(r#"{"meshes": 0}"#);
    page.hear(r#"{"past": {"from": 0, "to": 1, "number": 7}}"#);
    page.hear(r#"{"pace": "speed max"}"#);
    page.hear(r#"{"evaluate": {"text": "(+ 1 2)"}}"#);
    let messages = kept.take();
    assert!(messages[0].starts_with("meshes: "), "{messages:?}");
    assert!(messages[1].ends_with("\"number\":7}"), "{messages:?}");
    assert!(
        messages[2].contains("[\"pace\",{\"paused\":false,\"speed\":null}]"),
        "{messages:?}"
    );
    assert_eq!(messages[3], r#"{"failed":"the session is at work"}"#);
}

#[test]
fn malformed_requests_are_told() {
    let (page, kept) = page();
    for request in [
        "",
        "{",
        "{\"fly\": 1}",
        "{\"past\": {\"from\": 0}}",
        "{\"meshes\": -1}",
    ] {
        kept.take();
        page.hear(request);
        assert_eq!(kept.named("failed").len(), 1, "{request}");
    }
}

#[test]
fn places_are_counted_as_pages_count_them() {
    assert_eq!(byte_at("aé😀b", 4), "aé😀".len());
    assert_eq!(byte_at("ab", 9), 2);
    assert_eq!(units("é😀"), 3);
}
