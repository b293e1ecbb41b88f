//! Work that is dealt out among shards, and put together again.

use super::*;

const HUNT: [&str; 7] = ["hunt", "--rule", "published", "--robots", "4", "--max-walls", "3"];
const TABLE: [&str; 6] = ["reproduce", "frontier-fig7", "--runs", "10", "--seed", "7"];

/// Does these shards of `plan.json` by `hunt` or `reproduce`.
fn shards_done(folder: &Path, command: &str, shards: impl IntoIterator<Item = u8>) {
    for shard in shards {
        printed(folder, &[command, "--plan", "plan.json", "--shard", &shard.to_string()], 0);
    }
}

fn planned(folder: &Path, work: &[&str], shards: &str) {
    printed(folder, &[work, &["--plan", "plan.json", "--shards", shards]].concat(), 0);
}

/// Checks that the shards of a hunt are merged to what one process prints of it, and stores: runs of these names.
fn merged_as_by_one_process(many: &Path, hunt: &[&str], code: i32) -> Vec<String> {
    let one = &folder();
    for format in ["text", "json"] {
        let shown =
            |folder, arguments: &[&str]| printed(folder, &[arguments, &["--format", format]].concat(), code);
        assert_eq!(shown(many, &["merge", "plan.json"]), shown(one, hunt));
    }
    let runs = names(one);
    for run in &runs {
        assert_eq!(read(many, run), read(one, run), "{run}");
    }
    runs
}

#[test]
fn the_shards_of_a_hunt_in_any_order_give_what_one_process_gives() {
    let many = &folder();
    planned(many, &HUNT, "7");
    shards_done(many, "hunt", [3, 7, 1, 2, 6, 4, 5]);
    let said = refused(many, &["merge", "plan.json", "plan.json"]);
    assert!(said.contains("leave it out, or name a shard in its place"), "{said}");
    // A shard that is done is not searched again.
    let kept = read(many, "plan-3.json");
    shards_done(many, "hunt", [3]);
    assert_eq!(read(many, "plan-3.json"), kept);
    assert!(!merged_as_by_one_process(many, &HUNT, 1).is_empty());
}

#[test]
fn a_plan_of_which_a_shard_is_kept_is_not_replaced_by_another() {
    let folder = &folder();
    let other = ["hunt", "--rule", "published", "--robots", "3", "--max-walls", "3"];
    planned(folder, &other, "2");
    planned(folder, &HUNT, "2");
    shards_done(folder, "hunt", [2]);
    planned(folder, &HUNT, "2");
    let kept = read(folder, "plan.json");
    let said = refused(folder, &[&other[..], &["--plan", "plan.json", "--shards", "2"]].concat());
    assert!(said.contains("plan.json: this is another plan, and plan-2.json is a shard of it"), "{said}");
    let said = refused(folder, &[&other[..], &["--plan", "plan-2.json", "--shards", "2"]].concat());
    assert!(said.contains("plan-2.json: work is kept in this file, and is not overwritten"), "{said}");
    assert_eq!(read(folder, "plan.json"), kept);
    fs::remove_file(folder.join("plan-2.json")).expect("a shard");
    planned(folder, &other, "2");
}

#[test]
fn a_merge_replaces_neither_its_plan_nor_a_shard() {
    let folder = &folder();
    planned(folder, &["reproduce", "margins"], "2");
    shards_done(folder, "reproduce", [1, 2]);
    for file in ["plan.json", "plan-1.json"] {
        let kept = read(folder, file);
        for force in [&[][..], &["--force"]] {
            says(&refused(folder, &[&["merge", "plan.json", "--csv", file], force].concat()), &[file]);
            assert_eq!(read(folder, file), kept);
        }
    }
}

/// Hunts that look at each layout by itself: states, runs and rivals; with a trap, without one, and with one in an
/// early area.
#[test]
fn the_shards_of_hunts_of_layouts_give_what_one_process_gives() {
    let works: [(&[&str], i32); 5] = [
        (&["--scheme", "bricks", "--max-misses", "1", "--size", "4x3"], 1),
        (&["--scheme", "ants", "--max-misses", "1", "--size", "3x3"], 0),
        (&["--scheme", "mdfs", "--rule", "published", "--max-misses", "1", "--size", "3x2"], 1),
        (&["--scheme", "helpers", "--max-misses", "1", "--size", "3x2"], 0),
        (&["--scheme", "frontier", "--rule", "earlier", "--robots", "2", "--size", "3x2"], 1),
    ];
    for (work, code) in works {
        let work = [&["hunt"], work].concat();
        let many = &folder();
        planned(many, &work, "5");
        shards_done(many, "hunt", [4, 1, 5, 3]);
        // The last one is ended again and again, and taken up where it was.
        let shard = ["hunt", "--plan", "plan.json", "--shard", "2", "--budget", "1"];
        let mut ended = 0;
        while ran(many, &shard).status.code() == Some(3) {
            ended += 1;
        }
        assert!(ended > 0, "{work:?}");
        merged_as_by_one_process(many, &work, code);
    }
}

