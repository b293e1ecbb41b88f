//! The hunt of chains: all layouts, decided wall by wall as the team meets them, in one process that can be left and
//! taken up again, or dealt out.

use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use tautline_io::checkpoint::{self, Checkpoint, Part, Task, decode, encode};
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_io::shards;
use tautline_kernel::ground::Cell;
use tautline_proofs::chain::Subject;
use tautline_proofs::chain::search::{Bounds, Deal, Findings, Position, Search};
use tautline_proofs::engine::tree::Progress;
use tautline_proofs::plural::{counted, listed};

use super::areas;
pub use super::bounds::bounds;
use super::bounds::{AGAIN, fault, finding, team};
use crate::explore::hunt::{
    Bound, CoveredBound, Deals, Dealt, Facts, Far, Finding, Hunt, HuntReport, HuntRequest, Hunter,
    OngoingHunt, RUN_AGAIN, RunSize, in_order, outcome, read_deal,
};
use crate::explore::{Catalogue, ClauseId, RuleId};

/// The chain that is hunted.
#[derive(Debug)]
pub(super) struct Walls(pub(super) Subject);

impl Hunt for Walls {
    fn takes(&self) -> &'static [Bound] {
        &[Bound::Walls, Bound::Cells, Bound::Resume]
    }

    fn refusal(&self, bound: Bound) -> (String, String) {
        let (what, others) = match bound {
            Bound::Losses | Bound::Error => {
                ("a hunt of chains loses no messages and has no wrong fixes", "frontier")
            }
            Bound::Range => ("the robots of a chain hear each other as far as their rule says", "kit"),
            Bound::Walls | Bound::Cells | Bound::Misses | Bound::Resume => {
                ("the robots of a chain have no floor sensors to miss", "bricks")
            }
        };
        (what.to_owned(), format!("give `max-walls`, or a `scheme` that takes it, as {others}"))
    }

    fn hunt(&self, asked: &HuntRequest<'_>, hunter: &mut dyn Hunter) -> Result<HuntReport, Diagnostic> {
        if let Some(cells) = asked.bounds.max_cells {
            return areas::hunt(self.0, asked, cells, hunter);
        }
        let bounds = self.bounds(asked)?;
        report(asked, &bounds, &search(asked, &bounds, hunter)?)
    }

    fn deals(&self) -> Option<&dyn Deals> {
        Some(self)
    }

    fn begin(&self, asked: &HuntRequest<'_>) -> Result<Option<Box<dyn OngoingHunt>>, Diagnostic> {
        let bounds = self.bounds(asked)?;
        Ok(Some(Box::new(BegunWalls { search: start(&bounds)?, bounds })))
    }
}

/// A hunt that is made a wave at a time.
struct BegunWalls {
    search: Search,
    bounds: Bounds,
}

impl OngoingHunt for BegunWalls {
    fn step(&mut self) -> bool {
        self.search.wave()
    }

    fn progress(&self) -> Progress<'_> {
        self.search.progress()
    }

    fn report(&self, asked: &HuntRequest<'_>) -> Result<HuntReport, Diagnostic> {
        report(asked, &self.bounds, &self.search.found())
    }
}

impl Walls {
    fn bounds(&self, asked: &HuntRequest<'_>) -> Result<Bounds, Diagnostic> {
        let (robots, walls) = team(asked);
        let mut bounds =
            Bounds { budget_moves: asked.budget, ..bounds(self.0, robots, walls, asked.bounds.size)? };
        // Walls that nobody has asked for are no more than there can be.
        if asked.bounds.max_walls.is_none()
            && let Ok(reach) = bounds.reach()
        {
            bounds.max_walls = walls.min(reach.edges().count() as u32);
        }
        Ok(bounds)
    }
}

impl Deals for Walls {
    fn deal(&self, asked: &HuntRequest<'_>, shards: usize) -> Result<Dealt, Diagnostic> {
        areas::refuse(asked, "shards", "a hunt over areas is not dealt out")?;
        let search = start(&self.bounds(asked)?)?;
        let deal = search.deal(shards);
        let (left, moves) = (deal.left().to_vec(), deal.moves());
        Ok(Dealt { deal: encode(&(asked.bounds, deal))?, left, of: "team move", moves })
    }

