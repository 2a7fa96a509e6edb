//! Lambda lists as people read them.

/// The elements of a lambda list.
pub fn parameters(lambda_list: &str) -> Vec<&str> {
    let mut words = Vec::new();
    let mut depth = 0usize;
    let mut start = None;
    for (at, c) in lambda_list.char_indices() {
        if c.is_whitespace() && depth == 0 {
            if let Some(begin) = start.take() {
                words.extend(lambda_list.get(begin..at));
            }
            continue;
        }
        match c {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ => {}
        }
        start.get_or_insert(at);
    }
    words.extend(start.and_then(|begin| lambda_list.get(begin..)));
    words
}

/// The element of the lambda list to which the argument at that position belongs.
pub fn current_parameter(words: &[&str], position: usize, last: Option<&str>) -> Option<usize> {
    let mut left = position;
    let mut in_keys = false;
    for (at, word) in words.iter().enumerate() {
        match *word {
            "&optional" | "&allow-other-keys" | "&aux" | "&environment" => {}
            "&rest" | "&body" => return Some(at + 1).filter(|next| *next < words.len()),
            "&key" => in_keys = true,
            word if in_keys => {
                let name = word.trim_matches(['(', ')']).split_whitespace().next()?;
                let wanted = last?.trim_start_matches(':');
                if name.trim_start_matches(':').eq_ignore_ascii_case(wanted) {
                    return Some(at);
                }
            }
            _ if left == 0 => return Some(at),
            _ => left -= 1,
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_current_parameter_is_found() {
        let words = parameters("pose &optional type (name x) &key color");
        assert_eq!(
            words,
            ["pose", "&optional", "type", "(name x)", "&key", "color"]
        );
        assert_eq!(current_parameter(&words, 0, None), Some(0));
        assert_eq!(current_parameter(&words, 1, None), Some(2));
        assert_eq!(current_parameter(&words, 2, None), Some(3));
        assert_eq!(current_parameter(&words, 4, Some(":color")), Some(5));
        assert_eq!(current_parameter(&words, 3, Some("x")), None);
        let rest = parameters("test &body body");
        assert_eq!(current_parameter(&rest, 5, None), Some(2));
    }
}
