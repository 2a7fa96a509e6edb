//! Keyword arguments of builtins.

use crate::image::Image;
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;

/// The values of the keyword arguments `names` in `args`, which holds nothing but keyword
/// arguments; the first of several counts.
pub(crate) fn parse<const N: usize>(
    image: &Image,
    args: &[Value],
    names: [Sym; N],
) -> Result<[Option<Value>; N], Box<Raise>> {
    Ok(given(image, args, names)?.map(Option::<&Value>::cloned))
}

/// The same, borrowed.
pub(crate) fn given<'a, const N: usize>(
    image: &Image,
    args: &'a [Value],
    names: [Sym; N],
) -> Result<[Option<&'a Value>; N], Box<Raise>> {
    let mut values = [None; N];
    if args.is_empty() {
        return Ok(values);
    }
    let mut unknown = None;
    let mut others_allowed = None;
    for pair in args.chunks(2) {
        let [name, value] = pair else {
            return Err(Raise::program("odd number of &KEY arguments"));
        };
        let sym = name.as_symbol();
        let slot = names
            .iter()
            .position(|known| sym == Some(*known))
            .and_then(|i| values.get_mut(i));
        match slot {
            Some(slot @ None) => *slot = Some(value),
            Some(Some(_)) => {}
            None if sym == Some(known::K_ALLOW_OTHER_KEYS) => {
                others_allowed.get_or_insert(value.is_true());
            }
            None => {
                unknown.get_or_insert(name);
            }
        }
    }
    match unknown {
        Some(name) if others_allowed != Some(true) => {
            let shown = crate::print::to_string(image, name, true);
            Err(Raise::unknown_key(
                &shown,
                names.map(|known| image.name(known)),
            ))
        }
        _ => Ok(values),
    }
}
