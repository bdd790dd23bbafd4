//! Quantiles of a few numbers.

/// The number below which a share of all numbers is; sorts them.
pub fn quantile(numbers: &mut [f64], share: f64) -> f64 {
    numbers.sort_by(f64::total_cmp);
    let last = numbers.len().saturating_sub(1) as f64;
    let position = (last * share).round() as usize;
    numbers.get(position).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_of_the_sorted_numbers() {
        let mut numbers: Vec<f64> = (0..=100).rev().map(f64::from).collect();
        assert_eq!(quantile(&mut numbers, 0.5), 50.0);
        assert_eq!(quantile(&mut numbers, 0.95), 95.0);
        assert_eq!(quantile(&mut [3.0], 0.95), 3.0);
        assert!(quantile(&mut [], 0.5).is_nan());
    }
}