#[test]
fn a_shard_that_ran_out_of_its_budget_is_a_gap_until_it_has_gone_on() {
    let folder = &folder();
    let whole = printed(folder, &HUNT, 1);
    planned(folder, &HUNT, "2");
    shards_done(folder, "hunt", [1]);
    printed(folder, &["hunt", "--plan", "plan.json", "--shard", "2", "--budget", "5000"], 3);
    let output = ran(folder, &["merge", "plan.json"]);
    let said = String::from_utf8(output.stderr).expect("text");
    assert_eq!((output.status.code(), output.stdout.len()), (Some(4), 0), "{said}");
    assert!(said.contains("1 of 2 shards are not there: shard 2 is not at its end"), "{said}");
    shards_done(folder, "hunt", [2]);
    assert_eq!(printed(folder, &["merge", "plan.json"], 1), whole);
}

/// A nightly hunt: the same command each night, with a budget of somewhat more than a third of the whole.
#[test]
fn three_nights_with_a_budget_come_to_what_one_call_without_one_comes_to() {
    let (one, nights) = (&folder(), &folder());
    let whole = json(one, &[&HUNT[..], &["--resume", "hunt.json"]].concat(), 1);
    let moves = whole["moves"].as_u64().expect("a number");
    let budget = (moves * 2 / 5).to_string();
    let night = [&HUNT[..], &["--resume", "hunt.json", "--budget", &budget]].concat();
    let made = [3, 3, 1].map(|code| json(nights, &night, code));
    let moves_by: Vec<u64> = made.iter().map(|night| night["moves"].as_u64().expect("a number")).collect();
    assert_eq!(moves_by, [moves * 2 / 5, 2 * (moves * 2 / 5), moves]);
    assert_eq!(made[2], whole);
    assert_eq!(names(nights), names(one));
    for name in names(one) {
        assert_eq!(read(nights, &name), read(one, &name), "{name}");
    }
}

#[test]
fn a_shard_that_is_run_again_with_the_same_budget_goes_on() {
    let folder = &folder();
    let whole = printed(folder, &HUNT, 1);
    planned(folder, &HUNT, "2");
    shards_done(folder, "hunt", [1]);
    let shard = ["hunt", "--plan", "plan.json", "--shard", "2", "--budget", "50000"];
    let mut nights = 1;
    while ran(folder, &shard).status.code() == Some(3) {
        nights += 1;
        assert!(nights < 20, "it never goes on");
    }
    assert!(nights > 2, "{nights}");
    assert_eq!(printed(folder, &["merge", "plan.json"], 1), whole);
}

/// A file with right digests and a right checksum that says that all is done, and less is.
#[test]
fn a_shard_that_did_less_than_it_was_dealt_is_refused() {
    let folder = &folder();
    let refused_with = |far: &dyn Fn(&mut Value)| {
        let kept = read(folder, "plan-2.json");
        let (head, rest) = kept.split_once('\n').expect("lines");
        let mut value = serde_json::from_str(rest.lines().next().expect("a line")).expect("JSON");
        far(&mut value);
        let head = head.replace("\"done\":false", "\"done\":true");
        write(folder, "plan-2.json", sealed(&format!("{head}\n{value}\n")));
        let said = refused(folder, &["merge", "plan.json"]);
        write(folder, "plan-2.json", kept);
        says(&said, &["plan-2.json", "remove it, and run the shard again"]);
        said
    };
    let remove_plan = || {
        for file in ["plan.json", "plan-1.json", "plan-2.json"] {
            fs::remove_file(folder.join(file)).expect("a file");
        }
    };
    let budget = ["hunt", "--plan", "plan.json", "--shard", "2", "--budget", "5000"];
    planned(folder, &HUNT, "2");
    shards_done(folder, "hunt", [1]);
    printed(folder, &budget, 3);
    let mut said = vec![refused_with(&|_| {})];
    // It forgets what is left of this number of walls, and of all.
    let forget = |far: &mut Value, levels: usize| {
        far["lanes"] = Value::Array(Vec::new());
        let all = far["levels"].as_array_mut().expect("levels");
        all.resize(levels, serde_json::json!({"runs": 0, "moves": 0}));
    };
    said.push(refused_with(&|far| forget(far, 4)));
    shards_done(folder, "hunt", [2]);
    said.push(refused_with(&|far| far["count"]["searched"] = 1.into()));
    remove_plan();
    let layouts = ["hunt", "--scheme", "mdfs", "--rule", "published", "--max-misses", "1", "--size", "3x2"];
    planned(folder, &layouts, "2");
    shards_done(folder, "hunt", [1, 2]);
    let stages = |far: &mut Value| far.as_array().expect("stages").len();
    let looks = |far: &mut Value, stage: usize| far[stage].as_array_mut().expect("looks").pop();
    said.push(refused_with(&|far| drop(looks(far, stages(&mut far.clone()) - 1))));
    said.push(refused_with(&|far| drop(looks(far, stages(&mut far.clone()) - 2))));
    remove_plan();
    planned(folder, &TABLE, "2");
    shards_done(folder, "reproduce", [1, 2]);
    said.push(refused_with(&|far| drop(far["results"].as_array_mut().expect("results").pop())));
    assert_snapshot!(said.join("\n"));
}

