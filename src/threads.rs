//! The threads that share the work: one for each core, or as many as `RAYON_NUM_THREADS` says, within reason. Where the
//! system starts fewer, those do the work; if it starts none, this thread does it alone. What comes out is the same.

use std::io;
use std::sync::mpsc::{Sender, channel};
use std::thread;

use rayon::{ThreadBuilder, ThreadPoolBuilder};

/// The variable that says how many threads a user wants, as rayon knows it.
const WANTED: &str = "RAYON_NUM_THREADS";

/// More threads for each core only take memory.
const MOST_PER_CORE: usize = 8;

/// So many threads can always be asked for.
const ALWAYS_ALLOWED: usize = 16;

/// Whether the system starts a thread now.
pub(super) fn can_start() -> bool {
    thread::Builder::new().spawn(|| {}).is_ok()
}

/// Starts the threads, for the whole process.
pub(super) fn start() {
    let cores = thread::available_parallelism().map_or(1, usize::from);
    let wanted = wanted().unwrap_or(cores);
    let most = ALWAYS_ALLOWED.max(cores.saturating_mul(MOST_PER_CORE));
    if wanted > most {
        tracing::warn!(
            "{WANTED} asks for {wanted} threads; {most} do the work of this machine's {cores} cores"
        );
    }
    let threads = wanted.min(most);
    // They are started before the pool is made: it can be made once only, and is not if one of its threads is missing.
    let started: Vec<Sender<ThreadBuilder>> = (0..threads).map_while(|_| wait_for_work().ok()).collect();
    let pool = match started.len() {
        0 => ThreadPoolBuilder::new().num_threads(1).use_current_thread().build_global(),
        several => ThreadPoolBuilder::new()
            .num_threads(several)
            .spawn_handler(|thread| {
                started[thread.index()].send(thread).map_err(|_| io::ErrorKind::BrokenPipe.into())
            })
            .build_global(),
    };
    if let Err(error) = pool {
        tracing::warn!("the threads are those that rayon starts: {error}");
    }
    if started.len() < threads {
        let fewer = started.len().max(1);
        tracing::warn!("the system starts no more threads: {fewer} instead of {threads} do the work");
    }
}

/// A thread that waits for its part in the pool.
fn wait_for_work() -> io::Result<Sender<ThreadBuilder>> {
    let (give, take) = channel::<ThreadBuilder>();
    let work = move || {
        if let Ok(thread) = take.recv() {
            thread.run();
        }
    };
    thread::Builder::new().spawn(work).map(|_| give)
}

/// How many threads the user wants; 0, as no number, leaves it to the program.
fn wanted() -> Option<usize> {
    std::env::var(WANTED).ok()?.parse().ok().filter(|&threads| threads > 0)
}
