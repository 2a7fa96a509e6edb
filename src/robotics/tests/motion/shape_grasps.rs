//! Grasps that are found from shapes.

use std::f64::consts::FRAC_PI_2;

use crate::mesh::MeshLibrary;
use crate::motion::{ShapeGrasps, Ungraspable};
use crate::robot::Side;
use crate::world::Models;
use crate::world::grasp_library::{GRASPS, GraspDefinition, GraspLibrary};
use crate::world::object_definitions::{Grasping, ObjectDefinitions};

/// What is known after a text of definitions has been read.
fn defined(models: &Models, text: &str) -> ObjectDefinitions {
    let grasps = GraspLibrary::from_sexp(GRASPS, "grasps.sexp").unwrap();
    let meshes = MeshLibrary::none();
    match ObjectDefinitions::read(text, "o.sexp", &meshes, &models.objects, &grasps) {
        Ok(defined) => defined,
        Err(error) => panic!("{error}"),
    }
}

/// The grasps of a thing with such a record.
fn grasps(models: &Models, properties: &str) -> Result<ShapeGrasps, Ungraspable> {
    let defined = defined(models, &format!("(object thing {properties})"));
    ShapeGrasps::of(models, defined.objects.get("thing").unwrap(), &[])
}

fn named<'a>(grasps: &'a ShapeGrasps, wanted: &str) -> Option<&'a GraspDefinition> {
    let mut all = grasps.grasps.iter();
    all.find(|(side, name, _)| *side == Side::Right && name == wanted)
        .map(|(_, _, grasp)| grasp)
}

#[test]
fn a_carton_is_grasped_across_its_narrow_side() {
    let models = Models::pr2_in_kitchen().unwrap();
    let carton = grasps(&models, ":shapes ((box :size (0.06 0.2 0.25)))").unwrap();
    for name in ["top", "left-side", "right-side"] {
        let grasp = named(&carton, name).unwrap_or_else(|| panic!("no {name}"));
        // The first column is the direction in which the fingers close.
        assert!(grasp.rotation[0][0].abs() > 0.95, "{name}: {grasp:?}");
        assert!(grasp.translation[0].abs() < 0.005, "{name}: {grasp:?}");
    }
    // From the front it is 0.2 m wide.
    assert_eq!(named(&carton, "front"), None);
    assert_eq!(named(&carton, "back"), None);
}

#[test]
fn a_hand_goes_over_the_rim_of_a_wide_vessel() {
    let models = Models::pr2_in_kitchen().unwrap();
    let pot = ":shapes ((cylinder :radius 0.1 :length 0.006 :at (0 0 0.003))
                        (ring :count 16 :radius 0.1 :stave (0.006 0.042 0.1) :at (0 0 0.05)))";
    let pot = grasps(&models, pot).unwrap();
    let top = named(&pot, "top").unwrap();
    let [x, y, z] = top.translation;
    let out = libm::hypot(x, y);
    assert!((0.085..0.115).contains(&out), "{top:?}");
    assert!((0.06..0.1).contains(&z), "{top:?}");
    assert_eq!(named(&pot, "front"), None);
}

#[test]
fn what_cannot_be_grasped_is_refused_with_the_reason() {
    let models = Models::pr2_in_kitchen().unwrap();
    let refused = |properties: &str| match grasps(&models, properties) {
        Ok(found) => panic!("{properties}: {found:?}"),
        Err(why) => why.to_string(),
    };
    assert_eq!(
        refused(":shapes ((box :size (0.1 0.15 0.2)))"),
        "too wide by 16 mm: its narrowest part is 100 mm wide, and fingers go around 84 mm"
    );
    assert_eq!(
        refused(":shapes ((box :size (0.05 0.05 0.1))) :mass 4"),
        "too heavy by 2.2 kg: it has 4.0 kg, and an arm carries 1.8 kg"
    );
    // A flat board is narrow only from below to above, and what it lies on is in the way.
    assert!(refused(":shapes ((box :size (0.3 0.3 0.01)))").starts_with("not accessible: "));
    // A steep gable has no sides that are parallel.
    let gable = format!(
        ":friction 0.1 :shapes ((box :size (0.05 0.3 0.05) :rpy ({} 0 0)))",
        FRAC_PI_2 / 2.0
    );
    assert!(grasps(&models, &gable).is_ok());
    // A long heavy bar, of which only one end is narrow enough.
    let bar = ":mass 1.6 :shapes ((box :size (0.3 0.3 0.12)) (box :size (0.03 0.02 0.03) :at (0.165 0 0.045)))";
    assert!(
        refused(bar).starts_with("too unbalanced"),
        "{}",
        refused(bar)
    );
}

