use super::classes::COUNT;
use serde::Serialize;

/// The number of windows of each class, by row, and predicted class, by column.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Confusion(pub [[u32; COUNT]; COUNT]);

impl Confusion {
    pub fn from_pairs(judged: impl Iterator<Item = (usize, usize)>) -> Confusion {
        let mut counts = [[0; COUNT]; COUNT];
        judged.for_each(|(is, predicted)| counts[is][predicted] += 1);
        Confusion(counts)
    }

    pub fn sum<'a>(all: impl Iterator<Item = &'a Confusion>) -> Confusion {
        let mut sum = [[0; COUNT]; COUNT];
        for (row, of) in all.flat_map(|one| one.0.iter().enumerate()) {
            sum[row].iter_mut().zip(of).for_each(|(sum, count)| *sum += count);
        }
        Confusion(sum)
    }

    /// The harmonic mean of precision and recall of a class; `None` if no window has this true or predicted class.
    pub fn f1(&self, class: usize) -> Option<f64> {
        let right = self.0[class][class];
        let is: u32 = self.0[class].iter().sum();
        let predicted: u32 = self.0.iter().map(|row| row[class]).sum();
        (is + predicted > 0).then(|| 2.0 * f64::from(right) / f64::from(is + predicted))
    }

    /// The mean of the F1 of these classes; the F1 of an absent class is 0.
    pub fn macro_f1(&self, classes: &[usize]) -> f64 {
        classes.iter().map(|&class| self.f1(class).unwrap_or(0.0)).sum::<f64>() / classes.len().max(1) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn f1_is_the_harmonic_mean_of_precision_and_recall() {
        // Three of four windows of class 0 are found, and one of four predictions of class 0 is wrong.
        let judged = [(0, 0), (0, 0), (0, 0), (0, 1), (1, 0), (1, 1), (2, 2)];
        let confusion = Confusion::from_pairs(judged.into_iter());
        assert_eq!(confusion.f1(0), Some(0.75));
        assert_eq!(confusion.f1(1), Some(0.5));
        assert_eq!(confusion.f1(2), Some(1.0));
        assert_eq!(confusion.f1(3), None);
        assert_eq!(confusion.macro_f1(&[0, 1, 2]), 0.75);
        assert_eq!(confusion.macro_f1(&[2, 3]), 0.5);
    }
}
