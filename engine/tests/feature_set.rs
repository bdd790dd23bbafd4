//! Feature sets against ordinary sets.

use std::collections::BTreeSet;

use engine::{FeatureSet, MOST_IN_SET, SetCollector};
use proptest::collection::vec;
use proptest::prelude::*;

fn encoded(numbers: impl IntoIterator<Item = i64>) -> Vec<u8> {
    let mut collector = SetCollector::default();
    for number in numbers {
        collector.add(number).expect("a small set");
    }
    collector.set().expect("a small set").bytes().to_vec()
}

fn decoded(bytes: &[u8]) -> Vec<i64> {
    let set = FeatureSet::read(bytes).expect("the form of a set");
    let numbers: Vec<i64> = set.numbers().collect();
    assert_eq!(set.cardinality(), numbers.len() as u64);
    assert_eq!(set.least(), numbers.first().copied());
    assert_eq!(set.greatest(), numbers.last().copied());
    numbers
}

/// Runs, thick and thin stretches, far ends.
fn numbers() -> impl Strategy<Value = BTreeSet<i64>> {
    let start = prop_oneof![
        Just(0),
        Just(i64::MIN),
        Just(i64::MAX - 300),
        Just(-64),
        -500..500i64,
        any::<i64>(),
    ];
    let stretch =
        (start, 1..300i64, 1..5i64, any::<u64>()).prop_map(|(start, long, step, seed)| {
            (0..long)
                .filter(|i| step == 1 || (seed >> (i % 61) & 3) < 4 - step.cast_unsigned() % 4)
                .filter_map(|i| start.checked_add(i * (1 + (step - 1) * (seed & 1).cast_signed())))
                .collect::<Vec<_>>()
        });
    vec(stretch, 0..6).prop_map(|stretches| stretches.into_iter().flatten().collect())
}

