//! Campaigns: many runs that know nothing of each other, of which the first ones count where the user ends the work.

use tautline_io::diagnostic::Halt;
use tautline_proofs::engine::threads;

/// Runs that are shared out among the threads together.
const AT_ONCE: usize = 256;

/// The outcomes of `all` runs, in their order; where the user ends the work, of the first ones, without a gap: so what
/// comes out is that of a smaller campaign, whatever each run took.
///
/// # Errors
/// [`Halt`] of the first run.
pub(crate) fn first<T: Send, R: Send>(
    all: impl IntoIterator<Item = T>,
    run: impl Fn(T) -> Result<R, Halt> + Sync,
) -> Result<Vec<R>, Halt> {
    let (mut all, mut made) = (all.into_iter().peekable(), Vec::new());
    while all.peek().is_some() {
        for outcome in threads::each(all.by_ref().take(AT_ONCE), &run) {
            match outcome {
                Ok(outcome) => made.push(outcome),
                Err(Halt::Interrupted) if !made.is_empty() => return Ok(made),
                Err(halt) => return Err(halt),
            }
        }
    }
    Ok(made)
}

#[cfg(test)]
mod tests {
    use tautline_io::diagnostic::Diagnostic;

    use super::*;

    #[test]
    fn the_runs_before_the_first_that_was_not_made_count() {
        let up_to = |end: u32| {
            first(0..1000_u32, |run| if run < end || run == 999 { Ok(run) } else { Err(Halt::Interrupted) })
        };
        assert_eq!(up_to(1000), Ok((0..1000).collect()));
        assert_eq!(up_to(300), Ok((0..300).collect()));
        assert_eq!(up_to(0), Err(Halt::Interrupted));
        let wrong = || Halt::from(Diagnostic::usage("wrong", "right"));
        assert_eq!(first([1, 2], |run| if run == 1 { Ok(run) } else { Err(wrong()) }), Err(wrong()));
    }
}
