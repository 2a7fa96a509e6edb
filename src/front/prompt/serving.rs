//! Serving the session of the prompt to an editor: the prompt waits meanwhile.

use std::io::{self, Write};
use std::sync::{Arc, Mutex, PoisonError};

use super::{Keeper, Repl, input_name};
use crate::swank::{Ended, Keep, Server, ServerError, ServerOptions, Stopper, secret};
use session::dialogue::{Serve, evaluate_on};

/// The server that Ctrl-C stops, while there is one.
#[derive(Clone, Default)]
pub(super) struct Serving(Arc<Mutex<Option<Stopper>>>);

impl Serving {
    fn set(&self, stopper: Option<Stopper>) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = stopper;
    }

    /// Stops the server; returns whether there is one.
    pub(super) fn stop(&self) -> bool {
        let stopper = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(stopper) = &*stopper {
            stopper.stop();
        }
        stopper.is_some()
    }
}

impl Keep for Keeper {
    fn begins(&mut self, text: &str) {
        self.begun(text, true);
    }

    fn ends(&mut self, session: &dyn Serve) {
        self.ended(session);
    }
}

impl Repl {
    /// Serves the session to an editor, if the last input has asked for that, until Ctrl-C; returns
    /// the exit status if that ends the session.
    pub(super) fn serve_if_asked(&mut self) -> io::Result<Option<u8>> {
        let port = self.evaluator.borrow_mut().take_port();
        let Some(port) = port else {
            return Ok(None);
        };
        if self.evaluator.borrow().level() > 0 {
            let told = "; Emacs can be served once nothing stands still.";
            writeln!(io::stdout(), "{told}")?;
            return Ok(None);
        }
        match self.serve(port) {
            Ok(Ended::Quit(status)) => return Ok(Some(status)),
            Ok(Ended::Stopped) => writeln!(io::stdout(), "; Emacs is no longer served.")?,
            Err(error) => writeln!(io::stdout(), "; Emacs is not served: {error}.")?,
        }
        let mut evaluator = self.evaluator.borrow_mut();
        evaluator.set_interactive(true);
        if evaluator.level() > 0 {
            // An empty input shows where the evaluation is suspended.
            let name = input_name(self.number);
            evaluate_on(&mut self.screen, &mut *evaluator, &name, "")?;
        }
        Ok(None)
    }

    fn serve(&mut self, port: u16) -> Result<Ended, ServerError> {
        let secret = secret(None)?;
        let server = Server::bind(ServerOptions {
            port,
            secret: Some(secret.word),
            ..ServerOptions::default()
        })?;
        // If standard output is closed, the next input ends the prompt.
        let _ = writeln!(
            io::stdout(),
            "; Emacs can connect to {}: M-x slime-connect. Ctrl-C returns to the prompt.",
            server.address()
        );
        let serving = self.serving.clone();
        let mut evaluator = self.evaluator.borrow_mut();
        let keeper: &mut dyn Keep = &mut self.keeper;
        let ended = server.serve(&mut *evaluator, Some(keeper), |stopper| {
            serving.set(Some(stopper));
        });
        self.serving.set(None);
        ended
    }
}
