//! Compiles the library and the built-in plans ahead, so that sessions start from their code.

use std::error::Error;
use std::path::Path;
use std::{env, fs, thread};

use session::{Session, SessionError, SessionOptions};

/// Bytes of stack: the compiler recurses as deep as forms are nested.
const STACK_BYTES: usize = 64 << 20;

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed=src/front/build.rs");
    println!("cargo::rustc-check-cfg=cfg(fuzzing)");
    let thread = thread::Builder::new().stack_size(STACK_BYTES);
    let compiled = thread.spawn(compiled)?;
    let code = compiled.join().map_err(|_| "the compiler has failed")??;
    let folder = env::var_os("OUT_DIR").ok_or("there is no folder for what is made")?;
    fs::write(Path::new(&folder).join("precompiled"), code)?;
    Ok(())
}

/// What the library and the built-in plans are compiled to.
fn compiled() -> Result<Vec<u8>, SessionError> {
    Session::of_texts(&SessionOptions::default())?.precompile()
}
