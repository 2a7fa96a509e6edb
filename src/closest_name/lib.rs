//! "Did you mean …?": the known name that is nearest to a mistyped one.

/// The name among `names` that differs least from `wanted` (letters inserted, dropped, replaced
/// or swapped with their neighbour; case is ignored), or `None` when even the nearest one
/// differs in more than a third of its letters.
///
/// Of equally near names, those win that have the same letters, then those that have all the letters in order, and of
/// these the first.
pub fn closest_name<'a>(wanted: &str, names: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let wanted: Vec<char> = wanted.to_lowercase().chars().collect();
    let sorted = |letters: &[char]| {
        let mut letters = letters.to_vec();
        letters.sort_unstable();
        letters
    };
    let of_wanted = sorted(&wanted);
    let mut best: Option<((usize, bool, bool), &str)> = None;
    for name in names {
        let letters: Vec<char> = name.to_lowercase().chars().collect();
        let allowed = (letters.len().max(wanted.len()) / 3).max(1);
        if letters.len().abs_diff(wanted.len()) > allowed {
            continue;
        }
        let distance = edit_distance(&wanted, &letters);
        let is_other = distance <= allowed && sorted(&letters) != of_wanted;
        let rank = (distance, is_other, !has_in_order(&letters, &wanted));
        if distance <= allowed && best.is_none_or(|(least, _)| rank < least) {
            best = Some((rank, name));
        }
    }
    best.map(|(_, name)| name)
}

/// Does a name have these letters, in their order, among others?
fn has_in_order(name: &[char], letters: &[char]) -> bool {
    let mut name = name.iter();
    letters.iter().all(|letter| name.any(|x| x == letter))
}

/// Number of insertions, deletions, replacements and swaps of neighbours from `a` to `b`.
fn edit_distance(a: &[char], b: &[char]) -> usize {
    // Three rolling rows of the usual table: the row two above is needed for swaps.
    let mut above2: Vec<usize> = vec![0; b.len() + 1];
    let mut above: Vec<usize> = (0..=b.len()).collect();
    for (i, &x) in a.iter().enumerate() {
        let mut row = vec![i + 1; b.len() + 1];
        for (j, &y) in b.iter().enumerate() {
            let replaced = above[j] + usize::from(x != y);
            let mut least = replaced.min(above[j + 1] + 1).min(row[j] + 1);
            if i > 0 && j > 0 && x == b[j - 1] && a[i - 1] == y {
                least = least.min(above2[j - 1] + 1);
            }
            row[j + 1] = least;
        }
        above2 = std::mem::replace(&mut above, row);
    }
    above[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_name_with_a_swapped_letter() {
        let names = ["l_elbow_flex_joint", "r_elbow_flex_joint"];
        assert_eq!(
            closest_name("r_eblow_flex_joint", names),
            Some("r_elbow_flex_joint")
        );
    }

    #[test]
    fn ignores_case() {
        assert_eq!(closest_name(":BOTLE", [":cup", ":bottle"]), Some(":bottle"));
    }

    #[test]
    fn a_name_that_lacks_a_letter_is_completed() {
        assert_eq!(closest_name("lst", ["let", "list", "last"]), Some("list"));
    }

    #[test]
    fn swapped_letters_are_more_likely_than_a_lacking_one() {
        assert_eq!(closest_name("poes", ["poses", "pose"]), Some("pose"));
    }

    #[test]
    fn says_nothing_when_nothing_is_near() {
        assert_eq!(closest_name("spaceship", ["cup", "bottle"]), None);
    }
}
