//! Palettes for pictures of more colours than a palette has places.
//!
//! Neighbouring colours are merged, always the two that this changes least, until there is a place for each (pairwise
//! nearest neighbours, Equitz 1989): of a few colours too many only a few change, and no place is wasted. Then every colour
//! of the palette becomes the mean of those that it stands for (Lloyd's algorithm).

use std::collections::HashMap;

/// Places of a palette.
pub(super) const PLACES: usize = 256;

/// Merging takes time with the square of the number of colours; more than these are first put together into a grid of cells.
const MERGED: usize = 4096;

/// Means are taken over so many colours at most, or else over a grid of 64 levels a channel.
const COUNTED: usize = 1 << 16;

/// How often means are taken.
const PASSES: usize = 4;

/// Colours of a picture and how many pixels have each.
#[derive(Clone, Copy, Debug)]
struct Point {
    rgb: [u8; 3],
    weight: u64,
}

/// Colours that share a place.
#[derive(Clone, Copy, Debug, Default)]
struct Cluster {
    mean: [f64; 3],
    weight: f64,
}

impl Cluster {
    fn of(point: &Point) -> Self {
        Self {
            mean: point.rgb.map(f64::from),
            weight: point.weight as f64,
        }
    }

    fn add(&mut self, other: &Self) {
        self.weight += other.weight;
        let share = other.weight / self.weight;
        for (mean, more) in self.mean.iter_mut().zip(other.mean) {
            *mean += (more - *mean) * share;
        }
    }

    fn rgb(&self) -> [u8; 3] {
        self.mean.map(|level| level.round() as u8)
    }
}

/// The squares of the differences, summed.
fn distance(a: [u8; 3], b: [u8; 3]) -> u32 {
    let square = |i: usize| u32::from(a[i].abs_diff(b[i])).pow(2);
    square(0) + square(1) + square(2)
}

/// The index of the nearest colour of a palette.
pub(super) fn nearest(palette: &[[u8; 3]], rgb: [u8; 3]) -> usize {
    let indices = 0..palette.len();
    indices
        .min_by_key(|index| distance(palette[*index], rgb))
        .unwrap_or(0)
}

/// As many colours as there are places, near those of the pixels, of which there are more.
pub(super) fn palette(pixels: impl Iterator<Item = [u8; 3]> + Clone) -> Vec<[u8; 3]> {
    let points = points(pixels);
    let clusters = clusters(&points);
    let palette = merged(clusters).iter().map(Cluster::rgb).collect();
    improved(palette, &points)
}

/// The colours of the pixels, or means of those in each cell of a grid; in order.
fn points(pixels: impl Iterator<Item = [u8; 3]> + Clone) -> Vec<Point> {
    let mut weights: HashMap<[u8; 3], u64> = HashMap::new();
    for pixel in pixels.clone() {
        *weights.entry(pixel).or_default() += 1;
        if weights.len() > COUNTED {
            let pixels = pixels.map(|rgb| Point { rgb, weight: 1 });
            let point = |cluster: &Cluster| Point {
                rgb: cluster.rgb(),
                weight: cluster.weight as u64,
            };
            return cells(pixels, 6).iter().map(point).collect();
        }
    }
    let mut points: Vec<_> = weights
        .into_iter()
        .map(|(rgb, weight)| Point { rgb, weight })
        .collect();
    points.sort_unstable_by_key(|point| point.rgb);
    points
}

/// What is in the cells of a grid of so many bits a channel, where there is anything.
fn cells(points: impl Iterator<Item = Point>, bits: u32) -> Vec<Cluster> {
    let mut cells = vec![Cluster::default(); 1 << (3 * bits)];
    for point in points {
        let [r, g, b] = point.rgb.map(|level| usize::from(level >> (8 - bits)));
        cells[(r << bits | g) << bits | b].add(&Cluster::of(&point));
    }
    cells.retain(|cell| cell.weight > 0.0);
    cells
}

/// Few enough to be merged.
fn clusters(points: &[Point]) -> Vec<Cluster> {
    if points.len() <= MERGED {
        return points.iter().map(Cluster::of).collect();
    }
    let finer = [6, 5].into_iter();
    finer
        .map(|bits| cells(points.iter().copied(), bits))
        .find(|cells| cells.len() <= MERGED && cells.len() >= PLACES)
        .unwrap_or_else(|| cells(points.iter().copied(), 4))
}

/// How much worse it is to have one mean for both.
fn loss(a: &Cluster, b: &Cluster) -> f64 {
    let [red, green, blue] = [0, 1, 2].map(|i| a.mean[i] - b.mean[i]);
    (red * red + green * green + blue * blue) * a.weight * b.weight / (a.weight + b.weight)
}

