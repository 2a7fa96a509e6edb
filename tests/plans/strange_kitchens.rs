//! Kitchens as others build them: doors in two stages, drawers behind doors, flaps, fronts that reach into their
//! carcasses, bars beside the origin of their links, at another place than the origin, below a root of another name.

use super::cook::Cook;
use session::SessionOptions;

/// A box of a link: its size and its middle (m).
fn block([size, at]: [[f64; 3]; 2]) -> String {
    let text = |v: [f64; 3]| format!("{} {} {}", v[0], v[1], v[2]);
    format!(
        "<collision><origin xyz=\"{}\"/><geometry><box size=\"{}\"/></geometry></collision>",
        text(at),
        text(size)
    )
}

fn link(name: &str, blocks: &[[[f64; 3]; 2]]) -> String {
    let blocks: String = blocks.iter().copied().map(block).collect();
    format!("<link name=\"{name}\">{blocks}</link>")
}

/// A joint: its name, type, parent, child, origin, axis and upper limit.
fn joint(name: &str, kind: &str, [parent, child]: [&str; 2], at: &str, motion: &str) -> String {
    format!(
        "<joint name=\"{name}\" type=\"{kind}\"><parent link=\"{parent}\"/><child link=\"{child}\"/>
         <origin xyz=\"{at}\"/>{motion}</joint>"
    )
}

fn moves(axis: &str, upper: f64) -> String {
    format!(
        "<axis xyz=\"{axis}\"/><limit lower=\"0\" upper=\"{upper}\" effort=\"300\" velocity=\"10\"/>"
    )
}

/// A carcass that is open in front, at x = 0: width, and where it begins and ends above the floor (m).
fn carcass(name: &str, width: f64, [low, high]: [f64; 2]) -> String {
    let (side, tall, middle) = (width / 2.0 - 0.01, high - low, (high + low) / 2.0);
    link(
        name,
        &[
            [[0.5, 0.02, tall], [0.27, side, middle]],
            [[0.5, 0.02, tall], [0.27, -side, middle]],
            [[0.02, width, tall], [0.51, 0.0, middle]],
            [[0.5, width, 0.02], [0.27, 0.0, low]],
            [[0.5, width, 0.02], [0.27, 0.0, high]],
        ],
    )
}

/// A cupboard whose door comes out before it turns, with a drawer behind it, a cupboard with a flap, and a table,
/// far from the origin.
fn kitchen() -> String {
    let fixed = |parent: &str, child: &str, at: &str| {
        joint(&format!("{child}_joint"), "fixed", [parent, child], at, "")
    };
    let parts = [
        "<robot name=\"strange\"><link name=\"room_link\"/>".to_owned(),
        carcass("cupboard", 0.62, [0.4, 1.1]),
        fixed("room_link", "cupboard", "6 -3 0"),
        // The door is let into the carcass, so that it cannot turn where it is.
        "<link name=\"door_out\"/>".to_owned(),
        joint(
            "door_out_joint",
            "prismatic",
            ["cupboard", "door_out"],
            "0.03 0.285 0.75",
            &moves("-1 0 0", 0.03),
        ),
        link("door", &[[[0.02, 0.56, 0.66], [0.0, -0.285, 0.0]]]),
        joint(
            "door_joint",
            "revolute",
            ["door_out", "door"],
            "0 0 0",
            &moves("0 0 -1", 1.5),
        ),
        link(
            "door_handle",
            &[
                [[0.04, 0.015, 0.015], [0.025, 0.0, 0.1]],
                [[0.04, 0.015, 0.015], [0.025, 0.0, -0.1]],
                [[0.015, 0.015, 0.22], [0.0, 0.0, 0.0]],
            ],
        ),
        fixed("door", "door_handle", "-0.055 -0.5 0"),
        // Its rails reach into the carcass, and its bar is beside the origin of its link.
        link(
            "drawer",
            &[
                [[0.02, 0.44, 0.2], [0.0, 0.0, 0.1]],
                [[0.36, 0.4, 0.015], [0.18, 0.0, 0.01]],
                [[0.36, 0.015, 0.1], [0.18, 0.2, 0.05]],
                [[0.36, 0.015, 0.1], [0.18, -0.2, 0.05]],
                [[0.02, 0.4, 0.1], [0.35, 0.0, 0.05]],
                [[0.06, 0.62, 0.01], [0.33, 0.0, -0.005]],
            ],
        ),
        joint(
            "drawer_joint",
            "prismatic",
            ["cupboard", "drawer"],
            "0.12 0 0.6",
            &moves("-1 0 0", 0.36),
        ),
        link(
            "drawer_handle",
            &[[[0.015, 0.2, 0.015], [-0.05, 0.0, 0.15]]],
        ),
        fixed("drawer", "drawer_handle", "0 0 0"),
        carcass("niche", 0.6, [0.7, 1.1]),
        fixed("room_link", "niche", "6 -1.9 0"),
        link("niche_shelf", &[[[0.45, 0.54, 0.02], [0.0, 0.0, 0.0]]]),
        fixed("niche", "niche_shelf", "0.27 0 0.73"),
        link("flap", &[[[0.02, 0.56, 0.36], [0.0, 0.0, 0.19]]]),
        joint(
            "flap_joint",
            "revolute",
            ["niche", "flap"],
            "-0.02 0 0.71",
            &moves("0 -1 0", 1.2),
        ),
        link("flap_handle", &[[[0.015, 0.3, 0.015], [0.0, 0.0, 0.0]]]),
        fixed("flap", "flap_handle", "-0.055 0 0.32"),
        link("desk", &[[[0.7, 1.0, 0.74], [0.0, 0.0, 0.37]]]),
        fixed("room_link", "desk", "6.3 -4.4 0"),
        "</robot>".to_owned(),
    ];
    parts.concat()
}

