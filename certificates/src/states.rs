//! The checker of a section that lists states. It makes all steps from each state, and holds each against where the
//! section says that it leads; steps lead to the same state if they agree on its digest, of 128 bits. It looks at
//! subtrees by themselves, on as many threads as there are.

use std::hash::Hasher;
use std::sync::OnceLock;
use std::sync::atomic::Ordering::Relaxed;
use std::sync::atomic::{AtomicU16, AtomicU64};

use rayon::slice::ParallelSliceMut;
use siphasher::sip128::SipHasher13;

use crate::file::take;
use crate::model::{Answers, Model, Step};
use crate::verdict::{Counts, Refusal};

/// Checks that a section lists all states of `model`, and that they break nothing. `key` is the digest of the file: who
/// makes a file does not choose by which digests its states are told apart.
///
/// # Errors
/// [`Refusal`], which does not depend on the number of threads.
pub fn check_states<M: Model>(model: &M, section: &[u8], key: u128) -> Result<Counts, Refusal> {
    let run = |share| Checker::new(model, section, key)?.run(share);
    // One thread finds always the same fault first.
    run(SHARE).or_else(|refusal| run(u32::MAX).and(Err(refusal)))
}

/// The states of a subtree that another thread may look at.
const SHARE: u32 = 1 << 10;

/// A section, read.
#[derive(Default)]
struct Trees {
    /// The obligations for which there are ranks.
    owed: u16,
    /// Of each start 0, or the number of its state and 1.
    starts: Vec<u64>,
    /// Of each state the byte at which it stands.
    at: Vec<usize>,
    /// Of each state the number of states in its subtree.
    size: Vec<u32>,
    /// Of each obligation the rank of each state.
    ranks: Vec<Vec<u32>>,
}

impl Trees {
    fn read(section: &[u8]) -> Result<Self, Refusal> {
        let mut rest = section;
        let mut trees = Self::default();
        let read = trees.take(&mut rest, section.len());
        read.map(|()| trees).ok_or(Refusal::Malformed(section.len() - rest.len()))
    }

    fn take(&mut self, rest: &mut &[u8], length: usize) -> Option<()> {
        self.owed = take(rest)?.try_into().ok()?;
        self.ranks = vec![Vec::new(); self.owed.count_ones() as usize];
        for _ in 0..take(rest)? {
            self.starts.push(take(rest)?);
        }
        let mut roots = self.starts.iter().filter(|&&link| link == 0).count();
        // The states whose subtrees are not at their ends, with how many subtrees of theirs are to come.
        let mut open: Vec<(u32, usize)> = Vec::new();
        while !rest.is_empty() {
            if open.is_empty() {
                roots = roots.checked_sub(1)?;
            }
            let mut children = 0;
            let state = u32::try_from(self.at.len()).ok()?;
            self.at.push(length - rest.len());
            for _ in 0..take(rest)? {
                children += usize::from(take(rest)? == 0);
            }
            for ranks in &mut self.ranks {
                ranks.push(take(rest)?.try_into().ok()?);
            }
            self.size.push(1);
            open.push((state, children));
            while let Some((state, _)) = open.pop_if(|(_, left)| *left == 0) {
                self.size[state as usize] = self.at.len() as u32 - state;
                if let Some((_, left)) = open.last_mut() {
                    *left -= 1;
                }
            }
        }
        let is_ranked = |ranks: &Vec<u32>| ranks.iter().all(|&rank| (rank as usize) < self.at.len());
        (roots == 0 && open.is_empty() && !self.at.is_empty() && self.ranks.iter().all(is_ranked))
            .then_some(())
    }
}

/// The digest of a state: those of its parts, put together so that one can be taken out again.
type Digest = u128;

/// The digest of a state, in halves that are 0 until it is known.
#[derive(Default)]
struct DigestCell([AtomicU64; 2]);

impl DigestCell {
    /// Whether this is the digest, or none was known.
    fn is(&self, digest: Digest) -> bool {
        let is_half = |(half, new): (&AtomicU64, u64)| {
            let new = new.max(1);
            let known = half.load(Relaxed);
            let put = || half.compare_exchange(0, new, Relaxed, Relaxed);
            known == new || known == 0 && put().map_or_else(|other| other == new, |_| true)
        };
        self.0.iter().zip([digest as u64, (digest >> 64) as u64]).all(is_half)
    }
}

/// The states of a rank between which steps are bound to be made.
struct Class {
    /// Who acts in these steps.
    acting: AtomicU16,
    /// Who is awake in all states from which they are made; everybody, if there is none.
    awake: AtomicU16,
}

impl Class {
    /// Whether everybody acts who is awake throughout.
    fn is_fair(&self) -> bool {
        self.awake.load(Relaxed) & !self.acting.load(Relaxed) == 0
    }
}

