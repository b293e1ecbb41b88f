//! Runs on small lattices that break a clause: the one with the fewest walls, the same run on a lattice that is
//! given, and what happens in it.

use std::ops::ControlFlow;

use tautline_kernel::ground::{Cell, Edge, EdgeMark, Grid, Side};
use tautline_kernel::kit::{Next, Rule, Sight};

use super::symmetry::SymmetricLattice;
use super::world::{Demand, Event, Setting, Speeds, Successor, World};
use crate::engine::states::{self, Findings, Run, System};
use crate::judge::kit::Contact;
use crate::judge::{AnyCase, Lattice, kit as judge};
use crate::plural::listed;
use crate::run::{self, Ending, ScriptedRun, Words, place, sides};

/// The first choice of runs at any speeds, and of those at equal ones.
pub const ANY_SPEEDS: u32 = 0;
/// As [`ANY_SPEEDS`].
pub const EQUAL_SPEEDS: u32 = 1;

/// A run that breaks a demand, and where.
#[derive(Clone, Debug)]
pub struct Counterexample<const ROBOTS: usize> {
    /// The lattice, and the most walls that the run may meet.
    pub setting: Setting<ROBOTS>,
    /// The run.
    pub run: Run<Demand>,
}

/// The shortest run with the fewest walls that breaks `demand` on the lattice of `setting`; `None` if there is none
/// within the walls of `setting`. It breaks off where `look`, which searches a setting, does.
pub fn fewest<const ROBOTS: usize>(
    setting: Setting<ROBOTS>,
    demand: Demand,
    mut look: impl FnMut(&Setting<ROBOTS>) -> ControlFlow<(), Findings<Demand>>,
) -> ControlFlow<(), Option<Counterexample<ROBOTS>>> {
    for max_walls in 0..=setting.max_walls {
        let setting = Setting { max_walls, demand: Some(demand), ..setting };
        if let Some(run) = look(&setting)?.broken.into_iter().next() {
            return ControlFlow::Continue(Some(Counterexample { setting, run }));
        }
    }
    ControlFlow::Continue(None)
}

impl Counterexample<2> {
    /// The run on the lattice of `setting` whose image `run` is, a run on the [`SymmetricLattice`]; `None` if it goes
    /// round, since there another robot may be bound to act.
    pub fn of_image(setting: Setting<2>, run: &Run<Demand>) -> Option<Self> {
        if matches!(run.ending, states::Ending::Round(_)) {
            return None;
        }
        let lattice = SymmetricLattice::new(setting);
        let canonical = |world: &World<2>| {
            let mut least = *world;
            lattice.make_canonical(&mut least);
            least
        };
        let mut world = setting.starts().into_iter().nth(run.start)?;
        let mut steps = Vec::new();
        for (_, step) in run.played(&lattice, canonical(&world)) {
            let is_last = steps.len() + 1 == run.steps.len() && run.ending == states::Ending::There;
            let is_image = |turned: &Successor<2>| {
                canonical(&turned.world) == canonical(&step.state)
                    && (!is_last || turned.breaks.contains(&run.demand))
            };
            let mut turns = (0..).zip(setting.turns(&world));
            let (number, turned) = turns.find(|(_, turned)| is_image(turned))?;
            steps.push(number);
            world = turned.world;
        }
        (steps.len() == run.steps.len()).then(|| Self { setting, run: Run { steps, ..run.clone() } })
    }
}

impl<const ROBOTS: usize> Counterexample<ROBOTS> {
    /// The world at the start, and each step; fewer steps if the run is not one of the setting.
    fn steps(&self) -> Option<(World<ROBOTS>, Vec<Successor<ROBOTS>>)> {
        let start = self.setting.starts().into_iter().nth(self.run.start)?;
        let mut steps: Vec<Successor<ROBOTS>> = Vec::new();
        for &number in self.run.steps.iter().chain(self.run.round()) {
            let world = steps.last().map_or(&start, |turned| &turned.world);
            let Some(turned) = self.setting.turns(world).into_iter().nth(number as usize) else { break };
            steps.push(turned);
        }
        Some((start, steps))
    }