/// Sets that share much.
fn pair() -> impl Strategy<Value = (BTreeSet<i64>, BTreeSet<i64>)> {
    (numbers(), numbers(), numbers(), any::<u8>()).prop_map(|(common, a, b, how)| {
        let with = |own: BTreeSet<i64>, flag: bool| match flag {
            true => common.union(&own).copied().collect(),
            false => common.clone(),
        };
        (with(a, how & 3 != 0), with(b, how & 12 != 0))
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn what_goes_in_comes_out(set in numbers()) {
        let bytes = encoded(set.iter().rev().copied());
        prop_assert_eq!(decoded(&bytes), set.iter().copied().collect::<Vec<_>>());
    }

    #[test]
    fn the_algebra_is_that_of_sets((a, b) in pair(), other in any::<i64>()) {
        let (bytes_a, bytes_b) = (encoded(a.iter().copied()), encoded(b.iter().copied()));
        let (set_a, set_b) = (FeatureSet::trusted(&bytes_a), FeatureSet::trusted(&bytes_b));
        let is = |bytes: Result<Vec<u8>, _>, right: Vec<i64>| {
            prop_assert_eq!(decoded(&bytes.expect("a small set")), right);
            Ok(())
        };
        is(set_a.union(set_b), a.union(&b).copied().collect())?;
        is(set_a.intersection(set_b), a.intersection(&b).copied().collect())?;
        is(set_a.difference(set_b), a.difference(&b).copied().collect())?;
        prop_assert_eq!(set_a.contains(set_b), a.is_superset(&b));
        prop_assert_eq!(set_a.overlaps(set_b), !a.is_disjoint(&b));
        prop_assert_eq!(set_a == set_b, a == b);
        prop_assert_eq!(set_a.cmp(&set_b), a.cmp(&b));
        for number in b.iter().copied().chain([other, i64::MIN, i64::MAX, 0]) {
            prop_assert_eq!(set_a.contains_number(number), a.contains(&number));
        }
    }

    #[test]
    fn the_laws_of_sets_hold_in_bytes((a, b) in pair(), c in numbers()) {
        let [a, b, c] = [a, b, c].map(encoded);
        let or = |a: &[u8], b: &[u8]| FeatureSet::trusted(a).union(FeatureSet::trusted(b)).expect("small");
        let and = |a: &[u8], b: &[u8]| FeatureSet::trusted(a).intersection(FeatureSet::trusted(b)).expect("small");
        let less = |a: &[u8], b: &[u8]| FeatureSet::trusted(a).difference(FeatureSet::trusted(b)).expect("small");
        prop_assert_eq!(or(&a, &b), or(&b, &a));
        prop_assert_eq!(and(&a, &b), and(&b, &a));
        prop_assert_eq!(or(&or(&a, &b), &c), or(&a, &or(&b, &c)));
        prop_assert_eq!(and(&and(&a, &b), &c), and(&a, &and(&b, &c)));
        prop_assert_eq!(and(&a, &or(&b, &c)), or(&and(&a, &b), &and(&a, &c)));
        prop_assert_eq!(less(&c, &or(&a, &b)), and(&less(&c, &a), &less(&c, &b)));
        prop_assert_eq!(less(&c, &and(&a, &b)), or(&less(&c, &a), &less(&c, &b)));
        prop_assert_eq!(or(&less(&a, &b), &and(&a, &b)), a.clone());
        prop_assert_eq!(less(&a, &a), vec![0]);
        prop_assert_eq!(or(&a, &a), a);
    }

    #[test]
    fn a_collector_joins_numbers_and_sets(parts in vec((numbers(), any::<bool>()), 0..20)) {
        let mut collector = SetCollector::default();
        for (part, whole) in &parts {
            if *whole {
                collector.add_set(FeatureSet::trusted(&encoded(part.iter().copied()))).expect("small");
            } else {
                part.iter().for_each(|&number| collector.add(number).expect("small"));
            }
        }
        let right: BTreeSet<i64> = parts.into_iter().flat_map(|(part, _)| part).collect();
        prop_assert_eq!(decoded(collector.set().expect("small").bytes()), right.iter().copied().collect::<Vec<_>>());
        let again = collector.set().expect("small").bytes().to_vec();
        prop_assert_eq!(again, encoded(right));
    }

    #[test]
    fn only_the_one_form_is_read(bytes in vec(prop_oneof![any::<u8>(), 0..8u8, Just(255)], 0..40)) {
        if FeatureSet::read(&bytes).is_ok() {
            let numbers = decoded(&bytes);
            prop_assert!(numbers.is_sorted_by(|a, b| a < b));
            prop_assert_eq!(&encoded(numbers), &bytes);
        }
        // Whatever bytes are trusted, nothing panics.
        let set = FeatureSet::trusted(&bytes);
        set.numbers().take(1000).for_each(drop);
        let _ = set.contains_number(5);
        let _ = set.cmp(&FeatureSet::trusted(&[2, 0, 5]));
    }

    #[test]
    fn a_changed_form_is_refused_or_another_set(
        set in numbers(), at in any::<prop::sample::Index>(), value in any::<u8>(),
    ) {
        let mut bytes = encoded(set.iter().copied());
        let at = at.index(bytes.len());
        prop_assume!(bytes[at] != value);
        bytes[at] = value;
        if FeatureSet::read(&bytes).is_ok() {
            let other = decoded(&bytes);
            prop_assert!(other.iter().ne(&set));
            prop_assert_eq!(encoded(other), bytes);
        }
    }
}

#[test]
fn an_endless_run_is_malformed_and_not_walked() {
    let endless = [1, 2, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x7f];
    assert!(FeatureSet::read(&endless).is_err());
    let set = FeatureSet::trusted(&endless);
    assert_eq!(set.numbers().count(), 0);
    assert!(!set.contains_number(1 << 40));
}

#[test]
fn forms_are_as_documented() {
    let cases: [(&[i64], &[u8]); 9] = [
        (&[], &[0]),
        (&[0], &[1, 0, 0]),
        (&[63], &[1, 0, 63]),
        (&[-1], &[1, 1 << 2, 63]),
        (&[3, 4, 5, 9], &[4, 0, 3 | 0x80, 5 | 0x40, 9]),
        (&[0, 64, 192], &[3, 0, 0, 0, 0, 1 << 2, 0]),
        (&[0, 2, 4, 8], &[4, 1, 0b11, 0b10101, 1]),
        (
            &[i64::MIN],
            &[1, 0xfc, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x0f, 0],
        ),
        (
            &[i64::MAX],
            &[1, 0xf8, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x0f, 63],
        ),
    ];
    for (numbers, bytes) in cases {
        assert_eq!(encoded(numbers.iter().copied()), bytes, "{numbers:?}");
        assert_eq!(decoded(bytes), numbers);
    }
    assert_eq!(encoded(0..128), [0x80, 1, 2, 1]);
    let odd = [
        35, 3, 0xaa, 0xaa, 0xaa, 0xaa, 0xaa, 0xaa, 0xaa, 0xaa, 0, 0x80, 2,
    ];
    assert_eq!(encoded((1..64).step_by(2).chain(64..67)), odd);
}

#[test]
fn forms_that_are_not_the_one_are_refused() {
    let refused: [&[u8]; 14] = [
        &[],
        &[0x80],
        &[0, 0],
        &[1],
        &[1, 0],
        // A varint of more bytes than it needs.
        &[0x81, 0, 0, 0],
        // Another count.
        &[2, 0, 0],
        // More after it.
        &[1, 0, 0, 0],
        // A run of one, a run backwards, runs that touch.
        &[1, 0, 0x80, 0],
        &[2, 0, 0x81, 0],
        &[2, 0, 0x40, 1],
        // Another way of writing a word.
        &[1, 1, 1, 1],
        // No number in a word.
        &[0, 1, 0],
        // Full words, each led to by itself.
        &[0x80, 1, 2, 0, 2, 0],
    ];
    for bytes in refused {
        assert!(FeatureSet::read(bytes).is_err(), "{bytes:?}");
    }
}

#[test]
fn a_set_has_a_most() {
    let full = |words: u64| {
        let mut bytes = varint(words * 64);
        bytes.push(2);
        bytes.extend(varint(words - 1));
        bytes
    };
    let most = full(MOST_IN_SET / 64);
    let set = FeatureSet::read(&most).expect("just small enough");
    assert_eq!(set.greatest(), Some(MOST_IN_SET.cast_signed() - 1));
    assert!(FeatureSet::read(&full(MOST_IN_SET / 64 + 1)).is_err());
    assert!(FeatureSet::read(&full(1 << 57)).is_err());
    let one_more = encoded([-5]);
    assert!(set.union(FeatureSet::trusted(&one_more)).is_err());
}

fn varint(mut value: u64) -> Vec<u8> {
    let mut bytes = Vec::new();
    while value > 127 {
        bytes.push(value as u8 | 128);
        value >>= 7;
    }
    bytes.push(value as u8);
    bytes
}

/// Overlapping sets in any order: a collector is not quadratic.
#[test]
fn many_sets_are_collected_soon() {
    let mut collector = SetCollector::default();
    for i in 0..20_000_i64 {
        let start = i * 7919 % 20_000 * 25;
        let bytes = encoded((start..start + 500).step_by(2));
        collector
            .add_set(FeatureSet::trusted(&bytes))
            .expect("small");
    }
    // All of 0 to 500,448 but the odd ones below 25, then the odd ones to 500,473.
    assert_eq!(
        collector.set().expect("small").cardinality(),
        500_449 - 12 + 13
    );
}
