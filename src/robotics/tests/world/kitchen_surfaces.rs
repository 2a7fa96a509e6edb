//! How high the kitchen is, against heights measured on the meshes of the IAI kitchen (iai_maps,
//! iai_kitchen, of June 2019, the collision shapes of kitchen_01 of the time of CRAM's tutorial).

use parry3d_f64::math::Vector;
use parry3d_f64::query::Ray;

use crate::tests::world::fixture::models;
use crate::world::Models;
use crate::world::solid::to_parry;
use spatial::Pose;

/// The highest z (m) of the furniture above that place of the map (m).
fn height(models: &Models, [x, y]: [f64; 2]) -> f64 {
    let tree = &models.kitchen;
    let mut poses = Vec::new();
    tree.forward_kinematics(&Pose::identity(), &tree.zero_positions(), &mut poses);
    let from = 5.0;
    let ray = Ray::new(Vector::new(x, y, from), -Vector::Z);
    let hits = models.kitchen_geometry.solid_links.iter().flat_map(|link| {
        let pose = to_parry(&poses[link.link.index()]);
        let solids = link.solids.iter();
        solids.filter_map(move |s| s.shape.cast_ray(&(pose * s.pose), &ray, from, true))
    });
    from - hits.fold(from, f64::min)
}

#[test]
fn the_sink_has_the_shape_of_the_sink() {
    /// Places across the basin (y, m), from its right end to the drainer.
    const Y: [f64; 11] = [
        -0.59, -0.5715, -0.566, -0.557, -0.55, -0.45, -0.35, -0.29, -0.28, -0.264, 0.0,
    ];
    /// Places from the front to the back (x, m), and the heights (m) at each of the above.
    const HEIGHTS: [(f64, [f64; 11]); 16] = [
        (
            1.29,
            [
                0.856, 0.856, 0.856, 0.856, 0.856, 0.856, 0.856, 0.856, 0.856, 0.854, 0.856,
            ],
        ),
        (
            1.31,
            [
                0.856, 0.856, 0.856, 0.856, 0.856, 0.856, 0.856, 0.856, 0.856, 0.856, 0.856,
            ],
        ),
        (
            1.3185,
            [
                0.856, 0.856, 0.846, 0.846, 0.846, 0.846, 0.846, 0.846, 0.85, 0.85, 0.856,
            ],
        ),
        (
            1.323,
            [
                0.856, 0.856, 0.834, 0.825, 0.825, 0.825, 0.825, 0.825, 0.85, 0.85, 0.856,
            ],
        ),
        (
            1.3275,
            [
                0.856, 0.856, 0.834, 0.779, 0.779, 0.779, 0.779, 0.779, 0.85, 0.85, 0.856,
            ],
        ),
        (
            1.331,
            [
                0.856, 0.856, 0.834, 0.742, 0.742, 0.742, 0.742, 0.742, 0.85, 0.85, 0.856,
            ],
        ),
        (
            1.334,
            [
                0.856, 0.856, 0.834, 0.711, 0.711, 0.711, 0.711, 0.711, 0.85, 0.85, 0.856,
            ],
        ),
        (
            1.34,
            [
                0.856, 0.856, 0.834, 0.671, 0.671, 0.671, 0.671, 0.671, 0.85, 0.85, 0.856,
            ],
        ),
        (
            1.53,
            [
                0.856, 0.856, 0.834, 0.671, 0.671, 0.671, 0.671, 0.671, 0.85, 0.85, 0.856,
            ],
        ),
        (
            1.722,
            [
                0.856, 0.848, 0.827, 0.671, 0.671, 0.671, 0.671, 0.671, 0.85, 0.85, 0.856,
            ],
        ),
        (
            1.7265,
            [
                0.856, 0.848, 0.826, 0.705, 0.705, 0.705, 0.705, 0.705, 0.85, 0.85, 0.856,
            ],
        ),
        (
            1.7305,
            [
                0.856, 0.848, 0.826, 0.745, 0.745, 0.745, 0.745, 0.745, 0.85, 0.85, 0.856,
            ],
        ),
        (
            1.7355,
            [
                0.854, 0.848, 0.826, 0.79, 0.79, 0.79, 0.833, 0.836, 0.85, 0.85, 0.856,
            ],
        ),
        (
            1.7405,
            [
                0.856, 0.854, 0.841, 0.841, 0.842, 0.848, 0.848, 0.848, 0.85, 0.85, 0.856,
            ],
        ),
        (
            1.747,
            [
                0.856, 0.856, 0.856, 0.856, 0.856, 0.856, 0.856, 0.856, 0.856, 0.856, 0.856,
            ],
        ),
        (
            1.77,
            [
                0.856, 0.856, 0.856, 0.856, 0.856, 0.856, 0.856, 0.856, 0.856, 0.856, 0.856,
            ],
        ),
    ];
    let models = models();
    for (x, heights) in HEIGHTS {
        for (y, expected) in Y.into_iter().zip(heights) {
            let found = height(&models, [x, y]);
            assert!(
                (found - expected).abs() <= 0.01,
                "({x}, {y}): {found} instead of {expected}"
            );
        }
    }
}

#[test]
fn nothing_falls_between_the_units_and_the_wall() {
    let models = models();
    for i in 0..=40 {
        let x = 1.79 + 0.0005 * f64::from(i);
        for (y, top) in [(-1.04, 1.512), (-0.4, 0.852), (0.8, 0.852), (1.9, 1.512)] {
            let found = height(&models, [x, y]);
            assert!(found >= top - 1e-9, "({x}, {y}): {found}");
        }
    }
}
