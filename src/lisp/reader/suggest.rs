//! "Did you mean …?": the name nearest to one that does not exist.

/// The candidate with the smallest edit distance to `name` (ignoring case), if that is at most a
/// third of its length; of several, the first.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let wanted: Vec<char> = name.chars().flat_map(char::to_uppercase).collect();
    let mut limit = (wanted.len() / 3).clamp(1, 3) + 1;
    let mut best = None;
    for candidate in candidates {
        let found: Vec<char> = candidate.chars().flat_map(char::to_uppercase).collect();
        if found.is_empty() || found.len().abs_diff(wanted.len()) >= limit {
            continue;
        }
        let distance = edit_distance(&wanted, &found);
        if distance < limit {
            limit = distance;
            best = Some(candidate);
        }
    }
    best
}

/// Number of insertions, deletions, replacements and swaps of neighbours that turn one
/// word into the other (optimal string alignment).
fn edit_distance(a: &[char], b: &[char]) -> usize {
    let mut before_last: Vec<usize> = Vec::new();
    let mut last: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.iter().enumerate() {
        let mut row = Vec::with_capacity(b.len() + 1);
        row.push(i + 1);
        for (j, y) in b.iter().enumerate() {
            let mut cost = (last[j] + usize::from(x != y))
                .min(last[j + 1] + 1)
                .min(row[j] + 1);
            if i > 0 && j > 0 && *x == b[j - 1] && a[i - 1] == *y {
                cost = cost.min(before_last[j - 1] + 1);
            }
            row.push(cost);
        }
        before_last = last;
        last = row;
    }
    // The row has an entry for each prefix of `b`, so it is never empty.
    last.last().copied().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use crate::reader::suggest::*;

    #[test]
    fn the_nearest_name_is_found() {
        let names = ["LIST", "LENGTH", "LAST", "CAR"];
        assert_eq!(nearest("lenght", names), Some("LENGTH"));
        assert_eq!(nearest("lits", names), Some("LIST"));
        assert_eq!(nearest("zork", names), None);
    }
}
