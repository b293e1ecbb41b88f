//! The texts of errors: what is wrong, and what would be right where somebody can do something about it.

use std::error::Error;

use tautline_kernel::ground::Cell;
use tautline_kernel::position::Refusal;
use tautline_kernel::{chain, kit, pack};

#[test]
fn errors_say_what_would_be_right() {
    let said: [(&dyn Error, &str); 16] = [
        (&chain::Damage::Byte(0xff), "byte 0xff is no message of the chain"),
        (
            &chain::Damage::Length { bytes: 6, sent: 7 },
            "there are 6 messages, the team sent 7: keep all of them, in their order",
        ),
        (&chain::SetupError::TooFewRobots(1), "1 robots are no chain: it needs at least 2, the base counted"),
        (
            &chain::SetupError::TooManyRobots { robots: 9, most: 8 },
            "9 robots are too many: this chain holds at most 8, the base counted",
        ),
        (&kit::Damage::Flag(4), "4 is no flag of a message: flags are 0 to 3"),
        (&kit::Damage::Covered(2), "a side is 0 or 1, and not 2"),
        (&kit::Damage::Overfull, "an acknowledgement has no node and no sides"),
        (&kit::Misuse::Decides, "the robot may not decide now: ask `may_decide` before"),
        (&kit::Misuse::Looks, "the robot looks at no side: `looked` comes after `Next::Looks`"),
        (&kit::Misuse::Drives, "the robot does not drive: `arrived` comes after `Next::Drives`"),
        (&pack::SetupError::Robots(0), "no robots are no pack"),
        (&pack::SetupError::Robots(33), "33 robots are too many for a pack: it has at most 32"),
        (&pack::SetupError::Together(Cell::new(3, -4)), "two robots of a pack are in the cell 3,-4"),
        (&pack::SetupError::Apart(2, 5), "the pack is not connected: links join 2 of its 5 robots"),
        (&pack::RangeError::Sight, "a robot of a pack sees from 1 to 31 cells far"),
        (&pack::RangeError::Range, "robots of a pack hear each other 3 cells far or more"),
    ];
    for (error, words) in said {
        assert_eq!(error.to_string(), words);
    }
}

#[test]
fn a_refused_position_has_a_remedy() {
    let remedies = [
        (Refusal::Anchors(2), "give at least three anchors, and exactly three for the closed form"),
        (Refusal::NotFinite(0), "give metres, at most 10⁹ of them"),
        (Refusal::Negative(0), "give distances from 0"),
        (Refusal::Zero(0), "give a distance above a micrometre, or ask for residuals in metres"),
        (Refusal::Coincident { first: 0, second: 1 }, "give three anchors at different places"),
        (Refusal::Apart { first: 0, second: 1 }, "measure again, or allow for more noise"),
        (Refusal::Collinear, "move an anchor off the line of the others"),
        (Refusal::Division, "name the anchors in another order, or solve by linear least squares"),
        (Refusal::NoParticle, "give at least one particle"),
        (
            Refusal::NoPlace,
            "begin from the linear solution, or ask for the position without a place to begin from",
        ),
    ];
    for (refusal, remedy) in remedies {
        assert_eq!(refusal.remedy(), remedy);
    }
}
