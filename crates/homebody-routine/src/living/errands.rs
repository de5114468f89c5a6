//! How many errands make somebody move so many times as much as usual.
//!
//! Much of what somebody walks is not theirs to leave out: to the toilet, to the table, to the door. Who moves half as much
//! leaves out more than half of the errands.
//!
//! We assume that the errands make up for the rest: what is walked of need and on errands is counted for each hour of the
//! day, older days less and less, and errands are left out, or added, so that both together come to what is said.
//!
//! Left out: that the ways of need become shorter, too.

/// How far somebody walks in each hour of the day, of need and on errands.
#[derive(Clone, Debug)]
pub struct Errands {
    need_m: [f64; 24],
    /// Errands that there would have been, whether they were run or not.
    chances: [f64; 24],
    /// How far one leads, and back.
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

    /// A new day.
    pub fn wake(&mut self) {
        let fade = |value: &mut f64| *value *= KEPT;
        self.need_m.iter_mut().for_each(fade);
        self.chances.iter_mut().for_each(fade);
    }

    /// A way that had to be.
    pub fn need(&mut self, hour: f64, metres: f64) {
        self.need_m[hour as usize % 24] += metres;
    }

    /// Might have run an errand, and did with this chance.
    pub fn chance(&mut self, hour: f64, runs: f64) {
        self.chances[hour as usize % 24] += idle(runs);
    }

    /// Ran one; its way back is told apart.
    pub fn run(&mut self) {
        self.run += 1.0;
    }

    /// A way of an errand.
    pub fn errand(&mut self, metres: f64) {
        self.errand_m += metres;
    }

    /// With which chance an errand is run where there is so many times the usual movement; above 1, how many more there are.
    pub fn times(&self, movement: f64, hour: f64) -> f64 {
        let around = |of: &[f64; 24]| (24 - NEAR_H..=24 + NEAR_H).map(|by| of[(hour as usize + by) % 24]).sum::<f64>();
        let errands_m = around(&self.chances) * self.errand_m / self.run;
        let times = (movement + (movement - 1.0) * around(&self.need_m) / errands_m.max(1.0)).max(0.0);
        times * idle(times) * hurried(times)
    }
}

/// Who runs fewer errands has more occasions for one: how many of them there would be if all were run.
fn idle(runs: f64) -> f64 {
    /// Share of errands that come from having left out the one before (our choice, measured).
    const MORE: f64 = 0.25;
    1.0 - MORE * (1.0 - runs.min(1.0))
}

/// Who runs more errands sits less between them, and runs none meanwhile: how much less they have to sit.
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
    fn errands_and_needs_together_come_to_what_is_said() {
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
            // Of the occasions that there are more.
            let run = errands.times(movement, 12.0);
            let runs = movement + (movement - 1.0) / 2.0;
            let walked = 20.0 + 40.0 * run / (idle(runs) * hurried(runs));
            assert!((walked / 60.0 - movement).abs() < 0.02, "{walked}");
        }
        assert_eq!(errands.times(0.1, 12.0), 0.0);
    }
}
