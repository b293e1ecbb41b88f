//! Hunts dealt out.

use serde_json::value::RawValue;

use super::{Done, Of, Plan};
use crate::diagnostic::{Diagnostic, Halt};
use crate::explore::hunt::{Asked, Deals, Dealt, Hunt, HuntReport};
use crate::explore::{Profile, RuleId, SetupError};
use crate::resumable::Resumable;

/// The hunt of a rule.
fn hunt(scheme: &'static Profile, rule: RuleId) -> Result<&'static dyn Hunt, Diagnostic> {
    let row = scheme.rule(rule).ok_or(SetupError::Rule { scheme, rule }).map_err(Diagnostic::from)?;
    row.hunt.ok_or_else(|| {
        Diagnostic::usage(format_args!("nothing is hunted of {}", scheme.name), "hunt another scheme")
    })
}

/// The hunt of a rule that can be dealt out.
fn deals(scheme: &'static Profile, rule: RuleId) -> Result<&'static dyn Deals, Diagnostic> {
    hunt(scheme, rule)?.deals().ok_or_else(|| {
        let what = format!(
            "a hunt of {} by the rule {rule} is not dealt out: most of its states are led to from every start, so each shard \
             would search them again",
            scheme.name
        );
        let remedy = "leave `plan` and `shards` out; a smaller `size` or `max-walls` makes it shorter";
        Diagnostic::of_field("shards", what, remedy)
    })
}

/// The scheme and the rule that a plan hunts.
fn hunted(plan: &Plan) -> Result<(&'static Profile, RuleId), Diagnostic> {
    match plan.of {
        Of::Hunt { scheme, rule } => Ok((scheme, rule)),
        Of::Table { .. } => {
            Err(Diagnostic::usage("this plan is none of a hunt", "run it with the command that planned it"))
        }
    }
}

/// Deals a hunt out among so many shards.
///
/// # Errors
/// A [`Diagnostic`] if it cannot be dealt out.
pub fn deal_hunt(asked: &Asked<'_>, shards: u32) -> Result<(Of, Dealt), Diagnostic> {
    let &Asked { scheme, rule, .. } = asked;
    asked.check(hunt(scheme, rule)?)?;
    let dealt = deals(scheme, rule)?.deal(asked, shards as usize)?;
    Ok((Of::Hunt { scheme, rule }, dealt))
}

/// A shard of a hunt, where it was.
///
/// # Errors
/// A [`Diagnostic`] if the plan has no such shard, or it was never there.
pub fn hunt_part(
    plan: &Plan,
    shard: u32,
    far: Option<&RawValue>,
    budget_moves: Option<u64>,
) -> Result<Box<dyn Resumable>, Diagnostic> {
    plan.check_shard(shard)?;
    let (scheme, rule) = hunted(plan)?;
    let asked = Asked { budget: budget_moves, ..Asked::new(scheme, rule) };
    deals(scheme, rule)?.part(&asked, &plan.deal, shard as usize - 1, far)
}

/// What all shards of a hunt have found.
///
/// # Errors
/// [`Halt`] if they do not fit their plan, or one has done less than it was dealt.
pub fn merge_hunt(plan: &Plan, shards: &[Done]) -> Result<HuntReport, Halt> {
    let (scheme, rule) = hunted(plan)?;
    for (number, shard) in (1..).zip(shards) {
        shard.check(hunt_part(plan, number, Some(&shard.far), None).map_err(Halt::from))?;
    }
    let fars: Vec<&RawValue> = shards.iter().map(|shard| &*shard.far).collect();
    Ok(deals(scheme, rule)?.merge(&Asked::new(scheme, rule), &plan.deal, &fars)?)
}
