//! The figures of KIT as text, with what the paper prints beside it.

use super::super::prelude::*;
use super::drive::EXPLORED;
use super::figure::{Contest, Figure, Line, Race, Settings, Summary, Team, TeamRule};
use super::lattice::PATHS;

/// The paper's numbers: 78 % efficiency at 88 % (5 of 23 paths driven by both), and 7 min 24 s between one robot and
/// two.
pub(super) fn of(figure: Figure, lines: &[Line], races: &[Race]) -> Vec<PrintedFigure> {
    let gain = |race: &Race| {
        let Race { family, team, gain, .. } = race;
        PrintedFigure::of(format!("s by which two are sooner, {}, {family}", team.rule.word()), 444.0, *gain)
    };
    let shares = |line: &Line| {
        let of = format!("of two, {}, {}", line.team.rule.word(), line.family);
        let efficiency = PrintedFigure::of(format!("% efficiency {of}"), 78.0, line.efficiency);
        [efficiency, PrintedFigure::of(format!("% explored in the end {of}"), 88.0, line.explored)]
    };
    let is_published = |team: Team| team.rule != TeamRule::Repaired;
    match figure {
        Figure::Time => races.iter().filter(|race| is_published(race.team)).filter_map(gain).collect(),
        Figure::Overlap => {
            let two = lines.iter().filter(|line| line.team.robots == 2 && is_published(line.team));
            two.flat_map(shares).flatten().collect()
        }
    }
}

/// Whether two robots have explored more directions at nodes than one when all nodes are found.
pub(super) fn directions(lines: &[Line]) -> impl Iterator<Item = Judgement> + '_ {
    let published = lines.iter().filter(|line| line.team.rule != TeamRule::Repaired && line.team.robots == 1);
    published.filter_map(|one| {
        let is_two =
            |line: &&Line| (line.family, line.team.rule, line.team.robots) == (one.family, one.team.rule, 2);
        let two = lines.iter().find(is_two)?;
        let [of_one, of_two] = [one, two].map(|line| ends(line.directions));
        Some(Judgement::new(
            "“MAS has explored more direction at nodes than the single robot”",
            format!("{}, {}", one.team.rule.word(), one.family),
            format!("{} with two, {} with one", text(two.directions, 1), text(one.directions, 1)),
            below(of_one, of_two),
        ))
    })
}

/// Whether two robots find all nodes sooner than one; who never does is later than any.
pub(super) fn sooner(races: &[Race]) -> impl Iterator<Item = Judgement> + '_ {
    let is_said = |race: &&Race| {
        race.team.rule != TeamRule::Repaired && (race.other.rule, race.other.robots) == (race.team.rule, 1)
    };
    races.iter().filter(is_said).map(|race| {
        let [ahead, behind] = [race.ahead, race.behind].map(ends);
        Judgement::new(
            "“MAS is taking less time to explore and cover the area”",
            format!("{}, {}", race.team.rule.word(), race.family),
            format!(
                "two are sooner in {} % of the layouts, one in {} %",
                text(race.ahead, 1),
                text(race.behind, 1)
            ),
            below(behind, ahead),
        )
    })
}

/// Whether two robots that talk are sooner than two that do not.
pub(super) fn talking(figure: Figure, silence: &[Contest]) -> impl Iterator<Item = Judgement> + '_ {
    let goal = match figure {
        Figure::Time => "all nodes",
        Figure::Overlap => "88 % of the paths",
    };
    silence.iter().map(move |contest| {
        let [ahead, behind] = [contest.ahead, contest.behind].map(ends);
        let [talking, silent] = [contest.ahead, contest.behind].map(|share| text(share, 1));
        let sentence =
            "“Communication between agents benefits increase of the performance” (2): two sooner with it";
        Judgement::new(
            format!("{sentence}, {goal}"),
            format!("{}, {}", contest.rule.word(), contest.family),
            format!("sooner with it in {talking} % of the layouts, without it in {silent} %"),
            below(behind, ahead),
        )
    })
}

