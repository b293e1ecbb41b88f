//! Small lattices: all layouts of so many nodes, all starts, all orders of decisions and arrivals (KIT-1 to KIT-3, KIT-6 to
//! KIT-8, KIT-10 to KIT-12). A counterexample has the fewest nodes, of these the fewest walls, and of these the fewest steps.

use tautline_kernel::ground::{Area, Cell, Side};
use tautline_kernel::kit::{Next, Rule, Sight};

use super::world::{Answers, Demand, Event, Setting, Speeds, Starts, World};
use crate::decide::{Answer, Desk, Evidence, Method, Played, Refused, Seen};
use crate::engine::states::{END, Limits, Run, search};
use crate::engine::{Choices, Script, Unfit, Until, cover};

/// Columns, rows, and the most walls that one run meets.
pub(super) type Size = (i16, i16, u8);

/// Lattices to look at, and what is demanded of teams on them.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Lattices<const ROBOTS: usize> {
    /// Fewest nodes first.
    pub(super) sizes: &'static [Size],
    pub(super) speeds: Speeds,
    pub(super) answers: Answers,
    pub(super) starts: Starts,
    pub(super) demand: Demand,
    /// Whether other clauses are about the same teams, so that one pass answers all.
    pub(super) pass: Pass,
    /// The situations that must occur.
    pub(super) covers: &'static [&'static str],
}

/// How many demands are looked at in one pass.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Pass {
    /// One.
    Alone,
    /// All, as long as none is broken.
    Together,
}

/// What the states have shown.
struct Looked<const ROBOTS: usize> {
    states: u64,
    is_whole: bool,
    covered: Vec<&'static str>,
    broken: Option<(Choices, Setting<ROBOTS>, Run<Demand>)>,
}

impl<const ROBOTS: usize> Lattices<ROBOTS> {
    /// The teams on one lattice.
    fn setting(&self, rule: &Rule, size: Size, demand: Option<Demand>) -> Option<Setting<ROBOTS>> {
        let (width, height, max_walls) = size;
        let area = Area::new(Cell::new(0, 0), Cell::new(width - 1, height - 1))?;
        let Self { speeds, answers, starts, .. } = *self;
        Some(Setting { rule: *rule, area, max_walls, speeds, answers, starts, demand })
    }

    /// Looks at these lattices in their order, until something is broken.
    fn look(
        &self,
        rule: &Rule,
        sizes: &[Size],
        demand: Option<Demand>,
        limits: Limits<'_>,
    ) -> Looked<ROBOTS> {
        let mut looked = Looked { states: 0, is_whole: true, covered: Vec::new(), broken: None };
        for (number, &(width, height, most)) in (0..).zip(sizes) {
            // Mostly nothing is broken; where it is, the fewest walls are looked for.
            let all = self.search(rule, (width, height, most), demand, (limits, &mut looked));
            if all.is_none() {
                continue;
            }
            let fewer = (0..most).find_map(|walls| {
                let size = (width, height, walls);
                self.search(rule, size, demand, (limits, &mut looked)).map(|found| (walls, found))
            });
            let Some((walls, (setting, run))) = fewer.or_else(|| all.map(|found| (most, found))) else {
                continue;
            };
            let first = [number, u32::from(walls), run.start as u32];
            let choices =
                Choices { once: [&first[..], &run.steps[..]].concat(), again: run.round().to_vec() };
            looked.broken = Some((choices, setting, run));
            break;
        }
        looked
    }

    /// The first run that breaks something on one lattice.
    fn search(
        &self,
        rule: &Rule,
        size: Size,
        demand: Option<Demand>,
        (limits, looked): (Limits<'_>, &mut Looked<ROBOTS>),
    ) -> Option<(Setting<ROBOTS>, Run<Demand>)> {
        let setting = self.setting(rule, size, demand)?;
        let found = search(&setting, setting.starts(), limits);
        looked.states += found.states;
        looked.is_whole &= found.is_whole;
        for situation in found.covered {
            cover(&mut looked.covered, situation);
        }
        Some((setting, found.broken.into_iter().next()?))
    }

    fn answer(&self, looked: Looked<ROBOTS>) -> Answer {
        let is_covered = self.covers.iter().chain(&[END]).all(|situation| looked.covered.contains(situation));
        let evidence = looked.broken.map(|(choices, setting, run)| evidence(choices, &setting, &run));
        Answer::new(evidence, looked.is_whole && is_covered, Method::<Rule>::shows(self), looked.states)
    }
}

/// The smallest run that breaks a clause.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Smallest {
    /// Columns and rows of its lattice.
    pub nodes: (i16, i16),
    /// The most walls that it may meet: with fewer there is none on so many nodes.
    pub walls: u8,
    /// Drives.
    pub drives: usize,
    /// What happens, a line for each event.
    pub story: String,
}

