//! Certificates of local rules: what a rule answers as tables, and the set of places that the engine found, as a file
//! that Rocq checks. `proofs/rocq/Certificate.v` says what the tables mean, and proves that a rule whose certificate is
//! accepted keeps its promise for every number of robots and every layout.

use std::fmt::Write;

use tautline_kernel::ground::Cell;

use super::invariant::{Invariant, Tuple, is_within, offsets, promised};
use super::numbers::{ByNumber, NumberedRule};
use super::rule::{Act, Far, Local, Robot};
use crate::decide::MethodError;

/// A set of offsets for each sequence of kinds of robots.
enum Tree {
    /// Every place.
    All,
    /// A bit for each place, the first one in the lowest.
    Leaf(Vec<bool>),
    Node(Vec<Self>),
}

impl Tree {
    /// The tree of so many robots, `leaf` asked of the kinds of each sequence.
    fn of(
        kinds: usize,
        robots: usize,
        path: &mut Vec<usize>,
        leaf: &mut dyn FnMut(&[usize]) -> Self,
    ) -> Self {
        if path.len() == robots {
            return leaf(path);
        }
        let mut branches = Vec::new();
        for kind in 0..kinds {
            path.push(kind);
            branches.push(Self::of(kinds, robots, path, leaf));
            path.pop();
        }
        while branches.last().is_some_and(Self::is_empty) {
            branches.pop();
        }
        if branches.is_empty() { Self::Leaf(Vec::new()) } else { Self::Node(branches) }
    }

    /// Whether it has no place.
    fn is_empty(&self) -> bool {
        matches!(self, Self::Leaf(bits) if !bits.contains(&true))
    }

    fn write(&self, text: &mut String) {
        match self {
            Self::All => text.push_str("All"),
            Self::Leaf(bits) => {
                let digit = |four: &[bool]| {
                    let number = four.iter().rev().fold(0, |number, &bit| 2 * number + u32::from(bit));
                    char::from_digit(number, 16)
                };
                let digits: String = bits.chunks(4).rev().filter_map(digit).collect();
                let digits = digits.trim_start_matches('0');
                let digits = if digits.is_empty() { "0" } else { digits };
                // Writing to a string cannot fail.
                let _ = write!(text, "Leaf 0x{digits}%N");
            }
            Self::Node(branches) => {
                text.push_str("Node [");
                for (place, branch) in branches.iter().enumerate() {
                    text.push_str(if place == 0 { "" } else { ";\n " });
                    branch.write(text);
                }
                text.push(']');
            }
        }
    }
}

/// A rule in tables.
struct Tables<'r> {
    rule: &'r dyn NumberedRule,
    states: Vec<u32>,
    acts: Vec<Vec<Act<u32, u32>>>,
}

impl Tables<'_> {
    /// The table of a set of tuples of robots that are at most so far from the first one.
    fn of_robots(&self, window: i16, mut has: impl FnMut(&Tuple) -> bool) -> Tree {
        let colours = usize::from(self.rule.colours());
        let robot =
            |kind: usize, at| Robot { at, state: self.states[kind / colours], on: (kind % colours) as u8 };
        let mut leaf = |kinds: &[usize]| {
            let places = offsets(window, self.rule.robots() - 1);
            let tuple =
                |cells: &Vec<_>| kinds.iter().zip(cells).map(|(&kind, &at)| robot(kind, at)).collect();
            Tree::Leaf(places.iter().map(|cells| has(&tuple(cells))).collect())
        };
        Tree::of(self.states.len() * colours, self.rule.robots(), &mut Vec::new(), &mut leaf)
    }

    /// The table of plans. Where no robots are that are as far as `kept` from each other, everything is admitted.
    fn of_plans(&self, window: i16, kept: &[Tuple]) -> Tree {
        let colours = usize::from(self.rule.colours());
        let most = self.acts.iter().map(Vec::len).max().unwrap_or(0);
        let places = offsets(window, self.rule.robots() - 1);
        let mut leaf = |kinds: &[usize]| {
            let of_state = |&kind: &usize| kind / colours / colours / most;
            let acts: Option<Vec<&Act<u32, u32>>> = kinds
                .iter()
                .map(|kind| self.acts[of_state(kind)].get(kind / colours / colours % most))
                .collect();
            let Some(acts) = acts else { return Tree::Leaf(Vec::new()) };
            let states: Vec<u32> = kinds.iter().map(|kind| self.states[of_state(kind)]).collect();
            let is_met = |tuple: &Tuple| tuple.iter().map(|robot| robot.state).eq(states.iter().copied());
            if self.rule.reach().1 == Far::Broken && !kept.iter().any(is_met) {
                return Tree::All;
            }
            let admits = |cells: &Vec<_>| {
                let plans =
                    kinds.iter().zip(&acts).zip(&states).zip(cells).map(|(((kind, act), &state), &at)| {
                        let robot = Robot { at, state, on: (kind / colours % colours) as u8 };
                        robot.plans(act, (kind % colours) as u8)
                    });
                self.rule.admits(&plans.collect::<Vec<_>>())
            };
            Tree::Leaf(places.iter().map(admits).collect())
        };
        let kinds = self.states.len() * most * colours * colours;
        Tree::of(kinds, self.rule.robots(), &mut Vec::new(), &mut leaf)
    }

    /// The acts of each state: where each leads, and what may come of it.
    fn moves(&self) -> Result<String, MethodError> {
        let number = |state: &u32| {
            let place = self.states.iter().position(|known| known == state);
            place.ok_or_else(|| {
                MethodError::new(format_args!(
                    "{} is none of the states of the rule",
                    self.rule.state_words(*state)
                ))
            })
        };
        let of_act = |act: &Act<u32, u32>| {
            let Cell { x, y } = Cell::new(0, 0).after(act.step);
            let end = |(goes, state): &(bool, u32)| Ok(format!("({goes}, {}%nat)", number(state)?));
            let ends: Result<Vec<String>, MethodError> = act.ends.iter().map(end).collect();
            Ok(format!("(({x}, {y}), [{}])", ends?.join("; ")))
        };
        let of_state = |acts: &Vec<Act<u32, u32>>| {
            let acts: Result<Vec<String>, MethodError> = acts.iter().map(of_act).collect();
            Ok(format!("[{}]", acts?.join(";\n  ")))
        };
        let states: Result<Vec<String>, MethodError> = self.acts.iter().map(of_state).collect();
        Ok(format!("[{}]", states?.join(";\n ")))
    }
}

