//! A random forest that tells rows of figures apart by their classes.
//!
//! Breiman (2001): each tree is grown on a draw of rows with replacement, so many of each class, and looks at the root of the
//! number of figures at each branch, for the threshold that leaves the least Gini impurity. A row's chance of a class is the mean,
//! over the trees, of the share of that class in the leaf that the row comes to. A figure counts by how much impurity its
//! branches take away.

use homebody_core::random::Stream;

#[derive(Clone, Copy, Debug)]
pub struct Examples<'a> {
    /// The figures of each row; all rows have the same number.
    pub figures: &'a [Vec<f64>],
    /// The class of each row, below `classes`.
    pub class: &'a [usize],
    pub classes: usize,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Forest {
    trees: Vec<DecisionTree>,
    classes: usize,
    /// The impurity that each figure removed, in all trees.
    pub importance: Vec<f64>,
}

const DEEPEST: usize = 14;
/// Number of rows below which a branch is a leaf.
const LEAST_ROWS: usize = 4;

impl Forest {
    /// Grows so many trees. Each draws `each` rows of each class from those in `from`.
    pub fn grow(examples: Examples, from: &[Vec<usize>], each: &[usize], trees: usize, stream: &mut Stream) -> Forest {
        let figures = examples.figures.first().map_or(0, Vec::len);
        let mut forest = Forest { trees: Vec::new(), classes: examples.classes, importance: vec![0.0; figures] };
        for _ in 0..trees {
            let mut drawn = Vec::new();
            for (rows, &count) in from.iter().zip(each).filter(|(rows, _)| !rows.is_empty()) {
                drawn.extend((0..count).map(|_| rows[below(rows.len(), stream)]));
            }
            let mut growing = Growing { examples, nodes: Vec::new(), whole: drawn.len() as f64, stream };
            growing.branch(drawn, 0, &mut forest.importance);
            forest.trees.push(DecisionTree { nodes: growing.nodes });
        }
        forest
    }

    pub fn judge(&self, row: &[f64]) -> Vec<f64> {
        let mut chances = vec![0.0; self.classes];
        for tree in &self.trees {
            for (chance, share) in chances.iter_mut().zip(tree.judge(row)) {
                *chance += share / self.trees.len() as f64;
            }
        }
        chances
    }

    /// The most likely class of a row; of several the first.
    pub fn class_of(&self, row: &[f64]) -> usize {
        let chances = self.judge(row);
        (0..self.classes).rev().max_by(|&a, &b| chances[a].total_cmp(&chances[b])).unwrap_or(0)
    }
}

struct Growing<'a> {
    examples: Examples<'a>,
    nodes: Vec<DecisionNode>,
    whole: f64,
    stream: &'a mut Stream,
}

impl Growing<'_> {
    /// Adds the node of these rows, and those below it; returns its number.
    fn branch(&mut self, rows: Vec<usize>, depth: usize, importance: &mut [f64]) -> usize {
        let number = self.nodes.len();
        let mut counts = vec![0; self.examples.classes];
        rows.iter().for_each(|&row| counts[self.examples.class[row]] += 1);
        self.nodes.push(DecisionNode::Leaf(counts.iter().map(|&of| of as f64 / rows.len().max(1) as f64).collect()));
        let is_pure = counts.contains(&rows.len());
        if depth == DEEPEST || rows.len() < LEAST_ROWS || is_pure {
            return number;
        }
        let Some(Split { figure, threshold, gain }) = self.best_split(&rows, &counts) else { return number };
        importance[figure] += gain * rows.len() as f64 / self.whole;
        let (low, high) = rows.into_iter().partition(|&row| self.examples.figures[row][figure] <= threshold);
        let low = self.branch(low, depth + 1, importance);
        let high = self.branch(high, depth + 1, importance);
        self.nodes[number] = DecisionNode::Branch { figure, threshold, low, high };
        number
    }

    /// The best of as many figures as the root of their number.
    fn best_split(&mut self, rows: &[usize], counts: &[usize]) -> Option<Split> {
        let Examples { figures, class, .. } = self.examples;
        let count = figures[rows[0]].len();
        let looked_at = (count as f64).sqrt().ceil() as usize;
        let before = gini(rows.len(), counts);
        let mut best: Option<Split> = None;
        for _ in 0..looked_at {
            let figure = below(count, self.stream);
            let mut values: Vec<(f64, usize)> = rows.iter().map(|&row| (figures[row][figure], class[row])).collect();
            values.sort_by(|a, b| a.0.total_cmp(&b.0));
            let (mut low, mut high) = (vec![0; counts.len()], counts.to_vec());
            for at in 1..values.len() {
                low[values[at - 1].1] += 1;
                high[values[at - 1].1] -= 1;
                if values[at - 1].0 == values[at].0 {
                    continue;
                }
                let above = values.len() - at;
                let after = at as f64 * gini(at, &low) + above as f64 * gini(above, &high);
                let gain = before - after / values.len() as f64;
                if gain > best.as_ref().map_or(1e-12, |best| best.gain) {
                    best = Some(Split { figure, threshold: (values[at - 1].0 + values[at].0) / 2.0, gain });
                }
            }
        }
        best
    }
}

