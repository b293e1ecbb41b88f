//! The setting of a search: how many robots and WFRs, how far apart, and what may go wrong between them.

use tautline_kernel::mrc::Rule;

use crate::mrc::{Misreading, RobotReading};

/// Most robots of a setting.
pub const ROBOTS: usize = 3;
/// Most WFRs of a setting.
pub const WFRS: usize = 3;

/// How much may still go wrong in a run.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub struct Faults {
    /// Faults of all kinds together.
    pub in_all: u8,
    /// Messages that are lost.
    pub losses: u8,
    /// Messages that arrive once more.
    pub duplicates: u8,
    /// Timers that go off while what they wait for is on its way: a delay beyond what the timers allow for.
    pub delays: u8,
    /// Robots that fail.
    pub robots: u8,
    /// Path nodes that fail, each on the way between a robot and a WFR: until the next call, which makes a new tree, no
    /// message gets through between the two, and the robot does not find its way.
    pub nodes: u8,
}

impl Faults {
    /// At most `in_all` faults, of whichever kinds.
    pub const fn any(in_all: u8) -> Self {
        Self { in_all, losses: in_all, duplicates: in_all, delays: in_all, robots: in_all, nodes: in_all }
    }

    /// The faults that it allows, in words.
    fn bound(self) -> String {
        let Self { in_all, losses, duplicates, delays, robots, nodes } = self;
        let kinds = [
            (losses, "losses"),
            (duplicates, "duplicates"),
            (delays, "delays"),
            (robots, "failed robots"),
            (nodes, "failed nodes"),
        ];
        let fewer = kinds.into_iter().filter(|&(most, _)| most < in_all);
        let fewer: Vec<String> = fewer.map(|(most, kind)| format!("at most {most} {kind}")).collect();
        let of_them = if fewer.is_empty() { String::new() } else { format!(" ({})", fewer.join(", ")) };
        format!("at most {in_all} fault{}{of_them}", if in_all == 1 { "" } else { "s" })
    }

    /// The number left of one kind.
    pub(super) fn left(self, kind: impl Fn(&Self) -> u8) -> u8 {
        kind(&self).min(self.in_all)
    }

    /// One fault less.
    pub(super) fn spend(&mut self, kind: impl Fn(&mut Self) -> &mut u8) {
        *kind(self) -= 1;
        self.in_all -= 1;
    }
}

/// Which messages can be lost.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum LossKind {
    /// Any.
    All,
    /// Those that tell of a choice.
    Resb,
}

/// How long a robot holds a lease if it does not come.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Leases {
    /// Until it hears the WFR's next call.
    UntilCalled,
    /// Or until the WFR no longer counts on it under that call: longer than the WFR.
    UntilOver,
    /// Or for any time: it may let go earlier than the WFR.
    Any,
}

/// The setting of a search.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Setting {
    /// The rule of robots and WFRs.
    pub rule: Rule,
    /// How they misread what they hear.
    pub misread: Option<Misreading>,
    /// How robots read the paper.
    pub reading: RobotReading,
    /// Robots, at most [`ROBOTS`].
    pub robots: usize,
    /// WFRs, at most [`WFRS`].
    pub wfrs: usize,
    /// Events, each at one of the WFRs; the next at the same WFR when a robot has come.
    pub events: u8,
    /// Hops from each robot to each WFR: all combinations of 1 to this.
    pub max_hops: u16,
    /// The faults that may happen.
    pub faults: Faults,
    /// Which messages may be lost.
    pub lossy: LossKind,
    /// How long robots hold leases.
    pub leases: Leases,
}

impl Setting {
    /// The bound, in words.
    pub fn bound(&self) -> String {
        let Self { robots, wfrs, events, max_hops, faults, lossy, leases, .. } = *self;
        let count =
            |number: usize, one: &str| format!("{number} {one}{}", if number == 1 { "" } else { "s" });
        let hops = match max_hops {
            1 => "all one hop away".to_owned(),
            2 => "1 or 2 hops".to_owned(),
            most => format!("1 to {most} hops"),
        };
        let mut words = vec![
            count(robots, "robot"),
            count(wfrs, "WFR"),
            count(events.into(), "event"),
            faults.bound(),
            hops,
        ];
        match lossy {
            LossKind::All => {}
            LossKind::Resb => words.push("of messages only RESBs lost".to_owned()),
        }
        match leases {
            Leases::UntilCalled => {}
            Leases::UntilOver => words.push("leases end no earlier than the WFR's".to_owned()),
            Leases::Any => words.push("leases end at any time".to_owned()),
        }
        words.join(", ")
    }
}
