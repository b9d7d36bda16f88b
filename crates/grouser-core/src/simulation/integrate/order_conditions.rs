//! The order conditions of one-step methods: a solution is of an order if it treats all rooted
//! trees of that many nodes right. Source: Hairer, Norsett and Wanner (1993), Solving Ordinary
//! Differential Equations I, section II.2; Hairer and Wanner (1996), part II, section IV.7.

use nalgebra::{SMatrix, SVector};

/// A method of *N* stages, by the weights that sum earlier stages.
pub(super) struct Method<const N: usize> {
    /// In the points where rates are taken, *α*.
    pub(super) points: SMatrix<f64, N, N>,
    /// In stages that follow the motion along a line, *β*: of an explicit method the same.
    pub(super) lines: SMatrix<f64, N, N>,
}

impl<const N: usize> Method<N> {
    fn elementary_weights(&self, tree: &Tree) -> SVector<f64, N> {
        let branch = |tree| self.elementary_weights(tree);
        match tree.0.as_slice() {
            [] => SVector::repeat(1.0),
            [only] => self.lines * branch(only),
            many => many.iter().fold(SVector::repeat(1.0), |product, tree| {
                product.component_mul(&(self.points * branch(tree)))
            }),
        }
    }

    /// The greatest breach of the conditions of an order, by the weights *b* of the stages in a
    /// solution at a share of the step.
    pub(super) fn breach(&self, b: &SVector<f64, N>, order: usize, share: f64) -> f64 {
        let power = (0..order).fold(1.0, |power, _| power * share);
        let breach =
            |tree: &Tree| (b.dot(&self.elementary_weights(tree)) - power / tree.density()).abs();
        trees(order).iter().map(breach).fold(0.0, f64::max)
    }

    /// Checks that a solution is of an order, and of no higher one.
    pub(super) fn check(&self, b: &SVector<f64, N>, order: usize, share: f64) {
        /// Rounding error of coefficients of up to 165 with 16 digits, over a few products.
        const ROUNDING: f64 = 1e-12;
        for lower in 1..=order {
            let breach = self.breach(b, lower, share);
            assert!(breach < ROUNDING, "order {lower} at {share}: {breach:e}");
        }
        assert!(self.breach(b, order + 1, share) > 1e-5, "it is of a higher order at {share}");
    }
}

/// A rooted tree, by its branches.
#[derive(Clone, Debug, PartialEq, PartialOrd)]
pub(super) struct Tree(pub(super) Vec<Tree>);

impl Tree {
    fn order(&self) -> usize {
        1 + self.0.iter().map(Tree::order).sum::<usize>()
    }

    pub(super) fn density(&self) -> f64 {
        self.order() as f64 * self.0.iter().map(Tree::density).product::<f64>()
    }
}

/// All rooted trees with so many nodes: of those with one less, each with a leaf put anywhere.
pub(super) fn trees(order: usize) -> Vec<Tree> {
    if order == 1 {
        return vec![Tree(Vec::new())];
    }
    let mut all: Vec<Tree> = Vec::new();
    for grown in trees(order - 1).iter().flat_map(with_a_leaf) {
        if !all.contains(&grown) {
            all.push(grown);
        }
    }
    all
}

fn with_a_leaf(tree: &Tree) -> Vec<Tree> {
    let sorted = |mut branches: Vec<Tree>| {
        branches.sort_by(|one, other| one.partial_cmp(other).expect("an order"));
        Tree(branches)
    };
    let at_root = [tree.0.clone(), vec![Tree(Vec::new())]].concat();
    let mut grown = vec![sorted(at_root)];
    for (place, branch) in tree.0.iter().enumerate() {
        for taller in with_a_leaf(branch) {
            let mut branches = tree.0.clone();
            branches[place] = taller;
            grown.push(sorted(branches));
        }
    }
    grown
}

#[test]
fn there_are_as_many_trees_as_there_should_be() {
    let counts: Vec<usize> = (1..=6).map(|order| trees(order).len()).collect();
    assert_eq!(counts, [1, 1, 2, 4, 9, 20]);
}
