//! Agents on the floors of offices [Ferranti 2009, V.B]: how much is explored and marked as visited by Brick&Mortar,
//! Ants and Brick&Mortar with ants' ways where sensors are missed, by the number of agents (Fig. 11) and by the area
//! (Fig. 12); and how long they take where none is (the idealized conditions that the paper takes from its reference
//! 2).
//!
//! Layouts are `office:SIDExSIDE:4x4`, all agents start at the cell nearest the centre if nothing else is said, and all
//! teams get the same layouts, seeds and starts. A run that goes on is ended after a number of agents' steps, and
//! counted.

mod charts;
mod figure;
mod start;
mod team;
mod text;

use self::figure::Figure;
pub use self::figure::{Duration, Line, Summary};
pub use self::start::Start;
pub(super) use self::team::Crew;
pub use self::team::{Outcome, TEAMS, Team};
use super::prelude::*;

/// The description that all figures of agents share.
const ABOUT: Description = Description {
    examples: &["bricks-fig11 --svg fig11.svg", "bricks-ideal --runs 20 --format json"],
    doing: "exploring",
    pictures: &[("svg", "Store a chart")],
    takes: "a minute",
    ..Description::NOTHING
};

/// Figure 11.
pub const BRICKS_FIG11: Agents = Agents {
    figure: Figure::Agents,
    about: Description {
        id: "bricks-fig11",
        shows: "Brick&Mortar, Ants and both together in offices, 5.56 % of the sensors missed: what they \
            explore and mark as visited, by the number of agents",
        help: "What agents explore by their number, with missed sensors",
        ..ABOUT
    },
};

/// Figure 12.
pub const BRICKS_FIG12: Agents = Agents {
    figure: Figure::Area,
    about: Description {
        id: "bricks-fig12",
        shows: "Brick&Mortar, Ants and both together in offices, 5.56 % of the sensors missed: what 20 \
            agents explore and mark as visited, by the area",
        help: "What agents explore by the area, with missed sensors",
        ..ABOUT
    },
};

/// The work of agents where no sensor is missed.
pub const BRICKS_IDEAL: Agents = Agents {
    figure: Figure::Ideal,
    about: Description {
        id: "bricks-ideal",
        shows: "Brick&Mortar, Ants and both together in offices, no sensor missed: how long until \
            everything is explored, and until all agents know it, by the number of agents",
        help: "How long agents take, with none missed",
        takes: "some seconds",
        ..ABOUT
    },
};

/// Agents on the floors of offices.
#[derive(Clone, Copy, Debug)]
pub struct Agents {
    figure: Figure,
    about: Description,
}

settings! {
    /// How much is measured.
    #[derive(Copy, Eq)]
    pub struct Settings {
        /// Random layouts at each point
        pub layouts: u32 = 200, one("runs", "COUNT", from_to(1..=100_000));
        /// The seed of the first layout and its runs; the others have the seeds after it
        pub seed: u64 = 0, one("seed", "SEED", number);
        /// Steps of all agents together after which a run is ended
        pub max_steps: u32 = 200_000, one("max-steps", "STEPS", from_to(1..=u32::MAX.into()));
        /// Where the agents start
        pub starts: Start = Start::Centre, word("starts", "WHERE");
    }
}

/// A run of every team in one layout with so many cells on a side, and of so many agents.
type Job = Run<(u16, u16)>;

impl Table for Agents {
    type Settings = Settings;
    type Job = Job;
    type Sample = Vec<Outcome>;
    type Summary = Summary;

    fn about(&self) -> Description {
        self.about
    }

    fn jobs(&self, settings: &Settings) -> Result<Vec<Job>, Halt> {
        Ok(runs(self.figure.points(), |_| settings.layouts))
    }

    fn parts(&self, _: &Job) -> u64 {
        self.figure.runs().len() as u64
    }

    fn measure(&self, settings: &Settings, run: &Job, _: &dyn Observer) -> Result<Self::Sample, Halt> {
        let ((side, agents), seed) = (run.at, run.seed(settings.seed));
        let layout = generated(&format!("office:{side}x{side}:4x4"), seed)?;
        let starts = settings.starts.cells(&layout, agents, seed)?;
        let run = |(team, miss): (Team, _)| team.crew.run(&layout, &starts, (miss, seed), settings.max_steps);
        Ok(self.figure.runs().into_iter().map(run).collect())
    }

    fn merge(&self, settings: &Settings, results: Results<Self>) -> Result<Summary, Halt> {
        let Settings { layouts, seed, max_steps, starts } = *settings;
        let lines_at = |(side, agents)| {
            let here = at(&results, (side, agents));
            let line = |(place, (team, _))| {
                let outcomes: Vec<&Outcome> =
                    here.iter().filter_map(|outcomes| outcomes.get(place)).collect();
                Some((place, Line::of(team, side, agents, &outcomes)?))
            };
            self.figure.runs().into_iter().enumerate().filter_map(line).collect::<Vec<_>>()
        };
        let teams = self.figure.teams().len();
        let all = self.figure.points().into_iter().flat_map(lines_at);
        let (lines, unmissed): (Vec<_>, Vec<_>) = all.partition(|&(place, _)| place < teams);
        let [lines, unmissed]: [Vec<Line>; 2] =
            [lines, unmissed].map(|lines| lines.into_iter().map(|(_, line)| line).collect());
        let paper = text::of(self.figure, &lines);
        let miss = self.figure.miss().into();
        Ok(Summary { layouts, seed, miss, max_steps, starts, lines, unmissed, paper })
    }

    fn text(&self, _: &Settings, merged: &Summary) -> Result<String, Halt> {
        Ok(text::text(self.figure, merged))
    }

    fn sentences(&self, merged: &Summary) -> Vec<Judgement> {
        let mut judged = paper::judged(&merged.paper);
        judged.extend(text::judged(self.figure, merged));
        judged
    }

    fn draw(&self, _: usize, _: &Settings, merged: &Summary) -> Result<String, Halt> {
        Ok(charts::chart(self.figure, &merged.lines).svg())
    }
}
