//! The first ten minutes: what the program says to who knows nothing of it yet, and how one command leads to the next.

use insta::assert_snapshot;

use super::{folder, json, names, printed, ran, read, refused, says, write};

#[test]
fn without_a_command_it_says_what_to_do_first() {
    let folder = &folder();
    let said = printed(folder, &[], 0);
    assert!(said.lines().all(|line| line.chars().count() <= 90), "{said}");
    assert_snapshot!("first_steps", said);
    // Each of its commands does what it says, but for the first, which takes minutes.
    let commands = said.lines().filter_map(|line| line.trim_start().strip_prefix("tautline "));
    let commands: Vec<Vec<&str>> = commands
        .map(|line| line.split("   ").next().unwrap_or(line).split_whitespace().collect())
        .filter(|command: &Vec<&str>| command != &["prove"])
        .collect();
    assert_eq!(commands.len(), 5);
    for (command, code) in commands.iter().zip([1, 1, 0, 0, 0]) {
        assert!(!printed(folder, command, code).is_empty(), "{command:?}");
    }
    assert_eq!(names(folder), ["found", "run.html"]);
}

#[test]
fn each_scheme_is_listed_and_runs_by_its_own_rule() {
    let folder = &folder();
    assert_snapshot!("schemes", printed(folder, &["schemes"], 0));
    assert_snapshot!("unknown_scheme_to_list", refused(folder, &["schemes", "swarm"]));
    let listed = json(folder, &["schemes"], 0);
    for scheme in listed["schemes"].as_array().expect("a list") {
        let name = scheme["name"].as_str().expect("a name");
        let rules = scheme["rules"].as_array().expect("a list");
        let default = rules.iter().filter(|rule| rule["is_default"] == true);
        let default: Vec<_> = default.map(|rule| &rule["name"]).collect();
        assert_eq!(default.len(), 1, "{name}");
        let run = ["explore", "open:3x3", "--scheme", name, "--robots", "2", "--max-moves", "30"];
        let output = ran(folder, &[&run[..], &["--format", "json"]].concat());
        let run: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
        assert_eq!(&run["rule"], default[0], "{name}");
    }
}

#[test]
fn a_wrong_name_is_answered_with_the_names_there_are() {
    let folder = &folder();
    let tables = json(folder, &["reproduce"], 0);
    let tables = tables["reproductions"].as_array().expect("a list");
    let tables: Vec<&str> = tables.iter().filter_map(|table| table["id"].as_str()).collect();
    let tip = format!("tip: the tables are {}\n", tables.join(", "));
    for asked in [&["reproduce", "nope"][..], &["help", "reproduce", "nope"]] {
        says(&refused(folder, asked), &["'nope'", &tip]);
    }
    says(&refused(folder, &["reproduce", "kit"]), &["'kit-range'", "'kit-fig9'"]);
    for asked in [&["nope"][..], &["help", "nope"], &["--verbose", "nope"]] {
        says(&refused(folder, asked), &["'nope'", "tip: the commands are prove, library, schemes,"]);
    }
    says(
        &refused(folder, &["prove", "pack-99"]),
        &["no clause \"pack-99\"", "the clauses of PACK are PACK-1,"],
    );
    says(&refused(folder, &["prove", "nope"]), &["LATTICE, CHAIN, ", "PACK, and its number, as CHAIN-1"]);
}

#[test]
fn walls_that_nobody_has_asked_for_are_no_more_than_fit() {
    let folder = &folder();
    for (robots, size, walls) in [("4", "1x1", 0), ("2", "127x1", 2)] {
        let hunted = json(folder, &["hunt", "--robots", robots, "--size", size], 0);
        assert_eq!(hunted["max_walls"], walls, "{size}");
    }
    says(
        &refused(folder, &["hunt", "--robots", "2", "--size", "127x1", "--max-walls", "3"]),
        &["can be walls (2)"],
    );
}

#[test]
fn a_layout_without_a_name_is_refused() {
    let folder = &folder();
    for command in ["explore", "show"] {
        says(&refused(folder, &[command, ""]), &["'<LAYOUT>'", "it is empty, so name a file"]);
    }
}

#[test]
fn hunt_offers_the_schemes_of_which_something_is_hunted_and_no_others() {
    let folder = &folder();
    let (listed, help) = (json(folder, &["schemes"], 0), printed(folder, &["hunt", "--help"], 0));
    let schemes = listed["schemes"].as_array().expect("a list");
    let mut refused_ones = 0;
    for scheme in schemes {
        let (name, rules) =
            (scheme["name"].as_str().expect("text"), scheme["rules"].as_array().expect("a list"));
        let is_hunted = rules.iter().any(|rule| rule["hunt"] == true);
        assert_eq!(help.contains(&format!("- {name}:")), is_hunted, "{name}");
        if !is_hunted {
            let fault = refused(folder, &["hunt", "--scheme", name]);
            assert!(fault.contains("possible values") && fault.contains("bricks-ants"), "{fault}");
            refused_ones += 1;
        }
    }
    assert!((1..schemes.len()).contains(&refused_ones), "some are hunted, and some are not");
}

