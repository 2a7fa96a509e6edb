use std::collections::BTreeMap;

use serde::Deserialize;

use super::*;

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct State {
    is_there: bool,
    number: u32,
    texts: Vec<String>,
    bodies: Vec<Body>,
    by_name: BTreeMap<u8, Option<f64>>,
    last: i64,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
enum Body {
    Free,
    Ball {
        at: [f64; 3],
        touches: Vec<(u16, char)>,
    },
    Pair(f32, Shape),
    Only(Shape),
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
enum Shape {
    Round(u64),
    Flat(u8),
}

fn states() -> Vec<State> {
    let ball = |n: u16| Body::Ball {
        at: [f64::from(n), -0.0, 1.0 / f64::from(n)],
        touches: (0..n).map(|n| (n, 'é')).collect(),
    };
    let first = State {
        is_there: true,
        number: 7,
        texts: vec!["one".to_owned(), String::new()],
        bodies: vec![
            ball(3),
            Body::Free,
            Body::Pair(0.5, Shape::Flat(9)),
            ball(1),
        ],
        by_name: BTreeMap::from([(1, None), (4, Some(f64::MAX))]),
        last: -1,
    };
    let mut longer = first.clone();
    longer.texts.insert(0, "a longer text".to_owned());
    longer
        .bodies
        .extend([ball(9), Body::Only(Shape::Round(u64::MAX))]);
    longer.bodies[1] = ball(5);
    let mut shorter = longer.clone();
    shorter.bodies.truncate(2);
    shorter.by_name.clear();
    shorter.last = i64::MIN;
    vec![first, longer, shorter, State::default()]
}

fn written(state: &State, reference: Option<Reference<'_>>) -> (Vec<u8>, Places) {
    let mut writer = Writer::new(Vec::new(), reference, None);
    state.serialize(&mut writer).unwrap();
    writer.finish()
}

#[test]
fn what_is_written_against_any_state_is_read_again() {
    for one in states() {
        let (bytes, places) = written(&one, None);
        let reference = Reference {
            bytes: &bytes,
            places: &places,
        };
        for other in states() {
            let (bytes, _) = written(&other, Some(reference));
            let bytes = Compressed::new(&bytes, &mut Vec::new()).bytes().unwrap();
            let read = State::deserialize(&mut Reader::new(&bytes, Some(reference), None));
            assert_eq!(read.unwrap(), other);
            if one == other {
                assert!(bytes.iter().all(|byte| *byte == 0), "{bytes:?}");
            }
        }
    }
}

#[test]
fn an_element_that_grows_shifts_nothing() {
    let [one, mut other] = [0; 2].map(|_| states().swap_remove(0));
    let (earlier, places) = written(&one, None);
    let reference = Reference {
        bytes: &earlier,
        places: &places,
    };
    let Body::Ball { touches, .. } = &mut other.bodies[0] else {
        panic!("the first body is a ball");
    };
    touches.extend([(300, 'x'), (301, 'y')]);
    let (bytes, _) = written(&other, Some(reference));
    let changed = bytes.iter().filter(|byte| **byte != 0).count();
    // The number of touches, and two of them.
    assert_eq!(changed, 1 + 2 * 3);
}

#[test]
fn what_is_left_out_is_read_from_elsewhere() {
    let state = states().swap_remove(1);
    let mut writer = Writer::new(Vec::new(), None, Some("Shape"));
    state.serialize(&mut writer).unwrap();
    let (bytes, _) = writer.finish();
    assert!(bytes.len() < written(&state, None).0.len());
    let mut elsewhere = Vec::new();
    for shape in [Shape::Flat(9), Shape::Round(u64::MAX)] {
        plain(&shape, &mut elsewhere).unwrap();
    }
    let left_out = LeftOut {
        name: "Shape",
        bytes: &elsewhere,
    };
    let read = State::deserialize(&mut Reader::new(&bytes, None, Some(left_out)));
    assert_eq!(read.unwrap(), state);
}

#[test]
fn bytes_that_say_something_else_are_refused() {
    let (bytes, _) = written(&states()[1], None);
    let read = |bytes: &[u8]| State::deserialize(&mut Reader::new(bytes, None, None));
    for length in 0..bytes.len() {
        assert_eq!(read(&bytes[..length]), Err(PackingError::Short));
    }
    let mut wrong = bytes.clone();
    wrong[0] = 2;
    assert_eq!(read(&wrong), Err(PackingError::NotOf("true or false")));
    let mut compressed = Compressed::new(&bytes, &mut Vec::new());
    compressed.bytes = compressed.bytes[..20].into();
    let refused = PackingError::NotOf("what was compressed");
    assert_eq!(compressed.bytes(), Err(refused));
}
