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
    match figure {
        Figure::Agents => by_agents(merged),
        Figure::Area => by_area(merged),
        Figure::Ideal => ideal(merged),
    }
}

/// Brick&Mortar: ours, and as published.
const BOTH: [Team; 2] = {
    let [bricks, ..] = TEAMS;
    [bricks, BRICKS_PUBLISHED]
};

/// The lines of a team, point by point.
fn lines_of(merged: &Summary, team: Team) -> impl DoubleEndedIterator<Item = &Line> {
    merged.lines.iter().filter(move |line| line.team == team)
}

/// The sentences about Fig. 11.
fn by_agents(merged: &Summary) -> Vec<Judgement> {
    let ([_, _, ants, ants_published, ..], [beside, in_count]) = (TEAMS, READINGS);
    let always_whole = |line| always(Estimate::share(whole(line), merged.layouts));
    let fewest = |team| {
        let fewest = lines_of(merged, team).map(whole).min().unwrap_or(0);
        format!("everything in {fewest} of {} runs within their steps, at the worst point", merged.layouts)
    };
    let below_all = BOTH.map(|bricks| {
        let reaches = lines_of(merged, bricks).map(always_whole).fold(Verdict::Fails, Verdict::or);
        let never = lines_of(merged, bricks).all(|line| whole(line) < merged.layouts);
        let explored = lines_of(merged, bricks).map(|line| line.explored);
        let most = explored.max_by(|one, other| one.mean.total_cmp(&other.mean));
        Judgement::new(
            "“adding more agents … without however reaching the 100% mark”",
            bricks.name(),
            format!("at most {} %", Estimate::text_or_dash(most, 1)),
            Verdict::decided(never, reaches == Verdict::Holds),
        )
    });
    let ants = [ants, ants_published, beside, in_count].map(|team| {
        let verdict = lines_of(merged, team).map(always_whole).fold(Verdict::Holds, Verdict::and);
        let sentence = "“Ants always manage to explore 100% of the area's cells”";
        Judgement::new(sentence, team.name(), fewest(team), verdict)
    });
    let better = BOTH.into_iter().filter_map(|bricks| {
        let (one, most) = (lines_of(merged, bricks).next()?, lines_of(merged, bricks).next_back()?);
        Some(Judgement::new(
            "“Adding more agents allows us to achieve better results”",
            bricks.name(),
            format!("{} % by one, {} % by {}", one.explored.text(1), most.explored.text(1), most.agents),
            below(one.explored.interval, most.explored.interval),
        ))
    });
    let papers = [ants_published, beside, in_count];
    let affected = papers.iter().filter_map(|&team| share(merged, team));
    let late = papers.iter().filter_map(|&team| time(merged, team));
    let compromised = BOTH.into_iter().flat_map(|bricks| compromised(merged, bricks));
    let rivals = pairs(papers, BOTH).filter_map(|(ants, bricks)| more_robust(merged, ants, bricks));
    better.chain(below_all).chain(ants).chain(affected).chain(late).chain(compromised).chain(rivals).collect()
}

/// The sentences about Fig. 12.
fn by_area(merged: &Summary) -> Vec<Judgement> {
    let explored = |line: &Line| format!("{} % of {}x{1} cells", line.explored.text(1), line.side);
    let judged = BOTH.into_iter().filter_map(|bricks| {
        let (first, last) = (lines_of(merged, bricks).next()?, lines_of(merged, bricks).next_back()?);
        Some(Judgement::new(
            "“as we increase the area size, the agents have more opportunities to be trapped”",
            bricks.name(),
            format!("{}, {}", explored(first), explored(last)),
            below(last.explored.interval, first.explored.interval),
        ))
    });
    let terminates = BOTH.into_iter().filter_map(|bricks| {
        let Line { side, termination, .. } = *lines_of(merged, bricks).next()?;
        let done = termination.map_or(0, |duration| duration.seconds.count);
        Some(Judgement::new(
            "“In relatively small areas, agents running Brick&Mortar manage to terminate before all of them \
             are blocked”",
            bricks.name(),
            format!("all agents are done in {done} of {} runs of {side}x{side} cells", merged.layouts),
            always(Estimate::share(done, merged.layouts)),
        ))
    });
    terminates.chain(judged).collect()
}

/// The sentence about idealized conditions.
fn ideal(merged: &Summary) -> Vec<Judgement> {
    let [_, _, ants, ants_published, ..] = TEAMS;
    let rivals = BOTH.into_iter().flat_map(|bricks| [(bricks, ants), (bricks, ants_published)]);
    let judged = rivals.flat_map(|(bricks, ants)| {
        lines_of(merged, bricks).zip(lines_of(merged, ants)).map(move |(one, other)| {
            let others_moves = moves_of_all(merged, other);
            Judgement::new(
                "“in idealized conditions, Brick&Mortar significantly outperforms Ants in terms of \
                 exploration time”",
                format!("{}, {} against {}", counted(one.agents, "agent"), bricks.name(), ants.name()),
                format!("{} against {}", moves_or_runs(merged, one), Estimate::text_or_dash(others_moves, 0)),
                is_sooner(merged, one, others_moves),
            )
        })
    });
    judged.collect()
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
    match moves_of_all(merged, line) {
        None => Verdict::decided(false, others.is_some() && 2 * whole(line) < merged.layouts),
        moves => below(ends(moves), ends(others)),
    }
}

