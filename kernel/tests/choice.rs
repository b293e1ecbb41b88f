//! The door through which the unknown enters.

use tautline_kernel::choice::{Oracle, one_of};

/// Always answers this.
struct Always(u32);

impl Oracle for Always {
    fn pick(&mut self, _: u32) -> u32 {
        self.0
    }
}

#[test]
fn an_oracle_picks_an_option_and_one_that_answers_too_much_the_last() {
    for (answer, option) in [(0, 'a'), (1, 'b'), (2, 'c'), (3, 'c'), (u32::MAX, 'c')] {
        assert_eq!(one_of(&mut Always(answer), &['a', 'b', 'c']), option);
    }
    assert_eq!(one_of(&mut Always(5), &['a']), 'a');
}
