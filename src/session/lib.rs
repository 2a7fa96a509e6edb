//! One session: an image, a world, and what happens when text is evaluated in them.
//!
//! A session takes text and reports events; it prints nothing itself.

mod assist;
mod audience;
mod bounds;
mod check;
mod console;
mod converse;
mod copy;
mod deeds;
pub mod dialogue;
mod face;
mod facts;
pub mod functions;
pub mod grading;
mod host;
mod illustrate;
mod interruption;
pub mod lesson_file;
mod live_host;
mod log_level;
mod mesh_files;
mod objects;
mod options;
pub mod outside;
mod package_name;
mod person;
mod plans;
mod printing;
mod queries;
mod record;
mod serving;
pub mod simulation;
mod start;
mod sweep_file;
mod sweep_worlds;
pub mod sweeping;
mod tabulated;

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use crate::dialogue::{Evaluate, Event, Finding, Outcome};
use console::Evaluator;
use cram::Scheduler;
use host::SimulationHost;
use lisp::files::Closed;
use lisp::image::Image;
use lisp::library;
use lisp::source::Location;
use lisp::value::release::FreesAll;
use robotics::world::Models;
use simulation::Simulation;
use simulation::real::RobotAccess;
use view::picture::ViewError;
use view::picture::animation::Shot;
use view::watch::Follower;
use view::watch::live::Updates;

pub use audience::{Audience, Filming, WatchError};
pub use bounds::{InterruptHandle, Limit, Limits};
pub use check::suggested;
pub use face::{
    Datum, Failure, FramedPose, KeptOutput, ObserverId, PlanEvent, PlanEventKind, RestoreError,
    Snapshot, TaskBegin, TaskEnd, TaskLog, TaskNode, Unhandled, Within,
};
pub use kitchens::{ASSETS, Simulator};
pub use log_level::LogLevel;
pub use options::{SessionError, SessionOptions, is_built_in, is_generated, is_shipped_robot};

/// A session.
pub struct Session {
    /// What it began with.
    options: SessionOptions,
    evaluator: Evaluator,
    /// What the checked texts define.
    checked: check::KnownNames,
    /// Where the texts define what.
    told_names: assist::ToldNames,
    /// Where the last evaluation was when a limit or an interrupt ended it.
    ended_at: Option<Location>,
    /// The last to be dropped: what has been put off is freed.
    _rest: FreesAll,
}

impl Session {
    /// A fresh session: the robot at the origin, no objects, package `COMMON-LISP-USER`.
    pub fn new(options: &SessionOptions) -> Result<Session, SessionError> {
        Session::with_models(options, Arc::new(options.models()?))
    }

    /// A fresh session in a kitchen whose descriptions have been read.
    pub fn with_models(
        options: &SessionOptions,
        models: Arc<Models>,
    ) -> Result<Session, SessionError> {
        Session::of_image(options, models, Image::new())
    }

    /// A fresh session made of the texts of the library and the built-in plans, of which it keeps what
    /// they are compiled to.
    pub fn of_texts(options: &SessionOptions) -> Result<Session, SessionError> {
        let models = Arc::new(options.models()?);
        Session::of_image(options, models, Image::precompiling())
    }

    /// What the library and the built-in plans are compiled to, for [`lisp::image::precompiled::provide`], if
    /// the session is [made of texts](Session::of_texts).
    ///
    /// # Errors
    ///
    /// What cannot be compiled.
    pub fn precompile(mut self) -> Result<Vec<u8>, SessionError> {
        let image = &mut self.evaluator.image;
        library::precompile(image).map_err(|raise| SessionError::Plan {
            name: "library".to_owned(),
            report: printing::raised(image, raise).report,
        })
    }

