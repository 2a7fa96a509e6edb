//! How goals of ROS 2's actions end, as a session understands it.

use lisp::visible::visible;
use robotics::motion::RobotTrouble;
use robotics::robot::RobotPart;
use ros::Value;
use ros::action::ClientEnd;
use session::outside::{FingersReport, RobotEnd};

/// Maximum number of characters of what a server says.
const MAX_TEXT: usize = 300;

/// The end of a goal of an action of a name.
pub(super) fn end_of(name: &str, part: RobotPart, end: &ClientEnd) -> RobotEnd {
    let name = name.to_owned();
    let mut fingers = None;
    let mut is_cancelled = false;
    let trouble = match end {
        ClientEnd::Succeeded(result) => {
            fingers = report(part, result);
            // A server that succeeds with an error has not.
            complaint(result).map(|text| RobotTrouble::Aborted { name, text })
        }
        ClientEnd::Aborted(result) => {
            fingers = report(part, result);
            let text = complaint(result).or_else(|| said(result));
            let text = text.unwrap_or_else(|| "it does not say why".to_owned());
            Some(RobotTrouble::Aborted { name, text })
        }
        ClientEnd::Canceled { by_us: true } => {
            is_cancelled = true;
            None
        }
        ClientEnd::Canceled { by_us: false } => Some(RobotTrouble::CanceledElsewhere { name }),
        ClientEnd::Unserved { waited } => Some(RobotTrouble::Unserved {
            name,
            waited: waited.as_secs_f64(),
        }),
        ClientEnd::NoAnswer { waited } => Some(RobotTrouble::NoAnswer {
            name,
            waited: waited.as_secs_f64(),
        }),
        ClientEnd::Rejected => Some(RobotTrouble::Rejected { name }),
        ClientEnd::TimedOut { waited, has_ended } => Some(RobotTrouble::Late {
            name,
            limit: waited.as_secs_f64(),
            has_ended: *has_ended,
        }),
        ClientEnd::NotBegun { waited, has_ended } => Some(RobotTrouble::NotBegun {
            name,
            limit: waited.as_secs_f64(),
            has_ended: *has_ended,
        }),
        ClientEnd::NotEnding => Some(RobotTrouble::NotEnding { name }),
        ClientEnd::Gone => Some(RobotTrouble::Gone { name }),
        ClientEnd::Forgotten => Some(RobotTrouble::Forgotten { name }),
    };
    RobotEnd {
        trouble,
        is_cancelled,
        fingers,
    }
}

/// What a result complains of: a code that is not zero, and a text.
fn complaint(result: &Value) -> Option<String> {
    let code = result.get("error_code").and_then(Value::as_integer);
    match (code.filter(|code| *code != 0), said(result)) {
        (Some(code), Some(text)) => Some(format!("{text} (error {code})")),
        (Some(code), None) => Some(format!("error {code}")),
        // A text without a code complains of nothing.
        (None, _) => None,
    }
}

/// The text of a result, if it has one.
fn said(result: &Value) -> Option<String> {
    let texts = ["error_msg", "error_string"].map(|name| result.get(name).and_then(Value::as_text));
    let mut texts = texts.into_iter().flatten();
    texts.find(|text| !text.trim().is_empty()).map(shown)
}

/// What a server says, in one line that a terminal can show.
pub(super) fn shown(text: &str) -> String {
    let line: Vec<&str> = text.split_whitespace().collect();
    let line = visible(&line.join(" ")).to_string();
    match line.char_indices().nth(MAX_TEXT) {
        Some((end, _)) => format!("{} …", line.get(..end).unwrap_or_default()),
        None => line,
    }
}

fn report(part: RobotPart, result: &Value) -> Option<FingersReport> {
    let RobotPart::Gripper(_) = part else {
        return None;
    };
    let gap = result.get("position").and_then(Value::as_float);
    Some(FingersReport {
        gap: gap.filter(|gap| gap.is_finite())?,
        is_stalled: result.get("stalled") == Some(&Value::Bool(true)),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(code: i64, text: &str) -> Value {
        Value::record([("error_code", code.into()), ("error_msg", text.into())])
    }

    #[test]
    fn what_a_server_says_of_a_failure_is_in_one_short_line() {
        let end = |end| {
            end_of("/go", RobotPart::Base, &end)
                .trouble
                .map(|t| t.to_string())
        };
        let aborted = |code, text| end(ClientEnd::Aborted(record(code, text)));
        assert_eq!(
            aborted(7, "no\nway \u{7}there").as_deref(),
            Some("/go has given up: no way ^Gthere (error 7)")
        );
        assert_eq!(aborted(7, "").as_deref(), Some("/go has given up: error 7"));
        assert_eq!(
            aborted(0, "").as_deref(),
            Some("/go has given up: it does not say why")
        );
        assert_eq!(
            aborted(0, "no way").as_deref(),
            Some("/go has given up: no way")
        );
        let long = aborted(1, &"a".repeat(100_000)).unwrap_or_default();
        assert!(long.chars().count() < 400 && long.ends_with("… (error 1)"));
        assert_eq!(end(ClientEnd::Succeeded(record(0, ""))), None);
        // It contradicts itself.
        assert!(end(ClientEnd::Succeeded(record(3, "no"))).is_some());
    }
}
