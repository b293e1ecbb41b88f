//! Hunts dealt out.

use serde_json::value::RawValue;
use tautline_io::checkpoint::Part;
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_io::shards::{Plan, ShardFile, Work};

use crate::explore::Catalogue;
use crate::explore::hunt::{Deals, Dealt, HuntReport, HuntRequest};

/// The remedy for a plan that deals out what no hunt has.
const ANEW: &str = "take it as tautline wrote it, or plan anew";

/// The hunt that is asked for, if it can be dealt out.
fn deals(asked: &HuntRequest<'_>) -> Result<&'static dyn Deals, Diagnostic> {
    let &HuntRequest { scheme, rule, .. } = asked;
    scheme.hunt(rule)?.deals().ok_or_else(|| {
        let what = format!(
            "a hunt of {} by the rule {rule} is not dealt out: most of its states are led to from every \
             start, so each shard would search them again",
            scheme.name
        );
        let remedy = "leave `plan` and `shards` out; a smaller `size` or `max-walls` makes it shorter";
        Diagnostic::of_field("shards", what, remedy)
    })
}

/// The hunt that a plan deals out: a scheme of `catalogue` and its rule; all else its deal has.
///
/// # Errors
/// A [`Diagnostic`] if it is a plan of something else.
pub fn hunted(plan: &Plan, catalogue: Catalogue) -> Result<HuntRequest<'static>, Diagnostic> {
    if let Work::Hunt { scheme, rule } = &plan.of
        && let Some(scheme) = catalogue.scheme(scheme)
        && let Some(rule) = scheme.rules.iter().find(|row| row.name.as_str() == rule)
    {
        return Ok(HuntRequest::new(scheme, rule.name));
    }
    Err(plan.none_of("a hunt"))
}

/// Deals a hunt out among so many shards.
///
/// # Errors
/// A [`Diagnostic`] if it cannot be dealt out.
pub fn deal_hunt(asked: &HuntRequest<'_>, shards: u32) -> Result<(Work, Dealt), Diagnostic> {
    let &HuntRequest { scheme, rule, .. } = asked;
    asked.check(scheme.hunt(rule)?)?;
    let dealt = deals(asked)?.deal(asked, shards as usize)?;
    Ok((Work::Hunt { scheme: scheme.name.to_owned(), rule: rule.to_string() }, dealt))
}

/// A shard of the hunt that is `asked` for, where it was.
///
/// # Errors
/// A [`Diagnostic`] if the plan has no such shard, or it was never there.
pub fn hunt_part(
    plan: &Plan,
    asked: &HuntRequest<'_>,
    shard: u32,
    far: Option<&RawValue>,
) -> Result<Box<dyn Part>, Diagnostic> {
    plan.check_shard(shard)?;
    let part = deals(asked)?.part(asked, &plan.deal, (shard as usize - 1, plan.shards as usize), far);
    // Before a shard has begun, nothing but the plan can be at fault.
    part.map_err(|fault| if far.is_none() { fault.with_remedy(ANEW).found_in(plan.path()) } else { fault })
}

/// The report of what all shards of the hunt that is `asked` for have found.
///
/// # Errors
/// [`Halt`] if they do not fit their plan, or one has done less than it was dealt.
pub fn merge_hunt(plan: &Plan, asked: &HuntRequest<'_>, shards: &[ShardFile]) -> Result<HuntReport, Halt> {
    for (number, shard) in (1..).zip(shards) {
        shard.check(hunt_part(plan, asked, number, Some(&shard.far)).map_err(Halt::from))?;
    }
    let fars: Vec<&RawValue> = shards.iter().map(|shard| &*shard.far).collect();
    Ok(deals(asked)?.merge(asked, &plan.deal, &fars)?)
}