    fn of_image(
        options: &SessionOptions,
        models: Arc<Models>,
        mut image: Image,
    ) -> Result<Session, SessionError> {
        image.seed(options.seed);
        image.files = Arc::clone(&options.outside.files);
        image.polls().set_breathe(options.outside.breathe);
        image.extend(options.outside.clone());
        cram::install(&mut image);
        cram::pose::install(&mut image);
        cram::designator::install(&mut image);
        functions::install(&mut image);
        functions::name_system_folders(&mut image, &options.systems);
        facts::install(&mut image, &models);
        functions::install_topics(&mut image, Arc::clone(&models));
        let mut simulation = Simulation::new(models, options.log_level, options.seed);
        simulation.set_noise(options.noise_levels()?);
        simulation
            .meshes
            .package_paths
            .clone_from(&options.package_paths);
        simulation.meshes.kept_in.clone_from(&options.mesh_cache);
        if let Some((name, text)) = &options.objects {
            let defined = simulation.define_objects(&mut image, text, name, name);
            defined.map_err(|error| SessionError::Models(error.to_string()))?;
        }
        let audience = Audience::new(options);
        let host = SimulationHost::new(simulation, audience);
        let mut session = Session {
            options: options.clone(),
            evaluator: Evaluator::new(image, Scheduler::new(), host),
            checked: check::KnownNames::default(),
            told_names: assist::ToldNames::default(),
            ended_at: None,
            _rest: FreesAll,
        };
        session.evaluator.image.limits.heap.set_limit(options.heap);
        session.evaluator.image.output.set_shown(true);
        plans::load(&mut session.evaluator)?;
        session.evaluator.image.lock_packages(plans::OPEN_PACKAGES);
        check::install(&mut session.evaluator.image);
        // Nobody takes the world back to before the built-in plans.
        session.evaluator.host.person.snapshots = person::Snapshots::default();
        Ok(session)
    }

    /// Closes the session: from now on nothing that is evaluated can use a file, open a port or edit the
    /// world. Plans can move the robot, calculate and print. A recording or a page of the run that has begun
    /// goes on.
    pub fn close(&mut self) {
        self.evaluator.image.files = Arc::new(Closed);
        self.evaluator.host.is_closed = true;
    }

    /// Ends the session together with the process, to which freeing its memory is left.
    pub fn end_with_process(self) {
        let Evaluator {
            image, mut host, ..
        } = self.evaluator;
        std::mem::forget(image);
        std::mem::forget(std::mem::take(&mut host.simulation.facts));
        drop(host);
    }

    /// The examples of everything in the tables, with their names, in order of installation.
    pub fn examples(&self) -> Vec<(String, &'static str)> {
        let image = &self.evaluator.image;
        let entries = image.entries.iter();
        entries
            .flat_map(|(sym, entry)| {
                let examples = entry.examples().into_iter();
                examples.map(|example| (image.name(*sym).to_owned(), example))
            })
            .collect()
    }

    /// Checks a text as [`Evaluate::check`] does, but forgets afterwards which names it mentions.
    pub fn check_once(&mut self, source_name: &str, text: &str) -> Vec<Finding> {
        let known = self.checked.clone();
        let found = self.check(source_name, text);
        self.checked = known;
        found
    }

    /// The tables of the language.
    pub fn image(&self) -> &Image {
        &self.evaluator.image
    }

    /// The Lisp image.
    pub fn image_mut(&mut self) -> &mut Image {
        &mut self.evaluator.image
    }

    /// From now on, inputs are interrupted when so much real time has passed, all together.
    pub fn set_time_limit(&mut self, limit: Option<Duration>) {
        let now = self.evaluator.host.audience.outside().clock.now();
        self.evaluator.deadline = limit.and_then(|limit| now.checked_add(limit));
    }

    /// Remembers in a file what is done of lessons, and tells what was done in earlier sessions. `mark` is part of the name of a
    /// file beside it that is written first: another one for each process.
    pub fn remember_lessons(&mut self, path: &Path, mark: &str) {
        let files = Arc::clone(&self.options.outside.files);
        let path = path.display().to_string();
        self.evaluator.host.person.progress = Some(person::Progress::new(path, mark, files));
    }

    /// Where the last evaluation of this session was when a limit or an interrupt ended it.
    pub fn ended_at(&self) -> Option<&Location> {
        self.ended_at.as_ref()
    }

    /// What it began with.
    pub fn options(&self) -> &SessionOptions {
        &self.options
    }

    /// The descriptions of robot, kitchen and objects.
    pub fn models(&self) -> &Arc<Models> {
        &self.evaluator.host.simulation.models
    }

    /// What a person should know of the robot and the kitchen that were given: what was taken leniently in
    /// their files, and whether the robot starts where it cannot be.
    pub fn remarks(&self) -> Vec<String> {
        let models = self.models();
        let of_files = models.remarks.iter().map(ToString::to_string);
        let mut remarks: Vec<String> = of_files.chain(self.options.world_remarks.clone()).collect();
        if self.options.robot.is_some() || self.options.world.is_some() {
            remarks.extend(start::remark(models, self.simulation().world()));
        }
        remarks
    }

