//! Where a plan works: the share of successes over two draws, as a picture.

use kitchens::kitchen_path;
use sweep::Record;
use sweep::influence::Influence;
use view::picture::{Image, Line};

/// Cells along either axis.
const CELLS: usize = 16;
/// Edge of a cell and margin around all (pixels).
const EDGE: usize = 28;
const MARGIN: usize = 64;
/// Fewer worlds than these say little about a cell: it is hatched.
const FEW: u32 = 5;

const PAPER: [u8; 3] = [250, 250, 248];
const EMPTY: [u8; 3] = [225, 225, 222];
const INK: [u8; 3] = [40, 40, 40];

/// The paths of the two draws that a picture is best about: those that explain most, if they are
/// numbers, or else the first ones that are drawn. The seed of a kitchen is none: near seeds have nothing
/// in common. `None` if there are no two.
pub(crate) fn axes(records: &[Record]) -> Option<[String; 2]> {
    let first = records.first()?;
    let seed = kitchen_path(first);
    let drawn = first.draws.iter().map(|(name, _)| name);
    let drawn: Vec<&str> = drawn.collect();
    let influence = Influence::of(records);
    let explaining = influence.significant().map(|effect| effect.name.as_str());
    let differs = |name: &str| {
        let number = |record: &Record| record.draws.get(name)?.number();
        let first = number(first);
        first.is_some() && records.iter().any(|record| number(record) != first)
    };
    let mut found: Vec<&str> = Vec::new();
    for name in explaining.chain(drawn) {
        if found.len() < 2 && !found.contains(&name) && seed != Some(name) && differs(name) {
            found.push(name);
        }
    }
    let [x, y] = <[&str; 2]>::try_from(found).ok()?;
    Some([x.to_owned(), y.to_owned()])
}

/// The picture for the draws with two paths; `None` if they are no numbers, or the same in all worlds.
pub(crate) fn heat_map(records: &[Record], [x, y]: [&str; 2]) -> Option<Image> {
    let tried = records.iter().filter(|record| record.outcome.counts());
    let points: Vec<(f64, f64, bool)> = tried
        .filter_map(|record| {
            let number = |name| record.draws.get(name)?.number();
            Some((number(x)?, number(y)?, record.is_success()))
        })
        .collect();
    let range = |of: fn(&(f64, f64, bool)) -> f64| {
        let low = points.iter().map(of).fold(f64::INFINITY, f64::min);
        let high = points.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
        (low < high).then_some([low, high])
    };
    let (across, up) = (range(|p| p.0)?, range(|p| p.1)?);
    let mut cells = [[[0_u32; 2]; CELLS]; CELLS];
    for (px, py, works) in &points {
        let place = |value: f64, [low, high]: [f64; 2]| {
            // The cast rounds down; the highest value belongs to the last cell.
            (((value - low) / (high - low) * CELLS as f64) as usize).min(CELLS - 1)
        };
        let cell = &mut cells[place(*py, up)][place(*px, across)];
        cell[0] += u32::from(*works);
        cell[1] += 1;
    }
    let size = 2 * MARGIN + CELLS * EDGE;
    let mut image = Image::filled(size, size, PAPER);
    for (row, cells) in cells.iter().enumerate() {
        for (column, cell) in cells.iter().enumerate() {
            let left = MARGIN + column * EDGE;
            let top = MARGIN + (CELLS - 1 - row) * EDGE;
            paint(&mut image, [left, top], *cell);
        }
    }
    let bottom = MARGIN + CELLS * EDGE + 8;
    let right = MARGIN + CELLS * EDGE;
    let mut write = |text: &str, column: usize, row: usize| {
        let line = Line {
            text,
            size: 16,
            color: INK,
        };
        line.draw(&mut image, column, row);
        line.width()
    };
    write(&format!("{:.2}", across[0]), MARGIN, bottom);
    write(
        &format!("{:.2}", across[1]),
        right.saturating_sub(30),
        bottom,
    );
    write(x, MARGIN + CELLS * EDGE / 2 - 30, bottom + 16);
    write(&format!("{:.2}", up[0]), 8, right - 10);
    write(&format!("{:.2}", up[1]), 8, MARGIN);
    write(y, 8, MARGIN - 24);
    Some(image)
}

fn paint(image: &mut Image, [left, top]: [usize; 2], [works, count]: [u32; 2]) {
    let color = if count == 0 {
        EMPTY
    } else {
        shade(f64::from(works) / f64::from(count))
    };
    image.fill([left, top], [EDGE - 1, EDGE - 1], color);
    if (1..FEW).contains(&count) {
        for row in 0..EDGE - 1 {
            for column in (0..EDGE - 1).filter(|column| (column + row) % 6 == 0) {
                image.set(left + column, top + row, PAPER);
            }
        }
    }
}

/// From red for none to green for all, past yellow.
fn shade(share: f64) -> [u8; 3] {
    let mixed = |from: [f64; 3], to: [f64; 3], share: f64| {
        // Between the two, so within 0 to 255.
        [0, 1, 2].map(|i| (from[i] + (to[i] - from[i]) * share) as u8)
    };
    let (bad, middling, good) = (
        [190.0, 40.0, 40.0],
        [235.0, 200.0, 80.0],
        [40.0, 140.0, 60.0],
    );
    match share < 0.5 {
        true => mixed(bad, middling, 2.0 * share),
        false => mixed(middling, good, 2.0 * share - 1.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sweep::{Drawn, Ending};

    #[test]
    fn half_of_the_picture_is_red_where_the_plan_fails() {
        let world = |i: u64| {
            let (x, y) = ((i % 64) as f64, (i / 64) as f64);
            let ending = if x < 32.0 {
                Ending::Failure
            } else {
                Ending::Success
            };
            let mut record = Record::new(i, ending);
            record.draws.set("b.x", Drawn::Number(x));
            record.draws.set("b.y", Drawn::Number(y));
            record
        };
        let records: Vec<Record> = (0..64 * 64).map(world).collect();
        let image = heat_map(&records, ["b.x", "b.y"]).expect("both are numbers");
        let at = |column: usize, row: usize| {
            image.pixel(MARGIN + column * EDGE + 5, MARGIN + row * EDGE + 5)
        };
        assert_eq!(at(2, 3), Some(shade(0.0)));
        assert_eq!(at(12, 9), Some(shade(1.0)));
        assert_eq!(heat_map(&records, ["b.x", "b.z"]), None);
        let wanted = Some(["b.x", "b.y"].map(str::to_owned));
        assert_eq!(axes(&records), wanted);
        assert_eq!(axes(&records[..1]), None);
    }

    #[test]
    fn the_seed_of_a_kitchen_is_no_axis() {
        let world = |i: u32| {
            let mut record = Record::new(i.into(), Ending::Success);
            record.draws.set("home", Drawn::Integer(i.into()));
            let text = Drawn::Text("GALLEY".to_owned());
            record.draws.set("home.arrangement", text);
            let number = |scale: f64| Drawn::Number(f64::from(i) * scale);
            record.draws.set("home.counter-height", number(0.01));
            record.draws.set("cup.x", number(0.1));
            record
        };
        let records: Vec<Record> = (0..20).map(world).collect();
        let wanted = Some(["home.counter-height", "cup.x"].map(str::to_owned));
        assert_eq!(axes(&records), wanted);
    }
}