struct Checker<'a, M> {
    model: &'a M,
    section: &'a [u8],
    trees: Trees,
    hasher: SipHasher13,
    known: Vec<DigestCell>,
    /// Of each obligation the classes by their ranks.
    classes: Vec<Vec<Class>>,
    steps: AtomicU64,
    ends: AtomicU64,
    refusal: OnceLock<Refusal>,
}

/// The bytes by which a part is told.
#[derive(Default)]
struct PartBytes(Vec<u8>);

impl Hasher for PartBytes {
    #[inline]
    fn write(&mut self, bytes: &[u8]) {
        self.0.extend_from_slice(bytes);
    }

    fn finish(&self) -> u64 {
        0
    }
}

/// A state with its place in the section, and its digest.
struct Entry<S> {
    place: u32,
    state: S,
    digest: Digest,
}

/// The memory of one thread, kept from state to state.
struct Scratch<S> {
    told: PartBytes,
    /// The digests of the parts of the state that it looks at, as far as they were asked for.
    parts: Vec<Option<Digest>>,
    /// The states to which steps from it lead in the tree.
    children: Vec<Entry<S>>,
}

impl<S> Scratch<S> {
    fn new() -> Self {
        Self { told: PartBytes::default(), parts: Vec::new(), children: Vec::new() }
    }
}

impl<'a, M: Model> Checker<'a, M> {
    fn new(model: &'a M, section: &'a [u8], key: u128) -> Result<Self, Refusal> {
        let trees = Trees::read(section)?;
        let class = |_: &u32| Class { acting: AtomicU16::new(0), awake: AtomicU16::new(u16::MAX) };
        Ok(Self {
            model,
            section,
            known: trees.at.iter().map(|_| DigestCell::default()).collect(),
            classes: trees.ranks.iter().map(|ranks| ranks.iter().map(class).collect()).collect(),
            trees,
            hasher: SipHasher13::new_with_keys(key as u64, (key >> 64) as u64),
            steps: AtomicU64::new(0),
            ends: AtomicU64::new(0),
            refusal: OnceLock::new(),
        })
    }

    fn run(self, share: u32) -> Result<Counts, Refusal> {
        let starts = self.starts()?;
        rayon::scope(|scope| self.walk(scope, share, starts));
        let twice = || self.double().map(Refusal::Twice);
        self.refusal.get().cloned().or_else(twice).map_or(Ok(()), Err)?;
        for (bit, classes) in bits(self.trees.owed).zip(&self.classes) {
            if let Some(rank) = classes.iter().position(Class::is_fair) {
                return Err(Refusal::Endless(rank as u32, bit));
            }
        }
        let states = self.trees.at.len() as u64;
        Ok(Counts { states, steps: self.steps.into_inner(), ends: self.ends.into_inner() })
    }

    /// A state that stands somewhere before, too.
    fn double(&self) -> Option<u32> {
        let digest = |&place: &u32| self.known[place as usize].0.each_ref().map(|half| half.load(Relaxed));
        let mut places: Vec<u32> = (0..self.known.len() as u32).collect();
        places.par_sort_unstable_by_key(|place| (digest(place), *place));
        places.windows(2).rfind(|pair| digest(&pair[0]) == digest(&pair[1])).map(|pair| pair[1])
    }

    /// The starts that are roots.
    fn starts(&self) -> Result<Vec<Entry<M::State>>, Refusal> {
        let starts = self.model.starts();
        if starts.is_empty() || starts.len() != self.trees.starts.len() {
            return Err(Refusal::Starts(starts.len()));
        }
        let (mut roots, mut next, mut told) = (Vec::new(), 0, PartBytes::default());
        for (number, (state, &link)) in starts.into_iter().zip(&self.trees.starts).enumerate() {
            let parts = 0..self.model.parts(&state);
            let digest = parts.fold(0, |all, part| all ^ self.part(&state, part, &mut told));
            let place = if link == 0 { Some(next) } else { u32::try_from(link - 1).ok() };
            if !place.is_some_and(|place| self.is(place, digest)) {
                return Err(Refusal::Start(number));
            }
            if link == 0 {
                roots.push(Entry { place: next, state, digest });
                next += self.trees.size[next as usize];
            }
        }
        Ok(roots)
    }

    /// The digest of a part of `state`.
    fn part(&self, state: &M::State, part: usize, told: &mut PartBytes) -> Digest {
        told.0.clear();
        told.write_usize(part);
        self.model.tell(state, part, told);
        self.hasher.hash(&told.0).as_u128()
    }

    /// The digest of a state to which a step leads from the one that a thread looks at.
    fn digest(&self, from: &Entry<M::State>, to: &M::State, scratch: &mut Scratch<M::State>) -> Digest {
        let differing = self.model.differing(&from.state, to);
        let differs = |&part: &usize| part >= 64 || differing >> part & 1 == 1;
        (0..scratch.parts.len()).filter(differs).fold(from.digest, |all, part| {
            let before =
                scratch.parts[part].unwrap_or_else(|| self.part(&from.state, part, &mut scratch.told));
            scratch.parts[part] = Some(before);
            all ^ before ^ self.part(to, part, &mut scratch.told)
        })
    }

