//! `~<…~>`: texts spread over a field.

/// How texts are spread.
pub(super) struct Justification {
    pub(super) width: usize,
    /// The field grows in steps of this.
    pub(super) step: usize,
    /// Fewest characters between texts.
    pub(super) least: usize,
    pub(super) pad: char,
    /// Is there padding before the first text?
    pub(super) before: bool,
    /// Is there padding after the last text?
    pub(super) after: bool,
}

impl Justification {
    /// The texts in their field.
    pub(super) fn spread(&self, texts: &[String]) -> String {
        let gaps = texts.len().saturating_sub(1)
            + usize::from(self.pads_before(texts.len()))
            + usize::from(self.after);
        // A single text has others neither before nor after it, so there is nothing to keep apart.
        let is_single = texts.len() == 1 && !self.before && !self.after;
        let least = if is_single { 0 } else { self.least };
        let letters: usize = texts.iter().map(|t| t.chars().count()).sum();
        let needed = letters + gaps * least;
        let width = if needed > self.width {
            let step = self.step.max(1);
            self.width + (needed - self.width).div_ceil(step) * step
        } else {
            self.width
        };
        let mut padding = width - letters;
        let mut gaps = gaps;
        let mut gap = || {
            if gaps == 0 {
                return String::new();
            }
            let length = padding / gaps;
            padding -= length;
            gaps -= 1;
            self.pad.to_string().repeat(length)
        };
        let mut result = String::new();
        if self.pads_before(texts.len()) {
            result.push_str(&gap());
        }
        for (i, text) in texts.iter().enumerate() {
            if i > 0 {
                result.push_str(&gap());
            }
            result.push_str(text);
        }
        if self.after {
            result.push_str(&gap());
        }
        result
    }

    /// A single text is right-aligned unless the padding is to be after it.
    fn pads_before(&self, texts: usize) -> bool {
        self.before || texts == 1 && !self.after
    }
}
