//! prof
use planwright::spatial::Pose;
use planwright::viewer::*;
use planwright::world::*;
use std::sync::Arc;
fn cpu() -> f64 {
    let t = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap();
    t.split(' ').next().unwrap().parse::<f64>().unwrap() / 1e6
}
fn main() {
    let models = Arc::new(Models::pr2_in_kitchen().unwrap());
    let robot = RobotConfiguration {
        base: planwright::spatial::pose::from_xyz_rpy([-1.447, -0.15, 0.0], [0.0, 0.0, -1.5708]),
        joints: models.description.start_positions(&models.robot),
    };
    let mut world = World::new(models.clone(), robot);
    let _ = world.spawn(
        "BOTTLE",
        "bottle",
        &Pose::translation(-1.6, -0.9, 0.83),
        None,
        None,
    );
    let t = cpu();
    let looks = Looks::of(&models);
    println!("looks {:.2} ms", cpu() - t);
    let t = cpu();
    let scene = looks.scene(&world);
    println!("scene {:.3} ms", cpu() - t);
    println!(
        "bodies {} triangles {}",
        scene.bodies.len(),
        scene
            .bodies
            .iter()
            .map(|b| b.surface.triangles.len())
            .sum::<usize>()
    );
    for view in View::NAMED {
        let camera = view.camera(&world, 640, 480).unwrap();
        let mut best = f64::MAX;
        for _ in 0..20 {
            let t = cpu();
            let i = render(&scene, &camera);
            best = best.min(cpu() - t);
            std::hint::black_box(i);
        }
        println!("{view} {best:.1} ms");
    }
}
