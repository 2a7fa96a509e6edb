//! The past, in bounded memory.

use std::collections::VecDeque;
use std::sync::Arc;

use crate::watch::Moment;

/// Bytes that moments may take together.
const MOST_BYTES: usize = 96 << 20;

/// Moments in order of time. When they take too much memory, every second one of the older
/// half is forgotten: the longer ago, the coarser.
#[derive(Debug)]
pub(crate) struct Timeline {
    moments: VecDeque<Arc<Moment>>,
    bytes: usize,
    most_bytes: usize,
}

impl Default for Timeline {
    fn default() -> Self {
        Self::new(MOST_BYTES)
    }
}

impl Timeline {
    /// An empty past that takes about so many bytes at most.
    pub(crate) fn new(most_bytes: usize) -> Self {
        Self {
            moments: VecDeque::new(),
            bytes: 0,
            most_bytes,
        }
    }

    /// Adds a moment that is not before the last one; one at the same time takes its place.
    pub(crate) fn push(&mut self, moment: Arc<Moment>) {
        while let Some(last) = self.moments.back()
            && last.time >= moment.time
        {
            self.bytes -= last.bytes();
            self.moments.pop_back();
        }
        self.bytes += moment.bytes();
        self.moments.push_back(moment);
        if self.bytes > self.most_bytes {
            self.thin_out();
        }
    }

    fn thin_out(&mut self) {
        let half = self.moments.len() / 2;
        let mut place = 0;
        self.moments.retain(|_| {
            place += 1;
            // The first moment stays, so that the past keeps its beginning.
            place > half || place % 2 == 1
        });
        self.bytes = self.moments.iter().map(|m| m.bytes()).sum();
    }

    /// Time (s) of the first and the last moment.
    pub(crate) fn span(&self) -> Option<[f64; 2]> {
        Some([self.moments.front()?.time, self.moments.back()?.time])
    }

    /// The moments from the last one at or before `from` up to `to` (s), at most `most`.
    pub(crate) fn between(&self, from: f64, to: f64, most: usize) -> Vec<Arc<Moment>> {
        let after = self.moments.partition_point(|m| m.time <= from);
        let moments = self.moments.range(after.saturating_sub(1)..);
        let within = moments.take_while(|m| m.time <= to).take(most);
        let mut found: Vec<_> = within.cloned().collect();
        // A time before the first moment shows that one.
        if found.is_empty() {
            found.extend(self.moments.front().cloned());
        }
        found
    }

    /// Number of moments.
    pub(crate) fn len(&self) -> usize {
        self.moments.len()
    }

    /// Whether there are none.
    pub(crate) fn is_empty(&self) -> bool {
        self.moments.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use crate::watch::live::timeline::*;

    fn moment(time: f64) -> Arc<Moment> {
        Arc::new(Moment {
            time,
            ..Moment::default()
        })
    }

    fn times(moments: &[Arc<Moment>]) -> Vec<f64> {
        moments.iter().map(|m| m.time).collect()
    }

    #[test]
    fn a_stretch_begins_with_what_was_seen_at_its_start() {
        let mut past = Timeline::default();
        (0..5).for_each(|t| past.push(moment(f64::from(t))));
        assert_eq!(times(&past.between(1.5, 3.0, 9)), [1.0, 2.0, 3.0]);
        assert_eq!(times(&past.between(3.0, 3.5, 9)), [3.0]);
        assert_eq!(times(&past.between(-2.0, -1.0, 9)), [0.0]);
        assert_eq!(times(&past.between(0.0, 9.0, 2)), [0.0, 1.0]);
        assert_eq!(times(&past.between(f64::NAN, 9.0, 9)).len(), 5);
        assert!(Timeline::default().between(0.0, 1.0, 9).is_empty());
    }

    #[test]
    fn a_later_look_at_the_same_time_counts() {
        let mut past = Timeline::default();
        past.push(moment(1.0));
        let mut edited = Moment::clone(&moment(1.0));
        edited.joints = vec![1.0].into();
        past.push(Arc::new(edited));
        assert_eq!(past.len(), 1);
        assert_eq!(past.between(1.0, 1.0, 1)[0].joints.len(), 1);
    }

    #[test]
    fn memory_is_bounded_and_both_ends_stay() {
        let most = 200 * moment(0.0).bytes();
        let mut past = Timeline::new(most);
        (0..100_000).for_each(|t| past.push(moment(f64::from(t))));
        assert!(past.bytes <= most && past.len() >= 100);
        assert_eq!(past.span(), Some([0.0, 99_999.0]));
    }
}
