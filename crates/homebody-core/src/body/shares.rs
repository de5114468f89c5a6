//! The lengths and radii of limbs, as shares of the height.

/// Shares of the height, by Drillis and Contini (1966).
pub(super) mod share {
    pub const HIP: f64 = 0.530;
    pub const THIGH: f64 = 0.245;
    pub const SHANK: f64 = 0.246;
    pub const FOOT: f64 = 0.152;
    pub const TRUNK: f64 = 0.288;
    pub const UPPER_ARM: f64 = 0.186;
    pub const FOREARM: f64 = 0.146;
    pub const HAND: f64 = 0.108;
    pub const SHOULDER_HALF_WIDTH: f64 = 0.129;
    /// Half widths of the trunk below the armpits, as shares of the height (our choice).
    pub const CHEST_HALF_WIDTH: f64 = 0.11;
    pub const HIP_HALF_WIDTH: f64 = 0.0955;
    /// From the shoulders' line to the top of the head.
    pub const ABOVE_SHOULDERS: f64 = 0.182;
}

/// Radii as shares of the height, for a body of usual girth, after girths of adults.
pub(super) mod thick {
    pub const NECK: f64 = 0.034;
    pub const HEAD: f64 = 0.055;
    pub const TRUNK: f64 = 0.068;
    pub const THIGH: f64 = 0.045;
    pub const SHANK: f64 = 0.030;
    pub const FOOT: f64 = 0.020;
    pub const UPPER_ARM: f64 = 0.027;
    pub const FOREARM: f64 = 0.022;
}
