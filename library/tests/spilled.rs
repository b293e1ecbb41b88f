//! Searches that need more memory than they may have, and go on in a folder.

use std::fs;
use std::io::{self, Write};
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use tautline_kernel::choice::Oracle;
use tautline_library::{alpha, dijkstra, ricart};
use tautline_proofs::engine::states::{
    Create, Findings, Limits, MemoryLimit, Spill, SpillFault, System, WHOLE, search,
};
use tautline_proofs::engine::world::{Turn, World};
use tautline_proofs::protocol::{Keeps, Move, Protocol};
use tautline_proofs::{bound, demands};
use tempfile::TempDir;

fn folder() -> TempDir {
    tempfile::tempdir().expect("a folder")
}

/// The names of the files in a folder.
fn files(folder: &TempDir) -> Vec<String> {
    let name =
        |entry: io::Result<fs::DirEntry>| entry.expect("a file").file_name().into_string().expect("Unicode");
    fs::read_dir(folder.path()).expect("a folder").map(name).collect()
}

/// So many bytes for one search, and this folder.
fn memory(bytes: u64, folder: &TempDir) -> MemoryLimit {
    MemoryLimit::of(bytes + bytes / 3 + 2, 1).spilling(Spill::new(folder.path().to_owned()))
}

/// The findings that do not depend on where states are kept.
fn found<D>(findings: Findings<D>) -> Findings<D> {
    Findings { bytes: 0, ..findings }
}

/// Compares a search in memory with some in so many hundredths of it, by one worker and by three.
fn is_the_same<P: Protocol>(rule: &P, bound: impl Fn() -> P::Bound, demand: usize, percent: u64) -> bool {
    let keeps = || Keeps::<P>(bound(), demand);
    let whole = keeps().search(rule, Limits::NONE).expect("a search");
    for workers in [1, 3] {
        let (folder, bytes) = (folder(), whole.bytes * percent / 100);
        let memory = memory(bytes, &folder);
        let limits = Limits { memory: memory.memory(), workers: NonZeroUsize::new(workers), ..Limits::NONE };
        let some = keeps().search(rule, limits).expect("a search");
        assert!(some.bytes > bytes / 2 && some.bytes <= bytes, "{} of {bytes}", some.bytes);
        assert_eq!((files(&folder), memory.was_too_small(), memory.fault()), (vec![], false, None));
        assert_eq!(found(some), found(whole.clone()), "{workers} workers");
    }
    whole.broken.is_empty()
}

#[test]
fn a_search_on_disk_has_the_counts_and_the_first_run_of_one_in_memory() {
    use dijkstra::{Machines, Rule};

    assert!(is_the_same(&Rule::Published, || Machines::of(6, 6), 0, 55));
    assert!(!is_the_same(&Rule::CountsOn, || Machines::of(6, 6), 0, 55));
    assert!(is_the_same(&ricart::RULE, || ricart::Net::of(3, 1), 0, 30));
    let hasty = ricart::Conditions { defers: false, ..ricart::RULE };
    assert!(!is_the_same(&hasty, || ricart::Net::of(3, 1), 0, 30));
}

/// The graph stays in memory where endless runs are looked for.
#[test]
fn an_endless_run_is_found_on_disk_as_in_memory() {
    use dijkstra::{Machines, Rule};

    assert!(is_the_same(&Rule::Published, || Machines::of(6, 6), 1, 95));
    assert!(!is_the_same(&Rule::Published, || Machines::of(7, 4), 1, 95));
    let three = || alpha::Swarm { robots: 3, ..alpha::SWARM };
    assert!(!is_the_same(&alpha::RULE, three, 0, 80));
}

bound! {
    /// Words of so many signs.
    Words { signs: u8 } "words of {signs} signs"
}

/// A word gets another sign at its end, or loses its first one; some word is forbidden.
#[derive(Clone)]
struct Writes {
    forbidden: &'static [u8],
    most: usize,
}

/// How often somebody asked for moves.
static ASKED: AtomicU64 = AtomicU64::new(0);

impl Protocol for Writes {
    type Bound = Words;
    type State = Vec<u8>;
    demands! { always "the word is not there", |rule, _, _, word| *word != rule.forbidden; }

    fn starts(&self, _: &Words) -> impl IntoIterator<Item = Vec<u8>> {
        [vec![]]
    }

