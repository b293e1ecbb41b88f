//! The figures of agents as text, with what the paper prints beside it.

use super::super::prelude::*;
use super::figure::{Duration, Figure, Line, Summary};
use super::team::{READINGS, TEAMS, Team};

/// The numbers that the paper prints: of Brick&Mortar in Fig. 11.
pub(super) fn of(figure: Figure, lines: &[Line]) -> Vec<PrintedFigure> {
    let [bricks, ..] = TEAMS;
    let one = lines.iter().find(|line| (line.team, line.agents) == (bricks, 1));
    let one = one.filter(|_| figure == Figure::Agents);
    let printed = [
        PrintedFigure::of("% explored by one agent of bricks", 50.0, one.map(|line| line.explored)),
        PrintedFigure::of("% visited by one agent of bricks", 40.0, one.and_then(|line| line.visited)),
    ];
    printed.into_iter().flatten().collect()
}

/// The sentences of V.B, of every point of the figure.
pub(super) fn judged(figure: Figure, merged: &Summary) -> Vec<Judgement> {
    let ([bricks, _, ants, ants_published, ..], [beside, in_count]) = (TEAMS, READINGS);
    let of = |team: Team| merged.lines.iter().filter(move |line| line.team == team);
    let whole = |line: &Line| line.exploration.map_or(0, |duration| duration.seconds.count);
    let always_whole = |line| always(Estimate::share(whole(line), merged.layouts));
    let fewest = |team| {
        let fewest = of(team).map(whole).min().unwrap_or(0);
        format!("everything in {fewest} of {} runs within their steps, at the worst point", merged.layouts)
    };
    match figure {
        Figure::Agents => {
            let reaches = of(bricks).map(always_whole).fold(Verdict::Fails, Verdict::or);
            let never = of(bricks).all(|line| whole(line) < merged.layouts);
            let most =
                of(bricks).map(|line| line.explored).max_by(|one, other| one.mean.total_cmp(&other.mean));
            let below_all = Judgement::new(
                "“adding more agents … without however reaching the 100% mark”",
                bricks.name(),
                format!("at most {} %", Estimate::text_or_dash(most, 1)),
                Verdict::decided(never, reaches == Verdict::Holds),
            );
            let ants = [ants, ants_published, beside, in_count].map(|team| {
                let verdict = of(team).map(always_whole).fold(Verdict::Holds, Verdict::and);
                let sentence = "“Ants always manage to explore 100% of the area's cells”";
                Judgement::new(sentence, team.name(), fewest(team), verdict)
            });
            [below_all].into_iter().chain(ants).collect()
        }
        Figure::Area => {
            let (first, last) = (of(bricks).next(), of(bricks).next_back());
            let explored = |line: &Line| format!("{} % of {}x{1} cells", line.explored.text(1), line.side);
            let judged = first.zip(last).map(|(first, last)| {
                Judgement::new(
                    "“as we increase the area size, the agents have more opportunities to be trapped”",
                    bricks.name(),
                    format!("{}, {}", explored(first), explored(last)),
                    below(last.explored.interval, first.explored.interval),
                )
            });
            judged.into_iter().collect()
        }
        Figure::Ideal => {
            let ants = [ants, ants_published].into_iter().flat_map(|ants| {
                of(bricks).zip(of(ants)).map(move |(one, other)| {
                    let moves = |line: &Line| {
                        let is_whole = whole(line) == merged.layouts;
                        line.exploration.filter(|_| is_whole).map(|duration| duration.team_moves)
                    };
                    let (one_moves, other_moves) = (moves(one), moves(other));
                    let ends = |moves: Option<Estimate>| moves.and_then(|moves| moves.interval);
                    Judgement::new(
                        "“in idealized conditions, Brick&Mortar significantly outperforms Ants in terms of \
                         exploration time”",
                        format!("{}, {}", counted(one.agents, "agent"), ants.name()),
                        format!(
                            "{} team moves against {}",
                            Estimate::text_or_dash(one_moves, 0),
                            Estimate::text_or_dash(other_moves, 0)
                        ),
                        below(ends(one_moves), ends(other_moves)),
                    )
                })
            });
            ants.collect()
        }
    }
}

/// The figure for people.
pub(super) fn text(figure: Figure, merged: &Summary) -> String {
    let (missed, seconds) = match figure {
        Figure::Agents | Figure::Area => ("5.56 % of the sensors missed", String::new()),
        Figure::Ideal => ("no sensor missed", seconds(merged)),
    };
    format!(
        "Offices of 4x4 rooms, {missed}, {} at each point, seeds from {}; means with 95 % intervals\n\n{}\n\
         ended: runs that were stopped after {} of all agents. Where fewer than all runs explored every cell, or were\n\
         done, their number follows.\n{seconds}\n{}",
        counted(merged.layouts, "layout"),
        merged.seed,
        moves(merged),
        counted(merged.max_steps, "step"),
        paper::text(&merged.paper, 1, [40, 5, 13, 10])
    )
}

fn moves(merged: &Summary) -> String {
    let moves = |duration| of_runs(merged, duration, |duration| duration.team_moves.text(0));
    Columns::of(&merged.lines)
        .left("area", 7, |line| format!("{0}x{0}", line.side))
        .gap(1)
        .right("agents", 6, |line| line.agents)
        .gap(2)
        .left("team", 16, |line| line.team.name())
        .gap(1)
        .estimate("% explored", 15, 1, |line| line.explored)
        .estimate("% visited", 15, 1, |line| line.visited)
        .right("moves until explored", 26, move |line| moves(line.exploration))
        .right("moves until done", 26, move |line| moves(line.termination))
        .right("ended", 5, |line| line.ended)
        .text()
}

fn seconds(merged: &Summary) -> String {
    let hours = |duration| of_runs(merged, duration, |duration| duration.seconds.times(1.0 / 3600.0).text(1));
    Columns::of(&merged.lines)
        .title("Hours of the slowest agent")
        .right("agents", 6, |line| line.agents)
        .left("team", 16, |line| line.team.name())
        .gap(1)
        .right("until explored", 20, move |line| hours(line.exploration))
        .right("until done", 20, move |line| hours(line.termination))
        .text()
}

/// How long something took, and in how many runs if not in all.
fn of_runs(merged: &Summary, duration: Option<Duration>, text: impl Fn(Duration) -> String) -> String {
    match duration {
        None => "never".to_owned(),
        Some(duration) if duration.seconds.count < merged.layouts => {
            format!("{} ({})", text(duration), duration.seconds.count)
        }
        Some(duration) => text(duration),
    }
}
