//! Plain statistics of a few numbers.

/// The mean; nothing of nothing.
pub fn mean(numbers: &[f64]) -> Option<f64> {
    (!numbers.is_empty()).then(|| numbers.iter().sum::<f64>() / numbers.len() as f64)
}

/// The standard deviation; nothing of fewer than two.
pub fn sd(numbers: &[f64]) -> Option<f64> {
    let mean = mean(numbers).filter(|_| numbers.len() > 1)?;
    let squares: f64 = numbers.iter().map(|number| (number - mean) * (number - mean)).sum();
    Some((squares / (numbers.len() - 1) as f64).sqrt())
}

/// The share of the items that fulfil a condition.
pub fn share<T>(all: &[T], holds: impl Fn(&T) -> bool) -> Option<f64> {
    (!all.is_empty()).then(|| all.iter().filter(|one| holds(one)).count() as f64 / all.len() as f64)
}

/// The number below which so great a share of them lies.
pub fn quantile(numbers: &[f64], share: f64) -> Option<f64> {
    let mut sorted = numbers.to_vec();
    sorted.sort_by(f64::total_cmp);
    let last = sorted.len().checked_sub(1)?;
    let place = share * last as f64;
    let (below, above) = (sorted[place.floor() as usize], sorted[place.ceil() as usize]);
    Some(below + (above - below) * place.fract())
}

/// The correlation of each number with the one before it, at a lag of one.
pub fn lag_1_autocorrelation(numbers: &[f64]) -> Option<f64> {
    let mean = mean(numbers).filter(|_| numbers.len() > 2)?;
    let off: Vec<f64> = numbers.iter().map(|number| number - mean).collect();
    let whole: f64 = off.iter().map(|off| off * off).sum();
    let next: f64 = off.windows(2).map(|pair| pair[0] * pair[1]).sum();
    (whole > 0.0).then(|| next / whole)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statistics_of_a_few_numbers() {
        assert_eq!((mean(&[]), sd(&[1.0]), quantile(&[], 0.5)), (None, None, None));
        assert_eq!((mean(&[1.0, 3.0]), sd(&[1.0, 3.0])), (Some(2.0), Some(2.0_f64.sqrt())));
        assert_eq!(share(&[1, 2, 3, 4], |&one| one > 1), Some(0.75));
        assert_eq!(quantile(&[4.0, 1.0, 2.0, 3.0, 5.0], 0.5), Some(3.0));
        assert_eq!(quantile(&[0.0, 10.0], 0.9), Some(9.0));
        assert_eq!(lag_1_autocorrelation(&[1.0, -1.0, 1.0, -1.0]), Some(-0.75));
        assert_eq!(lag_1_autocorrelation(&[2.0, 2.0, 2.0]), None);
    }
}