    /// Where the robots start.
    pub fn starts(&self) -> Option<[Cell; ROBOTS]> {
        let (start, _) = self.steps()?;
        let cells: Vec<Cell> = (0..ROBOTS).filter_map(|robot| Some(start.team.stance(robot)?.to())).collect();
        cells.try_into().ok()
    }

    /// The walls that the run has met, and the number of each step where these are given, and no others.
    pub fn given(&self) -> Option<(Vec<Edge>, Vec<u32>)> {
        let (start, steps) = self.steps()?;
        let truth = steps.last().map_or(start.truth, |turned| turned.world.truth);
        let walls = self.setting.area.edges().filter(|&edge| truth.edge_has(EdgeMark::Wall, edge));
        let setting = Setting { given: Some(truth), demand: None, ..self.setting };
        let mut world = start;
        let numbers = steps.iter().map(|step| {
            let turns = setting.turns(&world);
            let number = turns.iter().position(|turned| turned.events == step.events)?;
            world = turns[number].world;
            Some(number as u32)
        });
        let numbers = numbers.collect::<Option<Vec<u32>>>()?;
        Some((walls.collect(), numbers))
    }

    /// The choices that make the run on a lattice that has the walls that it met: the first one says whether robots
    /// drive at equal speeds. `None` if a search of such runs is none of robots that drive side by side.
    pub fn scripted(&self) -> Option<ScriptedRun> {
        let Self { setting, run } = self;
        let (speeds, clause) = match (setting.speeds, run.demand) {
            // A run that loses contact where both stand has lost it before.
            (_, Demand::AtNodes) | (Speeds::OneByOne, _) => return None,
            (Speeds::Any, demand) => (ANY_SPEEDS, demand.clause(ROBOTS)),
            (Speeds::Equal, Demand::Contact) => (EQUAL_SPEEDS, "KIT-2"),
            (Speeds::Equal, demand) => (EQUAL_SPEEDS, demand.clause(ROBOTS)),
        };
        let (walls, steps) = self.given()?;
        let starts = self.starts()?.to_vec();
        let ending = if run.round().is_empty() { Ending::Move } else { Ending::Endless };
        let (frames, obstacles, breaks) = (Vec::new(), Vec::new(), Some(clause));
        let words = Words::default();
        let run = run::Run {
            scheme: "kit",
            area: setting.area,
            starts,
            walls,
            obstacles,
            frames,
            breaks,
            ending,
            words,
        };
        Some(ScriptedRun { run, choices: [&[speeds], &steps[..]].concat() })
    }

    /// Drives from the start on, those of a round once.
    pub fn drives(&self) -> usize {
        let steps = self.steps().map_or_else(Vec::new, |(_, steps)| steps);
        let events = steps.iter().flat_map(|turned| &turned.events);
        events.filter(|event| matches!(event, Event::Decides(.., Next::Drives(_)))).count()
    }

    /// The run written down for the judge, if there is one for it.
    pub(super) fn case(&self) -> Option<Box<dyn AnyCase>> {
        let Self { setting, run } = self;
        let clause = match (setting.speeds, run.demand) {
            (Speeds::Equal, Demand::Contact) => "KIT-2",
            (Speeds::Any | Speeds::Equal | Speeds::OneByOne, demand) => demand.clause(ROBOTS),
        };
        let walls = self.given()?.0;
        let (start, steps) = self.steps()?;
        case(clause, (setting, &walls), &start, steps, run.round().len())
    }

    /// The events, a line for each.
    pub fn story(&self) -> String {
        let (width, height) = (self.setting.area.width(), self.setting.area.height());
        let mut lines = format!("{width}×{height} nodes, 3 m apart\n");
        let Some((start, steps)) = self.steps() else { return lines };
        let starts = (0..ROBOTS).filter_map(|robot| Some((robot + 1, start.team.stance(robot)?.to())));
        lines += &listed(starts.map(|(robot, node)| format!("R{robot} starts at {node}")));
        lines.push('\n');
        for (number, turned) in steps.iter().enumerate() {
            if number == self.run.steps.len() {
                lines += "and from here on over and over:\n";
            }
            for event in &turned.events {
                lines += &words(event);
                lines.push('\n');
            }
        }
        lines
    }
}

