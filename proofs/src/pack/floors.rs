//! All small floors: every set of obstacles and all starts (PACK-1 to PACK-6, PACK-8, PACK-9). A rule of a pack leaves
//! nothing to chance, so there is one run for each. A counterexample has the fewest cells, and of these the fewest
//! obstacles.

use tautline_kernel::ground::{Area, Cell, neighbours};

use super::gains::Gains;
use super::readings::Subject;
use super::run::{Demand, Floor, RunOutcome, play, story};
use crate::decide::{
    self, Answer, Context, Depiction, DrawnCertificate, Evidence, Method, MethodError, MethodResult,
    RefutationPlay, Verdict,
};
use crate::engine::smallest::{Class, ClassFindings, Most, smallest};
use crate::engine::watchdog::Steps;
use crate::engine::{Choices, Script, ScriptError, Until, cover};
use crate::judge::{AnyCase, pack as judge};
use crate::plural::{counted, listed};
use crate::protocol::arrangements;
use crate::run::place;

/// Columns and rows.
pub(super) type Size = (i16, i16);

/// The rows of a floor: `#` is an obstacle.
pub(super) type Drawing = &'static [&'static str];

/// Where robots start.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Starts {
    /// Side by side: their cells share sides and are one set.
    Beside,
    /// Anywhere, as long as links join them.
    Linked,
}

/// Floors to look at.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Bounds {
    /// Fewest cells first, each with the most obstacles.
    pub(super) sizes: &'static [(Size, u32)],
    /// And these floors.
    pub(super) drawn: &'static [Drawing],
    pub(super) robots: usize,
    pub(super) sight_cells: u16,
    pub(super) range_cells: u16,
    pub(super) starts: Starts,
    pub(super) gains: Gains,
}

/// Floors, and what is demanded of a pack there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Floors {
    pub(super) bounds: Bounds,
    pub(super) demand: Demand,
    /// The situations that must occur.
    pub(super) covers: &'static [&'static str],
}

/// The number of a size, of its set of obstacles, and of the starts there.
type Place = [usize; 3];

/// The findings on all floors.
struct Findings {
    runs: u64,
    covered: Vec<&'static str>,
    /// By demand: the first floor where it is broken.
    broken: [Option<Place>; Demand::ALL.len()],
}

impl Bounds {
    fn subject(&self, subject: &Subject) -> Result<Subject, MethodError> {
        let rule = subject.rule.within(self.sight_cells, self.range_cells).map_err(MethodError::new)?;
        Ok(Subject { rule, ..*subject })
    }

    fn area(size: Size) -> Result<Area, MethodError> {
        let area = Area::new(Cell::new(0, 0), Cell::new(size.0 - 1, size.1 - 1));
        area.filter(|area| area.width() * area.height() < u64::BITS as usize)
            .ok_or_else(|| MethodError::new("a floor has from 1 to 63 cells"))
    }

    /// How many sizes and drawings there are.
    const fn count(&self) -> usize {
        self.sizes.len() + self.drawn.len()
    }

    /// The area of the size or drawing with this number, and the sets of obstacles there, the fewest first.
    fn layouts(&self, number: usize) -> Result<(Area, Vec<u64>), MethodError> {
        let Some(&(size, most)) = self.sizes.get(number) else {
            let drawing = self.drawn.get(number - self.sizes.len()).copied().unwrap_or_default();
            return Ok((Self::area(size_of(drawing))?, vec![obstacles_of(drawing)]));
        };
        let area = Self::area(size)?;
        let cells = area.width() * area.height();
        let mut sets: Vec<u64> = (0..1_u64 << cells).filter(|set| set.count_ones() <= most).collect();
        sets.sort_by_key(|set| (set.count_ones(), *set));
        Ok((area, sets))
    }

    /// The starts among the free cells.
    fn starts(&self, area: Area, obstacles: u64) -> Vec<Vec<Cell>> {
        let free: Vec<Cell> = (0..)
            .zip(area.cells())
            .filter(|(place, _)| obstacles >> place & 1 == 0)
            .map(|(_, cell)| cell)
            .collect();
        let mut starts = arrangements(&free, self.robots);
        starts.retain(|starts| self.starts == Starts::Linked || are_side_by_side(starts));
        starts
    }

