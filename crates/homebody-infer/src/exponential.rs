//! The exponential function in single precision from sums and products only: equal on all machines, and fast.

/// A result outside of the normal floats becomes the nearest normal float.
pub(crate) fn exp(exponent: f32) -> f32 {
    const LOG2_E: f32 = std::f32::consts::LOG2_E;
    /// ln 2 in two parts. The first has so few digits that its products with whole numbers are exact.
    const LN_2_HIGH: f32 = 0.693_359_4;
    const LN_2_LOW: f32 = -2.121_944_4e-4;
    /// A float of this size has no fractional digits, so adding it rounds.
    const ROUNDS: f32 = 12_582_912.0;
    let exponent = exponent.clamp(-87.0, 88.0);
    let rounded = exponent * LOG2_E + ROUNDS;
    let whole = rounded - ROUNDS;
    let rest = exponent - whole * LN_2_HIGH - whole * LN_2_LOW;
    // Taylor series of the rest, which is at most ln 2 / 2 in size.
    let series = [1.0 / 720.0, 1.0 / 120.0, 1.0 / 24.0, 1.0 / 6.0, 0.5, 1.0, 1.0];
    let value = series.into_iter().fold(0.0, |value, next| value * rest + next);
    // The last bits are the whole number; reading them is faster than a conversion.
    let whole = rounded.to_bits().wrapping_sub(ROUNDS.to_bits());
    value * f32::from_bits(whole.wrapping_add(127) << 23)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exp_is_exact_to_a_millionth() {
        for step in -8_600..8_700 {
            let exponent = step as f32 / 100.0;
            let right = libm::exp(f64::from(exponent));
            let off = (f64::from(exp(exponent)) - right).abs() / right;
            assert!(off < 1e-6, "{exponent}: {off}");
        }
        assert!(exp(f32::NEG_INFINITY) < 1e-37 && exp(-200.0) < 1e-37 && exp(200.0).is_finite());
    }
}
