//! Rajesh, Nagaraja and Suja 2024 as one system: robots that localise themselves, choose frontier cells, go there,
//! avoid obstacles and each other, and map what they find, with the noise of signals and of wheels. A run is clean if
//! nothing is noted that is not so, no two robots are in one cell, and every cell within reach is explored. Mutants
//! stand beside the rule.

use tautline_kernel::frontier::{Condition, Rule};
use tautline_kernel::ground::{Area, Cell};
use tautline_kernel::position::{Belief, Point as Place, SightError};
use tautline_proofs::engine::SeededOracle;

use super::prelude::*;
use tautline_field::stats::quantile;
use tautline_sim::explore::frontier::FRONTIER;
use tautline_sim::explore::{RuleId, Setup, has_double};
use tautline_sim::frontier::{Allowance, Explorers, cell_at};
use tautline_sim::objects::scattered;
use tautline_sim::options::{Options, Wheels};

/// The whole paper under noise.
#[derive(Clone, Copy, Debug)]
pub struct LocateExplore;

settings! {
    /// How much is measured.
    pub struct Settings {
        /// Random layouts of each size
        pub layouts: u32 = 1000, one("runs", "COUNT", from_to(1..=100_000));
        /// The seed of the first layout and its runs; the others have the seeds after it
        pub seed: u64 = 0, one("seed", "SEED", number);
        /// Noise of each beacon, in decibels
        pub noise_db: Vec<f64> = vec![0.0, 0.5, 1.0, 2.0], list("noise-db", real);
        /// Shares of blocked cells, in percent
        pub blocked: Vec<u8> = vec![10], list("blocked", from_to(0..=40));
        /// Robots of the teams
        pub robots: Vec<u16> = vec![4, 8], list("robots", from_to(1..=16));
        /// Beacons of each anchor that a robot averages at each stop
        pub readings: u16 = 100, one("readings", "BEACONS", from_to(1..=10_000));
        /// Anchors around the area, of which a robot takes the best three
        pub anchors: u8 = 3, one("anchors", "ANCHORS", from_to(3..=8));
    }
}

/// Columns and rows of the areas: that of Fig. 3 on its side, and one of four times as many cells.
const SIZES: [(u64, u64); 2] = [(7, 6), (12, 14)];

/// The rules: their names, what they are, and how many beacons they hear, if not as many as is said.
const RULES: [(&str, Rule, Option<u16>); 5] = [
    ("repaired", Rule::REPAIRED, None),
    ("fixes without covariance", Rule::REPAIRED.without(Condition::Fuse).without(Condition::Sure), None),
    ("unsure robots move", Rule::REPAIRED.without(Condition::Sure), None),
    ("wheels alone", Rule::REPAIRED.without(Condition::Sure), Some(0)),
    ("published, wanders", Rule::WANDERS, None),
];

/// The rule of the clauses.
const REPAIRED: usize = 0;

/// Team moves after which a run is left.
const MOST_MOVES: u32 = 5000;

/// Objects in each run.
const OBJECTS: u32 = 8;

/// The outcome of a run.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct Outcome {
    /// Team moves until every cell is explored, if that is so and nothing was broken.
    moves: Option<u32>,
    /// How often a robot stood to take another fix.
    stands: u32,
    /// The root mean square error of where robots take themselves to be, in millionths of a cell's side.
    off: u32,
    /// How far off the objects were that robots saw, in millionths of a cell's side, and what their ellipses say.
    objects: Vec<[u32; 2]>,
    /// How far off they are by [`printed_off`], each as it was seen first, in millionths of a cell's side.
    printed: Vec<u32>,
}

/// The whole table.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Summary {
    #[serde(flatten)]
    settings: Settings,
    /// Share of blocked cells by share, size by size, team by team, rule by rule.
    pub lines: Vec<Line>,
    /// How large a floor may be.
    pub floors: Vec<Floor>,
}

/// A team of a rule in areas of one size.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Line {
    /// Columns and rows.
    pub size: (u64, u64),
    /// Blocked cells, in percent.
    pub blocked: u8,
    /// Robots.
    pub robots: u16,
    /// The rule.
    pub rule: &'static str,
    /// Noise by noise.
    pub figures: Vec<Figure>,
}

