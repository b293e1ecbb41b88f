//! Bodies that run a chain from its start to its end, each unknown edge decided by the oracle: the plan of the
//! plain recursion (CHAIN-11), the cost of planning (CHAIN-12) and the obstacle-free optimum (CHAIN-9).

use std::ops::RangeInclusive;

use tautline_kernel::chain::{Chain, End, Intent, Kind};
use tautline_kernel::choice::{Oracle, one_of};
use tautline_kernel::ground::{
    Area, BitGrid, Cell, Edge, EdgeMark, Grid, LargeGrid, MediumGrid, Plane, SmallGrid,
};

use super::breach::CHEAP_LOOKS;
use super::plain::{PlainChain, PlainIntent, TooMany};
use super::subject::{Deception, Subject};
use crate::engine::{Outcome, Stop, require};
use crate::plural::listed;

/// The area of the paper for `robots`: (2N−1)² cells with the base in the middle.
pub(crate) fn area(robots: usize) -> (Area, Cell) {
    let range = i16::try_from(robots.saturating_sub(1)).unwrap_or(i16::MAX / 2);
    let base = Cell::new(range, range);
    (Area::new(Cell::new(0, 0), Cell::new(2 * range, 2 * range)).unwrap_or(Area::of(base)), base)
}

pub(super) fn start<G: Grid, const ROBOTS: usize>(
    observed: &Subject,
    robots: usize,
    grid: impl Fn(Area) -> Option<G>,
) -> Result<Chain<G, ROBOTS>, Stop> {
    let (area, base) = area(robots);
    grid(area).and_then(|grid| Chain::new(observed.rule, robots, base, grid).ok()).ok_or(Stop::Assumed)
}

/// A number from `range`.
pub(crate) fn within(range: &RangeInclusive<u32>, oracle: &mut dyn Oracle) -> u32 {
    range.start() + oracle.pick(range.end() - range.start() + 1)
}

/// Chains of any length in `range`.
pub(crate) fn chains(range: &RangeInclusive<u32>) -> String {
    format!("N = {} … {}", range.start(), range.end())
}

pub(super) const NO_MESSAGE: Stop = Stop::Violated("the log holds messages only");

/// More team moves than any run has in which something fails.
pub(super) const MANY: u32 = 20_000;

/// The key by which an edge is looked up.
pub(super) fn key(edge: Edge) -> (i16, i16, u8) {
    (edge.cell().x, edge.cell().y, edge.side() as u8)
}

/// Whether there is one of the few that are `left` here.
pub(super) fn is_one_of(left: &mut u32, oracle: &mut dyn Oracle) -> bool {
    let is_here = *left > 0 && oracle.flip();
    *left -= u32::from(is_here);
    is_here
}

/// The chains of [`spiral`].
const SPIRALS: RangeInclusive<u32> = 2..=32;

/// The bound of [`spiral`], in words.
pub(super) fn spirals() -> String {
    chains(&SPIRALS)
}

/// CHAIN-9: in an open area the chain is done after 9(N−1)−1 team moves.
///
/// # Errors
/// [`Stop::Violated`] if it is not.
pub(super) fn spiral(observed: &Subject, oracle: &mut dyn Oracle) -> Outcome {
    let robots = within(&SPIRALS, oracle) as usize;
    let optimum = 9 * (robots - 1) - 1;
    if observed.has_readings() {
        return plain_spiral(observed, robots, optimum);
    }
    let mut chain = start::<_, 32>(observed, robots, MediumGrid::new)?;
    let mut log = Vec::new();
    for _ in 0..optimum {
        let Intent::Go(plan) = chain.plan(&log).map_err(|_| NO_MESSAGE)? else { return Err(SHORTER) };
        log.extend_from_slice(chain.settle(&plan, |_| true).messages());
    }
    let end = chain.plan(&log).map_err(|_| NO_MESSAGE)?;
    require(end == Intent::Done(End::Explored), LONGER)?;
    Ok(AN_OPEN_AREA)
}

