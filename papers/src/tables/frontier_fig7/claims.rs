//! The paper's sentences, judged by what is measured.

use super::super::prelude::*;
use super::line::Line;

/// The team that the paper says is best.
const BEST: u16 = 8;

/// All of them.
pub(super) fn judged(lines: &[Line]) -> Vec<Judgement> {
    [of_figure, best_of_all, of_teams, fault_tolerance].map(|judged| judged(lines)).concat()
}

/// Whether the paper's sentences about several robots are judged of this team.
fn is_judged(line: &&Line) -> bool {
    ["published", "repaired", "wanders"].contains(&line.rule.as_str()) && [2, BEST].contains(&line.robots)
}

/// That about a robot that dies, in the mean of the layouts and on each of them.
fn fault_tolerance(lines: &[Line]) -> Vec<Judgement> {
    let teams = || lines.iter().filter(is_judged);
    let who = |line: &Line| format!("{} robots, {}, one dies", line.robots, line.rule);
    let in_mean = |line: &Line| {
        let one = lines.iter().find(|one| one.rule == line.rule && one.robots == 1);
        let one = one.and_then(|one| one.tolerant);
        let measured =
            format!("every cell in {} % of the runs, one robot {} %", text(line.tolerant, 1), text(one, 1));
        Judgement::new(
            "“fault tolerance will be improved” (1), in the mean",
            who(line),
            measured,
            below(ends(one), ends(line.tolerant)),
        )
    };
    let on_each = |line: &Line| {
        let measured = format!("all that the others can get to in {} % of the runs", text(line.cleared, 1));
        let verdict = always(line.cleared.map(|cleared| cleared.times(0.01)));
        Judgement::new("“fault tolerance will be improved” (1), on each layout", who(line), measured, verdict)
    };
    teams().map(in_mean).chain(teams().map(on_each)).collect()
}

/// Those about Fig. 7.
fn of_figure(lines: &[Line]) -> Vec<Judgement> {
    let of = |rule: &str, robots: u16| {
        lines.iter().find(|line| line.rule.as_str() == rule && line.robots == robots)
    };
    let moves = |rule: &str, robots| text(of(rule, robots).and_then(|line| line.moves), 1);
    let percent =
        |part: fn(&Line) -> Option<Estimate>, rule: &str, robots| text(of(rule, robots).and_then(part), 1);
    let estimate = |part: fn(&Line) -> Option<Estimate>, rule: &str, robots| of(rule, robots).and_then(part);
    let whole = estimate(|line| line.whole, "published", 1).map(|whole| whole.times(0.01));
    let alone = estimate(|line| line.double, "published", 8).map(|double| double.times(0.01).rest());
    let largest = lines.iter().map(|line| line.robots).max().unwrap_or(BEST);
    let [eight, six] = [8, 6].map(|robots| ends(estimate(|line| line.moves, "wanders", robots)));
    let less = |(rule, who): (&str, &str)| {
        let again = estimate(|line| line.again, rule, 8);
        let saved = estimate(|line| line.saved, rule, 8);
        Judgement::new(
            "maps are exchanged “to reduce overlapping”",
            who,
            format!(
                "in {} team moves of a run one explores a cell again, in {} more if it hears no map",
                text(again, 1),
                text(saved, 1)
            ),
            below(Some([0.0, 0.0]), ends(saved)),
        )
    };
    let mut judged = vec![
        Judgement::new(
            "“performs better when team of robots has 8 members”",
            "robots that wander",
            format!(
                "{} team moves with 6 and {} with 8, repaired {} and {}; \
                 {largest} is the largest team that is compared",
                moves("wanders", 6),
                moves("wanders", 8),
                moves("repaired", 6),
                moves("repaired", 8)
            ),
            below(eight, six),
        ),
        Judgement::new(
            "“avoiding … missing out sectors”",
            "one published robot",
            format!(
                "{} % of the cells, and all of them in {} % of the runs; repaired {} %",
                percent(|line| line.explored, "published", 1),
                percent(|line| line.whole, "published", 1),
                percent(|line| line.whole, "repaired", 1)
            ),
            always(whole),
        ),
        Judgement::new(
            "“avoiding overlapping”",
            "8 published robots",
            format!(
                "in {} % of the runs two are in one cell; repaired {} %",
                percent(|line| line.double, "published", 8),
                percent(|line| line.double, "repaired", 8)
            ),
            always(alone),
        ),
    ];
    judged.extend([("published", "8 published robots"), ("wanders", "8 robots that wander")].map(less));
    judged
}

