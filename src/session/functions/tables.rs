//! Installing the builtins that act on the world.

use crate::functions;
use crate::simulation::motion_types;
use lisp::builtin::{Builtin, Operator};
use lisp::image::Image;

/// Builtins by package.
static FUNCTIONS: &[(&str, &[Builtin])] = &[
    ("CRAM-PICK-PLACE-TUTORIAL", functions::tutorial::TABLE),
    ("CRAM-PICK-PLACE-TUTORIAL", functions::reaching::TABLE),
    ("CRAM-MOBILE-PICK-PLACE-PLANS", functions::plans::TABLE),
    ("CRAM-MOBILE-PICK-PLACE-PLANS", functions::carrying::TABLE),
    ("CRAM-MOBILE-PICK-PLACE-PLANS", functions::choosing::TABLE),
    ("CRAM-MOBILE-PICK-PLACE-PLANS", functions::scene::TABLE),
    (
        "CRAM-MOBILE-PICK-PLACE-PLANS",
        functions::containers::PLANS_TABLE,
    ),
    ("CRAM-MOBILE-PICK-PLACE-PLANS", functions::sight::TABLE),
    ("CRAM-PR2-PROCESS-MODULES", functions::real_robot::TABLE),
    ("CRAM-ROBOT-INTERFACES", functions::robot_state::TABLE),
    ("CRAM-BULLET-REASONING-UTILITIES", functions::objects::TABLE),
    ("CRAM-OBJECT-INTERFACES", functions::grasps::TABLE),
    ("ROSLISP", functions::ros::LOG_TABLE),
    ("ROSLISP-UTILITIES", functions::ros::UTILITIES_TABLE),
    ("SYSTEM", functions::ros::SYSTEM_TABLE),
    ("CRAM-LOCATION-COSTMAP", functions::locations::TABLE),
    ("PLANWRIGHT", functions::locations::FURNITURE_TABLE),
    ("PLANWRIGHT", functions::containers::TABLE),
    ("PLANWRIGHT", functions::contents::TABLE),
    ("PLANWRIGHT", functions::grains::TABLE),
    ("CRAM-BULLET-REASONING", functions::contents::SHAPE_TABLE),
    ("CRAM-BULLET-REASONING", functions::grains::SHAPE_TABLE),
    (
        "CRAM-BULLET-REASONING",
        functions::locations::VISUALIZATION_TABLE,
    ),
    ("CRAM-BULLET-REASONING", functions::asking::TABLE),
    ("CRAM-BULLET-REASONING", functions::boxes::TABLE),
    ("CRAM-BULLET-REASONING", functions::trials::TABLE),
    ("CRAM-BULLET-REASONING", functions::timeline::TABLE),
    ("CRAM-BULLET-REASONING", functions::straight_ways::TABLE),
    ("CRAM-BULLET-REASONING", functions::two_hands::TABLE),
    ("CRAM-BULLET-REASONING", functions::touches::TABLE),
    ("CRAM-BULLET-REASONING", functions::cutting::TABLE),
    ("PLANWRIGHT", functions::object_types::TABLE),
    ("PLANWRIGHT", functions::kitchens::TABLE),
    ("PLANWRIGHT", functions::kitchen_pictures::TABLE),
    ("PLAN-SYSTEM", functions::kitchens::DRAWN),
    ("PLANWRIGHT", functions::robots::TABLE),
    ("PLANWRIGHT", functions::explaining::TABLE),
    ("PLANWRIGHT", functions::noise::TABLE),
    ("PLANWRIGHT", functions::snapshots::TABLE),
    ("PLANWRIGHT", functions::pictures::TABLE),
    ("PLANWRIGHT", functions::prompt::TABLE),
    ("PLANWRIGHT", functions::leaving::TABLE),
    ("PLANWRIGHT", functions::watching::TABLE),
    ("PLAN-SYSTEM", functions::sweeps::TABLE),
    ("PLAN-SYSTEM", functions::sweep_things::TABLE),
    ("PLAN-SYSTEM", functions::lessons::TABLE),
    ("PLAN-SYSTEM", functions::run_facts::TABLE),
    ("PLANWRIGHT", crate::record::TABLE),
    ("SWANK", crate::objects::TABLE),
    ("SWANK", functions::serving::TABLE),
    ("SYSTEM", functions::prompt::SYSTEM_TABLE),
];

/// Operators by package.
static OPERATORS: &[(&str, &[Operator])] = &[
    ("CRAM-PR2-PROJECTION", functions::robot_macros::OPERATORS),
    ("PLANWRIGHT", functions::prompt::OPERATORS),
];

/// Functions of one package that another package exports under the same name.
static ALIASES: &[(&str, &str, &[&str])] = &[
    (
        "CRAM-OBJECT-INTERFACES",
        "CRAM-MANIPULATION-INTERFACES",
        &["DEF-OBJECT-TYPE-TO-GRIPPER-TRANSFORMS"],
    ),
    (
        "CRAM-PR2-PROJECTION",
        "CRAM-URDF-PROJECTION",
        &["WITH-SIMULATED-ROBOT", "WITH-PROJECTED-ROBOT"],
    ),
    (
        "CRAM-PR2-PROJECTION",
        "CRAM-PICK-PLACE-TUTORIAL",
        &["WITH-SIMULATED-ROBOT", "WITH-PROJECTED-ROBOT"],
    ),
];

/// Installs the builtins that act on the world. The packages must exist.
pub(crate) fn install(image: &mut Image) {
    for (package, table) in FUNCTIONS {
        if let Some(package) = image.packages.find(package) {
            image.install(package, table);
        }
    }
    for (package, table) in OPERATORS {
        if let Some(package) = image.packages.find(package) {
            image.install_operators(package, table);
        }
    }
    motion_types::install(image);
    for (from, to, names) in ALIASES {
        let (Some(from), Some(to)) = (image.packages.find(from), image.packages.find(to)) else {
            continue;
        };
        for name in *names {
            alias(image, from, to, name);
        }
    }
}

/// Makes a symbol of one package accessible in another. If the other package already has a
/// symbol with that name, that symbol gets the same meaning.
fn alias(
    image: &mut Image,
    from: lisp::value::package::PackageId,
    to: lisp::value::package::PackageId,
    name: &str,
) {
    let original = image.export_symbol(from, name);
    let other = match image.packages.find_symbol(to, name) {
        None => {
            image.packages.export(&mut image.symbols, to, original);
            return;
        }
        Some((other, _)) => other,
    };
    if other == original {
        image.packages.export(&mut image.symbols, to, original);
        return;
    }
    let function = image.symbol(original).function.clone();
    image.symbols.get_mut(other).function = function;
    if let Some(entry) = image.entries.get(&original).copied() {
        image.entries.insert(other, entry);
    }
    image.packages.export(&mut image.symbols, to, other);
}