const AN_OPEN_AREA: &str = "an open area";
const SHORTER: Stop = Stop::Violated("no run is shorter than the optimum");
const LONGER: &str = "all cells are explored after 9(N−1)−1 moves";

/// CHAIN-9 by the plain recursion.
fn plain_spiral(observed: &Subject, robots: usize, optimum: usize) -> Outcome {
    let (area, base) = area(robots);
    let mut plain = PlainChain::of(observed, robots, base, area).ok_or(Stop::Assumed)?.that_floods_once();
    let plan = |plain: &mut PlainChain| Ok(plain.plan(PATIENCE).map_err(|_| Stop::GivenUp)?.0);
    for _ in 0..optimum {
        let intent = plan(&mut plain)?;
        intent.steps().ok_or(SHORTER)?;
        plain.settle(&intent, |_| true);
    }
    require(plan(&mut plain)? == PlainIntent::Explored, LONGER)?;
    Ok(AN_OPEN_AREA)
}

/// Robots, and walls in percent, of [`any_order`].
const ORDERS: (usize, [u32; 5]) = (8, [1, 5, 10, 15, 20]);

/// The orders that [`any_order`] draws, in words.
pub(super) fn orders() -> String {
    format!("random layouts, N = {}, walls of {} %, the robots one by one", ORDERS.0, listed(ORDERS.1))
}

/// CHAIN-19 in a random layout: the robots go one by one, in a new order each time.
///
/// # Errors
/// [`Stop::Violated`] if two neighbours are ever out of contact.
pub(super) fn any_order(observed: &Subject, oracle: &mut dyn Oracle) -> Outcome {
    let walls_percent = one_of(oracle, &ORDERS.1);
    let mut chain = start::<_, 8>(observed, ORDERS.0, SmallGrid::new)?;
    let mut log = Vec::new();
    for _ in 0..MANY {
        let Intent::Go(plan) = chain.plan(&log).map_err(|_| NO_MESSAGE)? else { return Ok("a whole run") };
        let mut team = chain.cells().to_vec();
        let settled = chain.settle(&plan, |_| oracle.pick(100) >= walls_percent);
        log.extend_from_slice(settled.messages());
        let mut waiting: Vec<usize> = (1..team.len()).collect();
        while !waiting.is_empty() {
            let robot = waiting.swap_remove(oracle.pick(waiting.len() as u32) as usize);
            team[robot] = chain.cells()[robot];
            let holds = team.windows(2).all(|pair| observed.intended.keeps_contact(pair[0], pair[1]));
            require(holds, "neighbours are in contact after each robot that goes")?;
        }
    }
    Err(Stop::GivenUp)
}

/// Robots, and most walls, of [`same_plan_in_all_layouts`].
const FEW_WALLS: [(usize, u32); 3] = [(2, 3), (3, 2), (4, 2)];

/// The bound of [`same_plan_in_all_layouts`], in words.
pub(super) fn layouts_with_few_walls() -> String {
    let (robots, walls) = (FEW_WALLS.map(|(robots, _)| robots), FEW_WALLS.map(|(_, walls)| walls));
    format!("all layouts, N = {}, at most {} walls", listed(robots), listed(walls))
}

/// CHAIN-11 over all layouts with few walls.
///
/// # Errors
/// [`Stop::Violated`] if the plans differ.
pub(super) fn same_plan_in_all_layouts(observed: &Subject, oracle: &mut dyn Oracle) -> Outcome {
    let (robots, mut walls) = one_of(oracle, &FEW_WALLS);
    same_plan(observed, robots, &mut |_| !is_one_of(&mut walls, oracle))
}

/// Candidates that the plain recursion may look at in one plan before a comparison is given up.
const PATIENCE: u64 = 10_000;

/// Robots, and walls in percent, of [`same_plan_in_random_layouts`].
const RANDOM: (RangeInclusive<u32>, RangeInclusive<u32>) = (2..=12, 2..=30);