/// The two sentences that missed sensors hardly affect ants; no number tells how far “hardly” is.
const AFFECTED: &str = "detection errors “hardly affect” Ants (VI), “minor effects on Ants” (V.B)";

/// The paper's ants, who do the same by every reading where no sensor is missed.
const fn unmissed_ants() -> Team {
    let [_, _, _, ants, ..] = TEAMS;
    ants
}

/// The lines of a team that misses sensors, each beside that of `unmissed`, which misses none.
fn beside_unmissed(merged: &Summary, team: Team, unmissed: Team) -> impl Iterator<Item = (&Line, &Line)> {
    lines_of(merged, team).zip(merged.unmissed.iter().filter(move |line| line.team == unmissed))
}

/// Whether missed sensors hardly affect the share of the cells that ants explore, at every number of agents.
fn share(merged: &Summary, team: Team) -> Option<Judgement> {
    let all = || beside_unmissed(merged, team, unmissed_ants());
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

/// Whether missed sensors compromise how much Brick&Mortar explores, at some and at every number of agents.
fn compromised(merged: &Summary, team: Team) -> [Judgement; 2] {
    let all = || beside_unmissed(merged, team, team);
    let is_far = |(line, unmissed): (&Line, &Line)| {
        below(line.explored.interval, unmissed.explored.times(NEAR).interval)
    };
    let ratio = |(line, unmissed): (&Line, &Line)| line.explored.mean / unmissed.explored.mean;
    let order = |one: &(&Line, &Line), other: &(&Line, &Line)| ratio(*one).total_cmp(&ratio(*other));
    let measured = |at: Option<(&Line, &Line)>| {
        at.map_or_else(String::new, |(line, unmissed)| {
            let [ours, theirs] = [line, unmissed].map(|line| line.explored.text(1));
            format!("{ours} % against {theirs} % by {}", counted(line.agents, "agent"))
        })
    };
    let sentence = format!(
        "missed sensors “can greatly compromise the performance of Brick&Mortar” (V.B), “significantly” (VI): less \
         than {NEAR} of the cells that are explored with none missed"
    );
    let (some, every) = (Verdict::or as fn(_, _) -> _, Verdict::and as fn(_, _) -> _);
    [
        ("at some number of agents", all().min_by(order), all().map(is_far).fold(Verdict::Fails, some)),
        ("at every number of agents", all().max_by(order), all().map(is_far).fold(Verdict::Holds, every)),
    ]
    .map(|(which, at, verdict)| {
        Judgement::new(sentence.clone(), format!("{}, {which}", team.name()), measured(at), verdict)
    })
}

/// Whether ants that miss sensors explore more than Brick&Mortar that misses them, at every number of agents.
fn more_robust(merged: &Summary, ants: Team, bricks: Team) -> Option<Judgement> {
    let all = || lines_of(merged, ants).zip(lines_of(merged, bricks));
    let lead = |(ants, bricks): &(&Line, &Line)| ants.explored.mean - bricks.explored.mean;
    let (worst, rival) = all().min_by(|one, other| lead(one).total_cmp(&lead(other)))?;
    Some(Judgement::new(
        "Ants are “significantly more robust in realistic error conditions” (V.B): they explore more cells, at every \
         number of agents",
        format!("{} against {}", ants.name(), bricks.name()),
        format!(
            "{} % against {} % at worst, by {}",
            worst.explored.text(1),
            rival.explored.text(1),
            counted(worst.agents, "agent")
        ),
        all()
            .map(|(ants, bricks)| below(bricks.explored.interval, ants.explored.interval))
            .fold(Verdict::Holds, Verdict::and),
    ))
}

/// Whether missed sensors hardly affect how long ants explore, at every number of agents.
fn time(merged: &Summary, team: Team) -> Option<Judgement> {
    let all = || beside_unmissed(merged, team, unmissed_ants());
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
        "Offices of 4x4 rooms, {missed}, {} at each point, seeds from {}; means with 95 % intervals\n{}\n{}{unmissed}\n\
         ended: runs that were stopped after {} of all agents. Where fewer than all runs explored every cell, or were\n\
         done, their number follows.\n{seconds}\n{}",
        counted(merged.layouts, "layout"),
        merged.seed,
        merged.starts.line(),
        moves(merged, &merged.lines).text(),
        counted(merged.max_steps, "step"),
        paper::text(&merged.paper, 1)
    )
}

fn moves<'a>(merged: &Summary, lines: &'a [Line]) -> Columns<&'a Line> {
    let moves = |duration| of_runs(merged, duration, |duration| duration.team_moves.text(0));
    Columns::of(lines)
        .left("area", |line| format!("{0}x{0}", line.side))
        .right("agents", |line| line.agents)
        .left("team", |line| line.team.name())
        .estimate("% explored", 1, |line| line.explored)
        .estimate("% visited", 1, |line| line.visited)
        .right("moves until explored", move |line| moves(line.exploration))
        .right("moves until done", move |line| moves(line.termination))
        .right("ended", |line| line.ended)
}

fn seconds(merged: &Summary) -> String {
    let hours = |duration| of_runs(merged, duration, |duration| duration.seconds.times(1.0 / 3600.0).text(1));
    Columns::of(&merged.lines)
        .title("Hours of the slowest agent")
        .right("agents", |line| line.agents)
        .left("team", |line| line.team.name())
        .right("until explored", move |line| hours(line.exploration))
        .right("until done", move |line| hours(line.termination))
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
