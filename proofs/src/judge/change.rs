//! Every single change of plain data: a number that is one more or less, a name that is another one, an entry of a
//! list that is left out, stands twice, or is exchanged with the next one, a wall or an obstacle more or less. A
//! judge is attacked with them: a counterexample that is changed is no counterexample, or another one by right.

use std::collections::BTreeSet;
use std::fmt::{Debug, Display};

/// Data of which each part can be changed by itself.
pub trait Plain {
    /// Makes the change that `change` looks for, if it is one of these parts.
    fn change(&mut self, change: &mut Change);
}

/// A change that is looked for by its number.
#[derive(Debug)]
pub struct Change {
    /// Changes before it.
    before: usize,
    /// Where the part stands.
    place: Vec<String>,
    made: Option<String>,
}

/// All that differ from `whole` by a single change, and what that is.
pub fn all<T: Plain + Clone + PartialEq>(whole: &T) -> Vec<(String, T)> {
    let mut all = Vec::new();
    for before in 0.. {
        let mut changed = whole.clone();
        let mut change = Change { before, place: Vec::new(), made: None };
        changed.change(&mut change);
        let Some(made) = change.made else { break };
        if changed != *whole {
            all.push((made, changed));
        }
    }
    all
}

impl Change {
    /// Which of so many changes it is, if it is one of these; `what` says what each is.
    pub fn pick(&mut self, of: usize, what: impl Fn(usize) -> String) -> Option<usize> {
        if self.made.is_some() {
            return None;
        }
        let number = self.before;
        if number >= of {
            self.before -= of;
            return None;
        }
        self.made = Some(format!("{}: {}", self.place.join(" "), what(number)));
        Some(number)
    }

    /// Goes on with a part that is called so.
    pub fn within(&mut self, name: impl Display, part: &mut impl Plain) {
        self.place.push(name.to_string());
        part.change(self);
        self.place.pop();
    }

    /// One of `all` more or less.
    pub fn toggles<T: Ord + Copy + Debug>(&mut self, name: &str, set: &mut BTreeSet<T>, all: &[T]) {
        let toggled = self.pick(all.len(), |number| format!("{name} at {:?}, or not", all[number]));
        if let Some(toggled) = toggled.map(|number| all[number])
            && !set.remove(&toggled)
        {
            set.insert(toggled);
        }
    }

    /// Another one of `all`.
    pub fn another<T: PartialEq + Copy + Debug>(&mut self, one: &mut T, all: &[T]) {
        let others: Vec<T> = all.iter().copied().filter(|other| other != one).collect();
        if let Some(number) = self.pick(others.len(), |number| format!("{:?}", others[number])) {
            *one = others[number];
        }
    }
}

impl Plain for i32 {
    fn change(&mut self, change: &mut Change) {
        let others = [self.saturating_add(1), self.saturating_sub(1)];
        change.another(self, &others);
    }
}

impl Plain for usize {
    fn change(&mut self, change: &mut Change) {
        let others = [self.saturating_add(1), self.saturating_sub(1)];
        change.another(self, &others);
    }
}

impl Plain for bool {
    fn change(&mut self, change: &mut Change) {
        change.another(self, &[true, false]);
    }
}

impl<A: Plain, B: Plain> Plain for (A, B) {
    fn change(&mut self, change: &mut Change) {
        change.within("first", &mut self.0);
        change.within("second", &mut self.1);
    }
}

impl<T: Plain, const COUNT: usize> Plain for [T; COUNT] {
    fn change(&mut self, change: &mut Change) {
        for (number, part) in (1..).zip(self) {
            change.within(number, part);
        }
    }
}

impl<T: Plain + Default> Plain for Option<T> {
    fn change(&mut self, change: &mut Change) {
        if change.pick(1, |_| "there or not".to_owned()).is_some() {
            *self = if self.is_some() { None } else { Some(T::default()) };
        } else if let Some(part) = self {
            part.change(change);
        }
    }
}

impl<T: Plain + Clone> Plain for Vec<T> {
    fn change(&mut self, change: &mut Change) {
        let ways = ["left out", "twice", "exchanged with the next"];
        let what = |number: usize| format!("{} {}", number / ways.len() + 1, ways[number % ways.len()]);
        if let Some(number) = change.pick(ways.len() * self.len(), what) {
            let place = number / ways.len();
            match number % ways.len() {
                0 => drop(self.remove(place)),
                1 => self.insert(place, self[place].clone()),
                _ if place + 1 < self.len() => self.swap(place, place + 1),
                _ => {}
            }
            return;
        }
        for (number, part) in (1..).zip(self) {
            change.within(number, part);
        }
    }
}

/// Makes [`Plain`] of a struct by its parts, or of an enum of names by all of them.
#[cfg(feature = "rooms")]
macro_rules! plain {
    ($type:ty { $($part:ident),+ $(,)? }) => {
        impl $crate::judge::change::Plain for $type {
            fn change(&mut self, change: &mut $crate::judge::change::Change) {
                $(change.within(stringify!($part), &mut self.$part);)+
            }
        }
    };
    ($type:ident one of $($name:ident),+ $(,)?) => {
        impl $crate::judge::change::Plain for $type {
            fn change(&mut self, change: &mut $crate::judge::change::Change) {
                change.another(self, &[$(Self::$name),+]);
            }
        }
    };
}
#[cfg(feature = "rooms")]
pub(super) use plain;

#[cfg(all(test, feature = "rooms"))]
mod tests {
    use super::*;

    #[derive(Clone, Copy, PartialEq, Debug)]
    enum Name {
        One,
        Other,
    }

    #[derive(Clone, PartialEq, Debug)]
    struct Whole {
        name: Name,
        list: Vec<i32>,
        place: Option<usize>,
    }

    plain!(Name one of One, Other);
    plain!(Whole { name, list, place });

    #[test]
    fn each_part_is_changed_by_itself_and_nothing_comes_out_as_it_was() {
        let whole = Whole { name: Name::One, list: vec![5, 7], place: Some(0) };
        let (what, changed): (Vec<String>, Vec<Whole>) = all(&whole).into_iter().unzip();
        assert_eq!(
            what,
            [
                "name: Other",
                "list: 1 left out",
                "list: 1 twice",
                "list: 1 exchanged with the next",
                "list: 2 left out",
                "list: 2 twice",
                "list 1: 6",
                "list 1: 4",
                "list 2: 8",
                "list 2: 6",
                "place: there or not",
                "place: 1",
            ]
        );
        assert_eq!(changed[2].list, [5, 5, 7]);
        assert_eq!(changed[3].list, [7, 5]);
        assert_eq!((changed[10].place, changed[11].place), (None, Some(1)));
    }
}
