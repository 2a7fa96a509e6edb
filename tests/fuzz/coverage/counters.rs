//! The compiler's counters: how often each edge of the code was taken.

use std::mem;
use std::slice;
use std::sync::Mutex;

/// Where counters are: the first, and how many. There are several places if the program has several parts.
static PLACES: Mutex<Vec<(usize, usize)>> = Mutex::new(Vec::new());

/// What the code with counters calls at its beginning, before `main`.
///
/// # Safety
///
/// Only the compiler calls it, with the bounds of memory that lives as long as the program.
#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn __sanitizer_cov_8bit_counters_init(begin: *mut u8, end: *mut u8) {
    let place = (begin as usize, end as usize - begin as usize);
    if let Ok(mut places) = PLACES.lock()
        && !places.contains(&place)
    {
        places.push(place);
    }
}

/// How many counters are looked at together.
const WIDTH: usize = 256;
/// So many that have counted nothing.
const NONE: [u8; WIDTH] = [0; WIDTH];

/// What has been reached.
pub(crate) struct Coverage {
    places: Vec<(usize, usize)>,
    /// For each counter, the ranges in which it has been.
    seen: Vec<u8>,
    edges: usize,
}

impl Coverage {
    /// Nothing has been reached yet.
    pub(crate) fn new() -> Self {
        let places = PLACES.lock().map_or_else(|_| Vec::new(), |all| all.clone());
        let count = places.iter().map(|(_, count)| count).sum();
        Self {
            places,
            seen: vec![0; count],
            edges: 0,
        }
    }

    /// Number of counters.
    pub(crate) fn len(&self) -> usize {
        self.seen.len()
    }

    /// Number of edges that have been taken.
    pub(crate) fn edges(&self) -> usize {
        self.edges
    }

    /// Forgets what has been reached.
    pub(crate) fn forget(&mut self) {
        self.seen.fill(0);
        self.edges = 0;
    }

    /// Notes what has been reached since the last time, and sets all counters to zero; returns whether any of it
    /// is new.
    pub(crate) fn note(&mut self) -> bool {
        let mut is_new = false;
        let mut at = 0;
        for (begin, count) in &self.places {
            // SAFETY: the compiler has given these bounds; the program's threads count there without order, and
            // whatever they write meanwhile is a valid byte.
            let counters = unsafe { slice::from_raw_parts_mut(*begin as *mut u8, *count) };
            let seen = &mut self.seen[at..at + count];
            at += count;
            for (counters, seen) in counters.chunks_mut(WIDTH).zip(seen.chunks_mut(WIDTH)) {
                // Nearly all are zero.
                if *counters == NONE[..counters.len()] {
                    continue;
                }
                for (counter, seen) in counters.iter_mut().zip(seen) {
                    let range = range(mem::take(counter));
                    if range & !*seen != 0 {
                        self.edges += usize::from(*seen == 0);
                        *seen |= range;
                        is_new = true;
                    }
                }
            }
        }
        is_new
    }
}

/// The range in which a count is, as a bit; none for zero.
fn range(count: u8) -> u8 {
    match count {
        0 => 0,
        1 => 1,
        2 => 2,
        3 => 4,
        4..=7 => 8,
        8..=15 => 16,
        16..=31 => 32,
        32..=127 => 64,
        128.. => 128,
    }
}
