//! The search of lots, each of which is looked at by itself: all layouts of an area, say. Lots come in stages, smallest
//! first, and no stage is looked at after one in which enough was found. They are looked at in waves of a fixed number,
//! so that all comes out the same on any number of threads.
//!
//! Lots can be dealt out among shards. A shard takes the looks at its own lots, stage by stage, until it has found
//! enough itself; the looks of all shards are put together by the same search that one process makes.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::ops::ControlFlow;

use super::threads;
use super::watchdog::Steps;

/// Lots that are looked at together.
const WAVE: usize = 64;

/// Lots in stages.
pub trait Lots: Sync {
    /// Data that the lots of a stage share.
    type Stage: Copy + Send + Sync;
    /// A part of the work that is looked at by itself.
    type Lot: Send + Sync;
    /// The result of a lot.
    type Look: Look;
    /// The result of all lots together.
    type Findings: Default;
    /// Why a lot cannot be looked at.
    type Error: Send;

    /// All stages, in their order.
    fn stages(&self) -> Vec<Self::Stage>;

    /// The lots of a stage, always in the same order.
    ///
    /// # Errors
    /// Its fault, if one of them cannot be made.
    fn lots(&self, stage: Self::Stage) -> Result<Vec<Self::Lot>, Self::Error>;

    /// About how many steps a look at a lot takes; only how they compare matters.
    fn weight(&self, stage: Self::Stage, lot: &Self::Lot) -> u64;

    /// Looks at a lot, and may give it up after so many steps.
    ///
    /// # Errors
    /// Its fault, if it cannot be looked at.
    fn look(&self, stage: Self::Stage, lot: &Self::Lot, most_steps: u64) -> Result<Self::Look, Self::Error>;

    /// Adds a look to what was found in the lots before.
    ///
    /// # Errors
    /// Its fault, if what was seen cannot be told.
    fn add(&self, found: &mut Self::Findings, lot: &Self::Lot, look: Self::Look) -> Result<(), Self::Error>;

    /// All lots of a stage were looked at, and a later one may follow.
    fn cover(&self, found: &mut Self::Findings, stage: Self::Stage);
}

/// The result of a lot.
pub trait Look: Send {
    /// Steps that were made.
    fn steps(&self) -> u64;

    /// Whether all of the lot was looked at.
    fn is_whole(&self) -> bool;

    /// Whether no later stage is to be looked at.
    fn is_enough(&self) -> bool;
}

/// Searches all lots until enough is found, `watch` ends the work, or so many steps are made. Whether the search came
/// to its end stands beside what was found.
///
/// # Errors
/// The fault of a lot.
pub fn search<L: Lots>(
    lots: &L,
    budget_steps: Option<u64>,
    watch: &mut dyn FnMut(&L::Findings) -> ControlFlow<()>,
) -> Result<(L::Findings, bool), L::Error> {
    gather(lots, budget_steps, |_, stage, wave, most_steps| looks(lots, stage, wave, most_steps), watch)
}

/// The findings that one process would have had, by the looks of all shards, each stage by stage. A lot that no shard
/// has was not looked at.
///
/// # Errors
/// The fault of a lot.
pub fn merged<L: Lots>(lots: &L, shards: Vec<Vec<Vec<L::Look>>>) -> Result<(L::Findings, bool), L::Error> {
    let owners = deal(lots, shards.len())?;
    let mut shards: Vec<Vec<_>> =
        shards.into_iter().map(|stages| stages.into_iter().map(Vec::into_iter).collect()).collect();
    let mut next = |stage: usize, lot: usize| {
        let &owner = owners.get(stage)?.get(lot)?;
        shards.get_mut(owner)?.get_mut(stage)?.next()
    };
    let mut at = (0, 0);
    gather(
        lots,
        None,
        |number, _, wave, _| {
            let first = if at.0 == number { at.1 } else { 0 };
            at = (number, first + wave.len());
            Ok((first..at.1).map_while(|lot| next(number, lot)).collect())
        },
        &mut |_| ControlFlow::Continue(()),
    )
}