/// The smallest run of so many robots that breaks the clause with this id, on lattices of at most so many columns and rows with
/// at most so many walls: the fewest nodes, of these the fewest walls, and of these the fewest events. `None` if there is
/// none, or the clause is not about runs on lattices.
pub fn smallest<const ROBOTS: usize>(
    rule: &Rule,
    clause: &str,
    (columns, rows): (i16, i16),
    max_walls: u8,
) -> Option<Smallest> {
    let demand = match clause {
        "KIT-1" | "KIT-2" | "KIT-12" => Demand::Contact,
        "KIT-3" => Demand::Apart,
        "KIT-6" => Demand::Moves,
        "KIT-7" => Demand::Ends,
        "KIT-8" => Demand::Covers,
        "KIT-10" => Demand::Marks,
        "KIT-11" => Demand::Shortens,
        "KIT-13" => Demand::Whole,
        _ => return None,
    };
    let speeds = if clause == "KIT-2" { Speeds::Equal } else { Speeds::Any };
    let starts = if clause == "KIT-13" { Starts::SideBySide } else { Starts::Anywhere };
    let (answers, pass) = (Answers::AnyTime, Pass::Alone);
    let lattices = Lattices::<ROBOTS> { sizes: &[], speeds, answers, starts, demand, pass, covers: &[] };
    let sizes = (1..=columns).flat_map(|width| (1..=rows.min(width)).map(move |height| (width, height)));
    let walls = |(width, height): (i16, i16)| {
        let edges = width * (height - 1) + height * (width - 1);
        (width, height, max_walls.min(u8::try_from(edges).unwrap_or(u8::MAX)))
    };
    let mut sizes: Vec<Size> = sizes.map(walls).collect();
    sizes.sort_by_key(|&(width, height, _)| (width * height, height));
    let (choices, setting, run) = lattices.look(rule, &sizes, Some(demand), Limits::NONE).broken?;
    let story = story(&setting, &run);
    let walls = choices.once.get(1).map_or(0, |&walls| walls as u8);
    let nodes = (setting.area.width() as i16, setting.area.height() as i16);
    Some(Smallest { nodes, walls, drives: story.matches("drives to").count(), story })
}

impl<const ROBOTS: usize> Method<Rule> for Lattices<ROBOTS> {
    fn engine(&self) -> &'static str {
        "states"
    }

    fn bound(&self) -> String {
        let sizes: Vec<String> = self
            .sizes
            .iter()
            .map(|&(width, height, walls)| {
                let edges = width * (height - 1) + height * (width - 1);
                match i16::from(walls) {
                    walls if walls == edges => format!("{width}×{height}"),
                    1 => format!("{width}×{height} (at most 1 wall)"),
                    walls => format!("{width}×{height} (at most {walls} walls)"),
                }
            })
            .collect();
        let robots = if ROBOTS == 1 { "1 robot".to_owned() } else { format!("{ROBOTS} robots") };
        let speeds = match self.speeds {
            Speeds::Any => "any speeds",
            Speeds::Equal => "equal speeds",
        };
        let answers = match self.answers {
            Answers::AnyTime => "",
            Answers::AtOnce => ", answered at once",
        };
        let starts = match self.starts {
            Starts::Anywhere => "all starts",
            Starts::SideBySide => "all starts side by side",
        };
        format!("all layouts of {} nodes, {starts}, {robots}, {speeds}{answers}", sizes.join(", "))
    }

    fn family(&self, rule: &Rule) -> Option<String> {
        let Self { sizes, speeds, answers, starts, .. } = self;
        (self.pass == Pass::Together)
            .then(|| format!("kit {ROBOTS} {sizes:?} {speeds:?} {answers:?} {starts:?} {rule:?}"))
    }

    /// The choices are the numbers of the lattice, of the most walls, of the start, and of the steps.
    fn decide(&self, rule: &Rule, until: Until, desk: &mut Desk<'_, '_>) -> Result<Answer, Refused> {
        let limits = Limits { room: desk.room, ..Limits::NONE };
        if self.pass == Pass::Together && until == Until::Exhausted {
            let key = (self.family(rule), *rule);
            let kept: Result<&(bool, u64, bool, Vec<&'static str>), Refused> =
                desk.memory.recall(key, |_| {
                    let looked = self.look(rule, self.sizes, None, limits);
                    Ok((looked.broken.is_none(), looked.states, looked.is_whole, looked.covered))
                });
            if let (true, states, is_whole, covered) = kept?.clone() {
                return Ok(self.answer(Looked { states, is_whole, covered, broken: None }));
            }
        }
        Ok(self.answer(self.look(rule, self.sizes, Some(self.demand), limits)))
    }

    fn replay(&self, rule: &Rule, choices: &Choices) -> Result<Played, Unfit> {
        let mut script = Script::new(choices);
        let (width, height, most) = self.sizes[script.choose(self.sizes.len())?];
        let walls = script.choose(usize::from(most) + 1)? as u8;
        let setting = self.setting(rule, (width, height, walls), Some(self.demand)).ok_or(Unfit::Unbroken)?;
        let starts: Vec<World<ROBOTS>> = setting.starts();
        let number = script.choose(starts.len())?;
        let (of, run) = script.play(&setting, (number, starts[number]), |&demand| demand == self.demand)?;
        Ok(Played { of, evidence: evidence(choices.clone(), &setting, &run) })
    }
}