    /// Whether the state with this digest is the one that stands in this place, as far as that is known.
    fn is(&self, place: u32, digest: Digest) -> bool {
        self.known.get(place as usize).is_some_and(|known| known.is(digest))
    }

    /// Looks at all states of the subtrees of these ones.
    fn walk<'s>(&'s self, scope: &rayon::Scope<'s>, share: u32, mut ahead: Vec<Entry<M::State>>) {
        let mut scratch = Scratch::new();
        while let Some(placed) = ahead.pop() {
            if let Err(refusal) = self.look(&placed, &mut scratch) {
                // Of several threads the first one tells.
                let _ = self.refusal.set(refusal);
            }
            if self.refusal.get().is_some() {
                return;
            }
            for child in scratch.children.drain(..) {
                if self.trees.size[child.place as usize] >= share {
                    scope.spawn(move |scope| self.walk(scope, share, vec![child]));
                } else {
                    ahead.push(child);
                }
            }
        }
    }

    /// Makes all steps from a state: those that lead on in the tree lead to its children.
    fn look(&self, from: &Entry<M::State>, scratch: &mut Scratch<M::State>) -> Result<(), Refusal> {
        let &Entry { place, ref state, .. } = from;
        let mut record = &self.section[self.trees.at[place as usize]..];
        let mut next = || take(&mut record).unwrap_or(0);
        let (said, owed) = (next(), self.model.owed(state));
        if owed & !self.trees.owed != 0 {
            return Err(Refusal::Owes(place));
        }
        scratch.parts.clear();
        scratch.parts.resize(self.model.parts(state), None);
        let (mut child, mut step, mut is_still) = (place + 1, 0, true);
        let mut planned = state.clone();
        if let Some(plan) = self.model.plan(&mut planned) {
            let mut answers = Answers::with_mishaps(u32::MAX);
            loop {
                let Step { to, acting, breaks } = self.model.step(state, &planned, &plan, &mut answers);
                if step as u64 == said {
                    return Err(Refusal::Steps(place, step + 1));
                }
                if let Some(demand) = breaks {
                    return Err(Refusal::Breaks(place, step, demand));
                }
                let (link, digest) = (next(), self.digest(from, &to, scratch));
                let target = if link == 0 { Some(child) } else { linked(place, link) };
                let target = target.filter(|&target| self.is(target, digest));
                let target = target.ok_or(Refusal::Leads(place, step))?;
                if let Some(acting) = acting {
                    is_still = false;
                    self.rank((place, state, owed), (target, &to), acting)
                        .ok_or(Refusal::Rises(place, step))?;
                }
                if link == 0 {
                    scratch.children.push(Entry { place: child, state: to, digest });
                    child += self.trees.size[child as usize];
                }
                step += 1;
                if answers.advance().is_none() {
                    break;
                }
            }
        }
        if step as u64 != said {
            return Err(Refusal::Steps(place, step));
        }
        self.steps.fetch_add(said, Relaxed);
        self.ends.fetch_add(is_still.into(), Relaxed);
        let broken = if is_still { self.model.broken_at_end(state) } else { None };
        broken.map_or(Ok(()), |demand| Err(Refusal::Ends(place, demand)))
    }

    /// Notes a step that is bound to be made in its class, if it stays in one; `None` if its rank rises.
    fn rank(
        &self,
        (place, state, owed): (u32, &M::State, u16),
        (to, after): (u32, &M::State),
        acting: u16,
    ) -> Option<()> {
        let both = if owed == 0 { 0 } else { owed & self.model.owed(after) };
        for ((bit, ranks), classes) in bits(self.trees.owed).zip(&self.trees.ranks).zip(&self.classes) {
            let [from, to] = [place, to].map(|state| ranks[state as usize]);
            if both >> bit & 1 == 0 || to < from {
                continue;
            }
            if to > from {
                return None;
            }
            let class = &classes[from as usize];
            class.acting.fetch_or(acting, Relaxed);
            class.awake.fetch_and(self.model.awake(state), Relaxed);
        }
        Some(())
    }
}

/// The numbers of these bits.
fn bits(set: u16) -> impl Iterator<Item = u32> {
    (0..u16::BITS).filter(move |bit| set >> bit & 1 == 1)
}

/// The state to which a link from this one leads that is not 0: how far behind or before it, in turns.
fn linked(place: u32, link: u64) -> Option<u32> {
    let way = i64::try_from(link - 1).ok()?;
    let way = way >> 1 ^ -(way & 1);
    i64::from(place).checked_add(way)?.try_into().ok()
}