    fn part<'a>(
        &'a self,
        asked: &HuntRequest<'_>,
        deal: &RawValue,
        (shard, _): (usize, usize),
        far: Option<&RawValue>,
    ) -> Result<Box<dyn Part + 'a>, Diagnostic> {
        let (asked, deal) = read_deal::<Deal>(deal, asked)?;
        let bounds = self.bounds(&asked)?;
        let search = match far {
            None => Search::shard(&bounds, &deal, shard),
            Some(far) => Search::shard_at(&bounds, &deal, shard, &decode::<Position>(far, RUN_AGAIN)?),
        };
        Ok(Box::new(Waves(search.map_err(|refused| fault(refused, bounds.robots))?)))
    }

    fn merge(
        &self,
        asked: &HuntRequest<'_>,
        deal: &RawValue,
        shards: &[&RawValue],
    ) -> Result<HuntReport, Diagnostic> {
        let (asked, deal) = read_deal::<Deal>(deal, asked)?;
        let bounds = self.bounds(&asked)?;
        let positions =
            shards.iter().map(|far| decode(far, RUN_AGAIN)).collect::<Result<Vec<Position>, _>>()?;
        let merged =
            Search::merged(&bounds, &deal, &positions).map_err(|refused| fault(refused, bounds.robots))?;
        report(&asked, &bounds, &merged.found())
    }
}

/// A search that can be left after each of its waves.
#[derive(Debug)]
pub struct Waves(pub Search);

impl Part for Waves {
    fn step(&mut self) -> Result<bool, Halt> {
        Ok(self.0.wave())
    }

    fn far(&self) -> Result<Box<RawValue>, Diagnostic> {
        encode(&self.0.position())
    }

    fn is_done(&self) -> bool {
        self.0.is_complete()
    }

    fn facts(&self) -> checkpoint::Facts {
        let Progress { runs, moves, .. } = self.0.progress();
        checkpoint::Facts::Runs { runs, moves }
    }

    fn words(&self) -> String {
        let Progress { runs, moves, .. } = self.0.progress();
        format!("{}, {}", counted(runs, "run"), counted(moves, "team move"))
    }
}

/// The report of a search, and of each run that it found.
fn report(asked: &HuntRequest<'_>, bounds: &Bounds, found: &Findings) -> Result<HuntReport, Diagnostic> {
    let findings = found.counterexamples.iter().map(|found| {
        let runs = found.runs;
        finding(asked, bounds, found, |walls, steps, size| {
            (RunSize::Runs { runs, walls, steps }, format!("{size}; broken in {}", counted(runs, "run")))
        })
    });
    let mut findings = findings.collect::<Result<Vec<Finding>, Diagnostic>>()?;
    findings.sort_by_key(|found| ClauseId::new(found.clause));
    let &Findings { runs, moves, longest, ref levels, .. } = found;
    let (max_walls, is_complete) = (bounds.max_walls, found.complete && found.given_up == 0);
    let (robots, done) = (bounds.robots as u64, (levels.len() as u32).checked_sub(1));
    let covered = done.map(|walls| format!("with at most {}", counted(walls, "wall")));
    let (all_runs, all_moves) = (counted(runs, "run"), counted(moves, "team move"));
    let within = format!("{}, at most {}", counted(robots, "robot"), counted(max_walls, "wall"));
    Ok(HuntReport {
        robots,
        looked_for: in_order(bounds.invariants.iter().map(|invariant| invariant.clause())),
        facts: Facts::Runs { runs, moves, longest, max_walls },
        is_complete,
        done: CoveredBound::WallsDone(done),
        title: format!("{within}: {all_runs}, {all_moves}, {longest} the longest"),
        through: format!("{all_runs} and {all_moves}"),
        outcome: outcome(&findings, is_complete, covered),
        not_minimised: Vec::new(),
        found: findings,
    })
}

fn search(asked: &HuntRequest<'_>, bounds: &Bounds, hunter: &mut dyn Hunter) -> Result<Findings, Diagnostic> {
    let mut kept = Checkpoint::new(asked.resume, HuntTask::new(asked, bounds)?);
    let mut search = Waves(resume(&mut kept, bounds)?);
    // What cannot be kept is refused before it has cost anything.
    kept.keep(&search)?;
    while hunter.hears(Far::Tree(&search.0.progress())).is_continue() && search.0.wave() {
        kept.keep_now_and_then(&search);
    }
    if let Err(fault) = kept.keep(&search) {
        hunter.is_left_out(&fault);
    }
    Ok(search.0.found())
}

/// The search as it is in the file of `kept`, or from the start if there is no file.
///
/// # Errors
/// A [`Diagnostic`] if the file is damaged, of another hunt or in use, or the bounds cannot be searched.
pub fn resume(kept: &mut Checkpoint<'_, HuntTask>, bounds: &Bounds) -> Result<Search, Diagnostic> {
    let position: Option<Position> = kept.read()?;
    let search = position.map_or_else(|| Search::new(bounds), |position| Search::at(bounds, &position));
    search.map_err(|refused| kept.found(fault(refused, bounds.robots)))
}

