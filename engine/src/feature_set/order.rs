//! Sets in order: as their ascending numbers would be, one by one.

use super::algebra::Pairs;
use super::bytes::FeatureSet;
use std::cmp::Ordering;

impl PartialEq for FeatureSet<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.bytes() == other.bytes()
    }
}

impl Eq for FeatureSet<'_> {}

impl PartialOrd for FeatureSet<'_> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for FeatureSet<'_> {
    fn cmp(&self, other: &Self) -> Ordering {
        let mut pairs = Pairs::new(*self, *other);
        let Some(pair) = pairs.find(|pair| pair.a != pair.b) else {
            return Ordering::Equal;
        };
        // One of them has this number. It comes first, unless the other ends here.
        let differs = (pair.a ^ pair.b).trailing_zeros();
        let beyond = |bits: u64| bits >> differs >> 1 != 0;
        if pair.a >> differs & 1 == 1 {
            match beyond(pair.b) || pairs.any(|pair| pair.b != 0) {
                true => Ordering::Less,
                false => Ordering::Greater,
            }
        } else {
            match beyond(pair.a) || pairs.any(|pair| pair.a != 0) {
                true => Ordering::Greater,
                false => Ordering::Less,
            }
        }
    }
}
