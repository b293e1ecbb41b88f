//! Work that Python waits for: it goes on without Python's lock, and Ctrl-C ends it.

use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use pyo3::prelude::*;

/// How often Python is asked whether someone wants to stop.
const ASKED_EVERY: Duration = Duration::from_millis(50);

/// Does `work` on a thread of its own. It is told by `is_stopped` to stop, and then may return what it likes. `look` is
/// called now and then, and may end the work for good.
pub(crate) fn wait<T: Send>(
    py: Python<'_>,
    is_stopped: &AtomicBool,
    work: impl FnOnce() -> T + Send,
    mut look: impl FnMut(Python<'_>) -> PyResult<()>,
) -> PyResult<T> {
    thread::scope(|scope| {
        let (tell, told) = channel();
        scope.spawn(move || tell.send(work()));
        let told = Mutex::new(told);
        let mut ended = Ok(());
        loop {
            match heard(py, &told) {
                Ok(done) => return ended.map(|()| done),
                // A panic of the work comes out where the scope ends.
                Err(RecvTimeoutError::Disconnected) => break,
                Err(RecvTimeoutError::Timeout) => {}
            }
            if ended.is_ok() {
                ended = py.check_signals();
            }
            let looked = look(py);
            if ended.is_ok() {
                ended = looked;
            }
            if ended.is_err() {
                is_stopped.store(true, Ordering::Relaxed);
            }
        }
        ended.and_then(|()| {
            Err(pyo3::exceptions::PyRuntimeError::new_err("a bug of tautline: the work broke down"))
        })
    })
}

/// As [`wait_for`], of work that may be long in hearing that it is to stop: Ctrl-C leaves it to end on its thread.
pub(crate) fn wait_or_leave<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce(&AtomicBool) -> T + Send + 'static,
) -> PyResult<T> {
    let (tell, told) = channel::<()>();
    let told = Mutex::new(told);
    let is_stopped = Arc::new(AtomicBool::new(false));
    let asked = Arc::clone(&is_stopped);
    let worker = thread::spawn(move || {
        // Dropped when the work ends, whether it returns or panics.
        let _tell = tell;
        work(&asked)
    });
    while heard(py, &told) == Err(RecvTimeoutError::Timeout) {
        py.check_signals().inspect_err(|_| is_stopped.store(true, Ordering::Relaxed))?;
    }
    Ok(worker.join().unwrap_or_else(|panic| resume_unwind(panic)))
}

/// The message of another thread, if it comes before Python is asked again.
fn heard<T: Send>(py: Python<'_>, told: &Mutex<Receiver<T>>) -> Result<T, RecvTimeoutError> {
    py.detach(|| told.lock().unwrap_or_else(PoisonError::into_inner).recv_timeout(ASKED_EVERY))
}

/// As [`wait`], where nothing else is to be looked at.
pub(crate) fn wait_for<T: Send>(py: Python<'_>, work: impl FnOnce(&AtomicBool) -> T + Send) -> PyResult<T> {
    let is_stopped = AtomicBool::new(false);
    wait(py, &is_stopped, || work(&is_stopped), |_| Ok(()))
}
