//! Who may be connected: strangers, who have not shown the secret of a server, such as the random
//! word of the page's address, and guests, who have. However many strangers come, there is room for
//! guests: one stranger too many makes the one leave that has been served longest, who has had the
//! time to show the word. However busy the machine is, nobody has to leave before that: it counts from where the
//! stranger's own thread has begun.

use std::collections::VecDeque;
use std::io;
use std::net::{Shutdown, TcpListener, TcpStream};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// Time in which nobody has to leave, from where the stranger's thread has begun.
const TIME_TO_SHOW: Duration = Duration::from_millis(100);

/// How many connections may wait to be accepted. The system may allow fewer.
#[cfg(unix)]
const MAX_QUEUE: i32 = 4096;

/// How often it is looked whether somebody can leave.
const LOOK: Duration = Duration::from_millis(1);

/// How long nothing is accepted after file descriptors or threads have run out; some will be given back soon.
const PAUSE: Duration = Duration::from_millis(50);

/// Who is connected.
#[derive(Debug)]
pub struct Door {
    max_strangers: usize,
    max_guests: usize,
    strangers: Mutex<Strangers>,
    guests: AtomicUsize,
    /// Number of connections that have not ended, of those who had to leave, too.
    all: AtomicUsize,
}

#[derive(Debug, Default)]
struct Strangers {
    /// In order of arrival.
    waiting: VecDeque<Waiting>,
    last: u64,
}

#[derive(Debug)]
struct Waiting {
    number: u64,
    stream: TcpStream,
    /// When its thread has begun.
    since: Option<Instant>,
}

impl Strangers {
    /// The one that has been served longest, if it has had its time.
    fn take_longest(&mut self) -> Option<TcpStream> {
        let served = self.waiting.iter().enumerate();
        let served = served.filter_map(|(index, waiting)| Some((waiting.since?, index)));
        let (since, index) = served.min()?;
        if since.elapsed() < TIME_TO_SHOW {
            return None;
        }
        self.waiting.remove(index).map(|waiting| waiting.stream)
    }
}

impl Door {
    /// For a server that at most so many strangers, and so many guests besides, may be connected to.
    pub fn new(max_strangers: usize, max_guests: usize) -> Door {
        Door {
            max_strangers,
            max_guests,
            strangers: Mutex::default(),
            guests: AtomicUsize::new(0),
            all: AtomicUsize::new(0),
        }
    }

    /// Accepts connections for as long as `is_open`, which is asked after each, and serves each on its own thread
    /// with that name and so many bytes of stack.
    pub fn serve(
        self,
        listener: &TcpListener,
        (name, stack_bytes): (&str, usize),
        is_open: impl Fn() -> bool,
        serve: impl Fn(&Stranger, TcpStream) + Send + Sync + 'static,
    ) {
        lengthen_queue(listener);
        let (door, serve) = (Arc::new(self), Arc::new(serve));
        for stream in listener.incoming() {
            if !is_open() {
                return;
            }
            let admitted = stream.and_then(|stream| {
                let stranger = door.admit(&stream)?;
                let serve = Arc::clone(&serve);
                let thread = thread::Builder::new()
                    .name(name.to_owned())
                    .stack_size(stack_bytes);
                thread.spawn(move || {
                    stranger.begin();
                    serve(&stranger, stream);
                })
            });
            if admitted.is_err() {
                thread::sleep(PAUSE);
            }
        }
    }

