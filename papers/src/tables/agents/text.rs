//! The figures of agents as text, with what the paper prints beside it.

use super::super::prelude::*;
use super::super::sentences::{NEAR, SAME};
use super::figure::{Duration, Figure, Line, Summary};
use super::team::{BRICKS_PUBLISHED, READINGS, TEAMS, Team};

/// The numbers that the paper prints: of Brick&Mortar in Fig. 11.
pub(super) fn of(figure: Figure, lines: &[Line]) -> Vec<PrintedFigure> {
    let [bricks, ..] = TEAMS;
    let of = |team: Team| {
        let one = lines.iter().find(|line| (line.team, line.agents) == (team, 1));
        let one = one.filter(|_| figure == Figure::Agents);
        let what = |share| format!("% {share} by one agent of {}", team.name());
        [
            PrintedFigure::of(what("explored"), 50.0, one.map(|line| line.explored)),
            PrintedFigure::of(what("visited"), 40.0, one.and_then(|line| line.visited)),
        ]
    };
    [bricks, BRICKS_PUBLISHED].into_iter().flat_map(of).flatten().collect()
}

/// The sentences of V.B, of every point of the figure.
pub(super) fn judged(figure: Figure, merged: &Summary) -> Vec<Judgement> {
    let ([bricks, _, ants, ants_published, ..], [beside, in_count]) = (TEAMS, READINGS);
    let both = [bricks, BRICKS_PUBLISHED];
    let of = |team: Team| merged.lines.iter().filter(move |line| line.team == team);
    let always_whole = |line| always(Estimate::share(whole(line), merged.layouts));
    let fewest = |team| {
        let fewest = of(team).map(whole).min().unwrap_or(0);
        format!("everything in {fewest} of {} runs within their steps, at the worst point", merged.layouts)
    };
    match figure {
        Figure::Agents => {
            let below_all = both.map(|bricks| {
                let reaches = of(bricks).map(always_whole).fold(Verdict::Fails, Verdict::or);
                let never = of(bricks).all(|line| whole(line) < merged.layouts);
                let explored = of(bricks).map(|line| line.explored);
                let most = explored.max_by(|one, other| one.mean.total_cmp(&other.mean));
                Judgement::new(
                    "“adding more agents … without however reaching the 100% mark”",
                    bricks.name(),
                    format!("at most {} %", Estimate::text_or_dash(most, 1)),
                    Verdict::decided(never, reaches == Verdict::Holds),
                )
            });
            let ants = [ants, ants_published, beside, in_count].map(|team| {
                let verdict = of(team).map(always_whole).fold(Verdict::Holds, Verdict::and);
                let sentence = "“Ants always manage to explore 100% of the area's cells”";
                Judgement::new(sentence, team.name(), fewest(team), verdict)
            });
            let papers = [ants_published, beside, in_count];
            let (share, time) =
                (papers.map(|team| share(merged, team)), papers.map(|team| time(merged, team)));
            let affected = share.into_iter().chain(time).flatten();
            below_all.into_iter().chain(ants).chain(affected).collect()
        }
        Figure::Area => {
            let explored = |line: &Line| format!("{} % of {}x{1} cells", line.explored.text(1), line.side);
            let judged = both.into_iter().filter_map(|bricks| {
                let (first, last) = (of(bricks).next()?, of(bricks).next_back()?);
                Some(Judgement::new(
                    "“as we increase the area size, the agents have more opportunities to be trapped”",
                    bricks.name(),
                    format!("{}, {}", explored(first), explored(last)),
                    below(last.explored.interval, first.explored.interval),
                ))
            });
            judged.collect()
        }
        Figure::Ideal => {
            let rivals = both.into_iter().flat_map(|bricks| [(bricks, ants), (bricks, ants_published)]);
            let judged = rivals.flat_map(|(bricks, ants)| {
                of(bricks).zip(of(ants)).map(move |(one, other)| {
                    let others_moves = moves_of_all(merged, other);
                    Judgement::new(
                        "“in idealized conditions, Brick&Mortar significantly outperforms Ants in terms of \
                         exploration time”",
                        format!(
                            "{}, {} against {}",
                            counted(one.agents, "agent"),
                            bricks.name(),
                            ants.name()
                        ),
                        format!(
                            "{} against {}",
                            moves_or_runs(merged, one),
                            Estimate::text_or_dash(others_moves, 0)
                        ),
                        is_sooner(merged, one, others_moves),
                    )
                })
            });
            judged.collect()
        }
    }
}

/// The runs that explored every cell.
fn whole(line: &Line) -> u32 {
    line.exploration.map_or(0, |duration| duration.seconds.count)
}

/// Team moves until every cell was explored, if that was so in all runs.
fn moves_of_all(merged: &Summary, line: &Line) -> Option<Estimate> {
    line.exploration.filter(|_| whole(line) == merged.layouts).map(|duration| duration.team_moves)
}

/// Team moves until every cell was explored, or in how many runs that was so if not in all.
fn moves_or_runs(merged: &Summary, line: &Line) -> String {
    match moves_of_all(merged, line) {
        None => format!("everything in {} of {} runs", whole(line), merged.layouts),
        moves => format!("{} team moves", Estimate::text_or_dash(moves, 0)),
    }
}

