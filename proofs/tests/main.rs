//! The proofs, tried as a whole.

mod areas;
mod certificates;
mod charts;
mod coverage;
mod draw;
mod evidence;
mod exhausted;
mod fairness;
mod hostile;
mod judge_and_rule;
mod judge_of_agents;
mod judge_of_chains;
mod judges;
mod local;
mod local_rules;
mod log;
mod own_parts;
mod own_rule;
mod plans;
mod rescue;
mod rocq;
mod search;
mod smallest;
mod trap;
mod trees;