#[test]
fn a_run_that_is_found_is_tried_with_another_rule() {
    let folder = &folder();
    let found = printed(folder, &["hunt", "--rule", "published", "--max-walls", "3", "--out", "found"], 1);
    let file = "found/chain-13-published-n4.jsonl";
    assert!(found.contains(&format!("try a rule on it: tautline explore {file} --rule RULE")), "{found}");
    let told = json(folder, &["explore", file], 1);
    assert_eq!((&told["rule"], &told["robots"]), (&"published".into(), &4.into()));
    let told = json(folder, &["explore", file, "--rule", "repaired"], 0);
    assert_eq!((&told["rule"], &told["robots"]), (&"repaired".into(), &4.into()));
    let told = json(folder, &["explore", file, "--scheme", "ants", "--robots", "2"], 0);
    assert_eq!((&told["scheme"], &told["rule"]), (&"ants".into(), &"repaired".into()));
    printed(folder, &["prove", "CHAIN-14", "--out", "found"], 0);
    let stored: Vec<String> = names(&folder.join("found"));
    let stored = stored.iter().find(|name| name.starts_with("chain-14")).expect("a counterexample");
    let told = json(folder, &["explore", &format!("found/{stored}"), "--rule", "reel"], 0);
    assert_eq!(&told["rule"], "reel");
    let wrong = [
        refused(folder, &["explore", file, "--cell", "0.5"]),
        refused(folder, &["explore", file, "--rule", "counted"]),
        refused(folder, &["explore", "open:3x3", "--radius", "0.1"]),
    ];
    assert_snapshot!("wrong_runs_to_try", wrong.join("\n"));
}

#[test]
fn a_run_says_how_far_the_team_comes() {
    let folder = &folder();
    let told = printed(folder, &["explore", "open:40x40", "--robots", "4", "--base", "20,20"], 0);
    let reach: Vec<&str> = told.lines().filter(|line| line.contains("the reach of")).collect();
    assert_snapshot!(
        reach.join("\n"),
        @"49 of 1600 free cells are within 3 links of the base, the reach of this chain, which may explore others \
          beside it; the reach of one of 21 robots has all 1600 that are connected with the base"
    );
    // Where all is explored, also beyond the reach, it is no limit.
    let all = printed(folder, &["explore", "walls:6x6:0.2", "--seed", "12", "--robots", "5"], 0);
    assert!(all.contains("36 of 36 cells explored") && !all.contains("the reach of"), "{all}");
}

#[test]
fn a_clause_that_noise_breaks_is_said_to_be_no_refutation() {
    let folder = &folder();
    let run = "explore cells:7x6:0.1 --scheme frontier --rule published --robots 4 --noise-db 2 --readings 1";
    let told = ran(folder, &run.split(' ').collect::<Vec<_>>());
    let told = String::from_utf8(told.stdout).expect("text");
    let excuse = "with --noise-db this is no refutation of the rule: the clauses assume positions";
    assert!(told.contains(" is broken in team move ") && told.contains(excuse), "{told}");
}

#[test]
fn a_ros_map_is_taken_in_larger_cells() {
    let folder = &folder();
    let yaml = "image: map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n\
                negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
    write(folder, "map.yaml", yaml);
    let pixels = (0..20 * 10).map(|place| if place == 5 * 20 + 10 { 0_u8 } else { 255 });
    let image: Vec<u8> = b"P5 20 10 255\n".iter().copied().chain(pixels).collect();
    write(folder, "map.pgm", image);
    let show = |more: &[&str]| json(folder, &[&["show", "map.yaml"], more].concat(), 0);
    assert_eq!(show(&[])["free_cells"], 199);
    let large = show(&["--cell", "0.25", "--radius", "0.1"]);
    assert_eq!(
        (&large["width"], &large["height"], &large["free_cells"], &large["walls"]),
        (&4.into(), &2.into(), &8.into(), &2.into())
    );
    let wide = show(&["--cell", "0.25"]);
    assert_eq!((&wide["free_cells"], &wide["walls"]), (&7.into(), &0.into()));
    let wrong = [
        &["--cell", "0.12"][..],
        &["--cell", "5"],
        &["--cell", "0.25", "--radius", "-1"],
        &["--radius", "9"],
    ];
    let said = wrong.map(|more| refused(folder, &[&["show", "map.yaml"], more].concat()));
    assert_snapshot!("wrong_cells_of_a_map", said.join("\n"));
}

