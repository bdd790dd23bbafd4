//! [`Lottery`], a random sample of a stream.

use std::collections::BinaryHeap;

use fastrand::Rng;

use crate::scene::Volume;

/// Draws volumes at random out of a stream of unknown length. What it draws depends on the volumes
/// and the seed only, not on the order of the stream: each volume gets a ticket from a hash of its
/// content, and the lowest tickets win (bottom-k sampling, E. Cohen and H. Kaplan, "Summarizing
/// data using bottom-k sketches", 2007).
pub struct Lottery {
    seed: u64,
    prizes: usize,
    winners: BinaryHeap<Entry>,
}

struct Entry {
    ticket: u64,
    volume: Volume,
}

impl Lottery {
    /// A lottery with at most so many winners.
    pub fn new(prizes: usize, seed: u64) -> Self {
        Self {
            seed,
            prizes,
            winners: BinaryHeap::new(),
        }
    }

    /// Enters volumes.
    pub fn enter(&mut self, volumes: &[Volume]) {
        for &volume in volumes {
            let ticket = self.ticket(&volume);
            if self.winners.len() < self.prizes {
                self.winners.push(Entry { ticket, volume });
            } else if self.winners.peek().is_some_and(|last| ticket < last.ticket) {
                self.winners.pop();
                self.winners.push(Entry { ticket, volume });
            }
        }
    }

    /// The winners, the lowest ticket first.
    pub fn winners(self) -> Vec<Volume> {
        self.winners
            .into_sorted_vec()
            .into_iter()
            .map(|entry| entry.volume)
            .collect()
    }

    fn ticket(&self, volume: &Volume) -> u64 {
        let numbers = [
            volume.occluder.cast_unsigned(),
            volume.occludee.cast_unsigned(),
        ];
        let corners = volume
            .bounds
            .min
            .iter()
            .chain(&volume.bounds.max)
            .map(|c| c.to_bits());
        numbers
            .into_iter()
            .chain(corners)
            .fold(self.seed, |hash, number| {
                Rng::with_seed(hash ^ number).u64(..)
            })
    }
}

impl PartialEq for Entry {
    fn eq(&self, other: &Self) -> bool {
        self.ticket == other.ticket
    }
}

impl Eq for Entry {}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Entry {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.ticket.cmp(&other.ticket)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sql_types::Box3d;

    fn volumes(count: i64) -> Vec<Volume> {
        (0..count)
            .map(|i| Volume {
                occluder: 1,
                occludee: 2,
                bounds: Box3d {
                    min: [0.0; 3],
                    max: [1.0, 1.0, i as f64],
                },
            })
            .collect()
    }

    fn draw(volumes: &[Volume], seed: u64) -> Vec<Volume> {
        let mut lottery = Lottery::new(10, seed);
        volumes.chunks(7).for_each(|chunk| lottery.enter(chunk));
        lottery.winners()
    }

    #[test]
    fn the_order_of_the_stream_does_not_matter() {
        let mut stream = volumes(1000);
        let drawn = draw(&stream, 3);
        stream.reverse();
        assert_eq!(draw(&stream, 3), drawn);
        assert_ne!(draw(&stream, 4), drawn);
        assert_eq!(draw(&stream[..4], 3).len(), 4);
    }

    #[test]
    fn every_volume_has_the_same_chance() {
        let stream = volumes(100);
        let drawn = (0..2000).flat_map(|seed| draw(&stream, seed));
        let mut times = [0; 100];
        drawn.for_each(|volume| times[volume.bounds.max[2] as usize] += 1);
        assert!(
            times.iter().all(|&times| (140..260).contains(&times)),
            "{times:?}"
        );
    }
}
