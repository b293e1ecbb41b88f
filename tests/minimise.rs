//! Minimal runs: without any one of its robots, columns, rows, blocked cells and walls, each taken out by hand here, a
//! run breaks its clause no more.

use std::collections::BTreeSet;

use tautline::exhibit::exhibit;
use tautline::explore::{Limits, RuleName, SchemeName, Setup, Stopped, explore};
use tautline::fault::Halt;
use tautline::layout::{Generator, Layout};
use tautline::minimise::{Extent, Failure, Minimal, minimise};
use tautline_kernel::lattice::{Cell, Edge, Side};
use tautline_proofs::judge::judge;
use tautline_proofs::run::Breach;

/// Column and row.
type Place = (i16, i16);

/// A run written down in another way than the library's.
#[derive(Clone, PartialEq, Eq, Debug)]
struct Case {
    robots: u16,
    columns: i16,
    rows: i16,
    base: Place,
    blocked: BTreeSet<Place>,
    /// Pairs of neighbours, the western or northern first.
    walls: BTreeSet<(Place, Place)>,
}

impl Case {
    fn of(setup: &Setup) -> Self {
        let layout = &setup.layout;
        let place = |cell: Cell| (cell.x, cell.y);
        Self {
            robots: setup.robots,
            columns: layout.width(),
            rows: layout.height(),
            base: place(setup.base),
            blocked: layout.cells().filter(|&cell| !layout.is_free(cell)).map(place).collect(),
            walls: layout
                .walls()
                .map(|wall| (place(wall.cell()), place(wall.cell().beyond(wall.side()))))
                .collect(),
        }
    }

    fn setup(&self, rule: RuleName) -> Setup {
        let mut layout = Layout::open(self.columns as u64, self.rows as u64).expect("a size");
        self.blocked.iter().for_each(|&(x, y)| layout.block(Cell::new(x, y)));
        for &((x, y), (east, _)) in &self.walls {
            layout.build_wall(Edge::new(Cell::new(x, y), if east > x { Side::East } else { Side::South }));
        }
        let base = Cell::new(self.base.0, self.base.1);
        layout.place_base(base).expect("a free cell");
        let limits = Limits::default();
        Setup { scheme: SchemeName::Chain, rule, robots: self.robots, seed: 0, layout, base, limits }
    }

    /// Columns for rows.
    fn turned(&self) -> Self {
        let turned = |(x, y): Place| (y, x);
        Self {
            robots: self.robots,
            columns: self.rows,
            rows: self.columns,
            base: turned(self.base),
            blocked: self.blocked.iter().copied().map(turned).collect(),
            walls: self.walls.iter().map(|&(one, other)| (turned(one), turned(other))).collect(),
        }
    }

    /// Without `column`; one for each place that the base can have.
    fn without_column(&self, column: i16) -> Vec<Self> {
        let old = |(x, y): Place| (if x < column { x } else { x + 1 }, y);
        let places = || (0..self.rows).flat_map(|y| (0..self.columns - 1).map(move |x| (x, y)));
        let blocked: BTreeSet<Place> = places().filter(|&place| self.blocked.contains(&old(place))).collect();
        let has_wall = |one: Place, other: Place| {
            let between = ((one.0 + 1)..other.0).map(|x| (x, one.1));
            let path: Vec<Place> = [one].into_iter().chain(between).chain([other]).collect();
            path.windows(2).any(|pair| self.walls.contains(&(pair[0], pair[1])))
        };
        let walls = places()
            .flat_map(|(x, y)| [((x, y), (x + 1, y)), ((x, y), (x, y + 1))])
            .filter(|&(_, (x, y))| x < self.columns - 1 && y < self.rows)
            .filter(|&(one, other)| has_wall(old(one), old(other)))
            .collect::<BTreeSet<_>>();
        let (x, y) = self.base;
        let bases = if x == column { vec![x, x - 1] } else { vec![x - i16::from(x > column)] };
        bases
            .into_iter()
            .filter(|&x| 0 <= x && x < self.columns - 1 && !blocked.contains(&(x, y)))
            .map(|x| Self {
                columns: self.columns - 1,
                base: (x, y),
                blocked: blocked.clone(),
                walls: walls.clone(),
                ..self.clone()
            })
            .collect()
    }