    fn moves(&self, words: &Words, word: &Vec<u8>) -> Vec<Move<Vec<u8>>> {
        ASKED.fetch_add(1, Ordering::Relaxed);
        let longer = |sign| Move::of(0, "writes", [&word[..], &[sign]].concat());
        let signs = if word.len() < self.most { words.signs } else { 0 };
        let shorter = word.get(1..).map(|rest| Move::of(0, "forgets", rest.to_vec()));
        (0..signs).map(longer).chain(shorter).collect()
    }
}

/// No word is forbidden.
const WRITES: Writes = Writes { forbidden: &[9], most: 9 };

fn written(rule: &Writes, limits: Limits<'_>, workers: usize) -> Findings<&'static str> {
    let limits = Limits { workers: NonZeroUsize::new(workers), ..limits };
    Keeps::<Writes>(Words::of(3), 0).search(rule, limits).expect("a search")
}

/// A search of words in this memory, to the end of its states; it can be taken up.
fn words(memory: &MemoryLimit) -> Limits<'_> {
    Limits { memory: memory.asked("words"), ..Limits::NONE }
}

/// Words are of many lengths.
#[test]
fn a_search_that_is_killed_again_and_again_is_taken_up_and_comes_out_the_same() {
    let last = Writes { forbidden: &[2, 2, 1, 0, 2, 2, 0, 1, 2], ..WRITES };
    for rule in [WRITES, last] {
        let (whole, folder) = (written(&rule, Limits::NONE, 1), folder());
        assert_eq!((whole.states > 28_000, whole.broken.is_empty()), (true, rule.forbidden.len() == 1));
        let by = |most_steps, workers| {
            let memory = memory(whole.bytes / 3, &folder);
            (written(&rule, Limits { most_steps, ..words(&memory) }, workers), memory.fault())
        };
        for most_steps in [3, 5, 8].map(|tenths| whole.steps * tenths / 10) {
            let (some, fault) = by(most_steps, 2);
            assert_eq!((some.is_whole, some.steps, fault), (false, most_steps, None));
            assert!(files(&folder).iter().all(|name| name.ends_with(WHOLE)), "{:?}", files(&folder));
        }
        assert!(files(&folder).len() > 2);
        let before = ASKED.load(Ordering::Relaxed);
        let (some, fault) = by(u64::MAX, 1);
        assert_eq!((found(some), fault), (found(whole.clone()), None));
        assert!(ASKED.load(Ordering::Relaxed) - before < whole.looked_at, "it was begun anew");
        assert_eq!(files(&folder), Vec::<String>::new());
    }
}

/// A search that is killed once it has written some files.
fn killed() -> (TempDir, u64) {
    let (bytes, folder) = (written(&WRITES, Limits::NONE, 1).bytes / 3, folder());
    let memory = memory(bytes, &folder);
    written(&WRITES, Limits { most_steps: 50_000, ..words(&memory) }, 1);
    (folder, bytes)
}

#[test]
fn a_search_is_not_taken_up_from_what_is_damaged_or_of_another_rule() {
    let refused = |rule: &Writes, harm: fn(&mut Vec<u8>)| {
        let (folder, bytes) = killed();
        for name in files(&folder).iter().filter(|name| name.ends_with("-1.states")) {
            let path = folder.path().join(name);
            let mut content = fs::read(&path).expect("a file");
            harm(&mut content);
            fs::write(&path, content).expect("it is written");
        }
        let (memory, before) = (memory(bytes, &folder), files(&folder).len());
        let some = written(rule, words(&memory), 1);
        assert_eq!((some.is_whole, some.broken, files(&folder).len()), (false, vec![], before));
        memory.fault().map(|error| error.fault)
    };
    assert_eq!(refused(&WRITES, |content| content[1 << 15] ^= 1), Some(SpillFault::Damaged));
    assert_eq!(refused(&WRITES, |content| content.truncate(content.len() / 2)), Some(SpillFault::Damaged));
    assert_eq!(refused(&WRITES, |content| content[17] ^= 1), Some(SpillFault::Damaged));
    assert_eq!(refused(&Writes { most: 4, ..WRITES }, |_| {}), Some(SpillFault::Foreign));
}

