//! A node's knowledge of its neighbours and theirs from hellos, and which of them no sender has reached yet: the memory
//! of the scalable broadcast (Peng and Lu 2000). It grows with the number of neighbours, so the caller lends it.

use crate::net::NodeId;

/// The neighbours of a node and of the sender that it hears. The other schemes know of none: [`Surroundings::none`].
#[derive(Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Surroundings<'a> {
    /// The node's neighbours, ascending.
    pub neighbours: &'a [NodeId],
    /// The sender's neighbours, ascending.
    pub of_sender: &'a [NodeId],
    /// A bit for each of `neighbours` that no sender has reached, [`words`] of them: the node's own, from its first
    /// NOTICE to its next event. A neighbour without a bit counts as not reached.
    pub unreached: &'a mut [u64],
}

/// The words that hold a bit for each of `neighbours`.
pub const fn words(neighbours: usize) -> usize {
    neighbours.div_ceil(u64::BITS as usize)
}

impl Surroundings<'_> {
    /// Nothing is known.
    pub const fn none() -> Self {
        Self { neighbours: &[], of_sender: &[], unreached: &mut [] }
    }

    /// Begins an event: no neighbour is reached.
    pub(super) fn begin(&mut self) {
        self.unreached.fill(0);
        for place in 0..self.neighbours.len() {
            if let Some(word) = self.unreached.get_mut(place / 64) {
                *word |= 1 << (place % 64);
            }
        }
    }

    /// `sender` and its neighbours are reached.
    pub(super) fn reach(&mut self, sender: NodeId) {
        let mut reached = self.of_sender;
        for (place, &neighbour) in self.neighbours.iter().enumerate() {
            while let Some((&first, rest)) = reached.split_first()
                && first < neighbour
            {
                reached = rest;
            }
            if (neighbour == sender || reached.first() == Some(&neighbour))
                && let Some(word) = self.unreached.get_mut(place / 64)
            {
                *word &= !(1 << (place % 64));
            }
        }
    }

    /// Whether every neighbour is reached.
    pub(super) fn all_reached(&self) -> bool {
        self.unreached.len() >= words(self.neighbours.len()) && self.unreached.iter().all(|&word| word == 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sender_reaches_itself_and_its_neighbours() {
        let own: [NodeId; 70] = core::array::from_fn(|place| NodeId(2 * place as u32));
        let mut unreached = [u64::MAX; 2];
        let even_tens: [NodeId; 14] = core::array::from_fn(|place| NodeId(10 * place as u32));
        let mut around = Surroundings { neighbours: &own, of_sender: &even_tens, unreached: &mut unreached };
        around.begin();
        around.reach(NodeId(138));
        let left = own.iter().filter(|id| id.0 % 10 != 0 && id.0 != 138).count() as u32;
        assert_eq!(around.unreached.iter().map(|word| word.count_ones()).sum::<u32>(), left);
        around.of_sender = &own;
        around.reach(NodeId(1));
        assert!(around.all_reached());
    }

    #[test]
    fn a_neighbour_without_a_bit_is_never_reached() {
        let own = [NodeId(1); 65];
        let mut around = Surroundings { neighbours: &own, of_sender: &own, unreached: &mut [0] };
        around.begin();
        around.reach(NodeId(1));
        assert!(!around.all_reached());
    }
}
