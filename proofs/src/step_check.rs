//! Step checks: one macro makes of a body the exhaustive check, its test, its property and, in the hosted CI, its Kani
//! harnesses.

/// Registers checks that go through every answer to the choices of a body, each about a rule of type `$rule`, and makes
/// of each a module with the constant `CHECK`, a test, a property and Kani harnesses: one that must succeed, and one
/// for each mutant that must fail. Their loops go round at most `unwind` times.
///
/// The property is proptest's: the crate that uses the macro has `proptest` among its `dev-dependencies`.
///
/// ```
/// use tautline_kernel::choice::Oracle;
/// use tautline_proofs::clause::NamedRule;
/// use tautline_proofs::engine::{Outcome, require};
///
/// /// The largest of two numbers, by some rule.
/// type Larger = fn(u32, u32) -> u32;
///
/// fn is_no_less(larger: &Larger, oracle: &mut dyn Oracle) -> Outcome {
///     let (one, other) = (oracle.pick(8), oracle.pick(8));
///     require(larger(one, other) >= one.max(other), "it is less than neither")?;
///     Ok("two numbers")
/// }
///
/// fn pairs() -> String {
///     "all pairs of numbers below 8".to_owned()
/// }
///
/// fn first(one: u32, _: u32) -> u32 {
///     one
/// }
///
/// tautline_proofs::step_checks! { Larger;
///     no_less: is_no_less, NamedRule::new("ours", u32::max as Larger), pairs,
///         covers ["two numbers"], unwind 3, mutants {
///         the_first: "the first" => first as Larger,
///     };
/// }
///
/// # fn main() {
/// use tautline_proofs::clause::AnyCheck;
/// use tautline_proofs::decide::Cache;
/// use tautline_proofs::engine::tree::unwatched;
///
/// let decision = no_less::CHECK.decide(&mut Cache::default(), &mut unwatched).expect("it can be decided");
/// assert!(decision.is_as_registered(&no_less::CHECK));
/// # }
/// ```
#[macro_export]
macro_rules! step_checks {
    ($rule:ty; $($name:ident: $body:path, $about:expr, $range:path, covers $covers:expr, unwind $unwind:literal,
       mutants { $($mutant:ident: $what:literal => $wrong:expr),* $(,)? };)*) => {$(
        #[allow(missing_docs, reason = "the check is told by its name")]
        pub(crate) mod $name {
            #[allow(unused_imports, reason = "the expressions may name anything that stands around them")]
            use super::*;

            pub(crate) const CHECK: $crate::clause::Check<$rule> = $crate::clause::Check::new(
                $about,
                &$crate::decide::EveryAnswer { body: $body, range: $range, covers: &$covers },
                $crate::decide::Verdict::Holds,
                &[$($crate::clause::NamedRule::new($what, $wrong)),*],
            );

            #[cfg(test)]
            mod test {
                #[allow(unused_imports, reason = "the body is named as it is around the checks")]
                use super::*;

                #[test]
                fn holds_exhaustively_and_rejects_its_mutants() {
                    use $crate::clause::AnyCheck;
                    let mut cache = $crate::decide::Cache::default();
                    let decision = CHECK.decide(&mut cache, &mut $crate::engine::tree::unwatched);
                    let decision = decision.expect("a body can be decided");
                    assert!(decision.is_as_registered(&CHECK), "{}: {decision:?}", CHECK.bound());
                }

                #[test]
                fn holds_for_any_tape_and_rejects_its_mutants() {
                    use ::proptest::prelude::{TestCaseError, prop};
                    use ::proptest::test_runner::{Config, RngAlgorithm, TestCaseResult, TestRng, TestRunner};
                    use $crate::engine::{Stop, Tape};

                    let body: $crate::decide::Body<$rule> = $body;
                    let broken = |rule: $rule| {
                        let config = Config { cases: 20_000, failure_persistence: None, ..Config::default() };
                        let rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
                        let tapes = prop::collection::vec(0_u32..3600, 16);
                        let mut runner = TestRunner::new_with_rng(config, rng);
                        // One type for all of them, so that the runner is compiled once.
                        let case: Box<dyn Fn(Vec<u32>) -> TestCaseResult> =
                            Box::new(move |tape| match body(&rule, &mut Tape(&tape)) {
                                Err(Stop::Violated(demand)) => Err(TestCaseError::fail(demand)),
                                Err(Stop::Assumed | Stop::GivenUp) | Ok(_) => Ok(()),
                            });
                        runner.run(&tapes, case)
                    };
                    assert!(broken(CHECK.about.rule).is_ok(), "{}", stringify!($name));
                    for mutant in CHECK.mutants {
                        assert!(broken(mutant.rule).is_err(), "{} survives", mutant.name);
                    }
                }
            }

            #[cfg(kani)]
            mod harness {
                use super::*;

                #[kani::proof]
                #[kani::unwind($unwind)]
                fn holds() {
                    $crate::engine::symbolic::prove($body, &$about.rule);
                }

                $(#[kani::proof]
                #[kani::unwind($unwind)]
                #[kani::should_panic]
                fn $mutant() {
                    let wrong: $rule = $wrong;
                    $crate::engine::symbolic::prove($body, &wrong);
                })*
            }
        }
    )*};
}