/// Before, a search that took up the states of one file twice never ended.
#[test]
fn a_file_in_the_place_of_another_one_is_damaged() {
    let (folder, bytes) = killed();
    let file = |end: &str| {
        let name = files(&folder).into_iter().find(|name| name.ends_with(end)).expect("a file");
        folder.path().join(name)
    };
    fs::copy(file("-1.states"), file("-2.states")).expect("it is copied");
    let memory = memory(bytes, &folder);
    let some = written(&WRITES, words(&memory), 1);
    assert_eq!((some.is_whole, some.broken), (false, vec![]));
    assert_eq!(memory.fault().map(|error| error.fault), Some(SpillFault::Damaged));
}

#[test]
fn a_search_for_another_question_begins_anew_and_leaves_the_files_of_the_first() {
    let (folder, bytes) = killed();
    let before = files(&folder);
    let memory = memory(bytes, &folder);
    for asked in [memory.asked("other words"), memory.memory()] {
        let some = written(&WRITES, Limits { memory: asked, ..Limits::NONE }, 1);
        assert!(some.is_whole && some.broken.is_empty());
        assert_eq!(files(&folder), before);
    }
}

/// A disk that is full after so many bytes.
struct Full(fs::File, usize);

impl Write for Full {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.1 = self.1.checked_sub(bytes.len()).ok_or(io::ErrorKind::StorageFull)?;
        self.0.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

#[test]
fn a_full_disk_leaves_a_search_open_and_nothing_half_written_behind() {
    let in_memory = written(&WRITES, Limits::NONE, 1);
    let bytes = in_memory.bytes / 3;
    let right = found(in_memory);
    let nothing: Create = |_| Err(io::ErrorKind::PermissionDenied.into());
    let little: Create = |path| Ok(Box::new(Full(fs::File::create(path)?, 1 << 17)));
    let second: Create = |path| {
        let is_first = path.to_string_lossy().contains("-0.");
        Ok(Box::new(Full(fs::File::create(path)?, if is_first { usize::MAX } else { 1 << 12 })))
    };
    for (create, left) in [(nothing, 0), (little, 0), (second, 1)] {
        let folder = folder();
        let spill = Spill::with(folder.path().to_owned(), create);
        let memory = MemoryLimit::of(bytes * 4 / 3, 1).spilling(spill);
        let some = written(&WRITES, words(&memory), 1);
        assert_eq!((some.is_whole, some.broken), (false, vec![]));
        let error = memory.fault().expect("it fails");
        assert!(matches!(error.fault, SpillFault::Unwritable(_)), "{error}");
        assert!(error.to_string().contains("make room there"), "{error}");
        assert_eq!(files(&folder).len(), left, "{:?}", files(&folder));
        // There is room again.
        let whole = written(&WRITES, words(&self::memory(bytes, &folder)), 1);
        assert_eq!((found(whole), files(&folder).len()), (right.clone(), 0));
    }
}

/// A pair of counters, each a part: more values than a byte numbers.
struct Counters;

const MOST: [u16; 2] = [300, 90];

impl World for Counters {
    type State = [u16; 2];
    type Plan = ();
    type Event = ();
    type Demand = &'static str;

    fn plan(&self, _: &mut [u16; 2], _: &[u8]) -> Option<()> {
        Some(())
    }

    fn settle(&self, state: &mut [u16; 2], (): &(), _: &mut Vec<u8>, world: &mut impl Oracle) {
        let place = usize::from(world.flip());
        state[place] = (state[place] + 1) % MOST[place];
    }

    fn broken_by(&self, turn: &Turn<'_, Self>) -> Vec<&'static str> {
        let (far, late) = (*turn.after == [150, 40], *turn.after == [299, 89]);
        let demands = [(far, "not there"), (late, "never there")];
        demands.into_iter().filter_map(|(is_broken, demand)| is_broken.then_some(demand)).collect()
    }
}

impl System for Counters {
    type Part = u16;

    fn places(&self, _: &[u16; 2]) -> usize {
        2
    }

    fn part(&self, state: &[u16; 2], place: usize) -> u16 {
        state[place]
    }

    fn put(&self, state: &mut [u16; 2], place: usize, &part: &u16) {
        state[place] = part;
    }