/// The partner that a cluster is merged with at the least loss, and that loss.
fn partner(clusters: &[Cluster], index: usize) -> (f64, usize) {
    let mut best = (f64::INFINITY, index);
    for (other, cluster) in clusters.iter().enumerate() {
        if other != index {
            let loss = loss(&clusters[index], cluster);
            if loss < best.0 {
                best = (loss, other);
            }
        }
    }
    best
}

/// As many clusters as there are places, if there are more.
fn merged(mut clusters: Vec<Cluster>) -> Vec<Cluster> {
    let indices = 0..clusters.len();
    let mut partners: Vec<_> = indices.map(|index| partner(&clusters, index)).collect();
    while clusters.len() > PLACES {
        let indices = 0..clusters.len();
        let least = indices.min_by(|a, b| partners[*a].0.total_cmp(&partners[*b].0));
        let Some(kept) = least else { break };
        let gone = partners[kept].1;
        let cluster = clusters[gone];
        clusters[kept].add(&cluster);
        // The last takes the place of the one that is gone.
        let last = clusters.len() - 1;
        clusters.swap_remove(gone);
        partners.swap_remove(gone);
        let kept = if kept == last { gone } else { kept };
        for (index, known) in partners.iter_mut().enumerate() {
            let (_, of) = *known;
            if index == kept || of == kept || of == gone {
                *known = partner(&clusters, index);
            } else if of == last {
                known.1 = gone;
            }
        }
    }
    clusters
}

/// The palette whose colours are the means of those they stand for. A place that stands for none, or for the colour of
/// another, is given to the colour that is worst off.
fn improved(mut palette: Vec<[u8; 3]>, points: &[Point]) -> Vec<[u8; 3]> {
    let mut best = (u64::MAX, palette.clone());
    for _ in 0..PASSES {
        let mut clusters = vec![Cluster::default(); palette.len()];
        let mut losses = Vec::with_capacity(points.len());
        for point in points {
            let index = nearest(&palette, point.rgb);
            clusters[index].add(&Cluster::of(point));
            losses.push(point.weight * u64::from(distance(palette[index], point.rgb)));
        }
        let loss: u64 = losses.iter().sum();
        if loss < best.0 {
            best = (loss, palette.clone());
        }
        let mut worst: Vec<_> = (0..points.len()).filter(|i| losses[*i] > 0).collect();
        worst.sort_by_key(|index| std::cmp::Reverse(losses[*index]));
        let mut worst = worst.into_iter().map(|index| points[index].rgb);
        let mut taken = std::collections::HashSet::new();
        let mut wasted = Vec::new();
        for (index, cluster) in clusters.iter().enumerate() {
            if cluster.weight > 0.0 && taken.insert(cluster.rgb()) {
                palette[index] = cluster.rgb();
            } else {
                wasted.push(index);
            }
        }
        for index in wasted {
            if let Some(rgb) = worst.find(|rgb| taken.insert(*rgb)) {
                palette[index] = rgb;
            }
        }
    }
    best.1
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Root of the mean square error of a channel, and the colours that are used.
    fn quality(pixels: &[[u8; 3]]) -> (f64, usize) {
        let palette = palette(pixels.iter().copied());
        assert_eq!(palette.len(), PLACES);
        let mut used = std::collections::HashSet::new();
        let mut sum = 0_u64;
        for pixel in pixels {
            let rgb = palette[nearest(&palette, *pixel)];
            used.insert(rgb);
            sum += u64::from(distance(rgb, *pixel));
        }
        ((sum as f64 / (3 * pixels.len()) as f64).sqrt(), used.len())
    }

    #[test]
    fn of_a_few_colours_too_many_only_a_few_change() {
        // A sky, and spheres in shades of three colours.
        let sky = (0..124).flat_map(|i| [[128 + i, 180 + i / 2, 255]; 90]);
        let shades = (0..154_u8).flat_map(|i| {
            [[i, i / 2, 9], [9, i, i / 2], [i, 9, i]][usize::from(i % 3)..][..1].repeat(7)
        });
        let pixels: Vec<_> = sky.chain(shades).collect();
        let colors: std::collections::HashSet<_> = pixels.iter().collect();
        assert_eq!(colors.len(), 278);
        let (error, used) = quality(&pixels);
        assert_eq!(used, PLACES);
        assert!(error < 0.35, "{error}");
    }

    #[test]
    fn every_place_is_used_whatever_the_number_of_colours() {
        // A cube of 10,648 and of 79,507 colours.
        for step in [12, 6] {
            let levels = || (0..=255_u8).step_by(step);
            let pixels: Vec<_> = levels()
                .flat_map(|r| levels().flat_map(move |g| levels().map(move |b| [r, g, b])))
                .collect();
            let (error, used) = quality(&pixels);
            assert_eq!(used, PLACES, "{}", pixels.len());
            // Cubes of 40 levels, of which 256 fill all colours, have 11.6.
            assert!(error < 12.0, "{error} of {}", pixels.len());
        }
    }
}
