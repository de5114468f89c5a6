//! The exponential in single precision: of sums and products alone, so that it is the same on every machine, and quick.

/// `e` to the power of a number; a number so small or large that a float has no normal result counts as the nearest that has.
pub(crate) fn exp(exponent: f32) -> f32 {
    const LOG2_E: f32 = std::f32::consts::LOG2_E;
    /// The logarithm of 2 in two parts, of which the first has so few digits that whole numbers times it are exact.
    const LN_2_HIGH: f32 = 0.693_359_4;
    const LN_2_LOW: f32 = -2.121_944_4e-4;
    /// A float of this size has no digits after the point: adding it rounds.
    const ROUNDS: f32 = 12_582_912.0;
    let exponent = exponent.clamp(-87.0, 88.0);
    let rounded = exponent * LOG2_E + ROUNDS;
    let whole = rounded - ROUNDS;
    let rest = exponent - whole * LN_2_HIGH - whole * LN_2_LOW;
    // The series of the rest, which is at most half of the logarithm of 2 on either side of nothing.
    let series = [1.0 / 720.0, 1.0 / 120.0, 1.0 / 24.0, 1.0 / 6.0, 0.5, 1.0, 1.0];
    let value = series.into_iter().fold(0.0, |value, next| value * rest + next);
    // The last bits of what is rounded are the whole number: taking them is quicker than to convert it.
    let whole = rounded.to_bits().wrapping_sub(ROUNDS.to_bits());
    value * f32::from_bits(whole.wrapping_add(127) << 23)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_exponential_to_a_millionth() {
        for step in -8_600..8_700 {
            let exponent = step as f32 / 100.0;
            let right = libm::exp(f64::from(exponent));
            let off = (f64::from(exp(exponent)) - right).abs() / right;
            assert!(off < 1e-6, "{exponent}: {off}");
        }
        assert!(exp(f32::NEG_INFINITY) < 1e-37 && exp(-200.0) < 1e-37 && exp(200.0).is_finite());
    }
}