    /// Runs a pack on every floor; ends with the first one that breaks `until`.
    fn search(&self, subject: &Subject, until: Option<Demand>) -> Result<Findings, MethodError> {
        let subject = self.subject(subject)?;
        let mut found = Findings { runs: 0, covered: Vec::new(), broken: [None; Demand::ALL.len()] };
        let steps = Steps::begin();
        for number in 0..self.count() {
            let (area, sets) = self.layouts(number)?;
            for (set, obstacles) in sets.into_iter().enumerate() {
                for (start, starts) in self.starts(area, obstacles).into_iter().enumerate() {
                    steps.next();
                    let Some(played) = play(&subject, &Floor { area, obstacles, starts }, self.gains) else {
                        continue;
                    };
                    found.runs += 1;
                    for situation in played.covered {
                        cover(&mut found.covered, situation);
                    }
                    for &demand in &played.broken {
                        found.broken[demand as usize].get_or_insert([number, set, start]);
                    }
                    if until.is_some_and(|until| played.broken.contains(&until)) {
                        return Ok(found);
                    }
                }
            }
        }
        Ok(found)
    }
}

/// The columns and rows of a drawing.
const fn size_of(drawing: Drawing) -> Size {
    match drawing {
        [first, ..] => (first.len() as i16, drawing.len() as i16),
        [] => (0, 0),
    }
}

/// The obstacles of a drawing, a bit for each cell.
fn obstacles_of(drawing: Drawing) -> u64 {
    let cells = drawing.iter().flat_map(|row| row.bytes());
    (0..).zip(cells).filter(|&(_, sign)| sign == b'#').fold(0, |set, (place, _)| set | 1 << place)
}

/// Whether the cells share sides and are one set.
pub fn are_side_by_side(cells: &[Cell]) -> bool {
    let mut left = cells.to_vec();
    let mut joined: Vec<Cell> = left.pop().into_iter().collect();
    while let Some(cell) = joined.pop() {
        joined.extend(left.extract_if(.., |other| neighbours(cell, *other)));
    }
    left.is_empty()
}

impl Floors {
    /// The team moves until the demand is broken.
    fn moves(&self, played: &RunOutcome) -> usize {
        played.until(self.demand, self.bounds.range_cells).count()
    }

    /// The shortest run in a class that breaks the demand.
    fn shortest(
        &self,
        subject: &Subject,
        class: Class,
        until: Until,
    ) -> Result<ClassFindings<String>, MethodError> {
        let (subject, area) = (self.bounds.subject(subject)?, Bounds::area(class.size())?);
        // Where cells are R_c apart, whether robots are linked rests on equality.
        let range_cells = usize::from(self.bounds.range_cells);
        if self.demand == Demand::Connected && area.width().max(area.height()) > range_cells {
            return Ok(ClassFindings::default());
        }
        let bounds = Bounds { robots: class.robots, ..self.bounds };
        let mut all = ClassFindings::default();
        let sets = 0..1_u64 << (area.width() * area.height());
        for obstacles in sets.filter(|set| set.count_ones() <= class.barriers) {
            for starts in bounds.starts(area, obstacles) {
                let floor = Floor { area, obstacles, starts };
                let Some(played) = play(&subject, &floor, bounds.gains) else { continue };
                let is_broken = played.broken.contains(&self.demand);
                let shortest = is_broken
                    .then(|| (self.moves(&played), story(&subject.rule, &floor, &played, self.demand)));
                all.add(ClassFindings { cases: 1, is_whole: true, shortest });
                if is_broken && until == Until::Violation {
                    return Ok(all);
                }
            }
        }
        Ok(all)
    }

    /// The run on one floor; `None` if it breaks something else, or nothing.
    fn run(
        &self,
        subject: &Subject,
        [number, set, start]: Place,
    ) -> Result<Option<(RunOutcome, Floor)>, MethodError> {
        let subject = self.bounds.subject(subject)?;
        let (area, sets) = self.bounds.layouts(number)?;
        let Some(&obstacles) = sets.get(set) else { return Ok(None) };
        let starts = self.bounds.starts(area, obstacles).into_iter().nth(start);
        let floor = starts.map(|starts| Floor { area, obstacles, starts });
        let run = floor.and_then(|floor| Some((play(&subject, &floor, self.bounds.gains)?, floor)));
        Ok(run.filter(|(played, _)| played.broken.contains(&self.demand)))
    }

    /// The refutation by the run on one floor; `None` if it breaks something else, or nothing.
    fn evidence(&self, subject: &Subject, place: Place) -> Result<Option<Evidence>, MethodError> {
        let within = self.bounds.subject(subject)?;
        let choices = Choices { once: place.map(|place| place as u32).to_vec(), again: Vec::new() };
        Ok(self.run(subject, place)?.map(|(played, floor)| Evidence {
            choices,
            demand: self.demand.words(),
            seen: Depiction::Story(story(&within.rule, &floor, &played, self.demand)),
        }))
    }
}