/// The runs of a team with one noise.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Figure {
    /// Noise, in decibels.
    pub noise_db: f64,
    /// Runs in which nothing is broken and every cell within reach is explored.
    pub clean: Option<Estimate>,
    /// Team moves of clean runs.
    pub moves: Option<Estimate>,
    /// Team moves of clean runs over those of the repaired rule without noise, on the same layouts.
    pub ratio: Option<Estimate>,
    /// How often robots stand in a run.
    pub stands: Option<Estimate>,
    /// The root mean square error of where robots take themselves to be, in sides of a cell.
    pub off: Option<Estimate>,
    /// Errors of objects: the median and the 95th percentile, in sides of a cell.
    pub objects: Option<[f64; 2]>,
    /// The root mean square error of objects over that of their ellipses.
    pub objects_ratio: Option<f64>,
    /// Errors of objects whose printed coordinates are taken for their place in the area: the median and the 95th
    /// percentile, in sides of a cell.
    pub objects_printed: Option<[f64; 2]>,
}

/// The floors that a noise allows.
#[derive(Clone, Copy, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Floor {
    /// Noise, in decibels.
    pub noise_db: f64,
    /// Cells across the largest square in which a robot that has a fix need not stand for another one.
    pub without_stops: u32,
    /// Cells across the largest square in which it stands for at most ten team moves.
    pub with_stops: u32,
}

impl Settings {
    fn options(&self, noise_db: f64, readings: Option<u16>) -> Options {
        let readings = Some(readings.unwrap_or(self.readings));
        let odometry = (noise_db > 0.0).then_some(Wheels { share: 0.02, turn_degrees: 1.0 });
        Options { noise_db, readings, anchors: Some(self.anchors), odometry, ..Options::USUAL }
    }

    fn points(&self) -> impl Iterator<Item = Point> + '_ {
        let floors = pairs(self.blocked.iter().copied(), SIZES);
        pairs(floors, self.robots.iter().copied()).map(|((blocked, size), robots)| (blocked, size, robots))
    }

    /// The largest square for which this is so, in cells across.
    fn largest(&self, noise_db: f64, stops: u32) -> u32 {
        let is_small = |across: &i16| {
            let area = Area::new(Cell::new(0, 0), Cell::new(across - 1, across - 1));
            let allowance = area.and_then(|area| Allowance::new(&self.options(noise_db, None), area));
            matches!(allowance, Some(Allowance::Stops(needed)) if needed <= stops)
        };
        (1..500).take_while(is_small).count() as u32
    }
}

/// Blocked cells in percent, columns and rows, robots.
type Point = (u8, (u64, u64), u16);

impl Table for LocateExplore {
    type Settings = Settings;
    type Job = Run<Point>;
    type Sample = Vec<Outcome>;
    type Summary = Summary;

    fn about(&self) -> Description {
        Description {
            id: "locate-explore",
            shows: "robots that localise themselves and explore frontier cells: how \
                    many runs are clean, by the noise of signals",
            help: "How many runs are clean of robots that localise themselves and explore, by the noise of signals",
            more: "Wheels err by 2 % of the way and 1° a turn. Anchors stand in three corners. Of the mutants, robots \
                   without Sure never stand to take another fix. Off as printed: (d cos θ, -d sin θ) is taken for the \
                   place in the area, not in the frame of the robot.",
            examples: &[
                "locate-explore --runs 100",
                "locate-explore --noise-db 2 --blocked 10,20,30 --format json",
            ],
            doing: "exploring",
            takes: "minutes",
            ..Description::NOTHING
        }
    }

    fn jobs(&self, settings: &Settings) -> Result<Vec<Self::Job>, Halt> {
        if let Some(wrong) = settings.noise_db.iter().find(|noise_db| !(0.0..=100.0).contains(*noise_db)) {
            let what = format!("a standard deviation of noise is not {} dB", Number(*wrong));
            return Err(Diagnostic::usage(what, "give `noise-db` numbers of decibels from 0 to 100").into());
        }
        Ok(runs(settings.points(), |_| settings.layouts))
    }

