//! The answers of two robots that keep in touch: who is in reach of whom, whose paths are apart, and which drives are
//! admitted.

use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Area, Cell, MediumGrid, Step};
use tautline_kernel::kit::{Condition, Kit, Next, Reach, Rule, Sight, Stance};

use super::term::{at, bits, definition, everywhere, offsets};

/// Robots in contact are at most 3 apart, and drive one path farther. One is to spare.
const REACH: i16 = 5;

type Pair = Kit<MediumGrid, 2, 256>;

/// Always the same answer.
struct Always(u32);

impl Oracle for Always {
    fn pick(&mut self, below: u32) -> u32 {
        self.0.min(below - 1)
    }
}

fn stance(at: Cell, step: Step) -> Stance {
    match step {
        Step::Stay => Stance::Stands(at),
        Step::Cross(side) => Stance::Drives { from: at, to: at.beyond(side) },
    }
}

/// A bit for each offset, each step of the robot there, and each step of the robot here.
fn of_stances(ask: impl Fn(Stance, Stance) -> bool) -> String {
    let pairs = offsets(REACH).flat_map(|offset| {
        Step::ALL.into_iter().flat_map(move |there| Step::ALL.map(move |here| (offset, there, here)))
    });
    let answer =
        |(offset, there, here)| everywhere(|cell| ask(stance(cell, here), stance(at(cell, offset), there)));
    bits(&pairs.map(answer).collect::<Vec<_>>())
}

/// Whether the robot here, which stands, may drive through each side, by the offset and the step of the other robot. A
/// first number has the questions that robots can come to ask, a second one the answers.
fn drives(rule: Rule) -> [String; 2] {
    let (mut asked, mut admitted) = (Vec::new(), Vec::new());
    let area = Area::new(Cell::new(0, 0), Cell::new(15, 15)).expect("an area");
    let here = Cell::new(7, 7);
    for (offset, there) in offsets(REACH).flat_map(|offset| Step::ALL.map(move |there| (offset, there))) {
        let map = MediumGrid::new(area).expect("it is small");
        let kit = Pair::new(rule, map, &[at(here, offset), here]).ok().filter(|_| offset != (0, 0));
        let kit = kit.and_then(|kit| comes_to(&kit, stance(at(here, offset), there)));
        for side in Step::ALL.into_iter().filter(|&step| step != Step::Stay) {
            asked.push(kit.is_some());
            admitted.push(kit.as_ref().is_some_and(|kit| kit.admits(1, side)));
        }
    }
    [bits(&asked), bits(&admitted)]
}

/// The team in which the first robot has left, if it is to; `None` if it does not come to do so.
fn comes_to(kit: &Pair, wanted: Stance) -> Option<Pair> {
    let Stance::Drives { to, .. } = wanted else { return Some(*kit) };
    (0..4).find_map(|answer| {
        let (mut kit, mut oracle) = (*kit, Always(answer));
        let Ok(Next::Looks(side)) = kit.decide(0, &mut oracle) else { return None };
        let from = kit.stance(0)?.to();
        kit.looked(0, Sight::Free, &mut oracle).ok()?;
        (from.beyond(side) == to).then_some(kit)
    })
}

pub(super) fn terms() -> String {
    let is_in_reach = |offset| everywhere(|cell| Reach::PAPER.joins(cell, at(cell, offset)));
    let in_reach: Vec<bool> = offsets(REACH).map(is_in_reach).collect();
    let mut text = definition("reach", "Z", &format!("{REACH}%Z"));
    text += &definition("reached", "N", &bits(&in_reach));
    text += &definition("sure", "N", &of_stances(|one, other| one.is_sure_of(other, Reach::PAPER)));
    text += &definition("apart", "N", &of_stances(Stance::is_apart_from));
    let without = |condition| (format!("without_{condition:?}"), Rule::REPAIRED.without(condition));
    let mutants = [Condition::NextInReach, Condition::FromInReach, Condition::Apart].map(without);
    for (name, rule) in [("REPAIRED".to_owned(), Rule::REPAIRED)].into_iter().chain(mutants) {
        let [asked, admitted] = drives(rule);
        text += &definition(&format!("asked_{name}"), "N", &asked);
        text += &definition(&format!("admitted_{name}"), "N", &admitted);
    }
    text
}
