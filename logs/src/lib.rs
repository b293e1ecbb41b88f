//! Logs of where robots were, and a judge of them. [`read`] makes stamped positions of CSV, JSON lines or MCAP;
//! [`Tracks`] orders them by robot and time, and says what it cannot take; [`judge`] looks at all robots at each stamp,
//! and says whether a clause of `SPEC.md` is kept, broken or unknown. It knows no rule, and shares no code with one.
//!
//! Positions decide clauses of distances, of cells, and of cells that somebody has visited: [`CLAUSES`].
//!
//! ```
//! use tautline_logs::{Demand, Limits, Numbers, Tracks, Verdict, judge, read};
//!
//! let log = read(b"time,robot,x_m,y_m\n0,a,0,0\n0,b,2,0\n1,a,0,0\n1,b,3,0\n").expect("a log");
//! let numbers = Numbers::natural(&log.names);
//! let limits = Limits { tolerance_mm: 50, gap_us: 1_000_000, jump_us: 60_000_000 };
//! let tracks = Tracks::new(&log, &numbers, &limits);
//! let Verdict::Broken(breach) = judge(&tracks, &limits, &Demand::Neighbours { range_mm: 2_549 })? else {
//!     panic!("they are 3 m apart at the end")
//! };
//! assert_eq!((breach.at_us, breach.measured, breach.place), (1_000_000, 3_000, 5));
//! # Ok::<(), tautline_logs::TooMuch>(())
//! ```

#![expect(clippy::cast_precision_loss, reason = "microseconds and millimetres of a log are far below 2^53")]

mod clause;
mod ground;
mod judge;
mod numbers;
mod reader;
mod track;

pub use clause::{CLAUSES, Kind, not_judged};
pub use ground::{Grid, Ground, MOST_COMPARISONS, Strays, TooMuch, misplaced, visits};
pub use judge::{Breach, Demand, Doubt, Group, Verdict, judge};
pub use numbers::{NamesError, Numbers};
pub use reader::{Fault, FaultPlace, Form, Log, MOST_SAMPLES, Sample, read};
pub use track::{Limits, Refusals, Silence, Tracks};