/// The paper's sentence about eight robots, where larger teams are measured, too: no larger team of robots that wander,
/// as of repaired ones, explores every cell in fewer team moves.
fn best_of_all(lines: &[Line]) -> Vec<Judgement> {
    let of = |rule: &str| -> Vec<&Line> { lines.iter().filter(|line| line.rule.as_str() == rule).collect() };
    let judged = |(rule, who): (&str, &str)| {
        let lines = of(rule);
        let eight = lines.iter().find(|line| line.robots == BEST)?;
        let larger = lines.iter().filter(|line| line.robots > BEST);
        let fastest = larger.min_by(|one, other| one.mean().total_cmp(&other.mean()))?;
        let measured = format!(
            "{} team moves with {BEST}, {} with {}",
            text(eight.moves, 1),
            text(fastest.moves, 1),
            fastest.robots
        );
        let is_best = below(ends(eight.moves), ends(fastest.moves));
        Some(Judgement::new(
            "“performs better when team of robots has 8 members”, best of all",
            who,
            measured,
            is_best,
        ))
    };
    [("wanders", "robots that wander"), ("repaired", "repaired robots")]
        .into_iter()
        .filter_map(judged)
        .collect()
}

/// The paper's sentences about several robots beside one, and about robots that share their maps beside such that do
/// not. The energy of a team is taken to be the cells that its robots enter.
fn of_teams(lines: &[Line]) -> Vec<Judgement> {
    let nothing = Some([0.0, 0.0]);
    let teams = lines.iter().filter(is_judged);
    let one = |line: &Line| lines.iter().find(|one| one.rule == line.rule && one.robots == 1);
    let judged = |line: &Line| {
        let one = one(line);
        let worse = line.worse.map(|worse| worse.times(0.01).rest());
        let [moves, entered] = [|line: &Line| line.moves, |line: &Line| line.entered].map(|of| {
            (text(of(line), 1), text(one.and_then(of), 1), below(ends(of(line)), ends(one.and_then(of))))
        });
        let more = |what: &str, more: Option<Estimate>| format!("{} more {what} without", text(more, 1));
        [
            (
                "“always advantages over single robot exploration strategies as the total time … will be reduced” (1)",
                format!("on {} % of the layouts slower, or with fewer cells explored", text(line.worse, 1)),
                always(worse),
            ),
            (
                "“the total time … will be reduced” (1), in the mean",
                format!("{} team moves, one robot {}", moves.0, moves.1),
                moves.2,
            ),
            (
                "shared maps: “complete the exploration in lesser time” (4.5)",
                more("team moves", line.sooner),
                below(nothing, ends(line.sooner)),
            ),
            (
                "“which is energy efficient” (4.5), than without maps: fewer cells entered",
                more("cells", line.spared),
                below(nothing, ends(line.spared)),
            ),
            (
                "“which is energy efficient” (4.5), than one robot: fewer cells entered",
                format!("{} cells, one robot {}", entered.0, entered.1),
                entered.2,
            ),
        ]
        .map(|(sentence, measured, verdict)| {
            Judgement::new(sentence, format!("{} robots, {}", line.robots, line.rule), measured, verdict)
        })
    };
    let judged: Vec<[Judgement; 5]> = teams.map(judged).collect();
    (0..5).flat_map(|place| judged.iter().map(move |team| team[place].clone())).collect()
}

#[cfg(test)]
mod tests {
    use tautline_sim::explore::RuleId;

    use super::super::line::Outcome;
    use super::*;

    /// A team of so many repaired robots, whose runs leave out these cells.
    fn line(robots: u16, left: &[[u32; 2]]) -> Line {
        let outcome = |left: &[u32; 2]| Outcome {
            moves: Some(9),
            explored: 1000,
            is_double: false,
            again: None,
            entered: None,
            unheard: None,
            left: Some(*left),
        };
        let outcomes: Vec<Outcome> = left.iter().map(outcome).collect();
        Line::of(RuleId::REPAIRED, robots, &outcomes, &[Vec::new(), Vec::new()])
    }

    #[test]
    fn a_team_tolerates_a_death_in_the_mean_or_on_each_layout() {
        use Verdict::{Fails, Holds, Open};
        let alone = line(1, &[[7, 0]; 100]);
        assert_eq!((alone.tolerant.map(|share| share.mean), alone.cleared), (Some(0.0), None));
        let verdicts = |left: &[[u32; 2]]| -> Vec<Verdict> {
            fault_tolerance(&[alone.clone(), line(2, left)])
                .iter()
                .map(|judgement| judgement.verdict)
                .collect()
        };
        assert_eq!(verdicts(&[[0, 0]; 100]), [Holds, Holds]);
        assert_eq!(verdicts(&[[4, 0]; 100]), [Open, Holds], "the body shuts the way");
        let mut one = [[0, 0]; 100];
        one[30] = [4, 1];
        assert_eq!(verdicts(&one), [Holds, Fails], "on one layout they leave out what they can get to");
    }
}