#[test]
fn the_page_of_all_verdicts_has_them_and_their_counterexamples() {
    let folder = &folder();
    printed(folder, &["prove", "KIT-3", "LATTICE-1", "NOTICE-4", "--html", "report.html"], 0);
    let page = read(folder, "report.html");
    let part = |id: &str| {
        let (_, rest) = page.split_once(&format!("id=\"{id}\">")).expect("a part");
        let text = rest.split_once("</script>").expect("its end").0;
        serde_json::from_str::<serde_json::Value>(text).expect("JSON")
    };
    let (ledger, pages) = (part("ledger"), part("pages"));
    let (ledger, pages) = (ledger["clauses"].as_array().expect("a list"), pages.as_array().expect("a list"));
    assert_eq!(ledger.len(), pages.len());
    for (check, page) in ledger.iter().zip(pages) {
        assert_eq!(check["counterexample"].is_null(), page.is_null(), "{check}");
    }
    let plays = pages.iter().filter_map(|page| page.as_str()).filter(|page| page.contains("{{script}}"));
    assert_eq!(plays.count(), 2);
    assert_eq!(part("titles")["NOTICE"], "broadcast by k-FNF");
    // Each page has its marks, but a story has no script; and the script of the page fills them in.
    let marks = 2 * pages.iter().filter(|page| !page.is_null()).count() - 1;
    assert_eq!(page.matches("{{").count(), marks + 2);
    says(&refused(folder, &["prove", "LATTICE-1", "--html", "report.html/x"]), &["report.html/x"]);
}

#[test]
fn a_stored_run_has_a_page_by_a_command_of_its_own() {
    let folder = &folder();
    printed(folder, &["hunt", "--rule", "published", "--max-walls", "2", "--out", "found"], 1);
    let told = printed(folder, &["page", "found/chain-13-published-n4.jsonl"], 0);
    assert!(told.ends_with("the page that plays it: chain-13-published-n4.html\n"), "{told}");
    printed(folder, &["page", "found/chain-13-published-n4.jsonl", "--html", "other.html"], 0);
    printed(folder, &["replay", "found/chain-13-published-n4.jsonl", "--html", "replayed.html"], 1);
    let [page, other, replayed] =
        ["chain-13-published-n4.html", "other.html", "replayed.html"].map(|name| read(folder, name));
    assert!(page == other && page == replayed);
    write(folder, "none.jsonl", "hello\n");
    assert!(refused(folder, &["page", "none.jsonl"]).contains("none.jsonl"));
}

/// Agents have sensors that can be missed; runs of KIT and of frontier cells are made by the choices of a search.
#[test]
fn agents_and_runs_of_a_search_are_minimised_too() {
    let folder = &folder();
    let explore =
        ["explore", "cells:8x8:0.1", "--scheme", "bricks", "--robots", "3", "--miss", "0.2", "--seed", "3"];
    printed(folder, &[&explore[..], &["--trace", "agents.jsonl"]].concat(), 1);
    let agents = json(folder, &["minimise", "agents.jsonl"], 0);
    assert_eq!((&agents["before"]["robots"], &agents["after"]["robots"]), (&3.into(), &1.into()));
    let explore =
        ["explore", "cells:4x4:0.1", "--scheme", "bricks", "--robots", "2", "--miss", "0.1", "--seed", "11"];
    printed(folder, &[&explore[..], &["--rule", "published", "--trace", "short.jsonl"]].concat(), 1);
    let longer = printed(folder, &["minimise", "short.jsonl"], 0);
    says(&longer, &["or wall, and no missed sensor can go", "takes more team moves than before"]);
    printed(folder, &["hunt", "--scheme", "kit", "--rule", "published", "--size", "5x1", "--out", "kit"], 1);
    let kit = printed(folder, &["minimise", "kit/kit-1-published-n2.jsonl"], 0);
    says(&kit, &["no smaller team and layout breaks KIT-1, whatever happens in which order"]);
    assert!(kit.ends_with("replay it with: tautline replay kit-1-published-n2.jsonl\n"), "{kit}");
    // What `prove --out` stored of KIT plays as a run, and is minimised, too.
    let stored = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/kit-3-published.jsonl");
    assert!(printed(folder, &["page", stored, "--html", "kit.html"], 0).contains("KIT-3"));
    let played = read(folder, "kit.html");
    assert!(played.contains("kit (published), 2 robots"), "it plays the run");
    let kit = json(folder, &["minimise", stored, "--out", "minimal"], 0);
    assert_eq!((&kit["after"]["columns"], &kit["after"]["steps"]), (&3.into(), &3.into()));
}

#[test]
fn a_long_run_is_replayed_in_part_unless_all_of_it_is_asked_for() {
    let folder = &folder();
    printed(folder, &["explore", "cells:30x30:0.1", "--robots", "6", "--trace", "run.jsonl"], 0);
    let part = printed(folder, &["replay", "run.jsonl"], 0);
    assert!(part.lines().count() < 520, "{}", part.lines().count());
    assert!(part.ends_with("are not shown: --moves A..B shows some, --all every one.\n"), "{part}");
    let all = printed(folder, &["replay", "run.jsonl", "--all"], 0);
    assert!(
        all.lines().count() > part.lines().count() && all.contains("\nmove 1 ") && !all.contains("not shown")
    );
    assert!(
        refused(folder, &["replay", "run.jsonl", "--all", "--moves", "1..2"]).contains("cannot be used with")
    );
}