impl Method<Subject> for Floors {
    fn engine(&self) -> &'static str {
        "exhaustive"
    }

    fn bound(&self) -> String {
        let Bounds { sizes, drawn, robots, sight_cells, range_cells, starts, gains: _ } = self.bounds;
        let is_any = |((width, height), most): (Size, u32)| most >= (width * height) as u32;
        let of_a_kind =
            |one: &(Size, u32), other: &(Size, u32)| one.1 == other.1 || is_any(*one) && is_any(*other);
        let drawn = drawn.iter().map(|&drawing| {
            let ((width, height), obstacles) = (size_of(drawing), obstacles_of(drawing).count_ones());
            format!("{} drawn in {width}×{height} cells", counted(obstacles, "obstacle"))
        });
        let floors: Vec<String> = sizes
            .chunk_by(of_a_kind)
            .map(|sizes| {
                let obstacles = match sizes[0] {
                    kind if is_any(kind) => "all obstacles".to_owned(),
                    (_, 0) => "no obstacles".to_owned(),
                    (_, most) => format!("at most {}", counted(most, "obstacle")),
                };
                let sizes = listed(sizes.iter().map(|((width, height), _)| format!("{width}×{height}")));
                format!("{obstacles} in {sizes} cells")
            })
            .chain(drawn)
            .collect();
        let starts = match starts {
            Starts::Beside => "side by side",
            Starts::Linked => "that have links",
        };
        let robots = counted(robots as u64, "robot");
        format!(
            "{}; all starts of {robots} {starts}, R_s {sight_cells}, R_c {range_cells}",
            floors.join(", ")
        )
    }

    fn family(&self, subject: &Subject) -> Option<String> {
        Some(format!("{:?} {subject:?}", self.bounds))
    }

    /// The choices are the numbers of the size, of the set of obstacles, and of the starts.
    fn decide(&self, subject: &Subject, until: Until, context: &mut Context<'_, '_>) -> MethodResult {
        let once;
        let found = match until {
            Until::Exhausted => {
                context.cache.recall((self.bounds, *subject), |_| self.bounds.search(subject, None))?
            }
            Until::Violation => {
                once = self.bounds.search(subject, Some(self.demand))?;
                &once
            }
        };
        let (runs, is_covered) =
            (found.runs, self.covers.iter().all(|situation| found.covered.contains(situation)));
        let place = found.broken[self.demand as usize];
        let evidence = place.map(|place| self.evidence(subject, place)).transpose()?.flatten();
        Ok(Answer::new(evidence, is_covered, Verdict::Holds, runs))
    }

    fn replay(&self, subject: &Subject, choices: &Choices) -> Result<RefutationPlay, ScriptError> {
        let mut script = Script::new(choices);
        let number = script.choose(self.bounds.count())?;
        let (area, sets) = self.bounds.layouts(number).map_err(|_| ScriptError::Unbroken)?;
        let set = script.choose(sets.len())?;
        let starts = self.bounds.starts(area, sets[set]).len();
        let start = script.choose(starts)?;
        let evidence =
            self.evidence(subject, [number, set, start]).ok().flatten().ok_or(ScriptError::Unbroken)?;
        let of = [self.bounds.count(), sets.len(), starts].map(|of| of as u32).to_vec();
        Ok(RefutationPlay { of, evidence })
    }

    fn size(&self, subject: &Subject, choices: &Choices) -> Option<decide::Size> {
        let &[number, set, start] = &choices.once[..] else { return None };
        let place = [number, set, start].map(|place| place as usize);
        let (played, floor) = self.run(subject, place).ok().flatten()?;
        let (barriers, robots) = (floor.obstacles.count_ones(), floor.starts.len());
        let class = Class { area: floor.area, barriers, robots };
        Some((class.to_string(), self.moves(&played)))
    }

    fn smallest(&self, subject: &Subject) -> Result<Option<DrawnCertificate>, MethodError> {
        let most = Most { cells: 12, barriers: 2, robots: 1..=3 };
        Ok(Some(
            smallest(&most, |class, until| self.shortest(subject, class, until))?
                .drawn_by_cells(|story| story),
        ))
    }

    fn case(&self, subject: &Subject, choices: &Choices) -> Option<Box<dyn AnyCase>> {
        let &[number, set, start] = &choices.once[..] else { return None };
        let number = [number, set, start].map(|place| place as usize);
        let (played, floor) = self.run(subject, number).ok().flatten()?;
        let clause = match (self.demand, self.bounds.starts) {
            (Demand::Connected, _) => "PACK-1",
            (Demand::Covers, Starts::Beside) => "PACK-3",
            (Demand::Covers, Starts::Linked) => "PACK-5",
            (Demand::Near | Demand::Single | Demand::Ends | Demand::Free | Demand::Best, _) => return None,
        };
        let subject = self.bounds.subject(subject).ok()?;
        let moves = played.until(self.demand, self.bounds.range_cells);
        let moves = moves.map(|cells| cells.iter().copied().map(place).collect()).collect();
        Some(Box::new(judge::Run { clause, moves, ..floor.written(&subject) }))
    }
}
