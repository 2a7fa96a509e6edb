//! Reading and opening what may keep one waiting: pipes, devices and terminals. An interrupt is heard
//! meanwhile.

#[cfg(unix)]
use std::fs;
use std::fs::{File, OpenOptions};
use std::io::{self, BufReader, Read, Seek, SeekFrom};

use super::FileReader;
use crate::guard;

/// How much is read between two looks at what ends long work.
const CHUNK: usize = 1 << 16;

/// The bytes of a file, up to its end or a reason to stop, such as an interrupt or too much memory, which
/// leaves the calling function by unwinding.
pub(super) fn read(path: &str) -> io::Result<Vec<u8>> {
    #[cfg(unix)]
    if keeps_waiting(path) {
        return interruptible::read(path);
    }
    let mut file = File::open(path)?;
    let length = file.metadata()?.len();
    let mut bytes = Vec::new();
    make_room(&mut bytes, usize::try_from(length).unwrap_or(usize::MAX));
    let mut chunk = vec![0; CHUNK];
    loop {
        guard::look();
        match file.read(&mut chunk) {
            Ok(0) => return Ok(bytes),
            Ok(count) => take(&mut bytes, chunk.get(..count).unwrap_or_default()),
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
}

/// The bytes of a file as they are read, up to a reason to stop.
pub(super) fn reader(path: &str) -> io::Result<Box<dyn FileReader>> {
    #[cfg(unix)]
    if keeps_waiting(path) {
        return Ok(Box::new(io::Cursor::new(interruptible::read(path)?)));
    }
    Ok(Box::new(BufReader::with_capacity(
        CHUNK,
        Looking(File::open(path)?),
    )))
}

/// A file at each reading of which what ends long work is looked for.
struct Looking(File);

impl Read for Looking {
    fn read(&mut self, to: &mut [u8]) -> io::Result<usize> {
        guard::look();
        self.0.read(to)
    }
}

impl Seek for Looking {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.0.seek(to)
    }
}

/// Adds what has been read, which counts as memory before it is there.
fn take(bytes: &mut Vec<u8>, read: &[u8]) {
    if bytes.capacity() - bytes.len() < read.len() {
        let more = bytes.len().max(read.len());
        make_room(bytes, more);
    }
    bytes.extend_from_slice(read);
}

/// Makes room for so many bytes more; leaves the calling function by unwinding if there is none.
fn make_room(bytes: &mut Vec<u8>, more: usize) {
    guard::reserve(bytes.len().saturating_add(more));
    if bytes.try_reserve_exact(more).is_err() {
        guard::leave(guard::Stopped::HeapExhausted);
    }
}

/// Opens a file for writing. A pipe is open when somebody reads it.
pub(super) fn open(options: &OpenOptions, path: &str) -> io::Result<File> {
    #[cfg(unix)]
    if keeps_waiting(path) {
        return interruptible::open(options, path);
    }
    options.open(path)
}

#[cfg(unix)]
fn keeps_waiting(path: &str) -> bool {
    fs::metadata(path).is_ok_and(|found| !found.is_file() && !found.is_dir())
}

#[cfg(unix)]
mod interruptible {
    use std::fs::{File, OpenOptions};
    use std::io::{self, ErrorKind, Read};
    use std::os::unix::fs::{FileTypeExt, OpenOptionsExt};
    use std::time::Duration;

    use rustix::event::{PollFd, PollFlags, Timespec, poll};
    use rustix::fs::{OFlags, fcntl_getfl, fcntl_setfl};

    use super::{CHUNK, take};
    use crate::guard;

    /// How long an interrupt may have to wait.
    const BETWEEN_LOOKS: Duration = Duration::from_millis(20);
    pub(super) fn read(path: &str) -> io::Result<Vec<u8>> {
        let flags = (OFlags::NONBLOCK | OFlags::NOCTTY).bits();
        let flags = i32::try_from(flags).unwrap_or_default();
        let mut file = OpenOptions::new()
            .read(true)
            .custom_flags(flags)
            .open(path)?;
        let mut bytes = Vec::new();
        let mut chunk = vec![0; CHUNK];
        loop {
            guard::look();
            if !is_ready(&file)? {
                continue;
            }
            match file.read(&mut chunk) {
                Ok(0) => return Ok(bytes),
                Ok(count) => take(&mut bytes, chunk.get(..count).unwrap_or_default()),
                Err(error) if is_passing(&error) => {}
                Err(error) => return Err(error),
            }
        }
    }

    /// Waits a moment; is there anything to be read, or will there never be?
    fn is_ready(file: &File) -> io::Result<bool> {
        let time = Timespec::try_from(BETWEEN_LOOKS).ok();
        let mut waited = [PollFd::new(file, PollFlags::IN)];
        match poll(&mut waited, time.as_ref()) {
            Ok(count) => Ok(count > 0),
            Err(error) if is_passing(&error.into()) => Ok(false),
            Err(error) => Err(error.into()),
        }
    }

    pub(super) fn open(options: &OpenOptions, path: &str) -> io::Result<File> {
        let is_pipe = std::fs::metadata(path)?.file_type().is_fifo();
        if !is_pipe {
            return options.open(path);
        }
        let mut options = options.clone();
        let flags = i32::try_from(OFlags::NONBLOCK.bits()).unwrap_or_default();
        options.custom_flags(flags);
        loop {
            guard::look();
            match options.open(path) {
                // Nobody reads it.
                Err(error)
                    if error.raw_os_error() == Some(rustix::io::Errno::NXIO.raw_os_error()) =>
                {
                    std::thread::sleep(BETWEEN_LOOKS);
                }
                Err(error) => return Err(error),
                Ok(file) => {
                    let flags = fcntl_getfl(&file)?;
                    fcntl_setfl(&file, flags - OFlags::NONBLOCK)?;
                    return Ok(file);
                }
            }
        }
    }

    fn is_passing(error: &io::Error) -> bool {
        matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::Interrupted)
    }
}
