//! The habits of the reel, as a set of named conditions: the measure that makes every run end rests on each of them.

use crate::conditions;

conditions! {
    /// One habit of the reel, by the sentence it stands for.
    pub enum Habit in u16 {
        /// A task is begun only if a rehearsal on the known map carries it through.
        Rehearses,
        /// Each team move of an approach brings the robot that approaches one cell nearer.
        ComesNearer,
        /// A task is kept until it gains or is over.
        KeepsTask,
        /// The place of a robot on the walk is looked up behind that of the robot ahead, the last first: the walk may
        /// visit a cell twice.
        LastPlace,
        /// Each time the history is taken back without a gain, twice as much of it is.
        Doubles,
    }
}

/// A set of habits.
pub type Habits = Conditions;