impl TeamRule {
    const fn word(self) -> &'static str {
        match self {
            Self::Published => "published",
            Self::Ahead => "ahead",
            Self::Repaired => "repaired",
        }
    }
}

impl Team {
    /// Its name.
    pub(super) fn name(self) -> String {
        format!("{}, {}", self.rule.word(), counted(self.robots, "robot"))
    }
}

/// The first lines of the table, with the settings.
pub(super) fn head(settings: &Settings) -> String {
    let Settings { layouts, seed, speed, spread } = *settings;
    let (speed, spread) = (f64::from(speed.get()) / 1000.0, f64::from(spread) / 10.0);
    format!(
        "Lattices with {PATHS} paths, {} of each family, seeds from {seed}; {speed} m/s, drives up to {spread} % \
         faster or slower; means with 95 % intervals\n\n",
        counted(layouts, "layout"),
    )
}

/// The figure for people.
pub(super) fn told(figure: Figure, settings: &Settings, merged: &Summary) -> String {
    let head = head(settings);
    let body = match figure {
        Figure::Time => times(merged),
        Figure::Overlap => overlaps(merged),
    };
    format!(
        "{head}{body}\npublished: KIT at every node. ahead: as published, KIT only where the way ahead is blocked.\n\
         Runs that go to and fro, or stand still, are ended; a mean of seconds is over those that come so far.\n\n{}",
        paper::text(&merged.paper, 0)
    )
}

/// Two lines of text for each family and team, the family named once.
fn named(merged: &Summary) -> impl Iterator<Item = (&'static str, &Line)> {
    let mut last = "";
    merged.lines.iter().map(move |line| {
        let family = if line.family == last { "" } else { line.family };
        last = line.family;
        (family, line)
    })
}

fn times(merged: &Summary) -> String {
    let half = |line: &Line| -> Option<Estimate> {
        line.nodes.get(line.nodes.len().div_ceil(2).checked_sub(1)?).copied()
    };
    let nodes = Columns::of(named(merged))
        .title("Seconds until half of the nodes are found, and all; the directions that are explored at nodes by then")
        .left("family", |(family, _)| family)
        .left("team", |(_, line)| line.team.name())
        .estimate("half", 0, move |(_, line)| half(line))
        .estimate("all", 0, |(_, line)| line.nodes.last().copied())
        .estimate("directions", 1, |(_, line)| line.directions)
        .estimate("never all %", 1, |(_, line)| line.lost);
    let races = Columns::of(&merged.races)
        .title(
            "A team against another one: seconds by which it finds all nodes sooner, and how \
             often, where both do; and of all layouts",
        )
        .left("family", |race| race.family)
        .left("team", |race| race.team.name())
        .left("against", |race| race.other.name())
        .estimate("by s", 0, |race| race.gain)
        .estimate("sooner %", 1, |race| race.sooner)
        .estimate("both do %", 1, |race| race.both)
        .estimate("it first %", 1, |race| race.ahead)
        .estimate("other first %", 1, |race| race.behind);
    nodes.text() + &races.text()
}

fn overlaps(merged: &Summary) -> String {
    let title = format!(
        "When {EXPLORED} paths are explored: % of them driven by one robot alone, and seconds; seconds until all are"
    );
    let means = Columns::of(named(merged))
        .title(title)
        .left("family", |(family, _)| family)
        .left("team", |(_, line)| line.team.name())
        .estimate("efficiency", 1, |(_, line)| line.efficiency)
        .estimate("s to 88 %", 0, |(_, line)| line.most)
        .estimate("s to all", 0, |(_, line)| line.all);
    let shares = Columns::of(named(merged))
        .title(
            "% of the paths explored in the end, and % of the runs that reach \
                88 %, that never drive all, that lose contact",
        )
        .left("family", |(family, _)| family)
        .left("team", |(_, line)| line.team.name())
        .estimate("explored %", 1, |(_, line)| line.explored)
        .estimate("reach 88 %", 1, |(_, line)| line.reached)
        .estimate("never all %", 1, |(_, line)| line.ended)
        .estimate("out of contact %", 1, |(_, line)| line.cut);
    means.text() + &shares.text()
}
