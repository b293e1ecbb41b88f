//! A run of the simulator on a layout, as a page plays it: its team asks about sides that were not tried before, and
//! the layout answers unless somebody else does.

use std::collections::BTreeMap;

use tautline_grids::layout::Layout;
use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::ground::{Area, Edge, Step as Move};
use tautline_sim::draw::page::{film, number_of, place_of, side_of};
use tautline_sim::explore::{
    Change, ClauseId, Course, CourseMove, Hearers, Look, Play as _, Scene, Setup, Surroundings, Team,
};
use tautline_sim::trace;

use crate::ask::{Answers, Question};
use crate::clauses::sentence;
use crate::play::{Board, BrokenClause, Delta, Over, Play, Refusal, Step};
use crate::settings::Settings;

/// A run on a layout.
pub(crate) struct Run {
    setup: Setup,
    team: Box<dyn Team>,
    course: Course,
    /// The sides that were asked about, and whether they are open.
    asked: BTreeMap<Edge, bool>,
}

impl Run {
    /// The run of these settings, at its start.
    pub(crate) fn new(settings: &Settings) -> Result<Self, Diagnostic> {
        let setup = settings.setup()?;
        let team = settings.team(&setup)?;
        let course = Course::new(&*team, &setup.layout);
        Ok(Self { setup, team, course, asked: BTreeMap::new() })
    }

    /// The area of the board: that of the whole layout.
    fn area(&self) -> Area {
        self.setup.layout.size().area()
    }

    /// The changes of the team move `made`.
    fn delta(&self, made: &CourseMove, walls: Vec<(Edge, bool)>) -> Delta {
        let area = self.area();
        let number = |cell| place_of(area, cell);
        let team_move = self.course.team_move(made, &*self.team);
        let mut broken = broken_of(made.broken.iter().copied());
        for (one, &clause) in broken.iter_mut().zip(&made.broken) {
            one.told = self.setup.lines(clause, &self.course.report.chart, &team_move);
        }
        let mut delta = Delta {
            step: team_move.step,
            cells: made.frame.cells.iter().map(|&cell| number(cell)).collect(),
            tried: made
                .frame
                .steps
                .iter()
                .zip(&made.frame.blocked)
                .map(|(&step, &is)| letter(step, is))
                .collect(),
            back: made.frame.kind == tautline_kernel::chain::Kind::Backtrack,
            explored: made
                .frame
                .cells
                .iter()
                .chain(self.team.seen())
                .filter_map(|&cell| number(cell))
                .collect(),
            unseen: team_move.unseen.iter().filter_map(|&cell| number(cell)).collect(),
            walls: walls.into_iter().filter_map(|(edge, is)| Some((side_of(area, edge)?, is))).collect(),
            words: self.team.title().unwrap_or_default().to_owned(),
            broken,
            lost: self.setup.scheme.look.lost(&made.before, &made.frame.cells),
            ..Delta::default()
        };
        for (robot, &from) in made.before.iter().enumerate() {
            if let Move::Cross(at) = made.frame.steps[robot]
                && let Some(at) = side_of(area, Edge::new(from, at))
            {
                delta.known.push((at, !made.frame.blocked[robot]));
            }
        }
        let mut scene = Scene::default();
        self.team.show(&made.before, &mut scene);
        delta.show(area, &scene);
        delta
    }
}

/// The clauses in words.
fn broken_of(clauses: impl IntoIterator<Item = ClauseId>) -> Vec<BrokenClause> {
    let broken = |clause: ClauseId| BrokenClause {
        clause: clause.to_string(),
        sentence: sentence(clause.as_str()),
        told: Vec::new(),
        cells: Vec::new(),
    };
    clauses.into_iter().map(broken).collect()
}

/// The letter of a step: small where a wall was met.
fn letter(step: Move, is_blocked: bool) -> char {
    let letter = trace::letter(step);
    if is_blocked { letter.to_ascii_lowercase() } else { letter }
}

impl Delta {
    /// Takes in what a scene changes.
    fn show(&mut self, area: Area, scene: &Scene) {
        for change in scene.changes() {
            match change {
                Change::Clear { layer } => self.clear.push(*layer),
                &Change::Put { layer, robot, place: at, value } => {
                    self.put.extend(number_of(area, at).map(|at| (layer, robot, at, value)));
                }
                Change::Mark { layer, mark } => {
                    self.marks.push((*layer, mark.number, mark.value, mark.figures.clone()));
                }
                &Change::Know { side: edge, is_open } => {
                    self.known.extend(side_of(area, edge).map(|at| (at, is_open)));
                }
                Change::Say { layer, kind, from, to } => {
                    let to = match to {
                        Hearers::All => None,
                        Hearers::These(robots) => Some(robots.clone()),
                    };
                    self.say.push((*layer, *kind, *from, to));
                }
                Change::Take { .. } => {}
                &Change::Fail { robot } => self.failed.push(robot),
            }
        }
    }
}

