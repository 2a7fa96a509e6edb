//! What the worker of a page imports and exports.

use std::alloc::System;
use std::cell::{OnceCell, RefCell};
use std::panic;
use std::sync::Arc;
use std::time::Duration;

use cap::Cap;
use defect::keep_caught_panics_quiet;
use lisp::guard::heap::HeapLimit;
use session::outside::{Clock, Outside};
use session::{Session, SessionOptions};

use crate::files::MemoryFiles;
use crate::page::{Outbox, Page};

/// Counts the bytes in use.
#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, usize::MAX);

/// Bytes that a session may use: browsers give a page two to four gigabytes.
const MAX_BYTES: usize = 1 << 30;

#[link(wasm_import_module = "page")]
unsafe extern "C" {
    /// Milliseconds since some moment.
    fn now() -> f64;
    /// Returns after so many milliseconds, or earlier.
    fn wait(milliseconds: f64);
    /// Lets the worker hear the page.
    fn breathe();
    /// Sends a text.
    fn text(at: *const u8, count: usize);
    /// Sends bytes, and a word that says what they are.
    fn bytes(what: *const u8, what_count: usize, at: *const u8, count: usize);
}

thread_local! {
    /// Where the worker writes what it says.
    static LETTER: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static PAGE: OnceCell<Page> = const { OnceCell::new() };
}

struct Worker;

impl Outbox for Worker {
    fn text(&self, message: &str) {
        // SAFETY: the worker reads the bytes before it returns.
        unsafe { text(message.as_ptr(), message.len()) }
    }

    fn bytes(&self, what: &str, message: &[u8]) {
        // SAFETY: the worker reads the bytes before it returns.
        unsafe { bytes(what.as_ptr(), what.len(), message.as_ptr(), message.len()) }
    }
}

/// The clock of the browser.
#[derive(Debug)]
struct PageClock;

impl Clock for PageClock {
    fn now(&self) -> Duration {
        // SAFETY: it takes nothing and changes nothing.
        let now = unsafe { now() };
        Duration::try_from_secs_f64(now / 1000.0).unwrap_or_default()
    }

    fn wait(&self, duration: Duration) {
        // SAFETY: what the worker calls meanwhile borrows no more than it may, see `Page`.
        unsafe { wait(duration.as_secs_f64() * 1000.0) }
    }
}

fn breathe_now() {
    // SAFETY: what the worker calls meanwhile borrows no more than it may, see `Page`.
    unsafe { breathe() }
}

/// Keeps a file that the program has written.
fn written(name: &str, contents: Option<&[u8]>) {
    match contents {
        Some(contents) => Worker.bytes(&format!("file {name}"), contents),
        None => Worker.bytes(&format!("deleted {name}"), &[]),
    }
}

fn with_page(work: impl FnOnce(&Page)) {
    PAGE.with(|page| {
        work(page.get_or_init(|| {
            panic::set_hook(Box::new(|info| {
                let message = serde_json::json!({"panic": info.to_string()});
                Worker.text(&message.to_string());
            }));
            keep_caught_panics_quiet();
            let files = MemoryFiles::new(written);
            let outside = Outside {
                files: Arc::new(files.clone()),
                clock: Arc::new(PageClock),
                breathe: Some(breathe_now),
            };
            let heap = HeapLimit {
                bytes: MAX_BYTES,
                in_use: || ALLOCATOR.allocated(),
            };
            Page::new(Box::new(Worker), outside, files).with_heap(heap)
        }));
    });
}

fn take_letter(count: usize) -> Vec<u8> {
    let mut letter = LETTER.take();
    letter.truncate(count);
    letter
}

/// Room for so many bytes, which the worker then writes there.
#[unsafe(no_mangle)]
extern "C" fn room(count: usize) -> *mut u8 {
    LETTER.with_borrow_mut(|letter| {
        letter.clear();
        letter.resize(count, 0);
        letter.as_mut_ptr()
    })
}

/// Answers the request that has been written.
#[unsafe(no_mangle)]
extern "C" fn hear(count: usize) {
    let letter = take_letter(count);
    with_page(|page| page.hear(&String::from_utf8_lossy(&letter)));
}

/// Lets sessions start from the code that has been written.
#[unsafe(no_mangle)]
extern "C" fn provide(count: usize) {
    lisp::image::precompiled::provide(take_letter(count).leak());
}

/// Sends the code from which sessions start faster.
#[unsafe(no_mangle)]
extern "C" fn precompile() {
    let options = SessionOptions {
        outside: Outside {
            clock: Arc::new(PageClock),
            ..Outside::default()
        },
        ..SessionOptions::default()
    };
    match Session::of_texts(&options).and_then(Session::precompile) {
        Ok(code) => Worker.bytes("code", &code),
        Err(error) => Worker.text(&serde_json::json!({"failed": error.to_string()}).to_string()),
    }
}

/// Interrupts the input that is evaluated.
#[unsafe(no_mangle)]
extern "C" fn interrupt() {
    with_page(Page::interrupt);
}

/// Sends what is new in the live view.
#[unsafe(no_mangle)]
extern "C" fn show_news() {
    with_page(Page::show_news);
}
