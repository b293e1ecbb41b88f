//! Environments for learning: teams of robots on cells that must stay in contact (CHAIN-1), each on a layout of its
//! own. All of them lie in arrays, environment by environment, and one call steps them all without Python's lock. This
//! is the one place that has the rule of the environment: `pytautline.pettingzoo` is a face of one environment,
//! `pytautline.vector` of many.

use std::collections::BTreeMap;
use std::path::PathBuf;

use pyo3::buffer::{Element, PyBuffer};
use pyo3::prelude::*;
use tautline_grids::layout::generate::Generator;
use tautline_grids::layout::{self as layouts, Layout as Ground};
use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::chain;
use tautline_kernel::ground::{Cell, Edge, Side};
use tautline_proofs::plural::counted;

use crate::arguments::Int;
use crate::arrays::filled;
use crate::diagnostic::{Kind, error, raised};
use crate::layout::Layout;

/// The most bytes of all environments. One counts as [`OWN_BYTES`] and what its part of an observation has.
const MAX_BYTES: u128 = 1 << 28;
/// The bytes that an environment counts as, however small it is.
const OWN_BYTES: u128 = 1 << 10;

/// The sides that the actions 1 to 4 try. 0 stays.
const SIDES: [Side; 4] = [Side::East, Side::South, Side::West, Side::North];

/// The bit of a cell that was entered. Those below it are the sides that are open.
const EXPLORED: u8 = 1 << SIDES.len();

/// The arrays `walls`, `cells` and `explored`.
type Observation<'py> = [Bound<'py, PyAny>; 3];
/// An observation, and of each environment the reward, whether its episode is done, whether it is cut short, how many
/// cells are explored, and whether all neighbours are in contact.
type StepResult<'py> = (Observation<'py>, [Bound<'py, PyAny>; 5]);

/// By the numbers of environments, the seeds of the layouts on which they begin an episode.
type Fresh = BTreeMap<usize, u64>;

/// Many environments of the same size.
#[pyclass(module = "pytautline._native")]
pub(crate) struct Environments {
    name: String,
    /// The maker of each episode's layout. That of a file does not change.
    generator: Option<Generator>,
    robots: usize,
    max_cycles: u64,
    layouts: Vec<Ground>,
    /// Open sides and [`EXPLORED`]: environments by rows by columns.
    ground: Vec<u8>,
    /// Environments by robots.
    cells: Vec<Cell>,
    episodes: Vec<Episode>,
}

/// The counts of an episode. The default is of one that is over.
#[derive(Clone, Copy, Default)]
struct Episode {
    is_on: bool,
    explored: u32,
    reachable: u32,
    cycles: u64,
}

/// The outcome of a step. The default is that of a reset.
#[derive(Clone, Copy, Default)]
struct Outcome {
    reward: f64,
    is_done: bool,
    is_cut: bool,
    explored: u32,
    in_contact: bool,
}

#[pymethods]
impl Environments {
    #[new]
    fn new(
        py: Python<'_>,
        layout: PathBuf,
        environments: Int,
        robots: Int,
        max_cycles: Int,
    ) -> PyResult<Self> {
        let number = |name: &str, given: Int| given.within(py, name, 1..=u64::MAX);
        let max_cycles = number("max_cycles", max_cycles)?;
        let [environments, robots] = [number("num_envs", environments)?, number("robots", robots)?];
        let Layout { ground, name } = Layout::load(py, layout, 0, None)?;
        let cells = ground.size().cells();
        let each = OWN_BYTES + 2 * cells as u128 + 12 * u128::from(robots);
        if u128::from(environments).saturating_mul(each) > MAX_BYTES {
            let size = ground.size();
            let environments = counted(environments, "environment");
            let what = format!("{environments} of {size} cells and {robots} robots have too many bytes");
            let fewer = match MAX_BYTES / each {
                0 => "fewer robots, or a smaller layout".to_owned(),
                most => format!("at most {most} of them"),
            };
            let remedy = format!(
                "give {fewer}: {MAX_BYTES} bytes, of which one has {OWN_BYTES}, 2 a cell and 12 a robot"
            );
            return Err(error(py, Kind::Input, what, remedy));
        }
        let [environments, robots] = [environments as usize, robots as usize];
        Ok(Self {
            generator: name.parse().ok(),
            name,
            robots,
            max_cycles,
            ground: vec![0; environments * cells],
            cells: vec![Cell::new(0, 0); environments * robots],
            episodes: vec![Episode::default(); environments],
            layouts: vec![ground; environments],
        })
    }

    /// The layout of an environment's episode.
    fn layout(slf: &Bound<'_, Self>, environment: Int) -> PyResult<Layout> {
        let this = held(slf)?;
        let place = this.place(slf.py(), environment)?;
        Ok(Layout { ground: this.layouts[place].clone(), name: this.name.clone() })
    }

    /// Begins an episode in each of these environments.
    fn reset<'py>(slf: &Bound<'py, Self>, fresh: Fresh) -> PyResult<Observation<'py>> {
        let (py, this) = (slf.py(), &mut *held(slf)?);
        this.begin(py, &fresh)?;
        this.observation(py)
    }

    /// Begins an episode in each of these environments, and steps the others. Nothing changes where an error is raised.
    fn step<'py>(
        slf: &Bound<'py, Self>,
        actions: Bound<'py, PyAny>,
        fresh: Fresh,
    ) -> PyResult<StepResult<'py>> {
        let (py, this) = (slf.py(), &mut *held(slf)?);
        let is_over = |(place, episode): &(usize, &Episode)| !episode.is_on && !fresh.contains_key(place);
        if let Some((place, _)) = this.episodes.iter().enumerate().find(is_over) {
            let what = format!("the episode of environment {place} is over, or has not begun");
            return Err(error(py, Kind::Input, what, "call reset before the next step"));
        }
        let actions = this.actions(py, &actions)?;
        this.begin(py, &fresh)?;
        let outcomes = py.detach(|| {
            let stepped = actions.chunks_exact(this.robots).enumerate();
            let outcome = |(place, actions)| {
                if fresh.contains_key(&place) { Outcome::default() } else { this.advance(place, actions) }
            };
            stepped.map(outcome).collect::<Vec<_>>()
        });
        let (shape, each) = ([outcomes.len()], || outcomes.iter());
        let of = [
            filled(py, "d", &shape, each().map(|outcome| outcome.reward.to_ne_bytes()))?,
            filled(py, "?", &shape, each().map(|outcome| [u8::from(outcome.is_done)]))?,
            filled(py, "?", &shape, each().map(|outcome| [u8::from(outcome.is_cut)]))?,
            filled(py, "q", &shape, each().map(|outcome| i64::from(outcome.explored).to_ne_bytes()))?,
            filled(py, "?", &shape, each().map(|outcome| [u8::from(outcome.in_contact)]))?,
        ];
        Ok((this.observation(py)?, of))
    }
}