    /// Everything that this is without one robot, column, row, blocked cell or wall, and what went.
    fn smaller(&self) -> Vec<(String, Self)> {
        let mut smaller = Vec::new();
        if self.robots > 2 {
            smaller.push(("a robot".to_owned(), Self { robots: self.robots - 1, ..self.clone() }));
        }
        for column in 0..self.columns {
            let what = format!("column {column}");
            smaller.extend(self.without_column(column).into_iter().map(|case| (what.clone(), case)));
        }
        for row in 0..self.rows {
            let turned = self.turned().without_column(row);
            smaller.extend(turned.iter().map(|case| (format!("row {row}"), case.turned())));
        }
        for cell in &self.blocked {
            let blocked = self.blocked.iter().copied().filter(|other| other != cell).collect();
            smaller.push((format!("blocked {cell:?}"), Self { blocked, ..self.clone() }));
        }
        for wall in &self.walls {
            let walls = self.walls.iter().copied().filter(|other| other != wall).collect();
            smaller.push((format!("wall {wall:?}"), Self { walls, ..self.clone() }));
        }
        smaller
    }

    /// Whether its run breaks `breach`, whatever else it breaks before.
    fn breaks(&self, rule: RuleName, breach: Breach) -> bool {
        let run = explore(&self.setup(rule), &mut |made| {
            if made.breaches.contains(&breach) { Err(Halt::Interrupted) } else { Ok(()) }
        });
        run.is_err()
    }
}

fn setup(robots: u16, mut layout: Layout) -> Setup {
    let base = Setup::choose_base(&mut layout, None).expect("a free cell");
    let limits = Limits::default();
    Setup { scheme: SchemeName::Chain, rule: RuleName::Published, robots, seed: 0, layout, base, limits }
}

fn generated(description: &str, seed: u64) -> Layout {
    description.parse::<Generator>().expect("a generator").generate(seed).expect("a layout")
}

fn minimal(setup: &Setup, asked: Option<Breach>) -> Option<Minimal> {
    match minimise(setup, asked, &mut |_| Ok(())) {
        Ok(minimal) => Some(minimal),
        Err(Failure::Refused(_)) => None,
        Err(Failure::Halted(halt)) => panic!("{halt:?}"),
    }
}

/// Checks that `found` is what it promises to be.
fn check(found: &Minimal) {
    let Minimal { setup, breach, before, after, runs: _ } = found;
    let mut frames = Vec::new();
    let report = explore(setup, &mut |made| {
        frames.push(made.frame.clone());
        Ok(())
    });
    let report = report.expect("a run");
    assert_eq!((report.stopped, report.steps), (Stopped::Violation, after.steps));
    assert_eq!(judge(&exhibit(setup, *breach, &frames)), Ok(()), "{setup:?}");
    let case = Case::of(setup);
    assert_eq!((case.robots, case.columns, case.rows), (after.robots, after.columns, after.rows));
    assert_eq!((case.blocked.len(), case.walls.len()), (after.blocked, after.walls));
    let shrinks = |part: fn(&Extent) -> usize| part(after) <= part(before);
    assert!(shrinks(|extent| extent.robots.into()) && shrinks(|extent| extent.walls), "{found:?}");
    assert!(shrinks(|extent| extent.columns as usize) && shrinks(|extent| extent.rows as usize), "{found:?}");
    assert!(shrinks(|extent| extent.blocked), "{found:?}");
    assert!(case.breaks(setup.rule, *breach), "{setup:?}");
    for (what, smaller) in case.smaller() {
        assert!(!smaller.breaks(setup.rule, *breach), "{what} can go: {setup:?}");
    }
}

#[test]
fn nothing_of_a_minimal_run_can_go() {
    let mut found = 0;
    for robots in 4..=8 {
        let side = 2 * robots - 1;
        for density in ["0.1", "0.2", "0.3"] {
            for seed in 0..100 {
                let layout = generated(&format!("walls:{side}x{side}:{density}"), seed);
                if let Some(minimal) = minimal(&setup(robots, layout), None) {
                    check(&minimal);
                    found += 1;
                }
            }
        }
    }
    println!("{found} runs");
    assert!(found > 100, "{found}");
}

#[test]
fn nothing_of_a_minimal_run_among_blocked_cells_and_walls_can_go() {
    let mut found = 0;
    for seed in 0..150 {
        let mut layout = generated("cells:16x12:0.1", seed);
        let walls = generated("walls:16x12:0.1", seed);
        walls.walls().for_each(|wall| layout.build_wall(wall));
        if let Some(minimal) = minimal(&setup(7, layout), None) {
            check(&minimal);
            found += 1;
        }
    }
    println!("{found} runs");
    assert!(found > 20, "{found}");
}