    fn measure(&self, settings: &Settings, run: &Self::Job, _: &dyn Observer) -> Result<Vec<Outcome>, Halt> {
        let (blocked, (width, height), robots) = run.at;
        let seed = run.seed(settings.seed);
        let mut layout = generated(&format!("cells:{width}x{height}:{}", f64::from(blocked) / 100.0), seed)?;
        let base = Setup::choose_base(&mut layout, None)?;
        let starts = FRONTIER.default_starts(RuleId::REPAIRED, &layout, base, robots);
        let starts = starts.unwrap_or_else(|| vec![base]);
        let due = layout.reachable(&starts);
        let mut oracle = SeededOracle::new(seed, 0);
        let objects = scattered(&due, 1.0, OBJECTS, &mut oracle);
        let cases =
            RULES.iter().flat_map(|rule| settings.noise_db.iter().map(move |&noise_db| (rule, noise_db)));
        let outcome = |(&(_, rule, readings), noise_db): (&(&str, Rule, Option<u16>), f64)| {
            let options = settings.options(noise_db, readings);
            let team = Explorers::new(rule, &layout, &starts, options, seed).among(objects.iter().copied());
            follow(team, due.len() - starts.len(), &starts)
        };
        Ok(cases.map(outcome).collect())
    }

    fn merge(&self, settings: &Settings, results: Results<Self>) -> Result<Summary, Halt> {
        let noises = settings.noise_db.len();
        let line = |(blocked, size, robots): Point, number: usize| {
            let here = at(&results, (blocked, size, robots));
            let of = |rule: usize, noise: usize| -> Vec<&Outcome> {
                here.iter().filter_map(|outcomes| outcomes.get(rule * noises + noise)).collect()
            };
            let plain = settings.noise_db.iter().position(|&noise_db| noise_db == 0.0);
            let plain = plain.map(|noise| of(REPAIRED, noise));
            let figure = |(noise, &noise_db): (usize, &f64)| {
                Figure::of(noise_db, &of(number, noise), plain.as_deref().unwrap_or_default())
            };
            let figures = settings.noise_db.iter().enumerate().map(figure).collect();
            Line { size, blocked, robots, rule: RULES[number].0, figures }
        };
        let lines = settings.points().flat_map(|point| (0..RULES.len()).map(move |rule| (point, rule)));
        let lines: Vec<Line> = lines.map(|(point, rule)| line(point, rule)).collect();
        let noisy = settings.noise_db.iter().copied().filter(|&noise_db| noise_db > 0.0);
        let floor = |noise_db| Floor {
            noise_db,
            without_stops: settings.largest(noise_db, 0),
            with_stops: settings.largest(noise_db, 10),
        };
        let floors = noisy.map(floor).collect();
        Ok(Summary { settings: settings.clone(), lines, floors })
    }