    /// Admits a stranger; the one that has been served longest may have to leave. Waits while nobody has had the
    /// time to show the word, and while those who have to leave have not left.
    fn admit(self: &Arc<Self>, stream: &TcpStream) -> io::Result<Stranger> {
        while self.all.load(Ordering::Relaxed) >= 2 * self.max_strangers + self.max_guests {
            thread::sleep(LOOK);
        }
        let stream = stream.try_clone()?;
        let mut strangers = self.strangers();
        while strangers.waiting.len() >= self.max_strangers {
            if let Some(longest) = strangers.take_longest() {
                // It may have left by itself.
                let _ = longest.shutdown(Shutdown::Both);
            } else {
                drop(strangers);
                thread::sleep(LOOK);
                strangers = self.strangers();
            }
        }
        strangers.last += 1;
        let number = strangers.last;
        strangers.waiting.push_back(Waiting {
            number,
            stream,
            since: None,
        });
        self.all.fetch_add(1, Ordering::Relaxed);
        Ok(Stranger {
            door: Arc::clone(self),
            number,
        })
    }

    fn strangers(&self) -> MutexGuard<'_, Strangers> {
        // Nothing panics while holding the lock.
        self.strangers
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
    }
}

/// A connection that has not shown the word.
#[derive(Debug)]
pub struct Stranger {
    door: Arc<Door>,
    number: u64,
}

impl Stranger {
    /// The stranger's thread has begun.
    fn begin(&self) {
        let mut strangers = self.door.strangers();
        let own = |waiting: &&mut Waiting| waiting.number == self.number;
        if let Some(waiting) = strangers.waiting.iter_mut().find(own) {
            waiting.since = Some(Instant::now());
        }
    }

    /// The connection has shown the word. `None` if there are too many that have.
    pub fn welcome(&self) -> Option<Guest> {
        self.forget();
        let guest = Guest(Arc::clone(&self.door));
        let others = self.door.guests.fetch_add(1, Ordering::Relaxed);
        (others < self.door.max_guests).then_some(guest)
    }

    fn forget(&self) {
        let mut strangers = self.door.strangers();
        strangers
            .waiting
            .retain(|waiting| waiting.number != self.number);
    }
}

impl Drop for Stranger {
    fn drop(&mut self) {
        self.forget();
        self.door.all.fetch_sub(1, Ordering::Relaxed);
    }
}

/// A connection that has shown the word.
#[derive(Debug)]
pub struct Guest(Arc<Door>);

impl Drop for Guest {
    fn drop(&mut self) {
        self.0.guests.fetch_sub(1, Ordering::Relaxed);
    }
}

/// Lets more connections wait than the 128 of the standard library. Where no more can wait, whoever comes tries again
/// after a second or more, and a page then after those who try more often.
fn lengthen_queue(listener: &TcpListener) {
    // It works with the shorter queue, too.
    #[cfg(unix)]
    let _ = rustix::net::listen(listener, MAX_QUEUE);
    #[cfg(not(unix))]
    let _ = listener;
}

#[cfg(test)]
mod tests {
    use std::net::Ipv4Addr;

    use super::*;

    fn pair(listener: &TcpListener) -> (TcpStream, TcpStream) {
        let client = TcpStream::connect(listener.local_addr().unwrap()).unwrap();
        (client, listener.accept().unwrap().0)
    }

    #[test]
    fn nobody_has_to_leave_before_its_thread_has_begun() {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
        let door = Arc::new(Door::new(1, 1));
        let (_client, first) = pair(&listener);
        let (_other, second) = pair(&listener);
        let first = door.admit(&first).unwrap();
        let own = Arc::clone(&door);
        let admitting = thread::spawn(move || own.admit(&second).unwrap());
        thread::sleep(3 * TIME_TO_SHOW);
        assert!(!admitting.is_finished());
        let begin = Instant::now();
        first.begin();
        let second = admitting.join().unwrap();
        assert!(begin.elapsed() >= TIME_TO_SHOW, "{:?}", begin.elapsed());
        second.begin();
        assert!(second.welcome().is_some());
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn many_can_wait_to_be_accepted() {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
        lengthen_queue(&listener);
        let address = listener.local_addr().unwrap();
        let connect = || TcpStream::connect_timeout(&address, Duration::from_millis(900));
        let waiting: Vec<TcpStream> = (0..400).map_while(|_| connect().ok()).collect();
        assert_eq!(waiting.len(), 400);
    }
}