/// Whether every cell is explored in fewer than so many team moves, which all runs of another team of as many agents
/// took. Where fewer than half of the runs explore every cell, the median run takes longer than any of those.
fn is_sooner(merged: &Summary, line: &Line, others: Option<Estimate>) -> Verdict {
    let ends = |moves: Option<Estimate>| moves.and_then(|moves| moves.interval);
    match moves_of_all(merged, line) {
        None => Verdict::decided(false, others.is_some() && 2 * whole(line) < merged.layouts),
        moves => below(ends(moves), ends(others)),
    }
}

/// The two sentences that missed sensors hardly affect ants; no number tells how far “hardly” is.
const AFFECTED: &str = "detection errors “hardly affect” Ants (VI), “minor effects on Ants” (V.B)";

/// The lines of ants that miss sensors, each beside that of the paper's that miss none.
fn beside_unmissed(merged: &Summary, team: Team) -> impl Iterator<Item = (&Line, &Line)> {
    let lines = merged.lines.iter().filter(move |line| line.team == team);
    lines.zip(&merged.unmissed)
}

/// Whether missed sensors hardly affect the share of the cells that ants explore, at every number of agents.
fn share(merged: &Summary, team: Team) -> Option<Judgement> {
    let all = || beside_unmissed(merged, team);
    let is_near = |(line, unmissed): (&Line, &Line)| {
        below(unmissed.explored.times(NEAR).interval, line.explored.interval)
    };
    let ratio = |(line, unmissed): (&Line, &Line)| line.explored.mean / unmissed.explored.mean;
    let (line, unmissed) = all().min_by(|&one, &other| ratio(one).total_cmp(&ratio(other)))?;
    Some(Judgement::new(
        format!("{AFFECTED}: of the cells, {NEAR} or more of what is explored with none missed"),
        team.name(),
        format!(
            "{} % against {} % at worst, by {}",
            line.explored.text(1),
            unmissed.explored.text(1),
            counted(line.agents, "agent")
        ),
        all().map(is_near).fold(Verdict::Holds, Verdict::and),
    ))
}

/// Whether missed sensors hardly affect how long ants explore, at every number of agents.
fn time(merged: &Summary, team: Team) -> Option<Judgement> {
    let all = || beside_unmissed(merged, team);
    let is_near = |(line, unmissed): (&Line, &Line)| {
        is_sooner(merged, line, moves_of_all(merged, unmissed).map(|moves| moves.times(1.0 + SAME)))
    };
    let times = |(line, unmissed): (&Line, &Line)| {
        let mean = |line| moves_of_all(merged, line).map_or(f64::INFINITY, |moves| moves.mean);
        (merged.layouts - whole(line), mean(line) / mean(unmissed))
    };
    let (line, unmissed) = all().max_by(|&one, &other| {
        let ((fewer, one), (than, other)) = (times(one), times(other));
        fewer.cmp(&than).then(one.total_cmp(&other))
    })?;
    let ours = moves_or_runs(merged, line);
    let theirs = Estimate::text_or_dash(moves_of_all(merged, unmissed), 0);
    Some(Judgement::new(
        format!("{AFFECTED}: of the time, {} times or less of what it takes with none missed", 1.0 + SAME),
        team.name(),
        format!("{ours} against {theirs} team moves at worst, by {}", counted(line.agents, "agent")),
        all().map(is_near).fold(Verdict::Holds, Verdict::and),
    ))
}

/// The figure for people.
pub(super) fn text(figure: Figure, merged: &Summary) -> String {
    let (missed, seconds) = match figure {
        Figure::Agents | Figure::Area => ("5.56 % of the sensors missed", String::new()),
        Figure::Ideal => ("no sensor missed", seconds(merged)),
    };
    let unmissed = match &merged.unmissed[..] {
        [] => String::new(),
        lines => moves(merged, lines).title("Of these offices with no sensor missed").text(),
    };
    format!(
        "Offices of 4x4 rooms, {missed}, {} at each point, seeds from {}; means with 95 % intervals\n\n{}{unmissed}\n\
         ended: runs that were stopped after {} of all agents. Where fewer than all runs explored every cell, or were\n\
         done, their number follows.\n{seconds}\n{}",
        counted(merged.layouts, "layout"),
        merged.seed,
        moves(merged, &merged.lines).text(),
        counted(merged.max_steps, "step"),
        paper::text(&merged.paper, 1, [46, 5, 13, 10])
    )
}

fn moves<'a>(merged: &Summary, lines: &'a [Line]) -> Columns<&'a Line> {
    let moves = |duration| of_runs(merged, duration, |duration| duration.team_moves.text(0));
    Columns::of(lines)
        .left("area", 7, |line| format!("{0}x{0}", line.side))
        .gap(1)
        .right("agents", 6, |line| line.agents)
        .gap(2)
        .left("team", 18, |line| line.team.name())
        .gap(1)
        .estimate("% explored", 13, 1, |line| line.explored)
        .estimate("% visited", 15, 1, |line| line.visited)
        .right("moves until explored", 26, move |line| moves(line.exploration))
        .right("moves until done", 26, move |line| moves(line.termination))
        .right("ended", 5, |line| line.ended)
}

fn seconds(merged: &Summary) -> String {
    let hours = |duration| of_runs(merged, duration, |duration| duration.seconds.times(1.0 / 3600.0).text(1));
    Columns::of(&merged.lines)
        .title("Hours of the slowest agent")
        .right("agents", 6, |line| line.agents)
        .left("team", 18, |line| line.team.name())
        .gap(1)
        .right("until explored", 18, move |line| hours(line.exploration))
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
