//! The number of errands that makes up for a changed amount of movement.
//!
//! Much walking is unavoidable: to the toilet, to the table, to the door. A resident with half of the movement leaves out
//! more than half of the errands.
//!
//! We assume that errands make up for the rest: necessary and errand walks are counted by hour of the day, older days with
//! less weight, and errands are left out or added until the sum matches.
//!
//! Left out: that necessary walks become shorter, too.

/// Distances walked by hour of the day, of need and on errands.
#[derive(Clone, Debug)]
pub struct Errands {
    need_m: [f64; 24],
    /// Errands that were possible, whether run or not.
    chances: [f64; 24],
    /// Length of an errand, with the way back.
    errand_m: f64,
    run: f64,
}

/// Initial estimates (our choice): errands an hour, metres of each, and need of movement.
const BEFORE: (f64, f64, f64) = (3.0, 8.0, 10.0);

/// Hours within which the need of movement is made up (our choice): more than the errands that some of these hours
/// have.
const NEAR_H: usize = 5;

/// Weight of yesterday in comparison with today (our choice).
const KEPT: f64 = 0.9;

impl Errands {
    pub fn new() -> Errands {
        let (chances, errand_m, need_m) = BEFORE;
        Errands { need_m: [need_m; 24], chances: [chances; 24], errand_m: errand_m * 10.0, run: 10.0 }
    }

    pub fn wake(&mut self) {
        let fade = |value: &mut f64| *value *= KEPT;
        self.need_m.iter_mut().for_each(fade);
        self.chances.iter_mut().for_each(fade);
    }

    pub fn need(&mut self, hour: f64, metres: f64) {
        self.need_m[hour as usize % 24] += metres;
    }

    pub fn chance(&mut self, hour: f64, runs: f64) {
        self.chances[hour as usize % 24] += idle(runs);
    }

    /// Adds an errand; its way back is added separately.
    pub fn run(&mut self) {
        self.run += 1.0;
    }

    pub fn errand(&mut self, metres: f64) {
        self.errand_m += metres;
    }

    /// The probability of running an errand at this factor of movement; above 1, the number of errands.
    pub fn times(&self, movement: f64, hour: f64) -> f64 {
        let around = |of: &[f64; 24]| (24 - NEAR_H..=24 + NEAR_H).map(|by| of[(hour as usize + by) % 24]).sum::<f64>();
        let errands_m = around(&self.chances) * self.errand_m / self.run;
        let times = (movement + (movement - 1.0) * around(&self.need_m) / errands_m.max(1.0)).max(0.0);
        times * idle(times) * hurried(times)
    }
}

/// Fewer errands leave more occasions for one: the factor if none were run.
fn idle(runs: f64) -> f64 {
    /// Share of errands that come from having left out the one before (our choice, measured).
    const MORE: f64 = 0.25;
    1.0 - MORE * (1.0 - runs.min(1.0))
}

/// More errands leave less sitting time between them: the factor on it.
fn hurried(runs: f64) -> f64 {
    /// Duration of an errand in comparison with the sitting between two (our choice, measured).
    const TAKES: f64 = 0.35;
    /// Smallest share of the usual time that a person sits (our choice).
    const LEAST: f64 = 0.1;
    1.0 / (1.0 - TAKES * (runs - 1.0).max(0.0)).max(LEAST)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errands_and_needs_together_add_up_to_the_routine() {
        let mut errands = Errands::new();
        for day in 0..30 {
            errands.wake();
            for hour in 0..24 {
                // 20 m of need, and four errands of 10 m.
                errands.need(f64::from(hour), 20.0);
                for _ in 0..4 {
                    errands.chance(f64::from(hour), 1.0);
                    errands.run();
                    errands.errand(10.0);
                }
            }
            assert!(errands.times(1.0, 12.0) == 1.0, "on day {day}");
        }
        for movement in [0.5, 0.8, 1.5] {
            let run = errands.times(movement, 12.0);
            let runs = movement + (movement - 1.0) / 2.0;
            let walked = 20.0 + 40.0 * run / (idle(runs) * hurried(runs));
            assert!((walked / 60.0 - movement).abs() < 0.02, "{walked}");
        }
        assert_eq!(errands.times(0.1, 12.0), 0.0);
    }
}
