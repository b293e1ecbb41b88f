//! Same seed, same run: how many team moves every rule of every scheme takes in five layouts, and a checksum of them. A
//! change that is to make a rule faster changes nothing here; one that changes what robots do shows where.

use std::fmt::Write;
use std::num::NonZeroU32;

use crc32fast::Hasher;
use insta::assert_snapshot;
use tautline_grids::chance::Probability;
use tautline_grids::layout::Generator;
use tautline_kernel::ground::Cell;
use tautline_papers::rivals::CATALOGUE;
use tautline_sim::explore::{
    ExplorationRequest, Limits, Profile, Rule, Scene, Scheme, Senses, StopReason, explore,
};
use tautline_sim::failures::{Compass, Failure, WallAppearance};
use tautline_sim::options::Extra;

/// The layouts, and how many robots explore each, the base counted.
const LAYOUTS: [(&str, u64); 5] = [
    ("walls:7x6:0.25", 4),
    ("cells:12x10:0.2", 6),
    ("office:14x12:3x2", 8),
    ("walls:20x16:0.1", 13),
    ("cells:24x18:0.15", 5),
];

/// An event of a run.
#[derive(Clone, Copy, Debug)]
enum Event {
    Nothing,
    MissedSensors,
    LostMessages,
    ShortSight,
    Death,
    Wall,
}

impl Event {
    const ALL: [Self; 6] =
        [Self::Nothing, Self::MissedSensors, Self::LostMessages, Self::ShortSight, Self::Death, Self::Wall];

    fn can_befall(self, scheme: &Profile) -> bool {
        match self {
            Self::Nothing => true,
            Self::MissedSensors => scheme.senses == Senses::Floor,
            Self::LostMessages => scheme.extras.contains(&Extra::LOSS),
            Self::ShortSight => scheme.extras.contains(&Extra::SIGHT),
            Self::Death => scheme.extras.contains(&Extra::FAIL),
            Self::Wall => scheme.extras.contains(&Extra::WALL),
        }
    }

    fn befalls(self, asked: &mut ExplorationRequest) {
        let step = NonZeroU32::new(9).expect("not 0");
        match self {
            Self::Nothing => {}
            Self::MissedSensors => asked.miss = Probability::new(0.1),
            Self::LostMessages => {
                asked.options.loss = Probability::new(0.2).expect("a probability");
                asked.options.range_cells = asked.scheme.extras.contains(&Extra::RANGE).then_some(6);
            }
            Self::ShortSight => (asked.options.sight_cells, asked.options.range_cells) = (Some(3), Some(6)),
            Self::Death => asked.options.fail = Some(Failure { robot: 3, step }),
            Self::Wall => {
                asked.options.wall = Some(WallAppearance { cell: Cell::new(3, 3), side: Compass::E, step });
            }
        }
    }
}

/// The team moves of a run, with a sign if it does not end by all being explored; and a checksum of what robots and
/// others did.
fn run(scheme: Scheme, rule: &Rule, event: Event, layout: &str, robots: u64) -> Option<(String, u32)> {
    let generator: Generator = layout.parse().expect("a generator");
    let limits = Limits { max_moves: NonZeroU32::new(300), ..Limits::default() };
    let mut asked = ExplorationRequest {
        robots: Some(robots),
        seed: 7,
        limits,
        ..ExplorationRequest::new(scheme, rule.name)
    };
    event.befalls(&mut asked);
    let setup = asked.setup(generator.generate(7).expect("a layout")).ok()?;
    let mut done = Hasher::new();
    let report = explore(&setup, &mut |made| {
        for (step, &blocked) in made.frame.steps.iter().zip(&made.frame.blocked) {
            done.update(&[step.place() as u8, blocked.into()]);
        }
        let mut scene = Scene::default();
        made.team.show(made.before, &mut scene);
        done.update(format!("{:?}", scene.changes()).as_bytes());
        Ok(())
    });
    let report = report.ok()?;
    let sign = match report.stopped {
        StopReason::Explored => "",
        StopReason::Exhausted => "-",
        _ => "+",
    };
    Some((format!("{}{sign}", report.steps), done.finalize()))
}

#[test]
fn every_rule_makes_the_moves_that_it_made() {
    let mut table = String::new();
    for scheme in CATALOGUE.schemes() {
        for (rule, event) in scheme.rules.iter().flat_map(|rule| Event::ALL.map(|event| (rule, event))) {
            if !event.can_befall(&scheme) {
                continue;
            }
            let runs = LAYOUTS.map(|(layout, robots)| run(scheme, rule, event, layout, robots));
            let mut all = Hasher::new();
            write!(table, "{:<13}{:<16}{:<14}", scheme.name, rule.name.as_str(), format!("{event:?}"))
                .expect("text");
            for made in &runs {
                let (moves, sum) = made.clone().unwrap_or_default();
                write!(table, "{moves:>7}").expect("text");
                all.update(&sum.to_le_bytes());
            }
            writeln!(table, "  {:08x}", all.finalize()).expect("text");
        }
    }
    assert_snapshot!(table);
}