/// The search, whoever takes the looks at a wave of lots.
fn gather<L: Lots>(
    lots: &L,
    budget_steps: Option<u64>,
    mut take: impl FnMut(usize, L::Stage, &[L::Lot], u64) -> Result<Vec<L::Look>, L::Error>,
    watch: &mut dyn FnMut(&L::Findings) -> ControlFlow<()>,
) -> Result<(L::Findings, bool), L::Error> {
    let (mut found, mut left) = (L::Findings::default(), budget_steps.unwrap_or(u64::MAX));
    for (number, stage) in lots.stages().into_iter().enumerate() {
        let mut is_enough = false;
        for wave in lots.lots(stage)?.chunks(WAVE) {
            if left == 0 {
                return Ok((found, false));
            }
            let looks = take(number, stage, wave, left)?;
            let mut is_whole = looks.len() == wave.len();
            for (lot, look) in wave.iter().zip(looks) {
                left = left.saturating_sub(look.steps());
                is_whole &= look.is_whole();
                is_enough |= look.is_enough();
                lots.add(&mut found, lot, look)?;
            }
            if !is_whole || watch(&found).is_break() {
                return Ok((found, false));
            }
        }
        if is_enough {
            break;
        }
        lots.cover(&mut found, stage);
    }
    Ok((found, true))
}

fn looks<'a, L: Lots<Lot: 'a>>(
    lots: &L,
    stage: L::Stage,
    wave: impl IntoIterator<Item = &'a L::Lot>,
    most_steps: u64,
) -> Result<Vec<L::Look>, L::Error> {
    let look = |lot| {
        let _steps = Steps::begin();
        lots.look(stage, lot, most_steps)
    };
    threads::each(wave, look).into_iter().collect()
}

/// Of each stage the shard of each lot: the heaviest lots first, each goes to the shard that has least until then.
fn deal<L: Lots>(lots: &L, shards: usize) -> Result<Vec<Vec<usize>>, L::Error> {
    let mut loads: BinaryHeap<Reverse<(u64, usize)>> = (0..shards).map(|shard| Reverse((0, shard))).collect();
    let deal_stage = |stage: L::Stage| {
        let all = lots.lots(stage)?;
        let mut heaviest: Vec<(Reverse<u64>, usize)> =
            all.iter().enumerate().map(|(place, lot)| (Reverse(lots.weight(stage, lot)), place)).collect();
        heaviest.sort_unstable();
        let mut owners = vec![0; all.len()];
        for (Reverse(weight), place) in heaviest {
            let Some(Reverse((load, shard))) = loads.pop() else { break };
            owners[place] = shard;
            loads.push(Reverse((load.saturating_add(weight), shard)));
        }
        Ok(owners)
    };
    lots.stages().into_iter().map(deal_stage).collect()
}

/// How many lots each of so many shards has.
///
/// # Errors
/// The fault of a lot.
pub fn dealt<L: Lots>(lots: &L, shards: usize) -> Result<Vec<u64>, L::Error> {
    let mut left = vec![0; shards];
    for owner in deal(lots, shards)?.into_iter().flatten() {
        left[owner] += 1;
    }
    Ok(left)
}

/// A shard of the lots, and the looks that it has taken.
pub struct Shard<L: Lots> {
    lots: L,
    /// Its number, the first being 0.
    number: usize,
    stages: Vec<L::Stage>,
    /// Of each stage the shard of each lot.
    owners: Vec<Vec<usize>>,
    /// Of each stage that was begun, its own lots' looks.
    looks: Vec<Vec<L::Look>>,
    /// Its own lots of the last stage that was begun.
    own: Vec<L::Lot>,
    left: u64,
}

impl<L: Lots> Shard<L> {
    /// The shard with this number, the first being 0, of so many; it has taken these looks.
    ///
    /// # Errors
    /// The fault of a lot.
    pub fn new(
        lots: L,
        (number, of): (usize, usize),
        mut looks: Vec<Vec<L::Look>>,
        budget_steps: Option<u64>,
    ) -> Result<Self, L::Error> {
        let (stages, owners) = (lots.stages(), deal(&lots, of)?);
        looks.truncate(stages.len());
        let left = budget_steps.unwrap_or(u64::MAX);
        let mut shard = Self { lots, number, stages, owners, looks, own: Vec::new(), left };
        if shard.looks.is_empty() {
            shard.begin()?;
        } else {
            shard.own = shard.own_lots()?;
        }
        shard.go_on()?;
        Ok(shard)
    }

