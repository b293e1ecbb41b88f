//! Work dealt out to many machines: a *plan* says what is done, by which program, in how many shards; each shard keeps
//! how far it is in a file of its own, from which it is taken up again after whatever has killed it; and all shards
//! together give what one process gives, byte for byte. Who runs which shard where is the business of engines that
//! exist.

mod hunt;
mod plan;

pub use self::hunt::{deal_hunt, hunt_part, hunted, merge_hunt};
pub use self::plan::{Done, Gap, Keeper, Of, Plan};