struct Split {
    figure: usize,
    threshold: f64,
    gain: f64,
}

#[derive(Clone, Debug, PartialEq)]
struct DecisionTree {
    /// The root first.
    nodes: Vec<DecisionNode>,
}

#[derive(Clone, Debug, PartialEq)]
enum DecisionNode {
    /// The share of each class among its rows.
    Leaf(Vec<f64>),
    Branch {
        figure: usize,
        threshold: f64,
        low: usize,
        high: usize,
    },
}

impl DecisionTree {
    fn judge(&self, row: &[f64]) -> &[f64] {
        let mut at = 0;
        loop {
            match &self.nodes[at] {
                DecisionNode::Leaf(shares) => return shares,
                DecisionNode::Branch { figure, threshold, low, high } => {
                    at = if row[*figure] <= *threshold { *low } else { *high };
                }
            }
        }
    }
}

/// The chance that two rows drawn from these differ in their class.
fn gini(rows: usize, counts: &[usize]) -> f64 {
    let share = |&of: &usize| of as f64 / rows as f64;
    counts.iter().map(share).map(|share| share * (1.0 - share)).sum()
}

fn below(count: usize, stream: &mut Stream) -> usize {
    ((stream.unit() * count as f64) as usize).min(count - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three classes around the corners of a triangle, and a figure that says nothing.
    fn examples(spread: f64) -> (Vec<Vec<f64>>, Vec<usize>) {
        const CORNERS: [(f64, f64); 3] = [(0.0, 0.0), (4.0, 0.0), (0.0, 4.0)];
        let stream = &mut Stream::named(7, "corners");
        let row = |class: usize, stream: &mut Stream| {
            let (x, y) = CORNERS[class];
            vec![stream.normal(x, spread), stream.normal(y, spread), stream.normal(0.0, 1.0)]
        };
        let class: Vec<usize> = (0..300).map(|row| row % 3).collect();
        (class.iter().map(|&class| row(class, stream)).collect(), class)
    }

    fn grown(spread: f64) -> Forest {
        let (figures, class) = examples(spread);
        let from: Vec<Vec<usize>> =
            (0..3).map(|of| (0..class.len()).filter(|&row| class[row] == of).collect()).collect();
        let examples = Examples { figures: &figures, class: &class, classes: 3 };
        Forest::grow(examples, &from, &[100; 3], 30, &mut Stream::named(1, "forest"))
    }

    #[test]
    fn separates_distant_classes_by_their_figures() {
        let forest = grown(0.5);
        for (class, row) in [(0, [0.1, 0.2, 0.0]), (1, [3.8, 0.1, 0.0]), (2, [0.0, 4.3, 0.0])] {
            assert_eq!(forest.class_of(&row), class);
            let chances = forest.judge(&row);
            assert!(chances[class] > 0.9 && (chances.iter().sum::<f64>() - 1.0).abs() < 1e-9, "{chances:?}");
        }
        assert!(forest.importance[2] < 0.1 * forest.importance[0], "{:?}", forest.importance);
    }

    #[test]
    fn classes_that_lie_together_are_guessed() {
        let chances = grown(100.0).judge(&[0.0, 0.0, 0.0]);
        assert!(chances.iter().all(|&chance| chance < 0.8), "{chances:?}");
    }

    #[test]
    fn never_predicts_a_class_without_rows() {
        let figures = vec![vec![0.0], vec![1.0], vec![0.1], vec![0.9]];
        let class = [0, 2, 0, 2];
        let examples = Examples { figures: &figures, class: &class, classes: 3 };
        let from = [vec![0, 2], vec![], vec![1, 3]];
        let forest = Forest::grow(examples, &from, &[5, 5, 5], 10, &mut Stream::named(1, "forest"));
        assert_eq!([0.0, 0.5, 1.0].map(|value| forest.judge(&[value])[1]), [0.0; 3]);
        assert_eq!([forest.class_of(&[0.0]), forest.class_of(&[1.0])], [0, 2]);
    }
}