    fn is_enough(&self, _: &'static str) -> bool {
        false
    }
}

#[test]
fn states_that_are_kept_in_parts_go_to_disk_too_and_leave_nothing_there() {
    let (whole, folder) = (search(&Counters, [[0, 0]], Limits::NONE), folder());
    assert_eq!((whole.states, whole.broken.len()), (27_000, 2));
    let memory = memory(whole.bytes / 2, &folder);
    let limits = |most_steps| Limits { memory: memory.asked("counters"), ..Limits::steps(most_steps) };
    let cut = search(&Counters, [[0, 0]], limits(40_000));
    assert_eq!((cut.is_whole, cut.steps, files(&folder)), (false, 40_000, vec![]));
    assert_eq!(found(search(&Counters, [[0, 0]], limits(u64::MAX))), found(whole));
    assert_eq!((files(&folder), memory.fault()), (vec![], None));
}

#[test]
fn a_search_whose_graph_does_not_fit_is_open() {
    let (keeps, folder) = (Keeps::<dijkstra::Rule>(dijkstra::Machines::of(6, 6), 1), folder());
    let whole = keeps.search(&dijkstra::Rule::Published, Limits::NONE).expect("a search");
    let memory = memory(whole.bytes / 8, &folder);
    let some = keeps.search(&dijkstra::Rule::Published, Limits { memory: memory.memory(), ..Limits::NONE });
    assert_eq!((some.map(|some| some.is_whole), memory.was_too_small()), (Ok(false), true));
    assert_eq!((files(&folder), memory.fault()), (vec![], None));
}

/// Every state of the ring is a start: `RING_STATES` of each of eight machines, 8 unless it says otherwise. What is
/// found is printed: `cargo test -p tautline-library --test all twice_the_memory -- --ignored --nocapture`.
#[test]
#[ignore = "it takes a minute"]
fn a_search_of_twice_the_memory_comes_to_its_end() {
    let states =
        std::env::var("RING_STATES").map_or(8, |states| states.parse().expect("states of a machine"));
    compared(&dijkstra::Rule::Published, || dijkstra::Machines::of(8, states), 45);
}

/// Four robots of Alpha on a square of `ALPHA_SIDE` cells a side, 8 unless it says otherwise, whose endless runs are
/// looked for: `cargo test -p tautline-library --test all four_robots_on_disk -- --ignored --nocapture`.
#[test]
#[ignore = "it takes a minute"]
fn four_robots_on_disk_are_decided_in_less_memory() {
    let width = std::env::var("ALPHA_SIDE").map_or(8, |side| side.parse().expect("cells a side"));
    compared(&alpha::RULE, || alpha::Swarm { robots: 4, width, ..alpha::SWARM }, 70);
}

/// Prints what a search takes in memory and in so many hundredths of it.
fn compared<P: Protocol>(rule: &P, bound: impl Fn() -> P::Bound, percent: u64) {
    let tell = |found: &Findings<_>, begun: Instant, disk: u64| {
        let (seconds, Findings { states, steps, bytes, .. }) = (begun.elapsed().as_secs_f64(), found);
        let [bytes, disk] = [*bytes, disk].map(|bytes| bytes / 1_000_000);
        eprintln!("{states} states, {steps} steps, {bytes} MB of memory, {disk} MB on disk, {seconds:.0} s");
    };
    let keeps = || Keeps::<P>(bound(), 0);
    let begun = Instant::now();
    let whole =
        keeps().search(rule, Limits { workers: NonZeroUsize::new(2), ..Limits::NONE }).expect("a search");
    tell(&whole, begun, 0);
    let (folder, begun) = (folder(), Instant::now());
    let memory = memory(whole.bytes * percent / 100, &folder);
    let (most, is_over) = (AtomicU64::new(0), AtomicBool::new(false));
    let some = thread::scope(|scope| {
        scope.spawn(|| {
            while !is_over.load(Ordering::Relaxed) {
                let sizes = files(&folder).into_iter().map(|name| fs::metadata(folder.path().join(name)));
                most.fetch_max(sizes.flatten().map(|data| data.len()).sum(), Ordering::Relaxed);
                thread::sleep(Duration::from_millis(20));
            }
        });
        let some = keeps()
            .search(rule, Limits { memory: memory.memory(), workers: NonZeroUsize::new(2), ..Limits::NONE });
        is_over.store(true, Ordering::Relaxed);
        some.expect("a search")
    });
    tell(&some, begun, most.into_inner());
    assert_eq!(found(some), found(whole));
}