/// The layouts that [`same_plan_in_random_layouts`] draws, in words.
pub(super) fn random_layouts() -> String {
    let (robots, walls) = RANDOM;
    format!("random layouts, {}, {} to {} % walls", chains(&robots), walls.start(), walls.end())
}

/// CHAIN-11 over random layouts.
///
/// # Errors
/// [`Stop::Violated`] if the plans differ.
pub(super) fn same_plan_in_random_layouts(observed: &Subject, oracle: &mut dyn Oracle) -> Outcome {
    let robots = within(&RANDOM.0, oracle) as usize;
    let walls_percent = within(&RANDOM.1, oracle);
    same_plan(observed, robots, &mut |_| oracle.pick(100) >= walls_percent)
}

fn same_plan(observed: &Subject, robots: usize, is_open: &mut dyn FnMut(Edge) -> bool) -> Outcome {
    if robots <= 8 {
        in_step(observed, start::<_, 8>(observed, robots, SmallGrid::new)?, is_open)
    } else {
        in_step(observed, start::<_, 32>(observed, robots, MediumGrid::new)?, is_open)
    }
}

/// Runs the chain and the plain recursion of the rule it claims to follow side by side.
fn in_step<P: Plane, const ROBOTS: usize>(
    observed: &Subject,
    mut chain: Chain<BitGrid<P>, ROBOTS>,
    is_open: &mut dyn FnMut(Edge) -> bool,
) -> Outcome {
    let area = chain.grid().area();
    let plain = PlainChain::new(observed.intended, chain.cells().len(), chain.cells()[0], area);
    let mut plain = plain.that_floods_once();
    if observed.deception == Deception::DoubtsAll {
        plain = plain.that_doubts_all();
    }
    let mut log = Vec::new();
    for _ in 0..MANY {
        let Ok((expected, _)) = plain.plan(PATIENCE) else { return Err(Stop::GivenUp) };
        let intent = chain.plan(&log).map_err(|_| NO_MESSAGE)?;
        if chain.is_cut_short() {
            return Ok("a budget was used up");
        }
        let plan = match (&intent, &expected) {
            (Intent::Done(End::Explored), PlainIntent::Explored) => return Ok("everything explored"),
            (Intent::Done(End::Exhausted), PlainIntent::Exhausted) => return Ok("exhausted"),
            (Intent::Go(plan), PlainIntent::Advance(steps)) if plan.kind == Kind::Advance => (plan, steps),
            (Intent::Go(plan), PlainIntent::Backtrack(steps)) if plan.kind == Kind::Backtrack => {
                (plan, steps)
            }
            _ => {
                return Err(Stop::Violated(
                    "the team does what the recursion says: advance, backtrack or end",
                ));
            }
        };
        require(plan.0.steps() == plan.1.as_slice(), "the plan is that of the recursion")?;
        let mut expected_grid = *chain.grid();
        expected_grid.clear_edges(EdgeMark::Virtual);
        plain.virtual_obstacles().for_each(|edge| expected_grid.put_edge(EdgeMark::Virtual, edge));
        require(*chain.grid() == expected_grid, "the virtual obstacles are those of the recursion")?;
        let mut answers = Vec::new();
        let settled = chain.settle(plan.0, |edge| {
            let open = is_open(edge);
            answers.push((edge, open));
            open
        });
        log.extend_from_slice(settled.messages());
        plain.settle(&expected, |edge| answers.iter().any(|&(asked, open)| asked == edge && open));
        require(plain.cells() == chain.cells(), "the team is where the recursion has it")?;
    }
    Err(Stop::GivenUp)
}

/// Team moves after which the cost of plans has been seen enough in one layout.
const CHEAP_MOVES: u32 = 5_000;

/// Robots, and walls in thousandths, of [`cheap`].
const CHEAP_TEAMS: [usize; 4] = [16, 24, 32, 64];
const CHEAP_WALLS: [u32; 11] = [5, 10, 15, 20, 30, 50, 100, 150, 200, 250, 300];

/// The runs that [`cheap`] draws, in words.
pub(super) fn cheap_runs() -> String {
    first_moves(&CHEAP_TEAMS, &CHEAP_WALLS)
}

