//! Rescues over small fields, made live from the bytes or stored and read again.

use std::fs;
use std::io::Write;

use tautline_field::radio::ChannelName;
use tautline_field::rescue::{CallTimes, Fate, SchemeName, Setting, rescue as run, trace};
use tautline_io::atomic_file::{AtomicFile, Foreign, Replaceable};
use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::choice::{Oracle, one_of};
use tautline_proofs::engine::Tape;
use tautline_proofs::mrc::Demand;
use tautline_sim::explore::RuleName;

use super::parts::{numbers, told};

/// A rescue, and its seed.
fn setting(bytes: &mut Tape<'_>) -> (Setting, u64) {
    let area_m = [20.0 + f64::from(bytes.pick(40)), 20.0 + f64::from(bytes.pick(40))];
    let inside = |bytes: &mut Tape<'_>, side: usize| area_m[side] * f64::from(bytes.pick(256)) / 255.0;
    let setting = Setting {
        rule: one_of(bytes, &[RuleName::Repaired, RuleName::Published]),
        scheme: one_of(
            bytes,
            &[
                SchemeName::KFnf,
                SchemeName::Flooding,
                SchemeName::Counter,
                SchemeName::Distance,
                SchemeName::Sba,
            ],
        ),
        k: bytes.pick(10) as u8,
        nodes: 2 + bytes.pick(15) as usize,
        area_m,
        range_m: 5.0 + f64::from(bytes.pick(60)),
        obstacles_m: (0..bytes.pick(3))
            .map(|_| [inside(bytes, 0), inside(bytes, 1), inside(bytes, 0), inside(bytes, 1)])
            .collect(),
        wfrs: 1 + bytes.pick(2) as usize,
        wfrs_at: (0..bytes.pick(3)).map(|_| bytes.pick(20)).collect(),
        robots: 1 + bytes.pick(4) as usize,
        robots_at_m: (0..bytes.pick(3)).map(|_| [inside(bytes, 0), inside(bytes, 1)]).collect(),
        events_per_wfr: 1 + bytes.pick(2) as usize,
        calls: one_of(bytes, &[CallTimes::Together, CallTimes::Spread]),
        channel: one_of(bytes, &[ChannelName::Ideal, ChannelName::Shared]),
        loss: f64::from(bytes.pick(128)) / 255.0,
        shadowing_db: f64::from(bytes.pick(64)) / 8.0,
        exponent: 2.0 + f64::from(bytes.pick(128)) / 40.0,
        noise_db: f64::from(bytes.pick(64)) / 16.0,
        failing: bytes.pick(3) as usize,
        failing_nodes: bytes.pick(8) as usize,
    };
    (setting, bytes.pick(100).into())
}

/// A rescue of a few nodes: it comes to an end, in order; repaired, no clause is broken but, perhaps, that all are
/// served in time (MRC-5), and nobody comes twice; a setting that makes none is told in a line.
pub fn rescue(bytes: &[u8]) {
    let numbers = numbers(bytes);
    let (setting, seed) = setting(&mut Tape(&numbers));
    let report = match run(&setting, seed) {
        Ok(report) => report,
        Err(problem) => return told(&Diagnostic::from(problem)),
    };
    assert!(report.log.is_sorted_by_key(|logged| logged.at_ns));
    assert!(report.log.iter().all(|logged| !logged.event.to_string().is_empty()));
    assert_eq!(report.fates.len(), setting.wfrs * setting.events_per_wfr);
    if setting.rule == RuleName::Repaired {
        let is_safe = |demand| demand == Demand::IsServed;
        assert!(report.violations.iter().all(|violation| is_safe(violation.demand)), "{setting:?}, {seed}");
        let comes_twice = |fate: &Fate| matches!(fate, Fate::Served { visits: 2.., .. });
        assert!(!report.fates.iter().any(comes_twice), "{setting:?}, {seed}");
    }
}

/// Any bytes as a stored rescue, and one that was stored, with some of its bytes changed: it is refused in a line, or
/// is the same again.
pub fn rescue_trace(bytes: &[u8]) {
    let mut file = tempfile::NamedTempFile::new().expect("a file");
    if is_small(bytes) {
        file.write_all(bytes).expect("it can be written");
        read(&file);
    }
    let numbers = numbers(bytes);
    let mut bytes = Tape(&numbers);
    let changes = bytes.pick(4);
    let places = [(); 4].map(|()| (256 * bytes.pick(256) + bytes.pick(256), bytes.pick(256)));
    let (setting, seed) = setting(&mut bytes);
    let Ok(report) = run(&setting, seed) else { return };
    let replaceable = Replaceable::new(Foreign::Replace, []);
    let mut writer = AtomicFile::new(file.path(), &replaceable).expect("a place");
    trace::write(&mut writer, &setting, seed, &report);
    writer.keep().expect("a place");
    let mut stored = fs::read(file.path()).expect("a rescue");
    let original = stored.clone();
    for (place, byte) in places.into_iter().take(changes as usize) {
        let place = place as usize % stored.len();
        stored[place] = byte as u8;
    }
    if !is_small(&stored) {
        return;
    }
    fs::write(file.path(), &stored).expect("room");
    let again = read(&file);
    if stored == original {
        assert!(again == Some((setting, seed)), "what was stored is not replayed");
    }
}

/// The rescue of a file, unless it is refused.
fn read(file: &tempfile::NamedTempFile) -> Option<(Setting, u64)> {
    match trace::replay(file.path()) {
        Ok((setting, seed, _)) => Some((setting, seed)),
        Err(fault) => {
            told(&fault);
            None
        }
    }
}

/// Whether no number of the first line has three digits before the point, or a power of ten: a larger field takes long,
/// and is another rescue all the same.
fn is_small(bytes: &[u8]) -> bool {
    let header = bytes.split(|&byte| byte == b'\n').next().unwrap_or_default();
    let is_long = header
        .split(|byte| !byte.is_ascii_digit() && *byte != b'.')
        .any(|number| number.split(|&byte| byte == b'.').next().is_some_and(|whole| whole.len() > 2));
    let has_power = header.windows(2).any(|pair| {
        pair[0].eq_ignore_ascii_case(&b'e') && (pair[1].is_ascii_digit() || b"+-".contains(&pair[1]))
    });
    !is_long && !has_power
}
