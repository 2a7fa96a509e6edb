//! The errors of the robot's sensors and motors.

use crate::simulation::Simulation;
use crate::simulation::names::name_text;
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::known;
use lisp::value::number;
use lisp::value::raise::Raise;
use robotics::world::noise::NoiseLevels;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `PLANWRIGHT`.
pub(super) static TABLE: &[Builtin] = builtins![set_noise];

/// Sets the errors of the robot's sensors and motors, and returns the former settings. Settings are names and
/// numbers: :POSITION (m) and :YAW (rad) are standard deviations of what is detected up to 1 m away, :MISSES
/// and :FALSE-TYPES the probabilities that an object is overlooked or taken for another, :ODOMETRY-POSITION
/// (m) and :ODOMETRY-YAW (rad) standard deviations of where the robot is from where it takes itself to be
/// after a drive, :GRASP-POSITION (m) and :GRASP-YAW (rad) of where a hand arrives that approaches an object
/// or puts one down, :CALIBRATION-POSITION (m) and :CALIBRATION-YAW (rad) of how far each arm's calibration
/// is off. Plans see what the robot believes, so things end beside their targets. What is not named is zero;
/// without settings there are no errors. :USUAL stands for the errors of a PR2 in a laboratory. The same seed
/// gives the same errors.
///
/// `(progn (pw:set-noise :position 0.125 :misses 0.25) (pw:set-noise))` => `(:POSITION 0.125d0 :MISSES 0.25d0)`
/// `(pw:set-noise)` => `NIL`
#[builtin(edit)]
fn set_noise(simulation: &mut Simulation, image: &mut Image, settings: &[Value]) -> Result<Value> {
    let former = simulation
        .noise_levels()
        .map_or_else(Vec::new, NoiseLevels::settings);
    let former = former.into_iter().flat_map(|(name, value)| {
        [
            image.keyword(&name.to_uppercase()).into(),
            Value::Double(value),
        ]
    });
    let former = Value::list(former.collect::<Vec<_>>());
    simulation.set_noise(levels(image, settings)?);
    Ok(former)
}

/// The levels that settings give.
fn levels(image: &Image, settings: &[Value]) -> Result<Option<NoiseLevels>> {
    let name = |value: &Value| name_text(image, value).unwrap_or_default();
    match settings {
        [] => return Ok(None),
        [usual] if name(usual) == "USUAL" => return Ok(Some(NoiseLevels::usual())),
        _ => {}
    }
    let mut levels = NoiseLevels::default();
    for setting in settings.chunks(2) {
        let [key, value] = setting else {
            return Err(Raise::program("A setting of noise is a name and a number."));
        };
        let Some(value) = number::to_f64(value) else {
            return Err(Raise::type_error(value, known::REAL));
        };
        levels
            .set(&name(key), value)
            .map_err(|error| Raise::simple(error.to_string()))?;
    }
    Ok(Some(levels))
}
