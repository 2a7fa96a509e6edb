//! Work on several threads, whose results come in the order of the work.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError, mpsc};
use std::thread;

use crate::command::stack::THREAD_STACK;

/// Does the work on several threads, each with a function of its own that `worker` makes. `tell` gets
/// every result, in the order of the work, as soon as it and all before it are known; if it returns
/// false, no more work is begun. Returns all results up to the first that is missing. Nothing is kept
/// of work that has not begun, of which there may be any amount.
pub(in crate::command) fn in_order<W, I, R: Send, F: FnMut(W) -> R>(
    threads: usize,
    work: I,
    worker: impl Fn() -> F + Sync,
    mut tell: impl FnMut(&R) -> bool,
) -> Vec<R>
where
    I: IntoIterator<Item = W>,
    I::IntoIter: Send,
{
    let work = work.into_iter();
    let at_most = work.size_hint().1.unwrap_or(threads);
    let left = Mutex::new(Some(work.enumerate()));
    // Nothing panics while it takes work.
    let left = || left.lock().unwrap_or_else(PoisonError::into_inner);
    let mut done = Vec::new();
    thread::scope(|scope| {
        let (sender, receiver) = mpsc::channel();
        hire(scope, threads.min(at_most), || {
            let (sender, left, worker) = (sender.clone(), &left, &worker);
            move || {
                let mut run = worker();
                loop {
                    let next = left().as_mut().and_then(Iterator::next);
                    let Some((at, work)) = next else {
                        return;
                    };
                    if sender.send((at, run(work))).is_err() {
                        return;
                    }
                }
            }
        });
        drop(sender);
        let mut early = BTreeMap::new();
        for (at, result) in receiver {
            early.insert(at, result);
            while let Some(result) = early.remove(&done.len()) {
                let goes_on = tell(&result);
                done.push(result);
                if !goes_on {
                    *left() = None;
                    return;
                }
            }
        }
    });
    done
}

/// Begins so many threads, each with what `works` makes. If the machine has no more threads, those that there are do the
/// work.
fn hire<'s, F: FnOnce() + Send + 's>(
    scope: &'s thread::Scope<'s, '_>,
    threads: usize,
    works: impl Fn() -> F,
) {
    for _ in 0..threads {
        let thread = thread::Builder::new().stack_size(THREAD_STACK);
        if thread.spawn_scoped(scope, works()).is_err() {
            return;
        }
    }
}

/// Does several lots of work, one after the other, on the same threads, each with a function of its own that `worker`
/// makes when it first has something to do. `body` gets a function that does a lot: its results come in the order
/// of the work, up to the first that is missing.
pub(in crate::command) fn with_workers<W: Send, R: Send, F: FnMut(W) -> R, T>(
    threads: usize,
    worker: impl Fn() -> F + Sync,
    body: impl FnOnce(&mut dyn FnMut(Vec<W>) -> Vec<R>) -> T,
) -> T {
    let (give, work) = mpsc::channel::<(usize, W)>();
    // Nothing panics while it takes work.
    let work = Mutex::new(work);
    let next = || work.lock().unwrap_or_else(PoisonError::into_inner).recv();
    thread::scope(|scope| {
        // The threads end when there is nobody left to give them work.
        let give = give;
        let (sender, results) = mpsc::channel();
        hire(scope, threads, || {
            let (sender, next, worker) = (sender.clone(), &next, &worker);
            move || {
                let mut run = None;
                while let Ok((at, work)) = next() {
                    let run = run.get_or_insert_with(worker);
                    if sender.send((at, run(work))).is_err() {
                        return;
                    }
                }
            }
        });
        drop(sender);
        body(&mut |lot| {
            let mut done: Vec<Option<R>> = lot.iter().map(|_| None).collect();
            for work in lot.into_iter().enumerate() {
                // Who takes it is told below.
                let _ = give.send(work);
            }
            for (at, result) in results.iter().take(done.len()) {
                if let Some(place) = done.get_mut(at) {
                    *place = Some(result);
                }
            }
            done.into_iter().map_while(|result| result).collect()
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_come_in_order_on_any_number_of_threads() {
        for threads in [1, 2, 7] {
            let mut told = Vec::new();
            let slow = || {
                |n: u64| {
                    thread::sleep(std::time::Duration::from_micros(n * 7919 % 500));
                    n * n
                }
            };
            let done = in_order(threads, 0..1_000_000_000_000, slow, |square| {
                told.push(*square);
                told.len() < 60
            });
            assert_eq!(done, (0..60).map(|n| n * n).collect::<Vec<u64>>());
            assert_eq!(told, done);
        }
    }

    #[test]
    fn workers_do_one_lot_after_the_other() {
        let made = Mutex::new(0);
        let worker = || {
            let mut made = made.lock().unwrap();
            *made += 1;
            let (name, mut count) = (*made, 0);
            move |n: u64| {
                thread::sleep(std::time::Duration::from_micros(n * 7919 % 500));
                count += 1;
                (n * n, name, count)
            }
        };
        let lots = with_workers(3, worker, |squares| {
            [0..50, 50..51, 51..51, 51..90].map(|lot: std::ops::Range<u64>| squares(lot.collect()))
        });
        let squares: Vec<u64> = lots.iter().flatten().map(|(square, ..)| *square).collect();
        assert_eq!(squares, (0..90).map(|n| n * n).collect::<Vec<u64>>());
        // They are the same three workers at most, and each goes on counting.
        let mut all = 0;
        for worker in 1..=3 {
            let counts = lots.iter().flatten().filter(|(_, name, _)| *name == worker);
            let mut counts: Vec<u64> = counts.map(|(.., count)| *count).collect();
            counts.sort_unstable();
            assert!(
                counts.iter().copied().eq(1..=counts.len() as u64),
                "{counts:?}"
            );
            all += counts.len();
        }
        assert_eq!(all, 90);
    }
}
