//! A rule of the kernel whose conditions can be switched one by one.

use std::fmt;

use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::conditions::Conditional;

use super::scheme::{Hunt, Setup, Switches};
use super::team::Team;

/// The row of a rule of the kernel that is hunted through all states: where it stands, `start` makes its team and
/// `KernelHunt` hunts it.
macro_rules! searched {
    ($name:expr, $about:expr, $rule:expr) => {
        $crate::explore::Rule::new($name, $about, |setup| start(setup, $rule))
            .hunted(&KernelHunt($rule))
            .switched(&$crate::explore::switches::SwitchableRule {
                rule: $rule,
                start,
                hunt: |rule, _| Some(Box::new(KernelHunt(rule))),
            })
    };
}
pub(super) use searched;

/// The team of a setup that follows a rule of the kernel, at its start.
pub(super) type StartBy<R> = fn(&Setup, R) -> Result<Box<dyn Team>, Diagnostic>;

/// A rule of the kernel whose conditions can be switched: how its team starts, and how it is hunted.
#[derive(Debug)]
pub(super) struct SwitchableRule<R: 'static> {
    /// The rule.
    pub(super) rule: R,
    /// The team of a setup that follows a rule.
    pub(super) start: StartBy<R>,
    /// The hunt of a rule that claims to be the other one, if there is one.
    pub(super) hunt: fn(R, R) -> Option<Box<dyn Hunt>>,
}

impl<R: Conditional + fmt::Debug + Sync> Switches for SwitchableRule<R> {
    fn conditions(&self) -> &'static [(&'static str, &'static str)] {
        R::CONDITIONS
    }

    fn in_force(&self) -> u32 {
        self.rule.in_force()
    }

    fn start(&self, setup: &Setup, in_force: u32) -> Result<Box<dyn Team>, Diagnostic> {
        setup.check()?;
        (self.start)(setup, self.rule.with_in_force(in_force))
    }

    fn hunt(&self, in_force: u32) -> Option<Box<dyn Hunt>> {
        (self.hunt)(self.rule.with_in_force(in_force), self.rule)
    }
}