fn evidence<const ROBOTS: usize>(choices: Choices, setting: &Setting<ROBOTS>, run: &Run<Demand>) -> Evidence {
    Evidence { choices, demand: run.demand.words(), seen: Seen::Story(story(setting, run)) }
}

/// What happens in a run, a line for each event.
fn story<const ROBOTS: usize>(setting: &Setting<ROBOTS>, run: &Run<Demand>) -> String {
    let (width, height) = (setting.area.width(), setting.area.height());
    let mut lines = format!("{width}×{height} nodes, 3 m apart\n");
    let Some(mut world) = setting.starts().into_iter().nth(run.start) else { return lines };
    let starts = (0..ROBOTS).filter_map(|robot| Some((robot + 1, world.team.stance(robot)?.to())));
    let starts: Vec<String> = starts.map(|(robot, node)| format!("R{robot} starts at {node}")).collect();
    lines += &starts.join(", ");
    lines.push('\n');
    let once = run.steps.len();
    for (number, &step) in run.steps.iter().chain(run.round()).enumerate() {
        if number == once {
            lines += "and from here on over and over:\n";
        }
        let mut turns = setting.turns(&world);
        if turns.len() <= step as usize {
            break;
        }
        let turned = turns.swap_remove(step as usize);
        for event in &turned.events {
            lines += &words(event);
            lines.push('\n');
        }
        world = turned.world;
    }
    lines
}

/// An event in words.
fn words(event: &Event) -> String {
    match event {
        Event::Arrives(robot, node) => format!("R{} arrives at {node}", robot + 1),
        Event::Decides(robot, looks, next) => {
            let look = |&(side, sight): &(Side, Sight)| {
                let side = match side {
                    Side::East => "east",
                    Side::South => "south",
                    Side::West => "west",
                    Side::North => "north",
                };
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

#[cfg(test)]
mod tests {
    use std::time::Instant;

    use super::*;

    /// All states of two robots that follow the repaired rule on one lattice: none breaks anything.
    fn all_states(size: Size) {
        let lattices = Lattices::<2> {
            sizes: &[],
            speeds: Speeds::Any,
            answers: Answers::AnyTime,
            starts: Starts::Anywhere,
            demand: Demand::Contact,
            pass: Pass::Together,
            covers: &[],
        };
        let begun = Instant::now();
        let setting = lattices.setting(&Rule::REPAIRED, size, None).expect("a lattice");
        let found = search(&setting, setting.starts(), Limits::NONE);
        println!(
            "{size:?}: {} states, {} steps, {} MiB, {:.0} s",
            found.states,
            found.steps,
            found.bytes >> 20,
            begun.elapsed().as_secs_f64()
        );
        assert!(found.is_whole && found.broken.is_empty(), "{size:?}");
    }

    #[test]
    #[ignore = "takes minutes: cargo test --release -p tautline-proofs -- --ignored --nocapture two_robots_keep"]
    fn two_robots_keep_every_promise_on_three_by_three_nodes() {
        for walls in [0, 1] {
            all_states((3, 3, walls));
        }
    }

    #[test]
    #[ignore = "takes minutes: cargo test --release -p tautline-proofs -- --ignored --nocapture two_robots_keep"]
    fn two_robots_keep_every_promise_in_two_rows_of_four_nodes() {
        for walls in [0, 2, 4] {
            all_states((4, 2, walls));
        }
    }

    #[test]
    fn the_smallest_runs_that_break_the_published_rule() {
        let of = |clause: &str| {
            let found = smallest::<2>(&Rule::PUBLISHED, clause, (5, 2), 2)?;
            Some((found.nodes, found.walls, found.drives))
        };
        assert_eq!(of("KIT-1"), Some(((5, 1), 0, 5)));
        assert_eq!(of("KIT-2"), Some(((5, 2), 2, 7)));
        assert_eq!(of("KIT-3"), Some(((3, 1), 0, 3)));
        assert_eq!(of("KIT-6"), Some(((3, 1), 0, 1)));
        assert_eq!(smallest::<2>(&Rule::REPAIRED, "KIT-1", (3, 1), 2), None);
        assert_eq!(smallest::<2>(&Rule::PUBLISHED, "KIT-9", (3, 1), 2), None);
    }
}
