//! Certificates on the command line: written by `prove`, examined by `check`.

use std::fs;

use tautline_certificates::digest;
use tautline_io::atomic_file::{AtomicFile, Replaceable};

use super::{folder, json, names, printed, ran, refused, says, write};

/// The bytes of a certificate in which `one` stands once, and `other` in its place, with the digest made anew.
fn changed(bytes: &[u8], one: &[u8], other: &[u8]) -> Vec<u8> {
    let content = &bytes[..bytes.len() - 16];
    let place = content.windows(one.len()).position(|part| part == one).expect("it stands there");
    let mut changed = [&content[..place], other, &content[place + one.len()..]].concat();
    let digest = digest(&changed);
    changed.extend(digest.to_le_bytes());
    changed
}

#[test]
fn what_holds_gets_a_certificate_that_is_accepted_and_refused_where_it_is_changed() {
    let folder = &folder();
    let proved = ran(folder, &["prove", "KIT-5", "--certificate", "certificates"]);
    assert_eq!((proved.status.code(), &*proved.stderr), (Some(0), &b""[..]));
    let files = ["kit-5-published-states.cert", "kit-5-repaired-states.cert", "kit-5-robust-states.cert"];
    assert_eq!(names(&folder.join("certificates")), files);
    let paths = files.map(|file| format!("certificates/{file}"));
    let accepted = printed(folder, &["check", &paths[0], &paths[1]], 0);
    for words in [
        "certificates/kit-5-published-states.cert: accepted: 940 states, ",
        "certificates/kit-5-repaired-states.cert: accepted: 2327 states, ",
        " in 1 system\n  KIT-5 as repaired: ",
    ] {
        assert!(accepted.contains(words), "{accepted}");
    }
    let told = json(folder, &["check", &paths[1]], 0);
    assert_eq!(told["certificates"][0]["accepted"]["states"], 2_327);

    let bytes = fs::read(folder.join(&paths[0])).expect("a certificate");
    let said = |change: Vec<u8>| {
        write(folder, "changed.cert", change);
        refused(folder, &["check", "changed.cert"])
    };
    let mut damaged = bytes.clone();
    damaged[bytes.len() / 2] ^= 1;
    let cases = [
        (said(damaged), "its last 16 bytes are no digest of the others"),
        (said(bytes[..bytes.len() / 2].to_vec()), "it is cut short or changed"),
        (said(b"a text".to_vec()), "it does not begin with the line \"tautline certificate 1\""),
        (
            said(changed(&bytes, b"clause KIT-5", b"clause KIT-999")),
            "the clause \"KIT-999\", which is not known here",
        ),
        (
            said(changed(&bytes, b"rule published", b"rule printed")),
            "the rule \"printed\", and the check is about \"published\"",
        ),
        (said(changed(&bytes, b"tautline 0", b"tautline 9")), "it is a certificate of \"tautline 9"),
        (refused(folder, &["check", "nowhere.cert"]), "nowhere.cert"),
    ];
    // A file that is none does not take back what was said of others.
    let both = ran(folder, &["check", &paths[1], "changed.cert"]);
    assert_eq!(both.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&both.stdout).contains("accepted: 2327 states, "));
    // Of its states a checker keeps many times as many bytes.
    let large = fs::File::create(folder.join("large.cert")).expect("a file");
    large.set_len((1 << 28) + 1).expect("a large file");
    says(&refused(folder, &["check", "large.cert"]), &["large.cert: the file has more than 256 MiB"]);
    for (words, part) in cases {
        assert!(words.contains(part), "{part}: {words}");
    }

    // The states of the published rule are not those of the repaired one.
    let other = fs::read(folder.join(&paths[1])).expect("a certificate");
    let header = |bytes: &[u8]| {
        let end = bytes.windows(8).position(|part| part == b"\nstates ").expect("a line") + 1;
        end + bytes[end..].iter().position(|&byte| byte == b'\n').expect("its end") + 1
    };
    let mixed = [&other[..header(&other)], &bytes[header(&bytes)..bytes.len() - 16], &[0; 16][..]].concat();
    write(folder, "mixed.cert", changed(&mixed, b"clause", b"clause"));
    let mixed = printed(folder, &["check", "mixed.cert"], 1);
    assert!(mixed.starts_with("mixed.cert: refused: section 1, "), "{mixed}");
}

#[test]
fn every_certificate_is_known_again_and_replaced_by_the_next_one() {
    let folder = &folder();
    let proved = ran(folder, &["prove", "KIT-3", "--certificate", "certificates"]);
    assert_eq!(proved.status.code(), Some(0));
    let files = ["KIT_3_repaired.v", "kit-3-repaired-states-2.cert", "kit-3-repaired-states.cert"];
    assert_eq!(names(&folder.join("certificates")), files);
    for file in files {
        let next = AtomicFile::new(&folder.join("certificates").join(file), &Replaceable::default());
        assert_eq!(next.err(), None, "{file}");
    }
    // A proof that somebody else wrote is none of ours.
    let own = folder.join("Own.v");
    fs::write(&own, "From Coq Require Import ZArith NArith List.\n").expect("a file");
    assert!(AtomicFile::new(&own, &Replaceable::default()).is_err());
}

#[test]
fn a_search_over_layouts_gets_a_certificate_whose_ends_are_its_runs() {
    let folder = &folder();
    let proved = ran(folder, &["prove", "CHAIN-14", "--certificate", "certificates"]);
    assert_eq!((proved.status.code(), &*proved.stderr), (Some(0), &b""[..]));
    assert_eq!(names(&folder.join("certificates")), ["chain-14-repaired-search.cert"]);
    let path = "certificates/chain-14-repaired-search.cert";
    let accepted = printed(folder, &["check", path], 0);
    assert!(accepted.contains(" 358 ends in 1 system\n  CHAIN-14 as repaired: "), "{accepted}");
    let bytes = fs::read(folder.join(path)).expect("a certificate");
    let states = String::from_utf8_lossy(&bytes)
        .lines()
        .find_map(|line| line.strip_prefix("states ").map(str::to_owned));
    let told = json(folder, &["check", path], 0);
    assert_eq!(states, Some(told["certificates"][0]["accepted"]["states"].to_string()));
}

#[test]
fn what_holds_without_a_search_is_told_to_get_no_certificate() {
    let folder = &folder();
    let proved = ran(folder, &["prove", "KIT-9", "--certificate", "certificates"]);
    assert_eq!(proved.status.code(), Some(0));
    let said = String::from_utf8_lossy(&proved.stderr);
    let why = "KIT-9 as repaired gets no certificate: the engine exhaustive \
               searches neither all states nor all layouts";
    assert!(said.contains(why), "{said}");
    assert_eq!(names(&folder.join("certificates")), [""; 0]);
}
