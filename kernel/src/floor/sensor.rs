//! The data that one sensor stores.

use core::hash::{Hash, Hasher};

use crate::ground::Steps;

/// The state of a cell [Ferranti 2009, II.A]. Walls have no sensor.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Mark {
    /// No agent has been in the cell.
    #[default]
    Unexplored,
    /// Agents have been there, and may need to go through it again.
    Explored,
    /// Explored, and to be visited as soon as the last agent has left it: nobody enters. The paper does not have it.
    Closing,
    /// Agents have been there, and need not go through it again: it counts as a wall.
    Visited,
    /// Visited, and so in spite of whatever sensors have been missed. The paper does not have it.
    Sealed,
}

/// An agent's hold on the cell where its lap began (clause BRICKS-2).
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Claim {
    /// The agent.
    pub owner: u8,
}

/// The memory of one sensor.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Sensor {
    /// The state of the cell.
    pub mark: Mark,
    /// How many times an agent has entered, for Ants; it stays at the greatest number it can store.
    pub crossings: u32,
    /// Agents that are in the cell or on their way into it.
    pub agents: u8,
    /// The sides that a loop closure has shut. A side is shut when the sensors on both sides of it say so.
    pub shut: Steps,
    /// The claim on the cell, if there is one.
    pub claim: Option<Claim>,
    /// The sensor's own identifier; 0 where there is none yet. See [`Floor::unpack`](super::Floor::unpack) for what it
    /// tells.
    pub serial: u16,
}

/// The fate of a sensor that an agent has missed, when the agent places a new one in its cell [Ferranti 2009, V.A]. The
/// paper says no more than that the agent "marks it with the state 1". Sensors of one cell are seen or missed together.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum SensorFate {
    /// Whatever it stored is lost.
    Lost,
    /// It stays beside the new one: agents read the higher state and the higher count of the two.
    Beside,
    /// The new one takes its state over, and counts on from its count.
    Counted,
}

impl Sensor {
    /// The bits that a sensor stores for Brick&Mortar robust against missed sensors, but for the 16 of its identifier:
    /// 3 for the mark, 32 for the crossings, 8 for the agents, 4 for the sides that are shut, 9 for the claim. As
    /// published it stores 2 for the mark, and for Ants the crossings.
    pub const BITS: u32 = 56;

    /// The sensor once one agent more has entered.
    pub(super) const fn entered(self) -> Self {
        let mark = match self.mark {
            Mark::Unexplored | Mark::Explored => Mark::Explored,
            mark @ (Mark::Closing | Mark::Visited | Mark::Sealed) => mark,
        };
        let (crossings, agents) = (self.crossings.saturating_add(1), self.agents.saturating_add(1));
        Self { mark, crossings, agents, ..self }
    }

    /// The sensor, just placed in a cell in which `old` may lie, once one agent has entered.
    pub(super) fn entered_beside(self, old: Self, replaced: SensorFate) -> Self {
        let placed = self.entered();
        let crossings = match replaced {
            SensorFate::Lost => return placed,
            SensorFate::Beside => old.crossings.max(placed.crossings),
            SensorFate::Counted => old.crossings.max(self.crossings).saturating_add(1),
        };
        let Self { serial, agents, .. } = placed;
        Self { mark: old.mark.max(placed.mark), serial, agents, crossings, ..old }
    }

    /// The sensor once one agent has left.
    pub(super) const fn left(self) -> Self {
        Self { agents: self.agents.saturating_sub(1), ..self }
    }

    /// All that it stores but its identifier, in the lowest [`Sensor::BITS`] bits.
    pub const fn to_bits(self) -> u64 {
        let claim = match self.claim {
            None => 0,
            Some(Claim { owner }) => 1 | (owner as u64) << 1,
        };
        self.mark as u64
            | (self.crossings as u64) << 3
            | (self.agents as u64) << 35
            | (self.shut.bits() as u64) << 43
            | claim << 47
    }

    /// The sensor that stores `bits`; `None` if no sensor does.
    pub fn from_bits(bits: u64) -> Option<Self> {
        const MARKS: [Mark; 5] =
            [Mark::Unexplored, Mark::Explored, Mark::Closing, Mark::Visited, Mark::Sealed];
        let mark = *MARKS.get((bits & 0b111) as usize)?;
        let claim = match (bits >> 47 & 1, bits >> 48) {
            (0, 0) => None,
            (1, owner @ 0..=0xFF) => Some(Claim { owner: owner as u8 }),
            _ => return None,
        };
        Some(Self {
            mark,
            crossings: (bits >> 3) as u32,
            agents: (bits >> 35) as u8,
            shut: Steps::of_bits((bits >> 43) as u8 & 0b1111),
            claim,
            serial: 0,
        })
    }
}

/// In two words, not field by field: searches spend much of their time hashing floors.
impl Hash for Sensor {
    fn hash<H: Hasher>(&self, hasher: &mut H) {
        hasher.write_u64(self.to_bits());
        hasher.write_u16(self.serial);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::{Side, Step};

    #[test]
    fn a_sensor_fits_into_its_bits_and_comes_back() {
        let full = Sensor {
            mark: Mark::Sealed,
            crossings: u32::MAX,
            agents: u8::MAX,
            shut: Steps::of_bits(0b1111),
            claim: Some(Claim { owner: u8::MAX }),
            serial: 0,
        };
        assert_eq!(full.to_bits() >> (Sensor::BITS - 1), 1);
        let part = Sensor { shut: Steps::only(Step::Cross(Side::West)), claim: None, ..full };
        let owned = Sensor { claim: Some(Claim { owner: 0 }), ..Sensor::default() };
        for sensor in [full, part, owned, Sensor::default()] {
            assert_eq!(Sensor::from_bits(sensor.to_bits()), Some(sensor));
        }
        for wrong in [5, 1 << 48, 1 << Sensor::BITS] {
            assert_eq!(Sensor::from_bits(wrong), None, "{wrong:b}");
        }
    }

    #[test]
    fn a_new_sensor_counts_from_one_or_as_the_old_one_did_or_on_from_it() {
        let side = Steps::only(Step::Cross(Side::West));
        let old = Sensor { mark: Mark::Visited, crossings: 5, agents: 1, shut: side, claim: None, serial: 7 };
        let placed = Sensor { serial: 8, agents: 1, ..Sensor::default() };
        let entered = |replaced| placed.entered_beside(old, replaced);
        let new = Sensor { mark: Mark::Explored, crossings: 1, agents: 2, serial: 8, ..Sensor::default() };
        assert_eq!(entered(SensorFate::Lost), new);
        let beside = Sensor { mark: Mark::Visited, crossings: 5, shut: side, ..new };
        assert_eq!(entered(SensorFate::Beside), beside);
        assert_eq!(entered(SensorFate::Counted), Sensor { crossings: 6, ..beside });
        for replaced in [SensorFate::Lost, SensorFate::Beside, SensorFate::Counted] {
            let known = placed.entered_beside(Sensor::default(), replaced);
            assert_eq!(known, placed.entered(), "no old one, {replaced:?}");
            let fewer = Sensor { crossings: 2, ..Sensor::default() };
            let counting = Sensor { crossings: 4, ..placed }.entered_beside(fewer, replaced);
            assert_eq!(counting.crossings, 5, "{replaced:?}");
        }
    }
}
