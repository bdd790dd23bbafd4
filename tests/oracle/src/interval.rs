//! Intervals with outward rounding: the certified filter in front of rational arithmetic.

use std::cmp::Ordering;

use crate::number::Number;

/// An interval `[lo, hi]` that holds the exact value.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Interval {
    pub(crate) lo: f64,
    pub(crate) hi: f64,
}

impl Interval {
    const ENTIRE: Self = Self {
        lo: f64::NEG_INFINITY,
        hi: f64::INFINITY,
    };

    /// The interval around results that were rounded to nearest: one step outward on each side.
    pub(crate) fn outward(lo: f64, hi: f64) -> Self {
        // NaN stems from an overflow, so nothing is known.
        if lo.is_nan() || hi.is_nan() {
            return Self::ENTIRE;
        }
        Self {
            lo: lo.next_down(),
            hi: hi.next_up(),
        }
    }

    fn negated(self) -> Self {
        Self {
            lo: -self.hi,
            hi: -self.lo,
        }
    }

    /// Whether the exact value is known to be zero.
    fn is_zero(&self) -> bool {
        self.lo == 0.0 && self.hi == 0.0
    }

    /// Whether both hold one and the same number only.
    fn is_same(&self, other: &Self) -> bool {
        self.lo == self.hi && other.lo == other.hi && self.lo == other.lo
    }
}

impl Number for Interval {
    fn from_f64(value: f64) -> Self {
        Self {
            lo: value,
            hi: value,
        }
    }

    // Sums, differences and products that are surely exact stay so: whatever is parallel to an axis
    // and touches is then decided without rationals.
    fn plus(&self, other: &Self) -> Self {
        if self.is_zero() {
            return *other;
        }
        if other.is_zero() {
            return *self;
        }
        Self::outward(self.lo + other.lo, self.hi + other.hi)
    }

    fn minus(&self, other: &Self) -> Self {
        if other.is_zero() {
            return *self;
        }
        if self.is_same(other) {
            return Self::from_f64(0.0);
        }
        Self::outward(self.lo - other.hi, self.hi - other.lo)
    }

    fn times(&self, other: &Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return Self::from_f64(0.0);
        }
        hull([
            self.lo * other.lo,
            self.lo * other.hi,
            self.hi * other.lo,
            self.hi * other.hi,
        ])
    }

    // Everything where the divisor may be zero.
    fn over(&self, divisor: &Self) -> Self {
        if divisor.lo <= 0.0 && divisor.hi >= 0.0 {
            return Self::ENTIRE;
        }
        // By a positive divisor; a quotient has one sign at each end.
        let (over, by) = if divisor.lo > 0.0 {
            (*self, *divisor)
        } else {
            (self.negated(), divisor.negated())
        };
        let low = if over.lo < 0.0 { by.lo } else { by.hi };
        let high = if over.hi < 0.0 { by.hi } else { by.lo };
        Self::outward(over.lo / low, over.hi / high)
    }

    fn compare(&self, other: &Self) -> Option<Ordering> {
        if self.is_same(other) {
            Some(Ordering::Equal)
        } else if self.hi < other.lo {
            Some(Ordering::Less)
        } else if self.lo > other.hi {
            Some(Ordering::Greater)
        } else {
            None
        }
    }

    fn smaller(&self, other: &Self) -> Self {
        Self {
            lo: self.lo.min(other.lo),
            hi: self.hi.min(other.hi),
        }
    }

    fn larger(&self, other: &Self) -> Self {
        Self {
            lo: self.lo.max(other.lo),
            hi: self.hi.max(other.hi),
        }
    }

    fn sorted(mut numbers: Vec<Self>) -> Option<Vec<Self>> {
        numbers.sort_by(|a, b| a.lo.total_cmp(&b.lo));
        let certain = numbers
            .windows(2)
            .all(|pair| pair[0].compare(&pair[1]).is_some());
        certain.then_some(numbers)
    }
}

/// The outward hull of four rounded results, everything if one of them is NaN.
fn hull(values: [f64; 4]) -> Interval {
    // f64::min and f64::max would pass over a NaN.
    if values.iter().any(|value| value.is_nan()) {
        return Interval::ENTIRE;
    }
    let lo = values.iter().copied().fold(f64::INFINITY, f64::min);
    let hi = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    Interval::outward(lo, hi)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::exact::{Rational, rational};

    fn holds(interval: Interval, value: &Rational) -> bool {
        let below = interval.lo == f64::NEG_INFINITY || rational(interval.lo) <= *value;
        let above = interval.hi == f64::INFINITY || *value <= rational(interval.hi);
        below && above
    }

    proptest! {
        #[test]
        fn every_operation_holds_the_exact_result(
            a in any::<f64>().prop_filter("finite", |x| x.is_finite()),
            b in any::<f64>().prop_filter("finite", |x| x.is_finite()),
            c in -90_000.0..450_000.0,
            d in -1.0..1.0,
        ) {
            for (x, y) in [(a, b), (a, c), (c, d), (d, d)] {
                let (ix, iy) = (Interval::from_f64(x), Interval::from_f64(y));
                let (rx, ry) = (rational(x), rational(y));
                prop_assert!(holds(ix.plus(&iy), &(&rx + &ry)));
                prop_assert!(holds(ix.minus(&iy), &(&rx - &ry)));
                prop_assert!(holds(ix.times(&iy), &(&rx * &ry)));
                if y != 0.0 {
                    prop_assert!(holds(ix.over(&iy), &(&rx / &ry)));
                }
            }
        }
    }

    #[test]
    fn what_is_exact_stays_so() {
        let [a, b, zero] = [85_000.1, 447_000.3, 0.0].map(Interval::from_f64);
        assert_eq!(a.minus(&a).compare(&zero), Some(Ordering::Equal));
        assert_eq!(
            a.minus(&a).times(&b).plus(&b).compare(&b),
            Some(Ordering::Equal)
        );
        assert_eq!(a.minus(&b).minus(&a.minus(&b)).compare(&zero), None);
        assert!(Interval::sorted(vec![b, a, zero, a]).is_some());
        assert!(Interval::sorted(vec![b, a.times(&b), b.times(&a)]).is_none());
    }

    #[test]
    fn overflow_knows_nothing() {
        let huge = Interval::from_f64(f64::MAX).times(&Interval::from_f64(f64::MAX));
        assert!(
            huge.minus(&huge)
                .compare(&Interval::from_f64(0.0))
                .is_none()
        );
    }
}