/// Plans with a right checksum.
#[test]
fn a_plan_with_numbers_that_contradict_each_other_is_refused_and_how_many_shards_there_are_stands_once() {
    let folder = &folder();
    let layouts = ["hunt", "--scheme", "helpers", "--max-misses", "1", "--size", "3x2"];
    let table = ["reproduce", "repair-cost", "--runs", "2"];
    let changed = |work: &[&str], from: &str, to: &str| {
        planned(folder, work, "2");
        let plan = read(folder, "plan.json");
        assert!(plan.contains(from), "{plan}");
        write(folder, "plan.json", sealed(&plan.replace(from, to)));
    };
    for (work, from, to, words) in [
        (&layouts[..], "},null]", "},2147483648]", "plan anew"),
        (&table, "\"layouts\":2", "\"layouts\":1000000", "14 jobs are dealt out, and its settings give 7000"),
        (&table, "\"jobs\":14", "\"jobs\":15", "15 jobs are dealt out, and its settings give 14"),
        (&table, "\"layouts\":2", "\"layouts\":0", "plan.json: its settings have --runs 0: "),
        (&table, "\"layouts\":2", "\"layouts\":1000000000000", "plan.json:2:36"),
        (&layouts, "\"size\":[3,2]", "\"size\":[30,2]", "plan.json: 30x2 cells are 60"),
        (&["hunt", "--robots", "2", "--max-walls", "1"], "\"max_walls\":1", "\"max_walls\":3", "plan.json: "),
    ] {
        changed(work, from, to);
        let said = refused(folder, &[work[0], "--plan", "plan.json", "--shard", "1"]);
        assert!(said.contains(words), "{to}: {said}");
        fs::remove_file(folder.join("plan.json")).expect("a file");
    }
    let whole = printed(folder, &layouts, 0);
    changed(&layouts, "\"shards\":2", "\"shards\":1");
    shards_done(folder, "hunt", [1]);
    assert_eq!(printed(folder, &["merge", "plan.json"], 0), whole);
}

#[test]
fn the_shards_of_a_table_give_what_one_process_gives() {
    let (one, many) = (&folder(), &folder());
    let whole = printed(one, &[&TABLE[..], &["--svg", "cost.svg"]].concat(), 0);
    planned(many, &TABLE, "3");
    shards_done(many, "reproduce", [2, 3, 1]);
    let merge = ["merge", "plan.json", "--picture", "svg", "cost.svg"];
    assert_eq!(printed(many, &merge, 0), whole);
    let bare = &folder();
    planned(bare, &["reproduce", "repair-cost", "--runs", "2"], "1");
    shards_done(bare, "reproduce", [1]);
    let said = refused(bare, &["merge", "plan.json", "--picture", "a", "b.svg"]);
    assert!(said.contains("leave it out: this table has no pictures"), "{said}");
    let said = refused(many, &["merge", "plan.json", "--picture", "walked", "cost.svg", "--force"]);
    assert!(said.contains("ask for one of svg"), "{said}");
    let said = refused(many, &["merge", "plan.json", "--out", "found"]);
    assert!(said.contains("--out has no effect: a table has no counterexamples"), "{said}");
    assert_eq!(read(many, "cost.svg"), read(one, "cost.svg"));
}

