//! Hunts dealt out.

use serde_json::value::RawValue;

use super::{Of, Plan};
use crate::explore::hunt::{Asked, Deals, Dealt, Hunted};
use crate::explore::{Misfit, Profile, RuleId};
use crate::fault::Fault;
use crate::part::Part;

/// The hunt of a rule that can be dealt out.
fn deals(scheme: &'static Profile, rule: RuleId) -> Result<&'static dyn Deals, Fault> {
    let row = scheme.rule(rule).ok_or(Misfit::Rule { scheme, rule }).map_err(Fault::from)?;
    row.hunt.and_then(|hunt| hunt.deals()).ok_or_else(|| {
        let what = format!("a hunt of {} is not dealt out: it is searched in one piece", scheme.name);
        Fault::of_field("shards", what, "leave `plan` and `shards` out, or hunt a chain")
    })
}

/// The scheme and the rule that a plan hunts.
fn hunted(plan: &Plan) -> Result<(&'static Profile, RuleId), Fault> {
    match plan.of {
        Of::Hunt { scheme, rule } => Ok((scheme, rule)),
        Of::Table { .. } => {
            Err(Fault::usage("this plan is none of a hunt", "run it with the command that planned it"))
        }
    }
}

/// Deals a hunt out among so many shards.
///
/// # Errors
/// A [`Fault`] if it cannot be dealt out.
pub fn deal_hunt(asked: &Asked<'_>, shards: u32) -> Result<(Of, Dealt), Fault> {
    let &Asked { scheme, rule, .. } = asked;
    let dealt = deals(scheme, rule)?.deal(asked, shards as usize)?;
    Ok((Of::Hunt { scheme, rule }, dealt))
}

/// A shard of a hunt, where it was.
///
/// # Errors
/// A [`Fault`] if the plan has no such shard, or it was never there.
pub fn hunt_part(
    plan: &Plan,
    shard: u32,
    far: Option<&RawValue>,
    budget_moves: Option<u64>,
) -> Result<Box<dyn Part>, Fault> {
    plan.check_shard(shard)?;
    let (scheme, rule) = hunted(plan)?;
    deals(scheme, rule)?.part(&plan.deal, shard as usize - 1, far, budget_moves)
}

/// What all shards of a hunt have found.
///
/// # Errors
/// A [`Fault`] if they do not fit their plan.
pub fn merge_hunt(plan: &Plan, shards: &[Box<RawValue>]) -> Result<Hunted, Fault> {
    let (scheme, rule) = hunted(plan)?;
    deals(scheme, rule)?.merge(scheme, rule, &plan.deal, shards)
}