    /// The robot in its world.
    pub fn simulation(&self) -> &Simulation {
        &self.evaluator.host.simulation
    }

    /// Who answers questions about what is being typed.
    fn assistant(&self) -> assist::Assistant<'_> {
        assist::Assistant::new(&self.evaluator.image, &self.evaluator.host.simulation)
    }

    /// The outputs that show the session.
    pub fn audience(&self) -> &Audience {
        &self.evaluator.host.audience
    }

    /// Sets a function to be called after every step of a motion.
    pub fn set_observer(&mut self, observer: audience::Observer) {
        self.evaluator.host.audience.set_observer(observer);
    }

    /// Starts to film.
    pub fn start_film(&mut self, wanted: Filming) -> Result<(), ViewError> {
        self.evaluator
            .host
            .audience
            .start_film(&self.evaluator.host.simulation, wanted)
    }

    /// Ends the film and returns its shots; the last one shows the present state.
    pub fn end_film(&mut self) -> Vec<Shot> {
        self.evaluator
            .host
            .audience
            .end_film(&self.evaluator.host.simulation)
    }

    /// Opens the live view, unless it is open; returns the page's address.
    pub fn open_view(&mut self) -> Result<String, WatchError> {
        let host = &mut self.evaluator.host;
        host.audience
            .open_view(&host.simulation, &self.evaluator.image)
    }

    /// Shows a follower what happens from now on, at the pace of real time unless another one has been set. The
    /// session keeps its kitchen meanwhile.
    pub fn show_to(&mut self, follower: Box<dyn Follower>) {
        let host = &mut self.evaluator.host;
        host.audience
            .show_to(&host.simulation, &self.evaluator.image, follower);
    }

    /// Lets plans drive a robot elsewhere, by `with-real-robot`. Simulated time passes as real time does from now on,
    /// unless another pace has been set.
    pub fn drive(&mut self, robot: Box<dyn outside::RobotLink>) {
        let host = &mut self.evaluator.host;
        let interface = host.simulation.models.description.interface.clone();
        host.simulation.robot = Some(RobotAccess::new(robot, interface));
        host.audience.keep_real_time();
    }

    /// What a page of the program's own shows of the session from now on, as the live view does. The
    /// page sets the pace, too; until then it is that of real time.
    pub fn updates(&mut self) -> Updates {
        let host = &mut self.evaluator.host;
        host.audience
            .updates(&host.simulation, &self.evaluator.image)
    }

    /// Starts to record the session into an MCAP file.
    pub fn begin_recording(&mut self, path: &Path) -> Result<(), WatchError> {
        let host = &mut self.evaluator.host;
        host.audience
            .begin_recording(&host.simulation, &self.evaluator.image, path)
    }

    /// Ends the recording, if there is one; fails if it could not be written.
    pub fn end_recording(&mut self) -> Result<(), WatchError> {
        self.evaluator
            .host
            .audience
            .end_recording(&self.evaluator.host.simulation)
    }

    /// Keeps what happens from now on, to be written into a file as a page.
    pub fn keep_run(&mut self, path: &Path) -> Result<(), WatchError> {
        let host = &mut self.evaluator.host;
        host.audience
            .keep_run(&host.simulation, &self.evaluator.image, path)
    }

    /// Writes the page of the run that was to be kept, if there is one.
    pub fn write_kept_run(&mut self) -> Result<(), WatchError> {
        self.evaluator
            .host
            .audience
            .write_kept_run(&self.evaluator.host.simulation)
    }
}

impl Evaluate for Session {
    fn evaluate(&mut self, source_name: &str, text: &str, sink: &mut dyn FnMut(Event)) -> Outcome {
        self.evaluator.evaluate(source_name, text, sink)
    }

    fn check(&mut self, source_name: &str, text: &str) -> Vec<Finding> {
        check::check_text(
            &mut self.evaluator.image,
            &mut self.checked,
            source_name,
            text,
        )
    }

    fn prompt(&self) -> String {
        self.evaluator.prompt()
    }

    fn interrupt_handle(&self) -> Arc<AtomicBool> {
        Arc::clone(self.evaluator.image.interrupt())
    }
}
