//! The recursive chain [Kovács 2011, III]: its row, and its team: the kernel's chain, the log of messages that it reads
//! its history from, and the smallest grid that holds its area.

mod areas;
mod checkpoint;
mod faulty;
pub mod hunt;
mod shown;

use tautline_kernel::chain::{self, Chain, Intent, MAX_ROBOTS, Plan, Refused};
use tautline_kernel::ground::{Area, Cell, Edge, Grid, MediumGrid, SmallGrid};
use tautline_proofs::chain::Observed;
use tautline_proofs::chain::breach::{Breach, CHEAP_LOOKS, frame};
use tautline_proofs::chain::links::within_reach;
use tautline_proofs::plural::counted;
use tautline_proofs::run::Frame;

pub use self::checkpoint::Saved;
use self::faulty::Faulty;
pub use self::faulty::{ANY_ORDER, DEATH};
use self::hunt::Walls;
use super::clause::ClauseId;
use super::rule::RuleId;
use super::run::{End, Team, TeamMove};
use super::scene::{Layer, Scene};
use super::setup::{By, Clause, Drawn, Judge, Look, Profile, Rule, Senses, Setup, Starts};
use super::survey::Survey;
use crate::diagnostic::Diagnostic;
use crate::heap_grid::HeapGrid;
use crate::layout::Layout;
use crate::options::{Extra, Options};

/// The rule that reels the chain in and out instead of backtracking, and holds contact whoever fails.
pub const REEL: RuleId = RuleId::new("reel");
/// The same without *Hold*.
pub const UNHELD: RuleId = RuleId::new("unheld");

/// A base, a leader that seeks the frontier, and followers that keep radio contact.
pub static CHAIN: Profile = Profile {
    name: "chain",
    about: "A base, a leader that seeks the frontier, and followers that keep radio contact",
    rules: &[
        Rule::published(|setup| start(setup, chain::Rule::PUBLISHED), &Walls(Observed::PUBLISHED)),
        Rule::repaired(|setup| start(setup, chain::Rule::REPAIRED), &Walls(Observed::REPAIRED)),
        Rule {
            name: REEL,
            about: "Within the repaired conditions, the shortest rehearsed way to an unexplored cell",
            start: |setup| start(setup, chain::Rule::REEL),
            hunt: Some(&Walls(Observed::REEL)),
        },
        Rule {
            name: UNHELD,
            about: "The reel without the condition that holds contact whoever fails",
            start: |setup| start(setup, Observed::UNHELD.rule),
            hunt: Some(&Walls(Observed::UNHELD)),
        },
    ],
    team: "chain",
    robots: 2..=MAX_ROBOTS,
    starts: Starts::Base,
    senses: Senses::Bumps,
    extras: &[Extra::LOSS, Extra::FAIL, Extra::WALL, Extra::SPEEDS],
    drawn: &[
        Drawn { what: "which bytes are lost", by: By::Told(Extra::LOSS) },
        Drawn { what: "in which order the robots go", by: By::Told(Extra::SPEEDS) },
    ],
    look: Look::Linked {
        is_lost: |from, to| Breach::Contact.is_in(from, to) || Breach::Coverage.is_in(from, to),
    },
    knowledge: None,
    clauses: &[
        Clause {
            judge: Some(Judge::Chain),
            told: |_, _, made| far_apart(made),
            ..Clause::new(Breach::Contact.clause())
        },
        Clause {
            judge: Some(Judge::Chain),
            told: |_, _, made| crowded(&made.frame.cells),
            ..Clause::new(Breach::Crowding.clause())
        },
        Clause {
            judge: Some(Judge::Chain),
            told: |_, _, made| out_of_range(made),
            ..Clause::new(Breach::Coverage.clause())
        },
        Clause::new(Breach::Costly.clause()),
        Clause {
            judge: Some(Judge::Chain),
            missed: Some("Within reach and unexplored"),
            ..Clause::new(Breach::Completeness.clause())
        },
        Clause::new(ANY_ORDER.as_str()),
        Clause { missed: Some("Within reach of those left and unexplored"), ..Clause::new(DEATH.as_str()) },
    ],
};

struct ChainTeam<G, const ROBOTS: usize> {
    chain: Chain<G, ROBOTS>,
    log: Vec<u8>,
    /// Epochs before the last team move.
    epochs: u32,
}

/// The chain of `setup`, all robots at the base.
fn start(setup: &Setup, rule: chain::Rule) -> Result<Box<dyn Team>, Diagnostic> {
    match setup.robots {
        0..=8 => begin::<_, 8>(setup, rule, SmallGrid::new),
        9..=32 => begin::<_, 32>(setup, rule, MediumGrid::new),
        _ => begin::<_, MAX_ROBOTS>(setup, rule, |area| Some(HeapGrid::new(area))),
    }
    .map_err(fault)
}

fn begin<G: Grid + 'static, const ROBOTS: usize>(
    setup: &Setup,
    rule: chain::Rule,
    grid: impl Fn(Area) -> Option<G>,
) -> Result<Box<dyn Team>, Refused> {
    let (base, robots) = (setup.base, usize::from(setup.robots));
    let area = chain::area(setup.layout.size().area(), base, robots).ok_or(Refused::BaseOutside { base })?;
    let grid = grid(area).ok_or(Refused::TooManyRobots { robots, most: ROBOTS })?;
    let chain = Chain::<G, ROBOTS>::new(rule, robots, base, grid)?;
    let Options { loss, fail, wall, going, .. } = setup.options;
    if loss.is_never() && fail.is_none() && wall.is_none() && going.is_usual() {
        return Ok(Box::new(ChainTeam { chain, log: Vec::new(), epochs: 0 }));
    }
    Ok(Box::new(Faulty::new(setup, chain)))
}

