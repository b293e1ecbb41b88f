//! KIT [Peiris, 6] on random lattices: how long one robot and two take to find the nodes (Fig. 9), and what is driven
//! by both when 23 of 26 paths are explored (Fig. 14).
//!
//! The paper gives neither its map nor its speeds. From its 88 % and 78 % follow 26 paths, of which 23 are
//! explored and 5 driven by both. So every layout here has 26 paths, all within reach of a node that is drawn as
//! the start, and there are four families of them: compact, long and branching ones. As published both robots
//! start there, one after the other, and run KIT at every node, our main reading, or only where the way ahead is
//! blocked, as the words of section 3 have it; repaired the second one starts beside. Robots drive at 0.3 m/s,
//! unless it is asked for something else, and each drive is up to a tenth faster or slower; with equal speeds,
//! robots as published may drive to and fro for ever.

mod charts;
mod drive;
mod figure;
mod lattice;
mod range;
mod text;

use tautline_kernel::ground::Cell;
use tautline_kernel::kit::Rule;

pub use self::drive::{EXPLORED, Outcome};
use self::drive::{Finds, driven, is_any};
use self::figure::Figure;
pub use self::figure::{Contest, Line, Race, Settings, Summary, TEAMS, Team, TeamRule};
use self::lattice::FAMILIES;
pub use self::lattice::PATHS;
pub use self::range::KitRange;
use super::prelude::*;
use tautline_sim::kit::{self, Pace};

/// Places in [`TEAMS`] of a team and the one that is to be sooner: two robots against one by each rule, as the paper
/// compares them, and two repaired robots against two by each reading.
const RACES: [[usize; 2]; 5] = [[0, 1], [2, 3], [4, 5], [1, 5], [3, 5]];

/// Places in [`TEAMS`] of one robot and of two as published, by each reading. The runs of two that never talk follow
/// those of the teams: each is the run of the one robot, and another one of it.
const TALKING: [[usize; 2]; 2] = [[0, 1], [2, 3]];

/// The seed of the second of two robots that do not talk is so far from that of the first.
const OTHER_SEED: u64 = 1 << 63;

/// The description that both figures share.
const ABOUT: Description = Description {
    examples: &["kit-fig14 --svg overlap.svg", "kit-fig9 --runs 100 --format json"],
    doing: "driving",
    pictures: &[("svg", "Store a chart")],
    takes: "a minute",
    ..Description::NOTHING
};

/// How long it takes to find the nodes.
pub const KIT_FIG9: Kit = Kit {
    figure: Figure::Time,
    about: Description {
        id: "kit-fig9",
        shows: "KIT: how long one robot and two take to find the nodes of random lattices",
        help: "How long robots that keep in touch take to find the nodes",
        ..ABOUT
    },
};

/// Figure 14: how much both robots drive.
pub const KIT_FIG14: Kit = Kit {
    figure: Figure::Overlap,
    about: Description {
        id: "kit-fig14",
        shows: "KIT: how many of the explored paths are driven by both robots when 88 % are explored, and \
            how long all take",
        help: "How much robots that keep in touch overlap",
        ..ABOUT
    },
};

/// Robots that keep in touch on random lattices.
#[derive(Clone, Copy, Debug)]
pub struct Kit {
    figure: Figure,
    about: Description,
}

/// A run of every team in one layout of a family.
type Job = Run<usize>;

impl Table for Kit {
    type Settings = Settings;
    type Job = Job;
    type Sample = [Outcome; TEAMS.len() + TALKING.len()];
    type Summary = Summary;

    fn about(&self) -> Description {
        self.about
    }

    fn jobs(&self, settings: &Settings) -> Result<Vec<Job>, Halt> {
        Ok(runs(0..FAMILIES.len(), |_| settings.layouts))
    }

    fn parts(&self, _: &Job) -> u64 {
        (TEAMS.len() + TALKING.len()) as u64
    }

    fn measure(&self, settings: &Settings, run: &Job, _: &dyn Observer) -> Result<Self::Sample, Halt> {
        let family = FAMILIES.get(run.at).copied().unwrap_or(FAMILIES[0]);
        let seed = run.seed(settings.seed);
        let (layout, start) = family.layout(seed)?;
        let pace = Pace { speed: settings.speed, spread: settings.spread };
        let mut teams = TEAMS.map(|team| follow(team, &layout, start, pace, seed));
        let silent = TALKING.map(|[one, _]| {
            let (_, others) = follow(TEAMS[one], &layout, start, pace, seed.wrapping_add(OTHER_SEED));
            std::mem::take(&mut teams[one].1).with(others).outcome()
        });
        let mut outcomes = teams.into_iter().map(|(outcome, _)| outcome).chain(silent);
        Ok(std::array::from_fn(|_| outcomes.next().unwrap_or_default()))
    }

    fn merge(&self, settings: &Settings, results: Results<Self>) -> Result<Summary, Halt> {
        let (mut lines, mut races, mut silence) = (Vec::new(), Vec::new(), Vec::new());
        for (place, family) in FAMILIES.into_iter().enumerate() {
            let teams = of_teams(&results, place);
            lines.extend(TEAMS.into_iter().zip(&teams).map(|(team, all)| Line::of(family, team, all)));
            races.extend(RACES.map(|places| Race::of(family, places, places.map(|place| &teams[place][..]))));
            silence.extend(TALKING.into_iter().enumerate().map(|(number, [_, two])| {
                let teams = [TEAMS.len() + number, two].map(|place| &teams[place][..]);
                Contest::of(self.figure, family, TEAMS[two].rule, teams)
            }));
        }
        let paper = text::of(self.figure, &lines, &races);
        Ok(Summary { settings: *settings, lines, races, silence, paper })
    }

    fn text(&self, settings: &Settings, merged: &Summary) -> Result<String, Halt> {
        Ok(text::told(self.figure, settings, merged))
    }

    fn sentences(&self, merged: &Summary) -> Vec<Judgement> {
        let mut judged = paper::judged(&merged.paper);
        if self.figure == Figure::Time {
            judged.extend(text::sooner(&merged.races));
            judged.extend(text::directions(&merged.lines));
        }
        judged.extend(text::talking(self.figure, &merged.silence));
        judged
    }

    fn draw(&self, _: usize, _: &Settings, merged: &Summary) -> Result<String, Halt> {
        Ok(charts::chart(self.figure, &merged.lines).svg())
    }

    /// A repaired team always keeps in touch, and one or two of its robots drive every path.
    fn is_broken(&self, merged: &Summary) -> bool {
        let is_broken = |line: &&Line| is_any(line.ended) && line.team.robots < 3 || is_any(line.cut);
        let mut repaired = merged.lines.iter().filter(|line| line.team.rule == TeamRule::Repaired);
        repaired.any(|line| is_broken(&line))
    }
}

fn follow(team: Team, layout: &Layout, start: Cell, pace: Pace, seed: u64) -> (Outcome, Finds) {
    let starts = match team.rule {
        TeamRule::Published | TeamRule::Ahead => vec![start; team.robots],
        TeamRule::Repaired => kit::starts(layout, start, team.robots),
    };
    driven(team.rule.of_kit(), layout, &starts, pace, seed)
}

impl TeamRule {
    /// The kernel's rule.
    const fn of_kit(self) -> Rule {
        match self {
            Self::Published => Rule::PUBLISHED,
            Self::Ahead => Rule::AHEAD,
            Self::Repaired => Rule::REPAIRED,
        }
    }
}
