//! Names of curves beside them, where none hides another.

/// Middles as near to the wanted ones as their heights allow within a range, in the same order.
/// What finds no room there goes beyond its lower end.
///
/// Three names of curves that end at one height, each 10 high:
///
/// ```
/// use grouser_draw::labels::spread;
///
/// assert_eq!(spread(&[50.0, 50.0, 50.0], &[10.0; 3], [0.0, 100.0]), [40.0, 50.0, 60.0]);
/// ```
///
/// * `wanted`: ascending
/// * `heights`: of the names, as many
#[must_use]
pub fn spread(wanted: &[f64], heights: &[f64], [top, bottom]: [f64; 2]) -> Vec<f64> {
    // Neighbours that would overlap become one block, whose members then stand close and are as
    // near to their places as they can be on average.
    struct Block {
        members: usize,
        height: f64,
        /// Sum of where its first name would begin by the wish of each member.
        wishes: f64,
    }
    let mut blocks: Vec<Block> = Vec::new();
    let first = |block: &Block| {
        let wish = block.wishes / block.members as f64;
        wish.min(bottom - block.height).max(top)
    };
    for (wish, height) in wanted.iter().zip(heights) {
        blocks.push(Block { members: 1, height: *height, wishes: wish - height / 2.0 });
        while let [.., above, below] = &blocks[..] {
            if first(above) + above.height <= first(below) {
                break;
            }
            let wishes = above.wishes + below.wishes - above.height * below.members as f64;
            let (members, height) = (above.members + below.members, above.height + below.height);
            blocks.truncate(blocks.len() - 2);
            blocks.push(Block { members, height, wishes });
        }
    }
    let mut heights = heights.iter();
    let mut middles = Vec::with_capacity(wanted.len());
    for block in &blocks {
        let mut upper = first(block);
        for height in heights.by_ref().take(block.members) {
            middles.push(upper + height / 2.0);
            upper += height;
        }
    }
    middles
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_with_room_stand_where_their_curves_end() {
        assert_eq!(spread(&[20.0, 60.0], &[10.0, 10.0], [0.0, 100.0]), [20.0, 60.0]);
    }

    #[test]
    fn names_that_would_overlap_share_the_distance() {
        assert_eq!(spread(&[50.0, 52.0], &[10.0; 2], [0.0, 100.0]), [46.0, 56.0]);
    }

    #[test]
    fn names_stay_within_the_range_and_never_overlap() {
        let wanted = [1.0, 2.0, 97.0, 98.0, 99.0];
        let middles = spread(&wanted, &[12.0; 5], [0.0, 100.0]);
        assert!(middles.windows(2).all(|pair| pair[1] - pair[0] >= 12.0 - 1e-9), "{middles:?}");
        assert!(middles[0] >= 6.0 && middles[4] <= 94.0 + 1e-9, "{middles:?}");
    }
}