/// The fault of a chain that is refused.
fn fault(refused: Refused) -> Diagnostic {
    match refused {
        Refused::TooFewRobots { .. } | Refused::TooManyRobots { .. } => {
            let remedy = format!("give `robots` a number from 2 to {MAX_ROBOTS}");
            Diagnostic::of_field("robots", refused, remedy)
        }
        Refused::BaseOutside { .. } => {
            Diagnostic::of_field("base", refused, "give `base` a free cell of the layout")
        }
    }
}

/// The next team move of a chain that reads its own log; its end if there is none.
fn planned<G: Grid, const ROBOTS: usize>(
    chain: &mut Chain<G, ROBOTS>,
    log: &[u8],
) -> Result<Plan<ROBOTS>, End> {
    match chain.plan(log) {
        Ok(Intent::Go(plan)) => Ok(plan),
        Ok(Intent::Done(chain::End::Explored)) => Err(End::Explored),
        Ok(Intent::Done(chain::End::Exhausted)) => Err(End::Exhausted),
        Err(damaged) => unreachable!("the log holds what the chain has sent, but {damaged}"),
    }
}

/// Whether the last plan of a chain looked at more candidates than its budget.
fn is_costly<G: Grid, const ROBOTS: usize>(chain: &Chain<G, ROBOTS>) -> bool {
    chain.looked_at() > CHEAP_LOOKS * chain.cells().len() as u32
}

/// The cells within reach of so many robots from `base` that are unexplored.
fn left_out(layout: &Layout, chart: &Survey, base: Cell, robots: usize) -> Vec<Cell> {
    let due = within_reach(chart.area(), base, robots, |edge| layout.is_open(edge));
    due.into_iter().filter(|&cell| chart.step(cell).is_none()).collect()
}

impl<G: Grid, const ROBOTS: usize> Team for ChainTeam<G, ROBOTS> {
    fn cells(&self) -> &[Cell] {
        self.chain.cells()
    }

    fn advance(&mut self, is_open: &mut dyn FnMut(Edge) -> bool) -> Result<Frame, End> {
        self.epochs = self.chain.epochs();
        let plan = planned(&mut self.chain, &self.log)?;
        let settled = self.chain.settle(&plan, is_open);
        self.log.extend_from_slice(settled.messages());
        Ok(frame(plan.kind, settled.messages(), self.chain.cells()))
    }

    fn area(&self, _: &Layout) -> Area {
        self.chain.grid().area()
    }

    fn missed(&self, layout: &Layout, chart: &Survey) -> Vec<Cell> {
        left_out(layout, chart, self.cells()[0], self.cells().len())
    }

    fn broken_in_move(&self, before: &[Cell], frame: &Frame) -> Vec<ClauseId> {
        let seen = Breach::CHAIN.into_iter().filter(|breach| breach.is_in(before, &frame.cells));
        seen.chain(is_costly(&self.chain).then_some(Breach::Costly)).map(ClauseId::from).collect()
    }

    fn broken_at_end(&self, layout: &Layout, chart: &Survey, _: End) -> Vec<ClauseId> {
        if self.missed(layout, chart).is_empty() { Vec::new() } else { vec![Breach::Completeness.into()] }
    }

    fn layers(&self) -> Vec<Layer> {
        shown::layers()
    }

    fn show(&self, before: &[Cell], scene: &mut Scene) {
        shown::show(self.chain.grid(), before, self.epochs < self.chain.epochs(), scene);
    }
}

/// The neighbours in the chain that are out of contact.
fn far_apart(made: &TeamMove<'_>) -> Vec<String> {
    let told = |(robot, pair): (usize, [Cell; 2])| {
        let apart = apart(pair);
        format!("So R_{} is {apart} from R_{robot}: outside E_C, its cell is not wholly covered.", robot + 1)
    };
    pairs(Breach::Contact, made).map(told).collect()
}

/// The neighbours in the chain that may have left each other's range.
fn out_of_range(made: &TeamMove<'_>) -> Vec<String> {
    let told = |(robot, pair): (usize, [Cell; 2])| {
        let apart = apart(pair);
        format!("So the centres of R_{robot} and R_{}, {apart} apart in the end, may leave r_cov.", robot + 1)
    };
    pairs(Breach::Coverage, made).map(told).collect()
}

/// The robots that are too many in one cell.
fn crowded(team: &[Cell]) -> Vec<String> {
    let mut crowded: Vec<Cell> = team.iter().copied().filter(|&cell| cell != team[0]).collect();
    crowded.sort_unstable();
    crowded
        .chunk_by(|one, other| one == other)
        .filter(|cells| cells.len() > 2)
        .map(|cells| {
            let here = (1..).zip(team).filter(|&(_, &cell)| cell == cells[0]);
            let robots: Vec<String> = here.map(|(robot, _)| format!("R_{robot}")).collect();
            format!("So {} are in one cell, {}.", robots.join(", "), cells[0])
        })
        .collect()
}

/// The neighbours in the chain that commit `breach` by themselves: the number of the one behind, and where they are.
fn pairs<'a>(breach: Breach, made: &TeamMove<'a>) -> impl Iterator<Item = (usize, [Cell; 2])> + use<'a> {
    let TeamMove { before, frame, .. } = *made;
    (1..)
        .zip(before.windows(2).zip(frame.cells.windows(2)))
        .filter(move |(_, (from, to))| breach.is_in(from, to))
        .map(|(robot, (_, to))| (robot, [to[0], to[1]]))
}

fn apart([one, other]: [Cell; 2]) -> String {
    let (columns, rows) = one.apart(other);
    format!("{} and {}", counted(columns, "column"), counted(rows, "row"))
}
