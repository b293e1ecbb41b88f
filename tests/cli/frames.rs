//! A replay in short, for a person to judge: of its drawings the first, those in which a wall is met for the first time
//! and the last, and of each team move a line. The lines are read from the drawings, and what else a drawing shows is
//! checked to follow from them: walls stay, and a cell is explored when a robot is in it.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

/// Column and row.
type Place = (usize, usize);

/// The drawing of one team move.
struct Frame {
    title: String,
    lines: Vec<Vec<char>>,
}

/// Columns and rows from one cell of a drawing to the next.
const GRID: Place = (4, 2);

impl Frame {
    /// The drawings beside each other in a paragraph.
    fn all(paragraph: &str) -> Vec<Self> {
        let lines: Vec<Vec<char>> = paragraph.lines().map(|line| line.chars().collect()).collect();
        let title: String = lines[0].iter().collect();
        let starts: Vec<usize> = title.match_indices("move ").map(|(start, _)| start).collect();
        let ends = starts[1..].iter().map(|start| start - 3).chain([usize::MAX]);
        let cut = |line: &[char], start: usize, end: usize| {
            let cut = &line[start.min(line.len())..end.min(line.len())];
            cut.iter().collect::<String>().trim_end().to_owned()
        };
        let frame = |(start, end)| Self {
            title: cut(&lines[0], start, end),
            lines: lines[1..].iter().map(|line| cut(line, start, end).chars().collect()).collect(),
        };
        starts.iter().copied().zip(ends).map(frame).collect()
    }

    fn text(&self) -> String {
        let lines = self.lines.iter().map(|line| line.iter().collect::<String>() + "\n");
        [self.title.clone() + "\n"].into_iter().chain(lines).collect()
    }

    /// Columns and rows from one cell to the next: a cell is one character where nothing is in the way.
    fn grid(&self) -> Place {
        if self.lines[2][0] == '|' { (1, 1) } else { GRID }
    }

    /// The labels of the cells that have one.
    fn labels(&self) -> BTreeMap<Place, String> {
        let (across, down) = self.grid();
        let rows = (0..).zip(self.lines[1..].iter().step_by(down)).filter(|(_, line)| line[0] == '|');
        let labels = rows.flat_map(|(y, line)| {
            let cells = (0..).zip(line[1..line.len() - 1].chunks(across));
            cells.map(move |(x, text)| ((x, y), text[..text.len().min(3)].iter().collect::<String>()))
        });
        let trimmed = labels.map(|(cell, label)| (cell, label.trim().to_owned()));
        trimmed.filter(|(_, label)| !label.is_empty()).collect()
    }

    /// The base, and the robots beside it.
    fn robots(&self) -> (Place, BTreeMap<char, Place>) {
        let labels = self.labels();
        let base = labels.iter().find(|(_, label)| label.starts_with('B')).map(|(&cell, _)| cell);
        let team = labels.iter().filter(|(_, label)| !label.starts_with('B') && **label != "·");
        let team: Vec<(char, Place)> =
            team.flat_map(|(&cell, label)| label.chars().map(move |robot| (robot, cell))).collect();
        let robots: BTreeMap<char, Place> = team.iter().copied().collect();
        assert!(robots.len() == team.len() && robots.keys().all(char::is_ascii_digit), "{}", self.text());
        (base.expect("a base"), robots)
    }

    /// Where walls are met, by the side of a cell.
    fn met(&self) -> BTreeSet<(&'static str, Place)> {
        let (across, down) = self.grid();
        let signs =
            (0..).zip(&self.lines).flat_map(|(y, line)| (0..).zip(line).map(move |(x, sign)| (x, y, sign)));
        let met = signs.filter(|(.., sign)| **sign == 'x').map(|(x, y, _)| match (x, y) {
            (x, 0) => ("north", (x / across, 0)),
            (0, y) => ("west", (0, y / down)),
            (x, y) if y.is_multiple_of(down) => ("south", (x / across, y / down - 1)),
            (x, y) => ("east", (x / across - 1, y / down)),
        });
        met.collect()
    }

    /// The drawing without labels, and as if no wall was met.
    fn walls(&self) -> Vec<String> {
        let (_, down) = self.grid();
        let wall = |y: usize, sign: char| match (y.is_multiple_of(down), sign) {
            (true, '+' | '-') | (_, '|') => sign,
            (true, 'x') => '-',
            (false, 'x') => '|',
            _ => ' ',
        };
        let lines = self.lines.iter().enumerate();
        lines.map(|(y, line)| line.iter().map(|&sign| wall(y, sign)).collect()).collect()
    }
}

/// The name of a step.
fn step(from: Place, to: Place) -> &'static str {
    match (to.0.wrapping_sub(from.0), to.1.wrapping_sub(from.1)) {
        (1, 0) => "east",
        (usize::MAX, 0) => "west",
        (0, 1) => "south",
        (0, usize::MAX) => "north",
        _ => panic!("no step from {from:?} to {to:?}"),
    }
}

/// The text that `tautline replay` prints of a team with a base and at most nine robots, in short.
pub(crate) fn in_short(replayed: &str) -> String {
    let (text, drawn) = replayed.split_at(replayed.find("\nmove ").expect("a drawing") + 1);
    let mut paragraphs = drawn.split("\n\n").peekable();
    let mut frames = Vec::new();
    while let Some(paragraph) = paragraphs.next_if(|paragraph| paragraph.starts_with("move ")) {
        frames.extend(Frame::all(paragraph));
    }
    let story = paragraphs.collect::<Vec<_>>().join("\n\n");
    let walls = frames[0].walls();
    let (base, _) = frames[0].robots();
    let mut before = BTreeMap::new();
    let mut explored = BTreeSet::from([base]);
    let mut met = BTreeSet::new();
    let mut lines = String::new();
    let mut drawings = String::new();
    for (number, frame) in frames.iter().enumerate() {
        let (at, team) = frame.robots();
        assert_eq!((at, frame.walls()), (base, walls.clone()), "{}", frame.title);
        explored.extend(team.values().copied());
        assert_eq!(frame.labels().into_keys().collect::<BTreeSet<_>>(), explored, "{}", frame.title);
        let place = |team: &BTreeMap<char, Place>, robot| team.get(&robot).copied().unwrap_or(base);
        let mut steps: BTreeMap<&str, String> = BTreeMap::new();
        for &robot in before.keys().chain(team.keys()).collect::<BTreeSet<_>>() {
            let (from, to) = (place(&before, robot), place(&team, robot));
            if from != to {
                steps.entry(step(from, to)).or_default().push(robot);
            }
        }
        let moved = steps.into_iter().map(|(side, robots)| format!("{robots} {side}"));
        let bumps = frame.met();
        let bumped = bumps.iter().map(|(side, (x, y))| format!("a wall is met {side} of {x},{y}"));
        let said: Vec<String> = moved.chain(bumped).collect();
        let said = if said.is_empty() { "nobody moves".to_owned() } else { said.join(", ") };
        // Writing to a string cannot fail.
        let _ = writeln!(lines, "{}: {said}", frame.title.trim_start_matches("move "));
        // The story of a counterexample draws the last team move itself.
        let is_last = number + 1 == frames.len();
        let matters = if is_last { story.is_empty() } else { number == 0 || !bumps.is_subset(&met) };
        if matters {
            drawings += &(frame.text() + "\n");
        }
        met.extend(bumps);
        before = team;
    }
    format!("{text}{drawings}{lines}\n{story}")
}
