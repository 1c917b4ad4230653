//! Which settings are worth having.

/// What a setting costs and how wrong its picture is; less of either is better.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Point {
    pub(crate) cost: f64,
    pub(crate) error: f64,
}

impl Point {
    /// Whether a setting at `self` leaves no reason to choose one at `other`.
    pub(crate) fn dominates(&self, other: &Self) -> bool {
        self.cost <= other.cost && self.error <= other.error && self != other
    }
}

/// For each point the index of one that dominates it: of the Pareto front, with the least error; `None`
/// for the points of the front.
pub(crate) fn dominators(points: &[Point]) -> Vec<Option<usize>> {
    let on_front = |point: &Point| !points.iter().any(|other| other.dominates(point));
    let front: Vec<usize> = (0..points.len())
        .filter(|i| on_front(&points[*i]))
        .collect();
    points
        .iter()
        .map(|point| {
            front
                .iter()
                .copied()
                .filter(|i| points[*i].dominates(point))
                .min_by(|a, b| points[*a].error.total_cmp(&points[*b].error))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn front(points: &[(f64, f64)]) -> Vec<Option<usize>> {
        let points: Vec<_> = points
            .iter()
            .map(|&(cost, error)| Point { cost, error })
            .collect();
        dominators(&points)
    }

    #[test]
    fn the_front_is_what_nothing_dominates() {
        // The third costs more than the second and is no better; the last is worse in both.
        let found = front(&[(1.0, 9.0), (2.0, 3.0), (4.0, 3.0), (5.0, 0.0), (6.0, 7.0)]);
        assert_eq!(found, [None, None, Some(1), None, Some(3)]);
    }

    #[test]
    fn equal_settings_do_not_dominate_each_other() {
        assert_eq!(front(&[(1.0, 1.0), (1.0, 1.0)]), [None, None]);
        assert_eq!(front(&[]), []);
    }
}