#[test]
fn wrong_plans_and_shards() {
    let folder = &folder();
    let small = ["hunt", "--rule", "published", "--robots", "3", "--max-walls", "2"];
    planned(folder, &small, "3");
    let other = ["hunt", "--rule", "repaired", "--robots", "3", "--max-walls", "2"];
    printed(folder, &[&other[..], &["--plan", "other.json", "--shards", "3"]].concat(), 0);
    printed(folder, &[&TABLE[..], &["--plan", "table.json", "--shards", "2"]].concat(), 0);
    shards_done(folder, "hunt", [1, 2, 3]);
    printed(folder, &["hunt", "--plan", "other.json", "--shard", "2"], 0);
    let plan = read(folder, "plan.json");
    // What is not the same in every build is not shown.
    write(folder, "foreign.json", of_another_build(&plan));
    let old = plan.replace("\"version\":2", "\"version\":1");
    write(folder, "old.json", sealed(&old));
    write(folder, "damaged.json", plan.replace("\"answers\":[0", "\"answers\":[1"));
    // How the sum is drawn depends on its digits, and it is another one for each build.
    assert!(
        refused(folder, &["hunt", "--plan", "damaged.json", "--shard", "1"]).contains("the file is damaged")
    );
    let cases: [&[&str]; 18] = [
        &["hunt", "--plan", "plan.json"],
        &["hunt", "--shards", "3"],
        &["hunt", "--plan", "new.json", "--shards", "0"],
        &["hunt", "--plan", "plan.json", "--shard", "0"],
        &["hunt", "--plan", "plan.json", "--shard", "4"],
        &["hunt", "--plan", "plan.json", "--shard", "1", "--robots", "3"],
        &["hunt", "--plan", "none.json", "--shard", "1"],
        &["hunt", "--plan", "foreign.json", "--shard", "1"],
        &["hunt", "--plan", "old.json", "--shard", "1"],
        &["hunt", "--plan", "table.json", "--shard", "1"],
        &["hunt", "--plan", "plan-1.json", "--shard", "1"],
        &["hunt", "--scheme", "kit", "--plan", "new.json", "--shards", "2"],
        &["hunt", "--scheme", "bricks", "--max-walls", "2", "--plan", "new.json", "--shards", "2"],
        &["hunt", "--max-misses", "1", "--plan", "new.json", "--shards", "2"],
        &["hunt", "--plan", "new.json", "--shards", "2", "--format", "junit"],
        &["merge", "plan.json", "plan-1.json", "plan-2.json", "plan-1.json"],
        &["merge", "plan.json", "plan-1.json", "other-2.json"],
        &["reproduce", "--plan", "plan.json", "--shard", "1"],
    ];
    // So is the digest of a plan, also where it is clipped.
    let digest = |said: String| {
        let is_hash = |word: &&str| word.len() >= 16 && word.bytes().all(|byte| byte.is_ascii_hexdigit());
        let hashes: Vec<String> = said
            .split(|letter: char| !letter.is_ascii_alphanumeric())
            .filter(is_hash)
            .map(str::to_owned)
            .collect();
        hashes.iter().fold(said.clone(), |said, hash| said.replace(hash.as_str(), "<hash>"))
    };
    let said =
        cases.map(|case| format!("$ tautline {}\n{}\n", case.join(" "), digest(refused(folder, case))));
    assert_snapshot!(said.join("\n"));
    assert!(!folder.join("new.json").exists());
}

#[test]
fn what_a_ci_shows_of_a_verdict() {
    let folder = &folder();
    let hunt = ["hunt", "--rule", "published", "--robots", "3", "--max-walls", "2"];
    let shown = |arguments: &[&str], format, code| {
        printed(folder, &[arguments, &["--format", format]].concat(), code)
    };
    let annotations = shown(&hunt, "github", 1);
    assert!(
        annotations.lines().all(|line| line.starts_with("::error title=") || line.starts_with("::notice "))
    );
    let junit = shown(&hunt, "junit", 1);
    let small = ["hunt", "--robots", "3", "--max-walls", "1"];
    let passed = shown(&small, "junit", 0) + &shown(&small, "github", 0);
    let proved = shown(&["prove", "LATTICE-1"], "github", 0);
    assert_snapshot!([annotations, junit, passed, proved].join("\n"));
    // A shell that fails at any other code than 0 goes on where it is asked to.
    printed(folder, &[&hunt[..], &["--exit-zero"]].concat(), 0);
}