const DESCRIPTION: &str = "
(kitchen elsewhere)
(start 4.6 -2.6 :heading 0)
(behind flap niche_shelf)
(place table :on desk)";

fn cook() -> Cook {
    let mut cook = Cook::with(&SessionOptions {
        world: Some(("strange.urdf".to_owned(), kitchen())),
        world_description: Some(("strange.sexp".to_owned(), DESCRIPTION.to_owned())),
        ..SessionOptions::default()
    });
    cook.done(
        "(init-projection)
         (defun get-at (?name)
           (with-simulated-robot
             (perform (an action (type accessing)
                          (location (a location (in (an object (urdf-name ?name)))))))))
         (defun shut-again (?name)
           (with-simulated-robot
             (perform (an action (type sealing)
                          (location (a location (in (an object (urdf-name ?name)))))))))",
    );
    cook
}

/// Where the joints of the door, of what lets it out, of the drawer and of the flap are (m or rad).
fn joints(cook: &Cook) -> [f64; 4] {
    let world = cook.session.simulation().world();
    ["door_out_joint", "door_joint", "drawer_joint", "flap_joint"]
        .map(|name| (world.kitchen_joint(name).unwrap() * 1000.0).round() / 1000.0)
}

#[test]
fn the_robot_starts_where_the_description_says() {
    let cook = cook();
    let world = cook.session.simulation().world();
    let base = world.robot_configuration().base.translation;
    assert_eq!([base.x, base.y], [4.6, -2.6]);
}

#[test]
fn what_can_be_opened_is_found() {
    let mut cook = cook();
    assert_eq!(
        cook.done("(mapcar #'first (pw:list-containers))"),
        "(:DOOR :DRAWER :FLAP)\n"
    );
    let before = cook.done("(mapcar #'pp-plans::container-before '(:door :drawer :flap))");
    assert_eq!(before, "(NIL :DOOR NIL)\n");
}

#[test]
fn a_door_comes_out_before_it_turns_and_goes_in_again() {
    let mut cook = cook();
    cook.done("(get-at 'door)");
    assert_eq!(joints(&cook), [0.03, 1.5, 0.0, 0.0]);
    cook.done("(shut-again 'door)");
    assert_eq!(joints(&cook), [0.0; 4]);
}

#[test]
fn a_door_that_is_put_open_is_out() {
    let mut cook = cook();
    cook.done("(move-kitchen-joint :joint-name \"door_joint\" :joint-angle 1)");
    assert_eq!(joints(&cook), [0.03, 1.0, 0.0, 0.0]);
    cook.done("(move-kitchen-joint :joint-name \"door_joint\" :joint-angle 0)");
    assert_eq!(joints(&cook), [0.0; 4]);
}

#[test]
fn a_flap_is_opened_and_closed() {
    let mut cook = cook();
    cook.done("(get-at 'flap)");
    assert_eq!(joints(&cook), [0.0, 0.0, 0.0, 1.2]);
    cook.done("(shut-again 'flap)");
    assert_eq!(joints(&cook), [0.0; 4]);
}

#[test]
fn a_cup_is_brought_out_of_a_drawer_behind_a_door_and_back() {
    let mut cook = cook();
    cook.done("(btr-utils:spawn-object 'cup-1 :cup :pose '((6.28 -2.95 0.68) (0 0 0 1)))");
    let bring = |place: &str| {
        format!(
            "(with-simulated-robot
               (perform (an action (type transporting)
                            (object (an object (type cup)
                                        (location (a location (in (an object (urdf-name drawer)))))))
                            (target (a location {place})))))
             (pp-plans::support-of 'cup-1)"
        )
    };
    let on = cook.done(&bring("(on (an object (urdf-name desk)))"));
    assert!(on.contains("desk"), "{on}");
    assert_eq!(joints(&cook), [0.0; 4]);
    let back = "(with-simulated-robot
                  (perform (an action (type transporting)
                               (object (an object (type cup)
                                           (location (a location (on (an object (urdf-name desk)))))))
                               (target (a location (in (an object (urdf-name drawer))))))))
                (pp-plans::support-of 'cup-1)";
    let inside = cook.done(back);
    assert!(inside.contains("drawer"), "{inside}");
    assert_eq!(joints(&cook), [0.0; 4]);
}

#[test]
fn a_description_with_two_starts_or_without_one_is_an_error() {
    let refused = |text: &str| {
        let options = SessionOptions {
            world: Some(("strange.urdf".to_owned(), kitchen())),
            world_description: Some(("strange.sexp".to_owned(), text.to_owned())),
            ..SessionOptions::default()
        };
        session::Session::new(&options).err().unwrap().to_string()
    };
    let two = refused("(kitchen k) (start 1 2) (start 2 3)");
    assert!(two.contains("strange.sexp:1:25"), "{two}");
    let none = refused("(kitchen k) (start here)");
    assert!(none.contains("(start X Y :heading DEGREES)"), "{none}");
    let nothing = refused("(kitchen k) (behind flap)");
    assert!(nothing.contains("(behind DOOR LINK)"), "{nothing}");
    let stranger = refused("(kitchen k) (behind flap niche_shelff)");
    assert!(stranger.contains("did you mean niche_shelf?"), "{stranger}");
    let board = refused("(kitchen k) (behind niche_shelf flap)");
    assert!(board.contains("the link of a drawer or door"), "{board}");
}
