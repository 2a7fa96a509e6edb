//! Chunks of a recording, unpacked by threads ahead of who reads them.

use std::collections::VecDeque;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::{self, Scope};

use super::RecordingError;
use super::decompress::Chunk;

/// Maximum number of threads.
const MAX_THREADS: usize = 3;
/// How many chunks each of them may have.
const AHEAD: usize = 4;

/// The content of a chunk.
#[derive(Default)]
pub(super) struct Content {
    /// Its records.
    pub(super) bytes: Vec<u8>,
    /// Is it as its checksum says?
    pub(super) is_whole: bool,
}

/// A chunk record, and memory for what it holds.
struct Work {
    record: Vec<u8>,
    memory: Vec<u8>,
}

/// A thread that unpacks.
struct Hand {
    work: SyncSender<Work>,
    done: Receiver<(Vec<u8>, Result<Content, RecordingError>)>,
}

/// Unpacks chunks, which come out in the order in which they were given.
pub(super) struct Unpacker {
    /// They take turns. Without any, chunks are unpacked when they are taken.
    hands: Vec<Hand>,
    /// The chunks that wait, if there are no hands.
    waiting: VecDeque<Vec<u8>>,
    given: usize,
    taken: usize,
    /// Memory that can be used again.
    spare: Vec<Vec<u8>>,
}

impl Unpacker {
    /// Begins with as many threads as the machine has cores for.
    pub(super) fn new<'s>(scope: &'s Scope<'s, '_>) -> Self {
        // The one that reads has its own.
        let cores = thread::available_parallelism().map_or(1, usize::from);
        let hands = (0..(cores - 1).min(MAX_THREADS)).map(|_| {
            let (work, given) = sync_channel::<Work>(AHEAD);
            let (give, done) = sync_channel(AHEAD);
            let unpack = move || {
                for Work { record, memory } in given {
                    let content = Chunk::unpacked(&record, memory);
                    if give.send((record, content)).is_err() {
                        return;
                    }
                }
            };
            let begun = thread::Builder::new().spawn_scoped(scope, unpack);
            begun.ok().map(|_| Hand { work, done })
        });
        // The system may not have room for as many.
        let hands: Option<Vec<Hand>> = hands.collect();
        Self {
            hands: hands.unwrap_or_default(),
            waiting: VecDeque::new(),
            given: 0,
            taken: 0,
            spare: Vec::new(),
        }
    }

    /// Empty memory.
    pub(super) fn memory(&mut self) -> Vec<u8> {
        let mut memory = self.spare.pop().unwrap_or_default();
        memory.clear();
        memory
    }

    /// Takes memory that is no longer needed.
    pub(super) fn give_back(&mut self, memory: Vec<u8>) {
        self.spare.push(memory);
    }

    /// Has it as many chunks as it should have?
    pub(super) fn is_full(&self) -> bool {
        self.given - self.taken >= (self.hands.len() * AHEAD).max(1)
    }

    /// Gives the content of a chunk record to it, which must not be full.
    pub(super) fn give(&mut self, record: Vec<u8>) {
        let hand = self.given % self.hands.len().max(1);
        self.given += 1;
        let memory = self.memory();
        match self.hands.get(hand) {
            // A thread that has ended is told of when its chunk is taken.
            Some(hand) => drop(hand.work.send(Work { record, memory })),
            None => self.waiting.push_back(record),
        }
    }

    /// What the next chunk holds, or `None` if none has been given.
    pub(super) fn take(&mut self) -> Option<Result<Content, RecordingError>> {
        if self.taken == self.given {
            return None;
        }
        let hand = self.taken % self.hands.len().max(1);
        self.taken += 1;
        let (record, content) = match self.hands.get(hand) {
            // A thread ends early only by a defect, which its scope tells.
            Some(hand) => match hand.done.recv() {
                Ok(done) => done,
                Err(_) => (Vec::new(), Err(RecordingError::CutOff)),
            },
            None => {
                let record = self.waiting.pop_front()?;
                let content = Chunk::unpacked(&record, self.memory());
                (record, content)
            }
        };
        self.give_back(record);
        Some(content)
    }
}
