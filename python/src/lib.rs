//! The native half of the Python package `pytautline`: what is slow in Python, or is Tautline's own. The other half, in
//! the folder `pytautline`, has the classes that a person derives from, the errors, and the type stubs.

mod arguments;
mod arrays;
mod diagnostic;
mod environment;
mod estimate;
mod explore;
mod hunt;
mod layout;
mod local;
mod protocol;
mod rule;
mod run;
mod script;
mod sweep;
mod wait;

/// The native module that `pytautline` imports.
#[pyo3::pymodule]
mod _native {
    #[pymodule_export]
    use crate::environment::Environments;
    #[pymodule_export]
    use crate::estimate::{Estimate, estimate, estimate_ratio, estimate_share};
    #[pymodule_export]
    use crate::explore::{explore, in_contact, replay, schemes};
    #[pymodule_export]
    use crate::hunt::{Counterexample, HuntReport, hunt};
    #[pymodule_export]
    use crate::layout::Layout;
    #[pymodule_export]
    use crate::local::{EveryNumberReport, decide_every_number};
    #[pymodule_export]
    use crate::protocol::{
        Decision, ProtocolReport, StateRun, decide_protocol, hunt_protocol, replay_protocol,
    };
    #[pymodule_export]
    use crate::rule::team_move::TeamMove;
    #[pymodule_export]
    use crate::rule::{OwnCounterexample, OwnHuntReport, hunt_rule};
    #[pymodule_export]
    use crate::run::Run;
    #[pymodule_export]
    use crate::sweep::{Sweep, sweep};
}
