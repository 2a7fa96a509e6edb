//! The compiler's counters: how often each edge of the code was taken.

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

    /// Sets all counters to zero.
    pub(crate) fn clear(&self) {
        for (begin, count) in &self.places {
            // SAFETY: the compiler has given these bounds; the program's threads count there without order, and
            // whatever they write meanwhile is a valid byte.
            unsafe { (*begin as *mut u8).write_bytes(0, *count) };
        }
    }

    /// Notes what has been reached since the counters were cleared; returns whether any of it is new.
    pub(crate) fn note(&mut self) -> bool {
        let mut is_new = false;
        let mut at = 0;
        for (begin, count) in &self.places {
            // SAFETY: as above.
            let counters = unsafe { slice::from_raw_parts(*begin as *const u8, *count) };
            let seen = &mut self.seen[at..at + count];
            at += count;
            const WIDTH: usize = 64;
            for (counters, seen) in counters.chunks(WIDTH).zip(seen.chunks_mut(WIDTH)) {
                // Nearly all are zero, which words show faster than bytes.
                let (words, rest) = counters.as_chunks::<8>();
                let any = words
                    .iter()
                    .fold(0, |any, word| any | u64::from_ne_bytes(*word));
                if any == 0 && rest.iter().all(|counter| *counter == 0) {
                    continue;
                }
                for (counter, seen) in counters.iter().zip(seen) {
                    let range = range(*counter);
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
