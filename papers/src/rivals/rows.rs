//! The rivals of the chain [Kovács 2011, C]: their rows, and their teams. No clause is about them: what a robot that
//! meets a wall does to their links is measured, not promised.

use tautline_kernel::chain::{self, MAX_ROBOTS};
use tautline_kernel::ground::{Area, Cell, Circle};
use tautline_proofs::run::Frame;

use tautline_grids::layout::{self, Layout};
use tautline_io::diagnostic::Diagnostic;
use tautline_sim::explore::SCHEMES;
use tautline_sim::explore::{
    By, Catalogue, End, Joins, Layer, Look, Profile, RandomPart, Rule, RuleId, Setup, Shape, Starts,
    Surroundings, Team, Zone,
};

use super::parameters::MOST_SEARCHED;
use super::{Cells, Deadlock, Links, Moves, ParameterError, Parameters, Standstill};

/// Links by E_C.
pub const COVERED: RuleId = RuleId::new("covered");
/// Robots may share cells.
pub const SHARED: RuleId = RuleId::new("shared");
/// Both.
pub const COVERED_SHARED: RuleId = RuleId::new("covered-shared");
/// A team that is stuck goes its ways at random for a while.
pub const SCATTER: RuleId = RuleId::new("scatter");

/// How a stuck team scatters.
const SCATTERING: Deadlock = Deadlock::Scatter { after: 20, moves: 5 };

/// The row of a rival that has at most so many robots.
macro_rules! rival {
    ($name:literal, $team:literal, $about:literal, $parameters:expr, $most_robots:expr) => {
        Profile {
            about: $about,
            rules: &[
                Rule::new(RuleId::PUBLISHED, "As the paper publishes it", |setup| {
                    start(setup, $parameters.with_moves(Moves::Four))
                }),
                Rule::new(RuleId::REPAIRED, "With the repairs of its refuted claims", |setup| {
                    start(setup, $parameters)
                }),
                Rule::new(
                    COVERED,
                    "A rival of the chain, repaired, with links by E_C instead of E_S",
                    |setup| start(setup, $parameters.linked(Links::Covered)),
                ),
                Rule::new(
                    SHARED,
                    "A rival of the chain, repaired, whose robots may plan to share a cell",
                    |setup| start(setup, $parameters.in_cells(Cells::Shared)),
                ),
                Rule::new(COVERED_SHARED, "A rival of the chain, covered and shared", |setup| {
                    start(setup, $parameters.linked(Links::Covered).in_cells(Cells::Shared))
                }),
                Rule::new(
                    SCATTER,
                    "A rival of the chain, covered, that makes 5 legal team \
                     moves at random after every 20 without gain",
                    |setup| {
                        let parameters = $parameters.linked(Links::Covered);
                        start(setup, Parameters { deadlock: SCATTERING, ..parameters })
                    },
                ),
            ],
            team: $team,
            robots: 2..=$most_robots,
            starts: Starts::Base,
            look: Look::Tree { is_linked: |one, other| Circle::COVERED.covers(one, other) },
            drawn: &[RandomPart { what: "which of the team moves is made that are as good", by: By::Every }],
            ..Profile::named($name)
        }
    };
}

/// The best of all team moves.
pub static FULL_SEARCH: Profile = rival!(
    "full-search",
    "team of full search",
    "A rival of the chain: links are a tree, and each team move is the best of all",
    Parameters::FULL,
    MOST_SEARCHED
);

/// The best of a pool of team moves.
pub static ROOKER_BIRK: Profile = rival!(
    "rooker-birk",
    "team of rivals",
    "A rival of the chain: links are a tree, and each team move is the best of 1000 drawn at random",
    Parameters::POOL,
    MAX_ROBOTS
);

/// The rivals.
pub const RIVALS: &[&Profile] = &[&FULL_SEARCH, &ROOKER_BIRK];

/// All schemes: those of sim, and the rivals behind the chain.
pub const CATALOGUE: Catalogue = {
    let (chain, others) = SCHEMES.split_at(1);
    Catalogue(&[chain, RIVALS, others])
};

struct Rivals(super::Team);

/// The team of `setup`, all robots at the base.
fn start(setup: &Setup, parameters: Parameters) -> Result<Box<dyn Team>, Diagnostic> {
    rival(parameters, setup.robots, &setup.layout, setup.base, setup.seed)
}

/// A team with these parameters, the base counted, in the area that a chain of as many would explore: “this restriction
/// is applied for all of the tested algorithms” (D).
///
/// # Errors
/// A [`Diagnostic`] if the parameters do not fit, or the base is outside.
pub fn rival(
    parameters: Parameters,
    robots: u16,
    layout: &Layout,
    base: Cell,
    seed: u64,
) -> Result<Box<dyn Team>, Diagnostic> {
    let robots = usize::from(robots);
    let area = chain::area(layout.size().area(), base, robots).ok_or_else(|| {
        let outside = layout::outside("base", base, layout.size());
        Diagnostic::of_field("base", outside.what(), outside.remedy())
    })?;
    let team = super::Team::new(parameters, robots, base, area, seed).map_err(|unfit| fault(&unfit))?;
    Ok(Box::new(Rivals(team)))
}

/// The fault of a team that does not fit.
pub fn fault(unfit: &ParameterError) -> Diagnostic {
    Diagnostic::of_field(unfit.field(), unfit, unfit.remedy())
}

impl Team for Rivals {
    fn cells(&self) -> &[Cell] {
        self.0.cells()
    }

    fn advance(&mut self, world: &mut dyn Surroundings) -> Result<Frame, End> {
        self.0.advance(&mut |edge| world.is_open(edge)).map_err(|over| match over {
            Standstill::Explored => End::Explored,
            Standstill::Enclosed => End::Exhausted,
            Standstill::Stuck => End::Idle,
        })
    }

    fn area(&self, _: &Layout) -> Area {
        self.0.area()
    }

    fn layers(&self) -> Vec<Layer> {
        const COVERED: Zone = Zone {
            name: "E_C",
            about: "wholly within r_cov: in contact",
            has: |one, other| Circle::COVERED.covers(one, other),
        };
        vec![Layer {
            name: "links",
            about: "a tree of links from the base".to_owned(),
            shape: Shape::Links(Joins::Tree, &[COVERED]),
        }]
    }
}
