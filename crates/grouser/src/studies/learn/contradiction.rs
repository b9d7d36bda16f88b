//! What was learnt, against what was believed beforehand.

use super::filter::Filter;

/// A number of a soil that was learnt to be what its prior hardly allows.
#[derive(Clone, Debug, PartialEq)]
pub struct Contradiction {
    /// The key of the soil, or `discrepancy` for what the model gets wrong in it.
    pub key: String,
    /// How far off its prior it is [standard deviations].
    pub deviations: f64,
}

/// A number so far off its prior contradicts it [standard deviations]: one sample of 16 000 is.
const FAR: f64 = 4.0;

/// Step of derivatives in coordinates that are standard normal.
const STEP: f64 = 0.01;

impl Filter {
    /// The soil's numbers that are far off what was believed of them.
    ///
    /// In coordinates z in which the prior is standard normal, a key is a function of a sum of them,
    /// v_i = f_i(Σ_j L_ij z_j), and its own standard score is that sum over the size of its terms.
    pub(super) fn contradictions(&self) -> Vec<Contradiction> {
        let (unknowns, mean) = (&self.unknowns, self.belief.mean.as_slice());
        let (of_soil, of_model) = mean.split_at(unknowns.of_soil());
        let keys: Vec<&str> = unknowns.keys().collect();
        // How each key goes with each coordinate, a column for each.
        let columns: Vec<Vec<f64>> = (0..of_soil.len())
            .map(|place| {
                let at = |step: f64| {
                    let mut coordinates = vec![0.0; mean.len()];
                    coordinates[place] = step;
                    unknowns.values(&coordinates).unwrap_or_else(|| vec![0.0; keys.len()])
                };
                at(STEP).iter().zip(at(-STEP)).map(|(ahead, behind)| ahead - behind).collect()
            })
            .collect();
        let score = |key: usize| {
            let size = columns.iter().map(|it| it[key].powi(2)).sum::<f64>().sqrt();
            let moved: f64 = columns.iter().zip(of_soil).map(|(it, mean)| it[key] * mean).sum();
            if size > 0.0 { moved / size } else { 0.0 }
        };
        let of_keys = keys.iter().enumerate().map(|(place, key)| (*key, score(place)));
        let farthest =
            of_model.iter().copied().max_by(|one, other| one.abs().total_cmp(&other.abs()));
        let of_model = farthest.map(|score| ("discrepancy", score));
        let all = of_keys.chain(of_model).filter(|(_, score)| score.abs() >= FAR);
        all.map(|(key, deviations)| Contradiction { key: key.to_owned(), deviations }).collect()
    }
}