    fn text(&self, settings: &Settings, merged: &Summary) -> Result<String, Halt> {
        type Part = (&'static str, fn(&Figure) -> String);
        // Of the repaired rule.
        let parts: [Part; 9] = [
            ("team moves", |figure| text(figure.moves, 1)),
            ("times those without noise", |figure| text(figure.ratio, 2)),
            ("a robot stands, times a run", |figure| text(figure.stands, 1)),
            ("positions off, in cells (rms)", |figure| text(figure.off, 3)),
            ("objects off, in cells: median", |figure| plain(figure.objects.map(|[median, _]| median), 3)),
            ("objects off: 95th percentile", |figure| plain(figure.objects.map(|[_, most]| most), 3)),
            ("over their ellipses (rms)", |figure| plain(figure.objects_ratio, 2)),
            ("off as printed: median", |figure| plain(figure.objects_printed.map(|[median, _]| median), 3)),
            ("off as printed: 95th percentile", |figure| {
                plain(figure.objects_printed.map(|[_, most]| most), 3)
            }),
        ];
        let mut told = format!(
            "{} runs for each, {} anchors, {} beacons of each at a stop, \
             wheels 2 % of the way and 1° a turn, seed {}\n",
            settings.layouts, settings.anchors, settings.readings, settings.seed
        );
        for lines in merged.lines.chunks(RULES.len()) {
            let Line { size: (width, height), blocked, robots, figures, .. } = &lines[REPAIRED];
            told.extend([format!("\n{width}×{height} cells, {blocked} % blocked, {robots} robots\n")]);
            let mut clean = Columns::of(lines).left("clean runs, %", |line| line.rule);
            let mut repaired = Columns::of(&parts).left("repaired", |part| part.0);
            for (noise, noise_db) in settings.noise_db.iter().enumerate() {
                let title = format!("{} dB", Number(*noise_db));
                clean = clean.right(title.clone(), move |line| percent(line.figures[noise].clean, 1));
                repaired = repaired.right(title, move |part| part.1(&figures[noise]));
            }
            told += &(clean.text() + &repaired.text());
        }
        told += "\nThe largest square floor, in cells across, by the Cramér–Rao bound of a stop\n";
        let floors = Columns::of(&merged.floors)
            .right("noise, dB", |floor| floor.noise_db)
            .right("one fix is enough", |floor| floor.without_stops)
            .right("at most ten more are", |floor| floor.with_stops);
        Ok(told + &floors.text() + "\n±: the 95 % interval\n")
    }

    fn sentences(&self, merged: &Summary) -> Vec<Judgement> {
        judged(&merged.settings, &merged.lines)
    }
}

/// How far off an object at `object` is where its printed coordinates (d cos θ, −d sin θ) are taken for its place in
/// the area, not in the frame of the robot at `robot` that sees it without error (4.5). The origin is the midpoint of
/// the first cell.
fn printed_off(robot: Place, heading_rad: f64, object: Place) -> f64 {
    let (turn_rad, far) = Belief::known(robot, heading_rad).towards(object);
    let exact = SightError { bearing_rad: 0.0, distance_m: 0.0 };
    Belief::known(Place::new(0.0, 0.0), 0.0).sees(-turn_rad, far, &exact).at.distance_m(object)
}

/// Follows a team to the end of its run.
fn follow(mut team: Explorers, due: usize, starts: &[Cell]) -> Outcome {
    let mut seen: Vec<Cell> = starts.to_vec();
    let (mut moves, mut whole, mut is_clean) = (0, None, true);
    let (mut squares, mut count) = (0.0, 0);
    let mut printed = vec![None; team.objects().len()];
    while team.advance().is_ok() {
        moves += 1;
        for off in team.errors() {
            (squares, count) = (squares + off * off, count + 1);
        }
        is_clean &= !team.has_false_note() && !has_double(team.cells());
        for ((object, known), off) in team.objects().iter().zip(&mut printed) {
            if known.is_some() && off.is_none() {
                let robot = team.cells().iter().position(|&cell| cell == cell_at(*object));
                let pose = robot.and_then(|robot| team.poses().nth(robot));
                *off = pose.map(|(at, belief, _)| printed_off(at, belief.heading_rad(), *object));
            }
        }
        for &cell in team.cells() {
            if !seen.contains(&cell) {
                seen.push(cell);
            }
        }
        if whole.is_none() && seen.len() - starts.len() == due {
            whole = Some(moves);
        }
        if !is_clean || moves == MOST_MOVES {
            break;
        }
    }
    let off = team.objects().iter().filter_map(|(object, known)| {
        let known = known.as_ref()?;
        Some([millionths(known.at.distance_m(*object)), millionths(known.covariance.trace().sqrt())])
    });
    let objects = off.collect();
    let printed = printed.into_iter().flatten().map(millionths).collect();
    let off = millionths((squares / f64::from(count.max(1))).sqrt());
    let stands = team.stands() as u32;
    Outcome { moves: whole.filter(|_| is_clean), stands, off, objects, printed }
}

/// The sides of a cell, in what an outcome counts.
fn millionths(sides: f64) -> u32 {
    (1e6 * sides).round() as u32
}

/// The millionths in sides of a cell.
fn in_sides(millionths: u32) -> f64 {
    f64::from(millionths) / 1e6
}

impl Figure {
    fn of(noise_db: f64, outcomes: &[&Outcome], plain: &[&Outcome]) -> Self {
        let both = outcomes.iter().zip(plain).filter_map(|(outcome, plain)| {
            Some((f64::from(outcome.moves?), f64::from(plain.moves.filter(|&moves| moves > 0)?)))
        });
        let clean = || outcomes.iter().filter(|outcome| outcome.moves.is_some());
        let ends = |errors: &dyn Fn(&Outcome) -> Vec<u32>| {
            let mut errors: Vec<f64> = clean().flat_map(|outcome| errors(outcome)).map(in_sides).collect();
            errors.sort_by(f64::total_cmp);
            (!errors.is_empty()).then(|| [0.5, 0.95].map(|share| quantile(&errors, share).0))
        };
        let squares = |of: usize| -> f64 {
            clean()
                .flat_map(|outcome| outcome.objects.iter().map(move |all| f64::from(all[of]).powi(2)))
                .sum()
        };
        Self {
            noise_db,
            clean: share(outcomes.iter(), |outcome| outcome.moves.is_some()),
            moves: mean(clean().filter_map(|outcome| outcome.moves.map(f64::from))),
            ratio: ratio(both),
            stands: mean(clean().map(|outcome| f64::from(outcome.stands))),
            off: mean(clean().map(|outcome| in_sides(outcome.off))),
            objects: ends(&|outcome| outcome.objects.iter().map(|[off, _]| *off).collect()),
            objects_printed: ends(&|outcome| outcome.printed.clone()),
            objects_ratio: (squares(1) > 0.0).then(|| (squares(0) / squares(1)).sqrt()),
        }
    }
}

/// The paper's sentences, judged by what is measured with the most noise, floor by floor.
fn judged(settings: &Settings, lines: &[Line]) -> Vec<Judgement> {
    let (Some(last), Some(fewest), Some(most)) =
        (settings.noise_db.len().checked_sub(1), settings.robots.iter().min(), settings.robots.iter().max())
    else {
        return Vec::new();
    };
    let noise_db = settings.noise_db[last];
    let mut judged = [(); 4].map(|()| Vec::new());
    for (blocked, (width, height)) in pairs(settings.blocked.iter().copied(), SIZES) {
        let of = |rule: usize, robots: u16| {
            let is_it = |line: &&Line| {
                (line.blocked, line.size, line.robots, line.rule)
                    == (blocked, (width, height), robots, RULES[rule].0)
            };
            Some(&lines.iter().find(is_it)?.figures[last])
        };
        let floor = format!("{width}×{height} cells, {blocked} % blocked, {} dB", Number(noise_db));
        let teams = [*fewest, *most].map(|robots| (robots, of(REPAIRED, robots)));
        let ends = |part: fn(&Figure) -> Option<Estimate>| {
            teams.map(|(_, figure)| figure.and_then(part).and_then(|one| one.interval))
        };
        let measured = |part: fn(&Figure) -> Option<Estimate>, digits| {
            let of = |(robots, figure): (u16, Option<&Figure>)| {
                format!("{} with {}", text(figure.and_then(part), digits), counted(robots, "robot"))
            };
            let shown = if fewest == most { &teams[1..] } else { &teams[..] };
            shown.iter().copied().map(of).collect::<Vec<_>>().join(", ")
        };
        let (moves, off) = (|one: &Figure| one.moves, |one: &Figure| one.off);
        let [few, many] = ends(moves);
        judged[0].push(Judgement::new(
            "“performs better when team of robots has 8 members”",
            &floor,
            format!("team moves of the repaired rule: {}", measured(moves, 1)),
            if *most == 8 { below(many, few) } else { Verdict::Open },
        ));
        judged[1].push(Judgement::new(
            "“reduce the localization error to a threshold level of 0.02cm or below”",
            &floor,
            format!(
                "root mean square errors in cells, where 0.02 cm are 0.0002 of 1 m: {}",
                measured(off, 4)
            ),
            below(teams[0].1.and_then(off).and_then(|off| off.interval), Some([0.0002; 2])),
        ));
        let [few, many] = ends(off);
        judged[2].push(Judgement::new(
            "“gradual increase in localization error related to the number of robots”",
            &floor,
            format!("root mean square errors in cells: {}", measured(off, 3)),
            below(few, many),
        ));
        let published = of(RULES.len() - 1, *most).and_then(|figure| figure.clean);
        let repaired = of(REPAIRED, *most).and_then(|figure| figure.clean);
        judged[3].push(Judgement::new(
            "“avoiding overlapping or missing out sectors”",
            &floor,
            format!(
                "clean runs of {}: published {} %, repaired {} %",
                counted(*most, "robot"),
                percent(published, 1),
                percent(repaired, 1)
            ),
            always(published),
        ));
    }
    judged.concat()
}

#[cfg(test)]
mod tests {
    use core::f64::consts::{FRAC_PI_2, PI};

    use super::*;

    #[test]
    fn without_the_robots_pose_an_object_is_off_by_the_robots_place_and_turned_by_its_heading() {
        let [robot, object] = [Place::new(4.0, 3.0), Place::new(4.25, 2.5)];
        let off = |robot, heading_rad| printed_off(robot, heading_rad, object);
        let is = |off: f64, due: f64| (off - due).abs() < 1e-12;
        assert!(is(off(Place::new(0.0, 0.0), 0.0), 0.0), "at the origin the two readings are one");
        assert!(is(off(robot, 0.0), 5.0), "as far as the robot is from the origin");
        // What is (0.25, −0.5) from the robot is (−0.5, −0.25) and (−0.25, 0.5) in its frame.
        assert!(is(off(robot, FRAC_PI_2), Place::new(-0.5, -0.25).distance_m(object)));
        assert!(is(off(robot, PI), Place::new(-0.25, 0.5).distance_m(object)));
    }
}