    /// The looks that it has taken, stage by stage.
    pub fn looks(&self) -> &[Vec<L::Look>] {
        &self.looks
    }

    /// Takes the looks at its next lots. Returns whether there is more to do, and to spend.
    ///
    /// # Errors
    /// The fault of a lot.
    pub fn wave(&mut self) -> Result<bool, L::Error> {
        if self.is_done() || self.left == 0 {
            return Ok(false);
        }
        if let (Some(&stage), Some(taken)) =
            (self.stages.get(self.looks.len().wrapping_sub(1)), self.looks.last_mut())
        {
            let new = looks(&self.lots, stage, self.own.iter().skip(taken.len()).take(WAVE), u64::MAX)?;
            self.left = self.left.saturating_sub(new.iter().map(Look::steps).sum());
            taken.extend(new);
        }
        self.go_on()?;
        Ok(!self.is_done() && self.left > 0)
    }

    /// Whether it has looked at all its lots of each stage before the last one that was begun, and at no other.
    pub fn is_in_order(&self) -> bool {
        let own = |owners: &Vec<usize>| owners.iter().filter(|&&owner| owner == self.number).count();
        let begun = self.looks.len();
        let mut stages = self.looks.iter().zip(&self.owners).zip(1..);
        stages.all(
            |((taken, owners), stage)| {
                if stage == begun { taken.len() <= own(owners) } else { taken.len() == own(owners) }
            },
        )
    }

    /// Whether nothing is left to do.
    pub fn is_done(&self) -> bool {
        self.is_at_end() && (self.has_enough() || self.looks.len() == self.stages.len())
    }

    /// Whether it has looked at all its lots of the last stage that was begun.
    fn is_at_end(&self) -> bool {
        self.looks.last().is_none_or(|taken| taken.len() >= self.own.len())
    }

    /// Whether one process would look at no later stage than the last one that was begun.
    fn has_enough(&self) -> bool {
        self.looks.last().is_some_and(|taken| taken.iter().any(|look| look.is_enough() || !look.is_whole()))
    }

    /// Begins the next stage with a lot of its own.
    fn go_on(&mut self) -> Result<(), L::Error> {
        while self.is_at_end() && !self.is_done() {
            self.begin()?;
        }
        Ok(())
    }

    fn begin(&mut self) -> Result<(), L::Error> {
        if self.looks.len() < self.stages.len() {
            self.looks.push(Vec::new());
            self.own = self.own_lots()?;
        }
        Ok(())
    }

    fn own_lots(&self) -> Result<Vec<L::Lot>, L::Error> {
        let begun = self.looks.len().wrapping_sub(1);
        let (Some(&stage), Some(owners)) = (self.stages.get(begun), self.owners.get(begun)) else {
            return Ok(Vec::new());
        };
        let all = self.lots.lots(stage)?.into_iter().zip(owners);
        Ok(all.filter(|&(_, &owner)| owner == self.number).map(|(lot, _)| lot).collect())
    }
}

#[cfg(test)]
mod tests {
    use std::convert::Infallible;

    use super::*;

    /// Stages of so many numbers each; one of the numbers is enough, and one cannot be looked at to its end.
    struct Numbers {
        stages: Vec<u64>,
        enough: Option<(u64, u64)>,
        endless: Option<(u64, u64)>,
    }

    struct Glance {
        steps: u64,
        is_whole: bool,
        is_enough: bool,
    }

    impl Look for Glance {
        fn steps(&self) -> u64 {
            self.steps
        }

        fn is_whole(&self) -> bool {
            self.is_whole
        }

        fn is_enough(&self) -> bool {
            self.is_enough
        }
    }