impl Environments {
    /// The place of the environment with this number.
    fn place(&self, py: Python<'_>, number: Int) -> PyResult<usize> {
        number.within(py, "environment", 0..=self.episodes.len() - 1)
    }

    /// The actions, robot by robot, each at most 4.
    fn actions(&self, py: Python<'_>, given: &Bound<'_, PyAny>) -> PyResult<Vec<usize>> {
        let wanted = [self.episodes.len(), self.robots];
        let wrong = |what: String| {
            let [environments, robots] = wanted;
            let remedy = format!(
                "give an array of integers from 0 to {}, {environments} environments by {robots} robots",
                SIDES.len()
            );
            error(py, Kind::Input, what, remedy)
        };
        let (shape, actions) = entries::<i64>(given).or_else(|_| entries::<u64>(given)).map_err(|_| {
            let dtype =
                given.getattr("dtype").map_or_else(|_| "no array".to_owned(), |dtype| dtype.to_string());
            wrong(format!("the actions are {dtype}"))
        })?;
        if shape != wanted {
            return Err(wrong(format!("the actions have the shape {shape:?}")));
        }
        let known = |(at, action): (usize, i128)| match usize::try_from(action) {
            Ok(known) if known <= SIDES.len() => Ok(known),
            _ => Err(wrong(format!("actions[{}, {}] is {action}", at / self.robots, at % self.robots))),
        };
        actions.into_iter().enumerate().map(known).collect()
    }

    /// Begins episodes: all of them, or none where a layout cannot be made.
    fn begin(&mut self, py: Python<'_>, fresh: &Fresh) -> PyResult<()> {
        if let Some((&place, _)) = fresh.last_key_value() {
            self.place(py, Int(place as i128))?;
        }
        py.detach(|| {
            let made = fresh.iter().map(|(&place, &seed)| {
                let layout = match self.generator {
                    Some(generator) => generator.generate(seed)?,
                    None => self.layouts[place].clone(),
                };
                Ok((place, base(&layout)?, layout))
            });
            for (place, base, layout) in made.collect::<Result<Vec<_>, Diagnostic>>()? {
                self.start(place, base, layout);
            }
            Ok(())
        })
        .map_err(|fault: Diagnostic| raised(py, &fault))
    }