/// CHAIN-12: the first team moves, the cost of each plan in bounds.
///
/// # Errors
/// [`Stop::Violated`] if a plan looks at more than 100·N candidates.
pub(super) fn cheap(observed: &Subject, oracle: &mut dyn Oracle) -> Outcome {
    let robots = one_of(oracle, &CHEAP_TEAMS);
    let walls_permille = one_of(oracle, &CHEAP_WALLS);
    cheap_among(observed, robots, &mut |_| oracle.pick(1000) >= walls_permille)
}

/// Robots, and walls in thousandths, where plans are dearest.
const DEAR_TEAM: usize = 64;
const DEAR_WALLS: [u32; 6] = [5, 10, 15, 20, 25, 30];

/// The runs that [`cheap_among_few_walls`] draws, in words.
pub(super) fn runs_among_few_walls() -> String {
    first_moves(&[DEAR_TEAM], &DEAR_WALLS)
}

/// CHAIN-12 where plans are dearest.
///
/// # Errors
/// As of [`cheap`].
pub(super) fn cheap_among_few_walls(observed: &Subject, oracle: &mut dyn Oracle) -> Outcome {
    let walls_permille = one_of(oracle, &DEAR_WALLS);
    cheap_among(observed, DEAR_TEAM, &mut |_| oracle.pick(1000) >= walls_permille)
}

fn first_moves(robots: &[usize], walls_permille: &[u32]) -> String {
    let percent = walls_permille.iter().map(|permille| f64::from(*permille) / 10.0);
    let (robots, walls) = (listed(robots), listed(percent));
    format!("random layouts, N of {robots}, walls of {walls} %, at most {CHEAP_MOVES} moves")
}

fn cheap_among(observed: &Subject, robots: usize, is_open: &mut dyn FnMut(Edge) -> bool) -> Outcome {
    if observed.deception == Deception::PlainRecursion {
        plain_run(observed, robots, is_open)
    } else if robots <= 32 {
        cheap_run(start::<_, 32>(observed, robots, MediumGrid::new)?, is_open)
    } else {
        cheap_run(start::<_, 64>(observed, robots, LargeGrid::new)?, is_open)
    }
}

const CHEAP: &str = "a plan looks at no more than 100·N candidates of followers";

fn cheap_run<G: Grid, const ROBOTS: usize>(
    mut chain: Chain<G, ROBOTS>,
    is_open: &mut dyn FnMut(Edge) -> bool,
) -> Outcome {
    let most = CHEAP_LOOKS * chain.cells().len() as u32;
    let mut log = Vec::new();
    for _ in 0..CHEAP_MOVES {
        let Intent::Go(plan) = chain.plan(&log).map_err(|_| NO_MESSAGE)? else { return Ok("a whole run") };
        require(chain.looked_at() <= most, CHEAP)?;
        log.extend_from_slice(chain.settle(&plan, &mut *is_open).messages());
    }
    Ok("a longer run")
}

fn plain_run(observed: &Subject, robots: usize, is_open: &mut dyn FnMut(Edge) -> bool) -> Outcome {
    let (area, base) = area(robots);
    let mut plain = PlainChain::new(observed.rule, robots, base, area);
    for _ in 0..CHEAP_MOVES {
        match plain.plan((CHEAP_LOOKS * robots as u32).into()) {
            Ok((PlainIntent::Explored | PlainIntent::Exhausted, _)) => return Ok("a whole run"),
            Ok((intent, _)) => plain.settle(&intent, &mut *is_open),
            Err(TooMany) => return Err(Stop::Violated(CHEAP)),
        }
    }
    Ok("a longer run")
}

#[cfg(test)]
mod tests {
    use rustc_hash::FxHashMap;
    use tautline_kernel::chain::{Budget, Rule};

    use super::super::invariant::{Invariant, Moment};
    use super::super::links::has_explored;
    use super::*;
    use crate::engine::{SeededOracle, sample};

