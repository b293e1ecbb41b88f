//! A rule of one's own as a row of a catalogue: how its team starts in a layout, and how it is hunted.

use std::any::type_name;
use std::fmt;
use std::ops::ControlFlow;

use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Cell, Edge};
use tautline_proofs::decide::{Cache, Context, Depiction, Evidence, Method as _, Verdict};
use tautline_proofs::engine::states::MemoryLimit;
use tautline_proofs::engine::world::World as _;
use tautline_proofs::engine::{Until, outcomes};
use tautline_proofs::plural::counted;
use tautline_proofs::run::{Ending, Run};
use tautline_proofs::team::{Keeps, Places, Promise, Rule, Setting, Strategy};

use super::hunt::{
    Bound, CoveredBound, Exhibit, Facts, Far, Finding, Hunt, HuntReport, HuntRequest, Hunter, RunSize,
    outcome, setup as found_setup,
};
use super::own::Own;
use super::{Setup, Team};

/// A rule of one's own in its surroundings.
pub struct OwnRule<R: Rule + 'static> {
    /// The surroundings, and what is demanded of a team there.
    pub setting: &'static Setting<'static, R>,
    /// The rule.
    pub rule: R,
}

impl<R: Rule + PartialEq + 'static> OwnRule<R> {
    /// The team of a setup at its start. Robots of which nobody says where they start are where the setting has them.
    ///
    /// # Errors
    /// A [`Diagnostic`] if there are not so many robots, or one of them starts outside or in a blocked cell.
    pub fn start(&self, setup: &Setup) -> Result<Box<dyn Team>, Diagnostic> {
        let starts = match (&setup.starts, &self.setting.starts) {
            (None, Places::At(cells)) => cells(&self.rule),
            _ => setup.starts(),
        };
        if usize::from(setup.robots) != self.setting.robots {
            let what = format!("this rule is one of {}", counted(self.setting.robots, "robot"));
            return Err(Diagnostic::of_field("robots", what, format!("take {}", self.setting.robots)));
        }
        starts.iter().try_for_each(|&start| setup.layout.check_start(start))?;
        let playing = self.setting.in_layout(&self.rule, &starts, Vec::new());
        Ok(Box::new(Own::new(playing, setup.seed).choosing(&setup.choices)))
    }

    /// The answers of a counterexample to what no layout knows, in their order.
    fn choices(&self, demand: usize, evidence: &Evidence) -> Option<Vec<u32>> {
        // A tree asks about the layout alone.
        if self.setting.strategy() == Strategy::Tree {
            return None;
        }
        let (mut all, mut steps) = (Vec::new(), evidence.choices.all());
        let start = steps.next()? as usize;
        let mut scene = self.setting.starts(&self.rule).ok()?.into_iter().nth(start)?;
        let world = self.setting.playing(&self.rule, &[Promise(demand)]).ok()?;
        for number in steps {
            let mut planned = scene.clone();
            let Some(plan) = world.plan(&mut planned, &[]) else { break };
            let step = outcomes(|oracle| {
                let (mut after, mut answers) =
                    (planned.clone(), RecordedAnswers { oracle, drawn: Vec::new() });
                world.settle(&mut after, &plan, &mut Vec::new(), &mut answers);
                Some((after, answers.drawn))
            });
            let Some((after, drawn)) = { step }.nth(number as usize) else { break };
            scene = after;
            all.extend(drawn);
        }
        Some(all)
    }

    fn finding(
        &self,
        asked: &HuntRequest<'_>,
        demand: usize,
        evidence: &Evidence,
        run: &Run,
    ) -> Result<Finding, Diagnostic> {
        let choices = self.choices(demand, evidence).unwrap_or_default();
        let setup = Setup { choices, ..found_setup(asked.scheme, asked.rule, run)? };
        let (columns, rows) = (run.area.width(), run.area.height());
        let (walls, steps) = (run.walls.len() + run.obstacles.len(), run.frames.len());
        let clause = self.setting.demands[demand].id;
        Ok(Finding {
            clause,
            facts: RunSize::Area { columns, rows, walls, steps },
            title: format!("{} and {}", counted(walls, "wall"), counted(steps, "team move")),
            shown: match run.ending {
                Ending::Endless => Exhibit::Endless,
                Ending::Move | Ending::Over => Exhibit::Run(super::ClauseId::new(clause)),
            },
            setup,
        })
    }
}

impl<R: Rule + PartialEq + 'static> Hunt for OwnRule<R> {
    /// The bounds stand in the setting.
    fn takes(&self) -> &'static [Bound] {
        &[]
    }

    fn hunt(&self, asked: &HuntRequest<'_>, hunter: &mut dyn Hunter) -> Result<HuntReport, Diagnostic> {
        let (mut found, mut cases, mut is_complete) = (Vec::new(), 0, true);
        let mut cache = Cache::default();
        for (number, demand) in self.setting.demands.iter().enumerate() {
            let far = Far::Words(format!("{}, {} of {}", demand.id, number + 1, self.setting.demands.len()));
            let mut is_ended = hunter.hears(far).is_break();
            let mut watch = |progress: &tautline_proofs::engine::tree::Progress<'_>| {
                is_ended |= asked.budget.is_some_and(|budget| progress.moves > budget);
                let far = match self.setting.strategy() {
                    Strategy::Tree => Far::Tree(progress),
                    Strategy::States => Far::Words(format!("{}, states {}", demand.id, progress.moves)),
                };
                is_ended |= hunter.hears(far).is_break();
                if is_ended { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            };
            let context = &mut Context { cache: &mut cache, watch: &mut watch, memory: MemoryLimit::any() };
            let answer = Keeps(self.setting, number).decide(&self.rule, Until::Exhausted, context);
            let answer = answer.map_err(|why| Diagnostic::usage(why, "change the setting of the rule"))?;
            cases = cases.max(answer.cases);
            is_complete &= answer.verdict != Verdict::Open && !is_ended;
            if let Some(evidence) = &answer.counterexample
                && let Depiction::Robots(run) = &evidence.seen
            {
                found.push(self.finding(asked, number, evidence, run)?);
            }
            if is_ended {
                break;
            }
        }
        let (width, height) = self.setting.ground.size;
        Ok(HuntReport {
            robots: self.setting.robots as u64,
            looked_for: self.setting.demands.iter().map(|demand| demand.id).collect(),
            facts: Facts::States {
                size: format!("{width}x{height}"),
                states: cases,
                steps: cases,
                max_walls: None,
                range: None,
            },
            is_complete,
            done: CoveredBound::WallsDone(None),
            title: format!("{}: {}", Keeps(self.setting, 0).bound(), counted(cases, "case")),
            through: counted(cases, "case"),
            outcome: outcome(&found, is_complete, None),
            not_minimised: Vec::new(),
            found,
        })
    }
}

impl<R: Rule + 'static> fmt::Debug for OwnRule<R> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(type_name::<R>())
    }
}

/// Passes questions on, and keeps the answers to those that are not about the layout.
struct RecordedAnswers<'a> {
    oracle: &'a mut dyn Oracle,
    drawn: Vec<u32>,
}

impl Oracle for RecordedAnswers<'_> {
    fn pick(&mut self, below: u32) -> u32 {
        self.drawn.push(self.oracle.pick(below));
        self.drawn.last().copied().unwrap_or(0)
    }

    fn is_open(&mut self, edge: Edge) -> bool {
        self.oracle.is_open(edge)
    }

    fn is_free(&mut self, cell: Cell) -> bool {
        self.oracle.is_free(cell)
    }
}
