//! Which settings are worth having.

/// What a setting costs and how wrong its picture is; less of either is better.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Point {
    pub(crate) cost: f64,
    pub(crate) error: f64,
}

/// How a setting stands among others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Standing {
    /// On the Pareto front: nothing that costs as little is as good.
    OnFront,
    /// As one of the front in cost and error.
    EqualTo(usize),
    /// One of the front costs no more and is as good.
    DominatedBy(usize),
}

/// Smaller differences count for nothing.
const SLACK: f64 = 0.01;

fn no_more(a: f64, b: f64) -> bool {
    a <= b * (1.0 + SLACK)
}

impl Point {
    fn matches(&self, other: &Self) -> bool {
        no_more(self.cost, other.cost) && no_more(self.error, other.error)
    }

    /// Whether they differ by less than 1 % in both.
    pub(crate) fn equals(&self, other: &Self) -> bool {
        self.matches(other) && other.matches(self)
    }
}

/// How each point stands. From the cheapest on, a point is on the front if its error is by more than 1 % less than that of
/// the last on it, so that many small steps are worth having too; of several points that differ by less than 1 % the first
/// stands for all.
pub(crate) fn standings(points: &[Point]) -> Vec<Standing> {
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|a, b| {
        let [a, b] = [a, b].map(|i| (points[*i].cost, points[*i].error));
        a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    let mut front: Vec<usize> = Vec::new();
    for index in order {
        match front.last_mut() {
            Some(last) if points[*last].matches(&points[index]) => {
                // Of equals the first.
                if points[index].equals(&points[*last]) {
                    *last = index.min(*last);
                }
            }
            _ => front.push(index),
        }
    }
    let standing = |index: usize| {
        if front.contains(&index) {
            return Standing::OnFront;
        }
        let point = &points[index];
        let better = front.iter().copied().filter(|i| points[*i].matches(point));
        match better.min_by(|a, b| points[*a].error.total_cmp(&points[*b].error)) {
            Some(other) if point.equals(&points[other]) => Standing::EqualTo(other),
            Some(other) => Standing::DominatedBy(other),
            None => Standing::OnFront,
        }
    };
    (0..points.len()).map(standing).collect()
}

#[cfg(test)]
mod tests {
    use super::Standing::{DominatedBy, EqualTo, OnFront};
    use super::*;

    fn found(points: &[(f64, f64)]) -> Vec<Standing> {
        let points: Vec<_> = points
            .iter()
            .map(|&(cost, error)| Point { cost, error })
            .collect();
        standings(&points)
    }

    #[test]
    fn the_front_is_what_nothing_dominates() {
        // The third costs more than the second and is no better; the last is worse in both.
        let found = found(&[(1.0, 9.0), (2.0, 3.0), (4.0, 3.0), (5.0, 0.0), (6.0, 7.0)]);
        let expected = [OnFront, OnFront, DominatedBy(1), OnFront, DominatedBy(3)];
        assert_eq!(found, expected);
    }

    #[test]
    fn of_equal_settings_the_first_stands_for_all() {
        assert_eq!(found(&[(1.0, 1.0), (1.0, 1.0)]), [OnFront, EqualTo(0)]);
        assert_eq!(found(&[(1.0, 1.0), (0.995, 1.0)]), [OnFront, EqualTo(0)]);
        assert_eq!(found(&[]), []);
    }

    #[test]
    fn a_hundredth_is_not_worth_having() {
        let found = found(&[(1.0, 1.0), (1.5, 0.995), (2.0, 0.9), (2.0, 0.0), (9.0, 0.0)]);
        let expected = [
            OnFront,
            DominatedBy(0),
            DominatedBy(3),
            OnFront,
            DominatedBy(3),
        ];
        assert_eq!(found, expected);
    }
}