    #[test]
    fn one_flood_fill_for_all_candidates_tells_what_one_for_each_does() {
        let tally = sample(60, 0, |oracle| {
            let (robots, walls) = (2 + oracle.pick(6) as usize, oracle.pick(30));
            let (area, base) = area(robots);
            let mut each = PlainChain::new(Rule::REPAIRED, robots, base, area);
            let mut once = each.clone().that_floods_once();
            loop {
                let plan = each.plan(PATIENCE);
                require(plan == once.plan(PATIENCE), "the same plan")?;
                require(each.virtual_obstacles().eq(once.virtual_obstacles()), "the same obstacles")?;
                let Ok((intent, _)) = plan else { return Err(Stop::GivenUp) };
                if matches!(intent, PlainIntent::Explored | PlainIntent::Exhausted) {
                    return Ok("a whole run");
                }
                let mut answers = FxHashMap::default();
                let mut is_open =
                    |edge: Edge| *answers.entry(edge).or_insert_with(|| oracle.pick(100) >= walls);
                each.settle(&intent, &mut is_open);
                once.settle(&intent, &mut is_open);
            }
        });
        assert_eq!(tally.violation, None);
        assert!(tally.cases > 50, "{} cases", tally.cases);
    }

    #[test]
    #[ignore = "a thousand runs a density take minutes"]
    fn no_order_of_going_breaks_contact_in_a_thousand_runs_a_density() {
        let runs = |observed: &Subject| {
            (0..5_000).filter(|&seed| any_order(observed, &mut SeededOracle::new(19, seed)).is_err()).count()
        };
        assert_eq!(runs(&Subject::REEL), 0);
        assert!(runs(&Subject::UNHELD) > 0);
    }

    const DEMANDS: [Invariant; 9] = [
        Invariant::Admitted,
        Invariant::Distinct,
        Invariant::BaseStays,
        Invariant::Progress,
        Invariant::Heard,
        Invariant::Cheap,
        Invariant::CONTACT,
        Invariant::CROWDING,
        Invariant::COVERAGE,
    ];

    #[test]
    fn a_chain_whose_plans_are_cut_short_keeps_every_promise() {
        // Plans that were cut short: a plan was known by then, or all candidates were refused.
        let (mut known, mut refused) = (0, 0);
        for seed in 0..60 {
            let mut world = SeededOracle::new(3, seed);
            let robots = 5 + world.pick(6) as usize;
            let looks = one_of(&mut world, &[0, 3, 6, 10, 12, 14, 16, 20]);
            let walls_percent = 5 + world.pick(25);
            let rule = Rule { budget: Budget::LooksPerRobot(looks), ..Rule::REPAIRED };
            let observed = Subject::honest(rule);
            let mut chain: Chain<_, 32> = start(&observed, robots, MediumGrid::new).expect("it fits");
            let mut log = Vec::new();
            let ended = (0..3_000).any(|_| {
                let before = chain;
                let Intent::Go(plan) = chain.plan(&log).expect("its own log") else { return true };
                match plan.kind {
                    Kind::Advance if chain.is_cut_short() => known += 1,
                    Kind::Backtrack if chain.is_cut_short() => refused += 1,
                    Kind::Advance | Kind::Backtrack => {}
                }
                let planned = chain;
                let settled = chain.settle(&plan, |_| world.pick(100) >= walls_percent);
                log.extend_from_slice(settled.messages());
                let moment = Moment {
                    observed: &observed,
                    before: &before,
                    planned: &planned,
                    after: &chain,
                    plan: &plan,
                    steps: plan.steps(),
                    messages: settled.messages(),
                };
                for demand in DEMANDS {
                    assert_eq!(demand.check(&moment), Ok(()), "{demand:?}, {looks} looks, seed {seed}");
                }
                false
            });
            let (grid, base) = (chain.grid(), chain.cells()[0]);
            assert!(!ended || has_explored(grid, base, robots), "seed {seed}");
        }
        assert!(known > 0 && refused > 0, "{known} {refused}");
    }
}
