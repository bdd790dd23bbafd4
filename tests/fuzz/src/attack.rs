//! [`Attack`], one reader under mutated files.

use std::fs;
use std::panic;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

use fastrand::Rng;

use crate::MEMORY;
use crate::corpus::{seeds, words};
use crate::mutation::mutated;
use crate::reader::Reader;

/// Longest that one input may take.
const MOST_TIME: Duration = Duration::from_secs(10);

/// Most memory that one input may take, megabytes.
const MOST_MEMORY: f32 = 1024.0;

/// Where inputs are kept that a reader did not withstand.
const FAILURES: &str = "fuzz-failures";

/// One reader under mutated files.
pub struct Attack {
    reader: Reader,
    seed: u64,
}

impl Attack {
    /// The seed selects the mutations.
    pub fn new(reader: Reader, seed: u64) -> Self {
        Self { reader, seed }
    }

    /// Attacks for a time; says whether the reader withstood.
    pub fn run(&self, time: Duration) -> bool {
        let seeds = seeds(self.reader);
        let refused = seeds.iter().filter(|seed| !self.reader.read(seed)).count();
        if refused > 0 {
            println!(
                "{}: {refused} of {} seeds are not read",
                self.reader.name(),
                seeds.len()
            );
            return false;
        }
        let mut rng = Rng::with_seed(self.seed);
        let mut tally = Tally::default();
        let began = Instant::now();
        while began.elapsed() < time {
            let seed = &seeds[rng.usize(..seeds.len())];
            let input = mutated(seed, &seeds, words(self.reader), &mut rng);
            if let Err(what) = tally.take(self.reader, &input) {
                let path = self.keep(&input);
                println!("{}: {what}, kept as {}", self.reader.name(), path.display());
                return false;
            }
        }
        println!(
            "{}: {} inputs, {} of them read, slowest {} ms, most memory {:.0} MB",
            self.reader.name(),
            tally.inputs,
            tally.read,
            tally.slowest.as_millis(),
            tally.most_memory
        );
        true
    }

    fn keep(&self, input: &[u8]) -> PathBuf {
        let path = PathBuf::from(FAILURES).join(format!("{}-{}", self.reader.name(), self.seed));
        let kept = fs::create_dir_all(FAILURES).and_then(|()| fs::write(&path, input));
        kept.unwrap_or_else(|error| println!("cannot write {}: {error}", path.display()));
        path
    }
}

/// What happened so far.
#[derive(Default)]
struct Tally {
    inputs: u64,
    read: u64,
    slowest: Duration,
    most_memory: f32,
}

impl Tally {
    fn take(&mut self, reader: Reader, input: &[u8]) -> Result<(), String> {
        MEMORY.reset_peak_usage();
        let before = MEMORY.current_usage_as_mb();
        let began = Instant::now();
        let taken = within(MOST_TIME, reader, input)?;
        self.slowest = self.slowest.max(began.elapsed());
        let memory = MEMORY.peak_usage_as_mb() - before;
        self.most_memory = self.most_memory.max(memory);
        self.inputs += 1;
        self.read += u64::from(taken);
        if memory > MOST_MEMORY {
            return Err(format!("{memory:.0} MB of memory"));
        }
        Ok(())
    }
}

/// Reads on a thread of its own, whose panic and whose time are noticed. A thread that hangs is
/// left behind: the program ends soon.
fn within(time: Duration, reader: Reader, input: &[u8]) -> Result<bool, String> {
    let (send, receive) = channel();
    let input = input.to_vec();
    let thread = thread::Builder::new().spawn(move || {
        let taken = panic::catch_unwind(|| reader.read(&input));
        // The receiver waits, or has given up.
        let _ = send.send(taken);
    });
    thread.map_err(|error| format!("no thread: {error}"))?;
    wait(&receive, time)
}

fn wait(receive: &Receiver<thread::Result<bool>>, time: Duration) -> Result<bool, String> {
    match receive.recv_timeout(time) {
        Ok(Ok(taken)) => Ok(taken),
        Ok(Err(_)) => Err("a panic".to_owned()),
        Err(RecvTimeoutError::Timeout) => Err(format!("more than {} s", time.as_secs())),
        Err(RecvTimeoutError::Disconnected) => Err("a crash".to_owned()),
    }
}