/// The search within `bounds`, from the start.
///
/// # Errors
/// A [`Diagnostic`] if it cannot be made.
pub fn start(bounds: &Bounds) -> Result<Search, Diagnostic> {
    Search::new(bounds).map_err(|refused| fault(refused, bounds.robots))
}

/// The hunt that a file keeps.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HuntTask {
    format: String,
    version: u32,
    scheme: String,
    rule: String,
    robots: usize,
    /// North-west and south-east corner of the area.
    area: [Cell; 2],
    base: Cell,
    /// The SHA-256 of the program, whose rules these are.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    program: String,
    /// The schemes that are known to whoever asks.
    #[serde(skip)]
    known: Option<Catalogue>,
}

impl Task for HuntTask {
    const FORMAT: &'static str = "tautline hunt";
    const NOUN: &'static str = "a kept hunt";
    const OTHER: &'static str = "this is another hunt";
    const FIELDS: &'static [&'static str] = &["scheme", "rule", "robots", "area", "base", "program"];
    const AGAIN: &'static str = AGAIN;
    const ELSEWHERE: &'static str = "ask for the same, or give another `resume` file";
    const OTHER_BUILD: &'static str =
        "go on with that build, or hunt from the start with another `resume` file";

    fn unknown(&self, kept: &Self) -> Option<(&'static str, String)> {
        let known = self.known?;
        let Some(scheme) = known.scheme(&kept.scheme) else {
            let names = listed(known.names(|_| true).iter().map(|name| format!("`{name}`")));
            return Some(("scheme", format!("unknown variant `{}`, expected one of {names}", kept.scheme)));
        };
        let fault = scheme.find_rule(RuleId::read(&kept.rule)).err()?;
        Some(("rule", format!("{}: {}", fault.what(), fault.remedy())))
    }
}

impl HuntTask {
    /// The hunt that is `asked`, within `bounds`; a kept one is this program's.
    ///
    /// # Errors
    /// A [`Diagnostic`] if it is kept, and this program cannot be read.
    pub fn new(asked: &HuntRequest<'_>, bounds: &Bounds) -> Result<Self, Diagnostic> {
        let area = bounds.reach().unwrap_or(bounds.area);
        Ok(Self {
            format: Self::FORMAT.to_owned(),
            version: checkpoint::VERSION,
            scheme: asked.scheme.name.to_owned(),
            rule: asked.rule.to_string(),
            robots: bounds.robots,
            area: [area.first(), area.last()],
            base: bounds.base,
            program: asked.resume.map_or_else(|| Ok(String::new()), |_| shards::program())?,
            known: Some(asked.scheme.among),
        })
    }
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use tautline_kernel::chain::Rule;

    use super::*;
    use crate::explore::chain::CHAIN;
    use crate::explore::hunt::{Exhibit, HuntBounds};

    struct Patient;

    impl Hunter for Patient {
        fn hears(&mut self, _: Far<'_>) -> ControlFlow<()> {
            ControlFlow::Continue(())
        }

        fn is_left_out(&mut self, fault: &Diagnostic) {
            panic!("{fault:?}");
        }
    }

    /// The clauses that a hunt finds broken, and the stories of those that no file tells.
    fn found(observed: Subject) -> Vec<(&'static str, Option<String>)> {
        let asked = HuntRequest {
            bounds: HuntBounds { robots: Some(3), max_walls: Some(2), ..HuntBounds::default() },
            ..HuntRequest::new(&CHAIN, RuleId::PUBLISHED)
        };
        let report = Walls(observed).hunt(&asked, &mut Patient).expect("it can be searched");
        assert!(report.is_complete);
        let of_reels = observed == Subject::REEL || observed == Subject::REEL.following(Rule::REPAIRED);
        let clauses = ["CHAIN-1", "CHAIN-2", "CHAIN-3", "CHAIN-7", "CHAIN-13", "CHAIN-24"];
        assert_eq!(report.looked_for, clauses[..5 + usize::from(of_reels)]);
        let told = |finding: Finding| match finding.shown {
            Exhibit::Told(story) => (finding.clause, Some(story)),
            Exhibit::Run(_) | Exhibit::Story(..) | Exhibit::Endless => (finding.clause, None),
        };
        report.found.into_iter().map(told).collect()
    }

    #[test]
    fn a_reel_that_takes_longer_than_chain_24_allows_is_found_and_told() {
        assert_eq!(found(Subject::REEL), []);
        let slow = found(Subject::REEL.following(Rule::REPAIRED));
        let told: Vec<_> = slow.iter().filter(|(clause, _)| *clause == "CHAIN-24").collect();
        let [(_, Some(story))] = told[..] else { panic!("{slow:?}") };
        assert!(story.starts_with("Not so: each wall that is met costs at most N² team moves."), "{story}");
    }
}