    impl Lots for Numbers {
        type Stage = (u64, u64);
        type Lot = (u64, u64);
        type Look = Glance;
        /// The lots in the order in which they were added, and the stages that were covered.
        type Findings = (Vec<(u64, u64)>, Vec<u64>);
        type Error = Infallible;

        fn stages(&self) -> Vec<(u64, u64)> {
            (0..).zip(self.stages.iter().copied()).collect()
        }

        fn lots(&self, (stage, count): (u64, u64)) -> Result<Vec<(u64, u64)>, Infallible> {
            Ok((0..count).map(|lot| (stage, lot)).collect())
        }

        fn weight(&self, _: (u64, u64), lot: &(u64, u64)) -> u64 {
            1 + lot.1 % 7
        }

        fn look(&self, _: (u64, u64), lot: &(u64, u64), _: u64) -> Result<Glance, Infallible> {
            let is = |one: Option<(u64, u64)>| one == Some(*lot);
            Ok(Glance { steps: lot.1 % 7, is_whole: !is(self.endless), is_enough: is(self.enough) })
        }

        fn add(&self, found: &mut Self::Findings, lot: &(u64, u64), _: Glance) -> Result<(), Infallible> {
            found.0.push(*lot);
            Ok(())
        }

        fn cover(&self, found: &mut Self::Findings, (stage, _): (u64, u64)) {
            found.1.push(stage);
        }
    }

    const STAGES: [u64; 5] = [1, 300, 0, 17, 400];

    fn whole(lots: &Numbers) -> (<Numbers as Lots>::Findings, bool) {
        let Ok(found) = search(lots, None, &mut |_| ControlFlow::Continue(()));
        found
    }

    /// Each shard is left after every wave and taken up again.
    fn in_shards(new: impl Fn() -> Numbers, of: usize) -> (<Numbers as Lots>::Findings, bool) {
        let all = (0..of).map(|number| {
            let mut looks = Vec::new();
            loop {
                let Ok(mut shard) = Shard::new(new(), (number, of), looks, Some(1));
                while shard.wave() == Ok(true) {}
                if shard.is_done() {
                    return shard.looks;
                }
                looks = shard.looks;
            }
        });
        let Ok(found) = merged(&new(), all.collect());
        found
    }

    #[test]
    fn shards_find_what_one_process_finds() {
        let cases = [
            (None, None),
            (Some((1, 70)), None),
            (Some((3, 16)), None),
            (None, Some((1, 3))),
            (None, Some((4, 399))),
            (Some((3, 2)), Some((4, 5))),
        ];
        for (enough, endless) in cases {
            let new = || Numbers { stages: STAGES.to_vec(), enough, endless };
            let once = whole(&new());
            for of in [1, 2, 3, 7, 64, 1000] {
                assert_eq!(in_shards(new, of), once, "{enough:?}, {endless:?}, {of} shards");
            }
        }
    }

    #[test]
    fn every_lot_is_dealt_out_once_and_no_shard_has_much_more_than_another() {
        let lots = Numbers { stages: STAGES.to_vec(), enough: None, endless: None };
        for of in [1, 2, 5, 64] {
            let Ok(left) = dealt(&lots, of);
            assert_eq!(left.iter().sum::<u64>(), STAGES.iter().sum::<u64>());
            let mut loads = vec![0; of];
            let Ok(owners) = deal(&lots, of);
            for (stage, owners) in lots.stages().into_iter().zip(owners) {
                let Ok(all) = lots.lots(stage);
                all.iter().zip(owners).for_each(|(lot, owner)| loads[owner] += lots.weight(stage, lot));
            }
            let (most, least) = (loads.iter().max(), loads.iter().min());
            assert!(most.zip(least).is_some_and(|(most, least)| most - least <= 7), "{loads:?}");
        }
    }

    #[test]
    fn a_look_that_no_shard_has_leaves_the_search_without_an_end() {
        let lots = Numbers { stages: vec![10], enough: None, endless: None };
        let Ok(((seen, covered), is_whole)) = merged(&lots, vec![Vec::new(), Vec::new()]);
        assert_eq!((seen.len(), covered.len(), is_whole), (0, 0, false));
    }
}
