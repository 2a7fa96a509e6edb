//! What a person may set: by a line such as `%pictures off` at the beginning of a cell.

use view::picture::View;

/// Width and height of a picture of the world (pixels) by default, and their limits.
const SIZE: [usize; 2] = [400, 300];
const SIZES: std::ops::RangeInclusive<usize> = 16..=2048;

/// What a notebook shows, and what it does at conditions.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Settings {
    /// From where the world is shown after a cell that has changed it, if it is.
    pub(crate) view: Option<View>,
    /// Width and height of these pictures (pixels).
    pub(crate) size: [usize; 2],
    /// Whether a condition that nothing handles stops the plan where it is, if there is somebody who
    /// could choose a restart.
    pub(crate) has_debugger: bool,
}

impl Default for Settings {
    fn default() -> Settings {
        Settings {
            view: Some(View::Kitchen),
            size: SIZE,
            has_debugger: true,
        }
    }
}

impl Settings {
    /// Takes the lines that set something off the beginning of a cell; the others stay where they
    /// are, so that places in them are right. An error says what can be set.
    pub(crate) fn take(&mut self, cell: &str) -> Result<String, String> {
        let mut rest = String::with_capacity(cell.len());
        let mut lines = cell.split_inclusive('\n');
        for line in lines.by_ref() {
            let text = line.trim();
            let words: Vec<&str> = text.split_whitespace().collect();
            match words.as_slice() {
                ["%pictures", wanted @ ..] => self.set_pictures(wanted)?,
                ["%debugger", "on"] => self.has_debugger = true,
                ["%debugger", "off"] => self.has_debugger = false,
                ["%debugger", ..] => return Err("%debugger takes on or off.".to_owned()),
                [] => {}
                _ => {
                    rest.push_str(line);
                    break;
                }
            }
            rest.extend(line.chars().filter(|c| *c == '\n'));
        }
        rest.extend(lines);
        Ok(rest)
    }

    fn set_pictures(&mut self, wanted: &[&str]) -> Result<(), String> {
        let mut set = self.clone();
        for word in wanted {
            if *word == "off" {
                set.view = None;
            } else if *word == "on" {
                set.view = set.view.or(Settings::default().view);
            } else if let Some(view) = View::NAMED.into_iter().find(|v| v.name() == *word) {
                set.view = Some(view);
            } else if let Some(size) = size_of(word) {
                set.size = size;
            } else {
                let names = View::NAMED.map(|view| view.name()).join(", ");
                return Err(format!(
                    "%pictures takes on, off, a view ({names}) and a size such as 400x300."
                ));
            }
        }
        *self = set;
        Ok(())
    }
}

/// `400x300` as width and height.
fn size_of(word: &str) -> Option<[usize; 2]> {
    let (width, height) = word.split_once('x')?;
    let size = [width.parse().ok()?, height.parse().ok()?];
    size.iter().all(|side| SIZES.contains(side)).then_some(size)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_at_the_beginning_set_something() {
        let mut settings = Settings::default();
        let rest = settings.take("%pictures follow 320x240\n\n%debugger off\n(a)\n%pictures off\n");
        assert_eq!(rest.as_deref(), Ok("\n\n\n(a)\n%pictures off\n"));
        let wanted = Settings {
            view: Some(View::Follow),
            size: [320, 240],
            has_debugger: false,
        };
        assert_eq!(settings, wanted);
        assert_eq!(settings.take("%pictures off").as_deref(), Ok(""));
        assert_eq!(settings.view, None);
    }

    #[test]
    fn what_cannot_be_set_is_said() {
        let mut settings = Settings::default();
        for cell in [
            "%pictures here",
            "%pictures 9999x1",
            "%debugger",
            "%pictures off 1x",
        ] {
            assert!(settings.take(cell).is_err(), "{cell}");
        }
        assert_eq!(settings, Settings::default());
        assert_eq!(settings.take("%other").as_deref(), Ok("%other"));
    }
}
