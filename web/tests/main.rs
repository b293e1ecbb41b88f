//! The page as a browser drives it: requests and answers.

mod chain;
mod clauses;
mod schemes;