/// The most entries of the table of plans.
const MOST_ENTRIES: usize = 2_000_000;

impl Invariant {
    /// A file that Rocq checks, with the theorem that this set shows that `rule` keeps its promise.
    ///
    /// # Errors
    /// [`MethodError`] if the file would be too large, or if an act of the rule ends in none of its states.
    pub fn certificate<R: Local>(&self, rule: &R) -> Result<String, MethodError> {
        terms(&ByNumber::new(rule), self)
    }
}

/// The rule, the invariant, and the theorem that it is one, in Rocq's words.
pub(super) fn terms(rule: &dyn NumberedRule, invariant: &Invariant) -> Result<String, MethodError> {
    let states = rule.states();
    let acts: Vec<_> = states.iter().map(|&state| rule.acts(state)).collect();
    let tables = Tables { rule, states, acts };
    let (reach, far) = rule.reach();
    let width = if far == Far::Fine { invariant.window + 2 } else { invariant.window };
    let colours = usize::from(rule.colours()).pow(2);
    let plans = tables.acts.iter().map(Vec::len).sum::<usize>() * colours;
    let sides = (2 * width as usize + 1).pow(2);
    let entries =
        plans.pow(rule.robots() as u32).saturating_mul(sides.saturating_pow(rule.robots() as u32 - 1));
    if entries > MOST_ENTRIES {
        let why = format!("a certificate would have {entries} entries, more than {MOST_ENTRIES}");
        return Err(MethodError::new(why));
    }
    let mut text = format!(
        "From Coq Require Import ZArith NArith List.\nFrom Tautline Require Import Certificate.\n\
         Import ListNotations.\nLocal Open Scope Z_scope.\n\n\
         Definition rule_ : rule := {{|\n robots := {}; colours := {}; reach := {reach}; far \
         := {}; width := {width};\n moves :=\n {}",
        rule.robots(),
        rule.colours(),
        far == Far::Fine,
        tables.moves()?
    );
    let mut put = |name: &str, tree: &Tree| {
        // Writing to a string cannot fail.
        let _ = write!(text, ";\n {name} :=\n ");
        tree.write(&mut text);
    };
    put("admitted", &tables.of_plans(width, &invariant.kept));
    put("promised", &tables.of_robots(reach, |tuple| promised(rule, tuple)));
    put(
        "started",
        &tables.of_robots(width, |tuple| {
            let is_near = is_within(tuple, invariant.window);
            if is_near { rule.may_start(tuple) } else { far == Far::Fine }
        }),
    );
    text += " |}.\n\nDefinition certificate_ : certificate := {| window := ";
    let _ = write!(text, "{}; kept :=\n ", invariant.window);
    let is_kept = |tuple: &Tuple| invariant.kept.binary_search(tuple).is_ok();
    tables.of_robots(invariant.window, is_kept).write(&mut text);
    // Computed once, at `Qed`: the tactic `vm_compute` would do so before.
    text += " |}.\n\nTheorem accepted : accepts rule_ certificate_ = true.\nProof. \
             vm_cast_no_check (eq_refl true). Qed.\n\n\
             Theorem holds_ : holds rule_.\nProof. exact (sound rule_ certificate_ accepted). Qed.\n";
    Ok(text)
}