/// A run from `start` on, with these walls and steps, of which the last `round` come again for ever, said to break
/// `clause`: written down for the judge of two robots by the published rule, or of three by the repaired one; `None` if
/// it is no such run, or the judge does not know the clause.
pub fn case<const ROBOTS: usize>(
    clause: &'static str,
    (setting, walls): (&Setting<ROBOTS>, &[Edge]),
    start: &World<ROBOTS>,
    steps: Vec<Successor<ROBOTS>>,
    round: usize,
) -> Option<Box<dyn AnyCase>> {
    let Setting { rule, area, speeds, demand, .. } = *setting;
    let barred = walls.iter().copied().map(sides).collect();
    let lattice = Lattice { columns: area.width() as i32, rows: area.height() as i32, barred };
    let starts = start.team.robots().iter().map(|robot| place(robot.stance.to())).collect();
    let events = steps.into_iter().flat_map(|turned| turned.events);
    let steps = events.map(|event| written(&event)).collect::<Option<Vec<_>>>()?;
    let speeds = match speeds {
        Speeds::Any => judge::Speeds::Any,
        Speeds::Equal => judge::Speeds::Equal,
        Speeds::OneByOne => return None,
    };
    let reading = match rule {
        Rule::PUBLISHED => judge::Reading::Published,
        Rule::AHEAD => judge::Reading::Ahead,
        Rule::REPAIRED if judge::Party::knows(clause) && ROBOTS > 2 && speeds == judge::Speeds::Any => {
            return Some(Box::new(judge::Party { clause, lattice, starts, steps }));
        }
        _ => return None,
    };
    let contact = if demand == Some(Demand::AtNodes) { Contact::AtNodes } else { Contact::AllTheTime };
    let run = judge::Run { clause, reading, speeds, contact, lattice, starts, steps, round };
    (ROBOTS == 2 && judge::Run::knows(clause)).then(|| Box::new(run) as Box<dyn AnyCase>)
}

/// An event as the judge reads it.
fn written(event: &Event) -> Option<judge::Step> {
    let look = |&(side, sight): &(Side, Sight)| {
        let sees = match sight {
            Sight::Free => judge::Sees::Free,
            Sight::Obstacle => judge::Sees::Obstacle,
            Sight::Robot => judge::Sees::Robot,
        };
        judge::Look { side: side as usize, sees }
    };
    let (robot, what, looks) = match event {
        &Event::Arrives(robot, _) => (robot, judge::What::Arrives, Vec::new()),
        Event::Decides(robot, looks, next) => {
            let what = match next {
                Next::Drives(_) => judge::What::Drives,
                Next::Stays => judge::What::Stays,
                Next::Done => judge::What::IsDone,
                Next::Looks(_) => return None,
            };
            (*robot, what, looks.iter().map(look).collect())
        }
    };
    Some(judge::Step { robot, what, looks })
}

/// An event in words.
pub fn words(event: &Event) -> String {
    match event {
        Event::Arrives(robot, node) => format!("R{} arrives at {node}", robot + 1),
        Event::Decides(robot, looks, next) => {
            let look = |&(side, sight): &(Side, Sight)| {
                let side = run::name_of(side);
                let sight = match sight {
                    Sight::Free => "free",
                    Sight::Obstacle => "blocked",
                    Sight::Robot => "a robot",
                };
                format!("looks {side}: {sight}; ")
            };
            let looks: String = looks.iter().map(look).collect();
            let next = match next {
                Next::Drives(to) => format!("drives to {to}"),
                Next::Stays | Next::Looks(_) => "stays".to_owned(),
                Next::Done => "is done".to_owned(),
            };
            format!("R{} {looks}{next}", robot + 1)
        }
    }
}
