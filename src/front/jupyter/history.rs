//! What has been evaluated, for clients that offer it again.

use std::collections::VecDeque;

use serde_json::{Value, json};

/// Maximum number of inputs and of their bytes that are kept; the oldest are forgotten.
const MAX_INPUTS: usize = 10_000;
const MAX_BYTES: usize = 16 << 20;

/// The number by which this session goes; earlier ones are not known.
const SESSION: i64 = 1;

/// The inputs of a session.
#[derive(Default)]
pub(crate) struct History {
    inputs: VecDeque<Input>,
    bytes: usize,
}

struct Input {
    line: u64,
    text: String,
    output: Option<String>,
}

impl Input {
    fn bytes(&self) -> usize {
        self.text.len() + self.output.as_ref().map_or(0, String::len)
    }
}

impl History {
    /// Adds an input with its number and its values, if it has any.
    pub(crate) fn add(&mut self, line: u64, text: &str, output: Option<String>) {
        let input = Input {
            line,
            text: text.to_owned(),
            output,
        };
        self.bytes += input.bytes();
        self.inputs.push_back(input);
        while self.inputs.len() > MAX_INPUTS || self.bytes > MAX_BYTES {
            let Some(oldest) = self.inputs.pop_front() else {
                return;
            };
            self.bytes -= oldest.bytes();
        }
    }

    /// The answer to a `history_request`.
    pub(crate) fn answer(&self, wanted: &Value) -> Value {
        let number = |key: &str| wanted.get(key).and_then(Value::as_i64);
        let count = number("n").and_then(|n| usize::try_from(n).ok());
        let all = self.inputs.iter();
        let found: Vec<&Input> = match wanted.get("hist_access_type").and_then(Value::as_str) {
            Some("tail") => all.collect(),
            Some("range") if matches!(number("session"), None | Some(0 | SESSION)) => {
                let line = |key| number(key).and_then(|n| u64::try_from(n).ok());
                let from = line("start").unwrap_or(0);
                let to = line("stop").unwrap_or(u64::MAX);
                all.filter(|input| (from..to).contains(&input.line))
                    .collect()
            }
            Some("search") => {
                let pattern = wanted.get("pattern").and_then(Value::as_str);
                let pattern: Vec<char> = pattern.unwrap_or("*").chars().collect();
                let mut found: Vec<&Input> =
                    all.filter(|input| matches(&pattern, &input.text)).collect();
                if wanted.get("unique").and_then(Value::as_bool) == Some(true) {
                    without_repetitions(&mut found);
                }
                found
            }
            _ => Vec::new(),
        };
        let is_range = wanted.get("hist_access_type").and_then(Value::as_str) == Some("range");
        let left_out = match count {
            Some(count) if !is_range => found.len().saturating_sub(count),
            _ => 0,
        };
        let with_output = wanted.get("output").and_then(Value::as_bool) == Some(true);
        let told = found.iter().skip(left_out).map(|input| match with_output {
            true => json!([SESSION, input.line, [input.text, input.output]]),
            false => json!([SESSION, input.line, input.text]),
        });
        json!({"status": "ok", "history": told.collect::<Vec<_>>()})
    }
}

/// Leaves the last of several equal inputs.
fn without_repetitions(inputs: &mut Vec<&Input>) {
    let mut seen = std::collections::HashSet::new();
    inputs.reverse();
    inputs.retain(|input| seen.insert(input.text.as_str()));
    inputs.reverse();
}

/// Whether a text is of a pattern in which `*` stands for any characters and `?` for one.
fn matches(pattern: &[char], text: &str) -> bool {
    let text: Vec<char> = text.chars().collect();
    let (mut p, mut t) = (0, 0);
    // Where to go on after a `*` that stands for one character more.
    let mut retry: Option<(usize, usize)> = None;
    while t < text.len() {
        match pattern.get(p) {
            Some('*') => {
                retry = Some((p + 1, t + 1));
                p += 1;
            }
            Some(c) if *c == '?' || *c == text[t] => (p, t) = (p + 1, t + 1),
            _ => match retry {
                Some((after, next)) => {
                    (p, t) = (after, next);
                    retry = Some((after, next + 1));
                }
                None => return false,
            },
        }
    }
    pattern[p..].iter().all(|c| *c == '*')
}

#[cfg(test)]
mod tests {
    use super::*;

    fn history() -> History {
        let mut history = History::default();
        for (line, text) in [(1, "(a)"), (2, "(ab)"), (3, "(a)")] {
            history.add(line, text, Some("NIL".to_owned()));
        }
        history
    }

    fn lines(wanted: Value) -> Vec<u64> {
        let answer = history().answer(&wanted);
        let told = answer["history"].as_array().expect("a list");
        told.iter().filter_map(|entry| entry[1].as_u64()).collect()
    }

    #[test]
    fn inputs_are_found_in_three_ways() {
        assert_eq!(lines(json!({"hist_access_type": "tail", "n": 2})), [2, 3]);
        let range = json!({"hist_access_type": "range", "session": 0, "start": 1, "stop": 3});
        assert_eq!(lines(range), [1, 2]);
        let other = json!({"hist_access_type": "range", "session": -1, "start": 1, "stop": 3});
        assert!(lines(other).is_empty());
        let search = json!({"hist_access_type": "search", "pattern": "(?)", "n": 9});
        assert_eq!(lines(search), [1, 3]);
        let unique = json!({"hist_access_type": "search", "pattern": "*a*", "unique": true});
        assert_eq!(lines(unique), [2, 3]);
    }

    #[test]
    fn what_came_of_an_input_is_told_if_it_is_wanted() {
        let wanted = json!({"hist_access_type": "tail", "n": 1, "output": true});
        let answer = history().answer(&wanted);
        assert_eq!(answer["history"], json!([[1, 3, ["(a)", "NIL"]]]));
    }

    #[test]
    fn the_oldest_inputs_are_forgotten() {
        let mut history = History::default();
        let large = "x".repeat(MAX_BYTES / 2);
        (1..=3).for_each(|line| history.add(line, &large, None));
        assert_eq!(history.inputs.len(), 2);
        assert_eq!(history.bytes, MAX_BYTES);
    }

    #[test]
    fn patterns_that_try_much_are_not_slow() {
        let pattern: Vec<char> = "*a".repeat(50).chars().collect();
        assert!(!matches(&pattern, &("a".repeat(49) + &"b".repeat(10_000))));
        assert!(matches(&pattern, &"a".repeat(1000)));
    }
}