/// Asks whoever decides about sides, each once, and about what no layout knows.
struct SideOracle<'a> {
    layout: &'a Layout,
    world: &'a mut Answers,
    asked: &'a mut BTreeMap<Edge, bool>,
    /// The walls that answers make or take away.
    walls: Vec<(Edge, bool)>,
}

impl Surroundings for SideOracle<'_> {
    fn is_open(&mut self, edge: Edge) -> bool {
        let Self { layout, world, asked, walls } = self;
        let cells = [edge.cell(), edge.cell().beyond(edge.side())];
        if cells.iter().any(|&cell| !layout.is_free(cell)) {
            return false;
        }
        *asked.entry(edge).or_insert_with(|| {
            let usual = u32::from(layout.has_wall(edge));
            let answer = world.ask(usual, || question(layout, edge, usual)).min(1);
            if answer != usual {
                walls.push((edge, answer == 1));
            }
            answer == 0
        })
    }

    fn choose(&mut self, words: &str, options: &mut dyn FnMut() -> Vec<String>, usual: u32) -> u32 {
        let (words, robots) = (words.to_owned(), Vec::new());
        self.world.ask(usual, || Question { words, options: options(), usual, side: None, robots })
    }
}

/// The question whether a side is open.
fn question(layout: &Layout, edge: Edge, usual: u32) -> Question {
    let (cell, beyond) = (edge.cell(), edge.cell().beyond(edge.side()));
    Question {
        words: format!("Is the side between {cell} and {beyond} open?"),
        options: vec!["open".to_owned(), "a wall".to_owned()],
        usual,
        side: side_of(layout.size().area(), edge),
        robots: Vec::new(),
    }
}

/// The names of so many robots, if they do not count from 1.
fn names(look: Look, robots: usize) -> Vec<String> {
    let first = look.first_number();
    if first == 1 { Vec::new() } else { (first..first + robots).map(|robot| robot.to_string()).collect() }
}

impl Play for Run {
    fn board(&self) -> Board {
        let area = self.area();
        let Self { setup, team, course, .. } = self;
        let cells = team.cells();
        let own = team.area(&setup.layout);
        let number = |cell| place_of(area, cell);
        Board {
            columns: area.width(),
            rows: area.height(),
            area: [own.first().x, own.first().y, own.width() as i16, own.height() as i16],
            robot: setup.scheme.look.robot(),
            unit: "team move",
            squares: usize::from(setup.scheme.look.has_base()),
            names: names(setup.scheme.look, cells.len()),
            has_leader: matches!(setup.scheme.look, Look::Linked { .. }),
            sees: setup.scheme.knowledge.is_some(),
            due: course.report.cells,
            layers: team.layers().iter().map(film::layer).collect(),
            start: Delta {
                cells: cells.iter().map(|&cell| number(cell)).collect(),
                tried: ".".repeat(cells.len()),
                explored: cells.iter().chain(team.seen()).filter_map(|&cell| number(cell)).collect(),
                ..Delta::default()
            },
        }
    }

    fn step(&mut self, world: &mut Answers) -> Step {
        let Self { setup, team, course, asked } = self;
        let mut asking = SideOracle { layout: &setup.layout, world, asked, walls: Vec::new() };
        let made = course.step(&mut **team, &setup.layout, setup.limits, &mut asking);
        let walls = asking.walls;
        for &(edge, is_wall) in &walls {
            if is_wall {
                setup.layout.build_wall(edge);
            } else {
                setup.layout.remove_wall(edge);
            }
        }
        if let Some(made) = made {
            return Step::Made(Box::new(self.delta(&made, walls)));
        }
        let report = &self.course.report;
        let last = report.violations.iter().filter(|broken| broken.step == report.steps);
        let at_end =
            last.filter_map(|broken| Some((broken.clause, self.setup.missed(broken.clause, &report.chart)?)));
        let broken = at_end.flat_map(|(clause, (what, cells))| {
            let mut broken = broken_of([clause]);
            for one in &mut broken {
                one.cells = cells.iter().filter_map(|&cell| place_of(self.area(), cell)).collect();
                let listed: Vec<String> = cells.iter().take(20).map(|cell| format!("({cell})")).collect();
                let more = cells.len().saturating_sub(20);
                let more = if more > 0 { format!(" and {more} more") } else { String::new() };
                one.told = vec![format!("{what}: {}{more}.", listed.join(" "))];
            }
            broken
        });
        Step::Over(Over { words: report.stop_words().to_owned(), broken: broken.collect() })
    }

    fn refusals(&self) -> Vec<Refusal> {
        let (area, cells) = (self.area(), self.team.cells());
        let refused = |refusal: tautline_sim::explore::Refusal| {
            let to = place_of(area, cells.get(refusal.robot)?.after(refusal.step))?;
            Some(Refusal { robot: refusal.robot, to, by: refusal.by })
        };
        self.team.refusals().into_iter().filter_map(refused).collect()
    }
}
