//! Seeds: each scheme takes one in any layout where it draws something, and the command on a page has it.

use tautline_papers::rivals::CATALOGUE;
use tautline_sim::explore::{By, Profile};

use super::*;

/// Rules and options, one for each kind of draw, by which a run of `scheme` draws something.
fn told(scheme: &Profile) -> Vec<Vec<String>> {
    let words = |by: &By| match by {
        By::Every => String::new(),
        By::Miss => "--miss 0.2".to_owned(),
        By::Told(extra) => match extra.field {
            "speeds" => "--speeds".to_owned(),
            field @ ("loss" | "small") => format!("--{field} 0.3"),
            "odometry" => "--odometry 0.3:20".to_owned(),
            field => format!("--{field} 6"),
        },
        By::Rule(rule) => format!("--rule {rule}"),
    };
    let each = scheme.drawn.iter().map(|drawn| words(&drawn.by));
    each.map(|words| words.split_whitespace().map(str::to_owned).collect()).collect()
}

/// The text that a page has for `key`, as JSON.
fn on_page(page: &str, key: &str) -> String {
    let (_, film) = page.split_once("id=\"film\">").expect("a film");
    let film: Value = serde_json::from_str(film.split("</script>").next().expect("its end")).expect("JSON");
    film["again"][key].as_str().expect("text").to_owned()
}

#[test]
fn the_command_on_a_page_makes_its_run_again_in_an_own_map() {
    let mut again = 0;
    for scheme in CATALOGUE.schemes() {
        for told in told(&scheme) {
            let folder = &folder();
            let explore =
                ["explore", "cells:6x6:0.1", "--seed", "5", "--robots", "3", "--scheme", scheme.name];
            let rule = scheme.rules[0].name;
            let rule: &[&str] =
                if told.contains(&"--rule".to_owned()) { &[] } else { &["--rule", rule.as_str()] };
            let told: Vec<&str> = told.iter().map(String::as_str).collect();
            let files = ["--html", "run.html", "--trace", "run.jsonl", "--max-moves", "30"];
            let output = ran(folder, &[&explore, rule, &told, &files].concat());
            assert!(matches!(output.status.code(), Some(0 | 1)), "{}, {told:?}: {output:?}", scheme.name);
            let page = read(folder, "run.html");
            write(folder, "own.txt", on_page(&page, "layout"));
            let command = on_page(&page, "command");
            assert!(command.contains(" --seed 5 "), "{command}");
            let words = command.replace("LAYOUT", "own.txt").replace("run.html", "again.html");
            let words: Vec<&str> =
                words.split_whitespace().skip(1).chain(["--trace", "again.jsonl"]).collect();
            assert_eq!(ran(folder, &words).status.code(), output.status.code(), "{command}");
            let [run, same] = ["run.jsonl", "again.jsonl"].map(|name| read(folder, name));
            assert_eq!(run, same, "{command}");
            again += 1;
        }
    }
    assert!(again >= CATALOGUE.schemes().count(), "{again}");
}

#[test]
fn a_seed_that_draws_nothing_is_refused_with_what_would_be_drawn() {
    let folder = &folder();
    let said: Vec<String> = CATALOGUE
        .schemes()
        .filter(|scheme| scheme.drawn.iter().all(|drawn| drawn.by != By::Every))
        .map(|scheme| {
            let rule = scheme.rules[0].name;
            let robots = scheme.robots.end().min(&2).to_string();
            let arguments =
                ["explore", "open:5x5", "--seed", "3", "--robots", &robots, "--scheme", scheme.name];
            let arguments = [&arguments[..], &["--rule", rule.as_str()]].concat();
            format!("{}: {}\n", scheme.name, refused(folder, &arguments))
        })
        .collect();
    assert_snapshot!(said.join("\n"));
    assert!(refused(folder, &["show", "open:5x5", "--seed", "3"]).contains("nothing here is left to chance"));
}

#[test]
fn a_number_that_nobody_writes_out_has_an_exponent_in_texts_and_commands() {
    let folder = &folder();
    let frontier =
        "explore open:3x3 --scheme frontier --robots 2 --loss 1e-320 --noise-db 1e-31 --odometry 1e-9:1e-30";
    let rescue = "rescue --seeds 0 --loss 1e-320 --noise-db 1e-310 --shadowing-db 1e-300 --robot 1e-312,1";
    for (command, numbers) in [
        (frontier, &["--loss 1e-320", "--noise-db 1e-31", "--odometry 0.000000001:1e-30"][..]),
        ("explore open:3x3 --scheme kit --robots 2 --spread 1e-320", &["--spread 1e-320"]),
        (rescue, &["--loss 1e-320", "--noise-db 1e-310", "--shadowing-db 1e-300", "--robot 1e-312,1"]),
    ] {
        let asked: Vec<&str> = command.split(' ').chain(["--html", "run.html", "--force"]).collect();
        let told = ran(folder, &asked);
        let told = String::from_utf8(told.stdout).expect("text");
        assert!(!told.contains("0000000000"), "{told}");
        says(&on_page(&read(folder, "run.html"), "command"), numbers);
    }
    let told = printed(folder, &["locate", "--noise-db", "1e-300", "--runs", "3"], 0);
    assert!(told.contains(", noise 1e-300 dB,"), "{told}");
    says(&refused(folder, &["rescue", "--range", "1e300"]), &["the radio range cannot be 1e300 m"]);
}
