//! The past, in bounded memory.

use std::collections::VecDeque;
use std::sync::Arc;

use crate::watch::Frame;

/// Approximate limit of the memory (bytes) for all frames.
const MAX_BYTES: usize = 96 << 20;

/// Frames in order of time. When they take too much memory, every other one of the older half
/// is forgotten, so the past gets coarser with age.
#[derive(Debug)]
pub(crate) struct Timeline {
    frames: VecDeque<Arc<Frame>>,
    bytes: usize,
    most_bytes: usize,
}

impl Default for Timeline {
    fn default() -> Self {
        Self::new(MAX_BYTES)
    }
}

impl Timeline {
    /// An empty past that takes at most about `most_bytes`.
    pub(super) fn new(most_bytes: usize) -> Self {
        Self {
            frames: VecDeque::new(),
            bytes: 0,
            most_bytes,
        }
    }

    /// Adds a frame that is not before the last one; it replaces one at the same time.
    pub(super) fn push(&mut self, frame: Arc<Frame>) {
        while let Some(last) = self.frames.back()
            && last.time >= frame.time
        {
            self.bytes -= last.bytes();
            self.frames.pop_back();
        }
        self.bytes += frame.bytes();
        self.frames.push_back(frame);
        if self.bytes > self.most_bytes {
            self.thin_out();
        }
    }

    fn thin_out(&mut self) {
        let half = self.frames.len() / 2;
        let mut place = 0;
        self.frames.retain(|_| {
            place += 1;
            // The first frame is kept, so that the past keeps its beginning.
            place > half || place % 2 == 1
        });
        self.bytes = self.frames.iter().map(|m| m.bytes()).sum();
    }

    /// Time (s) of the first and the last frame.
    pub(super) fn span(&self) -> Option<[f64; 2]> {
        Some([self.frames.front()?.time, self.frames.back()?.time])
    }

    /// The frames from the last one at or before `from` up to `to` (s), at most `most`.
    pub(super) fn between(&self, from: f64, to: f64, most: usize) -> Vec<Arc<Frame>> {
        let after = self.frames.partition_point(|m| m.time <= from);
        let frames = self.frames.range(after.saturating_sub(1)..);
        let within = frames.take_while(|m| m.time <= to).take(most);
        let mut found: Vec<_> = within.cloned().collect();
        // For a time before the first frame, that frame is shown.
        if found.is_empty() {
            found.extend(self.frames.front().cloned());
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use crate::watch::live::timeline::*;

    fn frame(time: f64) -> Arc<Frame> {
        Arc::new(Frame {
            time,
            ..Frame::default()
        })
    }

    fn times(frames: &[Arc<Frame>]) -> Vec<f64> {
        frames.iter().map(|m| m.time).collect()
    }

    #[test]
    fn a_stretch_begins_with_what_was_seen_at_its_start() {
        let mut past = Timeline::default();
        (0..5).for_each(|t| past.push(frame(f64::from(t))));
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
        past.push(frame(1.0));
        let mut edited = Frame::clone(&frame(1.0));
        edited.joints = vec![1.0].into();
        past.push(Arc::new(edited));
        assert_eq!(past.frames.len(), 1);
        assert_eq!(past.between(1.0, 1.0, 1)[0].joints.len(), 1);
    }

    #[test]
    fn memory_is_bounded_and_both_ends_stay() {
        let most = 200 * frame(0.0).bytes();
        let mut past = Timeline::new(most);
        (0..100_000).for_each(|t| past.push(frame(f64::from(t))));
        assert!(past.bytes <= most && past.frames.len() >= 100);
        assert_eq!(past.span(), Some([0.0, 99_999.0]));
    }
}