    /// Begins one episode: all robots are in the base.
    fn start(&mut self, place: usize, base: Cell, layout: Ground) {
        let (size, robots) = (layout.size().cells(), self.robots);
        let open = |cell: Cell| {
            let is_open = SIDES.map(|side| layout.is_open(Edge::new(cell, side)));
            (0..).zip(is_open).map(|(bit, is_open)| u8::from(is_open) << bit).sum()
        };
        let ground = &mut self.ground[place * size..][..size];
        ground.iter_mut().zip(layout.cells()).for_each(|(sides, cell)| *sides = open(cell));
        ground[index(&layout, base)] |= EXPLORED;
        self.cells[place * robots..][..robots].fill(base);
        let reachable = layout.spread(&[base]).count() as u32;
        self.episodes[place] = Episode { is_on: true, explored: 1, reachable, cycles: 0 };
        self.layouts[place] = layout;
    }

    /// One step of one environment.
    fn advance(&mut self, place: usize, actions: &[usize]) -> Outcome {
        let (layout, episode) = (&self.layouts[place], &mut self.episodes[place]);
        let (size, robots) = (layout.size().cells(), self.robots);
        let ground = &mut self.ground[place * size..][..size];
        let cells = &mut self.cells[place * robots..][..robots];
        let before = episode.explored;
        for (cell, &action) in cells.iter_mut().zip(actions) {
            if action > 0 && ground[index(layout, *cell)] & (1 << (action - 1)) > 0 {
                *cell = cell.beyond(SIDES[action - 1]);
            }
            let entered = &mut ground[index(layout, *cell)];
            episode.explored += u32::from(*entered & EXPLORED == 0);
            *entered |= EXPLORED;
        }
        episode.cycles += 1;
        let keeps = |pair: &[Cell]| chain::Rule::REPAIRED.keeps_contact(pair[0], pair[1]);
        let apart: u32 = cells.windows(2).map(|pair| u32::from(!keeps(pair))).sum();
        let is_done = episode.explored >= episode.reachable;
        let is_cut = episode.cycles >= self.max_cycles;
        episode.is_on = !is_done && !is_cut;
        Outcome {
            reward: f64::from(episode.explored - before) - f64::from(apart),
            is_done,
            is_cut,
            explored: episode.explored,
            in_contact: apart == 0,
        }
    }

    fn observation<'py>(&self, py: Python<'py>) -> PyResult<Observation<'py>> {
        let (environments, layout) = (self.episodes.len(), &self.layouts[0]);
        let sides = self.cells.chunks_exact(self.robots).zip(self.ground.chunks_exact(layout.size().cells()));
        let sides = sides.flat_map(|(cells, ground)| cells.iter().map(|&cell| ground[index(layout, cell)]));
        let walls =
            sides.flat_map(|sides| [0, 1, 2, 3].map(|bit| i16::from(sides >> bit & 1 ^ 1).to_ne_bytes()));
        let cells = self.cells.iter().flat_map(|cell| [cell.x.to_ne_bytes(), cell.y.to_ne_bytes()]);
        let explored = self.ground.iter().map(|sides| i16::from(sides & EXPLORED > 0).to_ne_bytes());
        let area = [environments, layout.height() as usize, layout.width() as usize];
        Ok([
            filled(py, "h", &[environments, self.robots, SIDES.len()], walls)?,
            filled(py, "h", &[environments, self.robots, 2], cells)?,
            filled(py, "h", &area, explored)?,
        ])
    }
}

/// The environments, which one thread at a time has.
fn held<'py>(environments: &Bound<'py, Environments>) -> PyResult<PyRefMut<'py, Environments>> {
    environments.try_borrow_mut().map_err(|_| {
        let remedy = "let one thread at a time step them, or give each thread environments of its own";
        error(environments.py(), Kind::Input, "another thread steps these environments", remedy)
    })
}

/// The shape and the entries of an array of these numbers.
fn entries<T: Element + Copy + Into<i128>>(array: &Bound<'_, PyAny>) -> PyResult<(Vec<usize>, Vec<i128>)> {
    let buffer = PyBuffer::<T>::get(array)?;
    let entries = buffer.to_vec(array.py())?;
    Ok((buffer.shape().to_vec(), entries.into_iter().map(Into::into).collect()))
}

/// The place of a cell in the rows of its layout.
const fn index(layout: &Ground, cell: Cell) -> usize {
    cell.y as usize * layout.width() as usize + cell.x as usize
}

/// The base that a layout names, or else the free cell the fewest steps from the centre, ties by row, then by column.
fn base(layout: &Ground) -> Result<Cell, Diagnostic> {
    let steps = |cell: &Cell| {
        let from = |at: i16, cells: i16| (2 * i32::from(at) - i32::from(cells) + 1).abs();
        from(cell.x, layout.width()) + from(cell.y, layout.height())
    };
    let nearest = || layout.cells().filter(|&cell| layout.is_free(cell)).min_by_key(steps);
    layout.base().or_else(nearest).ok_or_else(layouts::no_free_cell)
}