#[test]
fn the_same_shape_has_the_same_grasps() {
    let models = Models::pr2_in_kitchen().unwrap();
    let shape =
        ":shapes ((cylinder :radius 0.03 :length 0.2) (sphere :radius 0.035 :at (0 0 0.1)))";
    let first = grasps(&models, shape).unwrap();
    assert_eq!(first, grasps(&models, shape).unwrap());
    let bits = |grasps: &ShapeGrasps| -> u64 {
        let numbers = grasps.grasps.iter().flat_map(|(_, _, g)| g.translation);
        numbers.fold(0, |all: u64, n| all.rotate_left(7) ^ n.to_bits())
    };
    assert_eq!(
        bits(&first),
        bits(&grasps(&Models::pr2_in_kitchen().unwrap(), shape).unwrap())
    );
}

#[test]
fn grasps_in_the_file_come_before_the_shape() {
    let models = Models::pr2_in_kitchen().unwrap();
    let text = "(object a :shapes ((sphere :radius 0.03)) :kind fruit)
                (object b :shapes ((sphere :radius 0.03)) :grasps (top front))
                (object c :shapes ((sphere :radius 0.03)) :grasps ())
                (grasp top :types (a) :arms (left) :translation (0 0 0) :rotation top-across-x
                       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
                       :lift (0 0 0.1) :second-lift (0 0 0.1))
                (order (a) top)";
    let known = defined(&models, text);
    let ways: Vec<&Grasping> = known.defined.iter().map(|one| &one.grasping).collect();
    let among = Grasping::Among(vec!["top".to_owned(), "front".to_owned()]);
    assert_eq!(ways, [&Grasping::AsDefined, &among, &Grasping::AsDefined]);
    assert_eq!(known.grasps.grasps("a"), ["top"]);
    assert!(known.objects.is_kind_of("a", "fruit"));
    let listed: Vec<&str> = known
        .objects
        .types()
        .map(|kind| kind.name.as_str())
        .collect();
    assert_eq!(listed[25..], ["a", "b", "c"]);
    let only = ShapeGrasps::of(
        &models,
        known.objects.get("b").unwrap(),
        &["top".to_owned(), "front".to_owned()],
    );
    let names: Vec<String> = only
        .unwrap()
        .grasps
        .into_iter()
        .map(|(_, name, _)| name)
        .collect();
    assert_eq!(names, ["top", "front", "top", "front"]);
}

#[test]
fn a_redefined_type_has_the_grasps_of_its_new_shape() {
    let models = Models::pr2_in_kitchen().unwrap();
    let known = defined(
        &models,
        "(object cup :shapes ((box :size (0.04 0.04 0.1))))",
    );
    assert!(known.grasps.grasps("cup").is_empty());
    assert_eq!(known.objects.types().len(), 25);
    assert_eq!(known.objects.get("cup").unwrap().edition, 1);
    // It is of the same kind as before.
    assert!(known.objects.is_kind_of("cup", "kitchen-item"));
}

#[test]
fn mistakes_in_definitions_are_reported_with_their_place() {
    let models = Models::pr2_in_kitchen().unwrap();
    let grasps = GraspLibrary::from_sexp(GRASPS, "grasps.sexp").unwrap();
    let error = |text: &str| {
        let meshes = MeshLibrary::none();
        match ObjectDefinitions::read(text, "o.sexp", &meshes, &models.objects, &grasps) {
            Ok(_) => "no error".to_owned(),
            Err(error) => error.to_string(),
        }
    };
    assert_eq!(
        error("(object a :shapes ((mesh a.stl)))"),
        "o.sexp:1:26: expected a text between quotes, found a.stl"
    );
    assert_eq!(
        error("(object a :shapes ((mesh \"a.stl\" :scale 0)))"),
        "o.sexp:1:41: expected a number or three numbers, none of which is 0, found 0"
    );
    assert_eq!(
        error("(object a :shapes ((sphere :radius 1)) :kind a)"),
        "o.sexp:1:46: a is a kind of a already, or the same"
    );
    assert_eq!(
        error("(object a :shapes ((sphere :radius 1)))\n(object a :shapes ((sphere :radius 1)))"),
        "o.sexp:2:9: the object a is given twice; keep one"
    );
    assert_eq!(
        error("(object a :shapes ())"),
        "o.sexp:1:19: expected at least one shape, found ()"
    );
    assert!(error("(object a :shapes ((mesh \"a.stl\")))").starts_with("o.sexp:1:26: "));
}
