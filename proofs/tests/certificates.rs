//! Certificates of local rules in the hands of Rocq: what is changed in one bit is refused, and so is a certificate of
//! another rule. Where `coqc` cannot be had, the test says that it is skipped.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, id};

use tautline_kernel::chain::Rule;
use tautline_kernel::frontier::Rule as FrontierRule;
use tautline_proofs::chain::local::Contact;
use tautline_proofs::frontier::local::Alone;
use tautline_proofs::local::{Invariant, Local};

use crate::draw::Draw;

/// A folder with the proofs that a certificate needs, compiled.
struct Rocq(PathBuf);

impl Rocq {
    /// `None` where there is no `coqc`.
    fn new() -> Option<Self> {
        let version = Command::new("coqc").arg("--version").output();
        if version.is_err() {
            eprintln!("skipped: there is no coqc");
            return None;
        }
        let folder = std::env::temp_dir().join(format!("tautline-certificates-{}", id()));
        fs::create_dir_all(&folder).expect("a folder");
        let rocq = Self(folder);
        for name in ["Lattice", "Local", "Certificate"] {
            let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("rocq");
            let text = fs::read_to_string(sources.join(format!("{name}.v"))).expect("a proof");
            assert!(rocq.accepts(name, &text), "{name}");
        }
        Some(rocq)
    }

    /// Whether Rocq accepts this file.
    fn accepts(&self, name: &str, text: &str) -> bool {
        let file = format!("{name}.v");
        fs::write(self.0.join(&file), text).expect("a file");
        let mut coqc = Command::new("coqc");
        let compiled = coqc.args(["-q", "-Q", ".", "Tautline", &file]).current_dir(&self.0).output();
        compiled.expect("coqc runs").status.success()
    }
}

impl Drop for Rocq {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// The certificate without one place that a table has: a bit of that table is 0 instead of 1.
fn without_a_place(text: &str, table: &str, draw: &mut Draw) -> String {
    let from = text.find(&format!("{table} :=")).expect("a table");
    let to = text[from..].find(";\n started").or_else(|| text[from..].find("|}")).expect("an end") + from;
    let mut places = Vec::new();
    for (start, _) in text[from..to].match_indices("0x") {
        let digits = text[from + start + 2..].chars().take_while(char::is_ascii_hexdigit);
        for (place, value) in
            digits.enumerate().filter_map(|(place, digit)| Some((place, digit.to_digit(16)?)))
        {
            let bits = (0..4).filter(|bit| value >> bit & 1 == 1);
            places.extend(bits.map(|bit| (from + start + 2 + place, value & !(1 << bit))));
        }
    }
    let (place, value) = places[draw.below(places.len() as u64) as usize];
    let digit = char::from_digit(value, 16).expect("a digit");
    format!("{}{digit}{}", &text[..place], &text[place + 1..])
}

fn certificate<R: Local>(rule: &R) -> String {
    Invariant::of(rule).expect("a local rule").certificate(rule).expect("it is small")
}

#[test]
fn a_certificate_with_one_bit_changed_is_refused_and_so_is_that_of_another_rule() {
    let Some(rocq) = Rocq::new() else { return };
    let (contact, alone) = (Contact::<false>(Rule::REPAIRED), Alone::of(FrontierRule::REPAIRED));
    let texts = [certificate(&contact), certificate(&alone)];
    for (number, text) in texts.iter().enumerate() {
        assert!(rocq.accepts(&format!("Right{number}"), text), "{text}");
    }
    let mut draw = Draw(41);
    // Of frontier cells nothing but the one that two robots share breaks the promise.
    for number in 0..12 {
        // Rocq takes three seconds for one of frontier cells, and half a second for another: fewer of those.
        let text = &texts[usize::from(number % 4 == 3)];
        let table = if number % 4 == 2 { "promised" } else { "kept" };
        let changed = without_a_place(text, table, &mut draw);
        assert!(changed != *text);
        assert!(!rocq.accepts(&format!("Changed{number}"), &changed), "{number}: {changed}");
    }
    let repaired = Invariant::of(&contact).expect("a local rule");
    for other in [Rule::PUBLISHED, Rule::REPAIRED.without(tautline_kernel::chain::Condition::SafeAhead)] {
        let certificate = repaired.certificate(&Contact::<false>(other)).expect("it is small");
        assert!(!rocq.accepts("Another", &certificate), "{other:?}");
    }
}
