//! Random scene texts, of ordinary numbers or with extreme ones among them.

use super::random::Random;

/// Numbers that are hard on arithmetic; all can be read as `f32`.
const EXTREME: [&str; 18] = [
    "0",
    "1",
    "-1",
    "0.5",
    "1e-45",
    "1e-38",
    "-1e-30",
    "1e-19",
    "1e-8",
    "0.9999999",
    "1.0000001",
    "20000",
    "-1e5",
    "1e9",
    "1e18",
    "-1e19",
    "1e30",
    "3.4e38",
];

/// A random scene text, of ordinary numbers or with extreme ones among them.
pub struct Writer<'r> {
    pub random: &'r Random,
    /// One number in so many is extreme; none if it is 0.
    pub extreme: usize,
    /// Coordinates are up to this large.
    pub scale: f64,
    /// Shapes lie along the axes, all but along them, touch each other and have extreme ratios.
    pub aimed: bool,
}

impl Writer<'_> {
    fn is_extreme(&self) -> bool {
        self.extreme != 0 && self.random.below(self.extreme) == 0
    }

    /// A coordinate.
    fn number(&self) -> String {
        if self.is_extreme() {
            return EXTREME[self.random.below(EXTREME.len())].to_owned();
        }
        match self.random.below(8) {
            0 => "0".to_owned(),
            1 => format!("{}", self.random.below(7) as f64 - 3.0),
            _ => format!("{:e}", self.random.between(-self.scale, self.scale) as f32),
        }
    }

    /// A whole number of steps, or all but that.
    fn step(&self) -> f64 {
        let whole = (self.random.below(9) as f64 - 4.0) * self.scale / 4.0;
        match self.random.below(6) {
            0 => whole * (1.0 + self.random.sign() * self.random.log_between(1e-8, 1e-3)),
            1 => whole + self.random.sign() * self.random.log_between(1e-30, 1e-3) * self.scale,
            _ => whole,
        }
    }

    fn steps(&self, count: usize) -> String {
        let all: Vec<_> = (0..count)
            .map(|_| format!("{:e}", self.step() as f32))
            .collect();
        all.join(" ")
    }

    /// A component of a normal: 0, all but 0, or anything.
    fn component(&self) -> f64 {
        match self.random.below(4) {
            0 => 0.0,
            1 => self.random.sign(),
            2 => self.random.sign() * self.random.log_between(1e-38, 1e-3),
            _ => self.random.between(-1.0, 1.0),
        }
    }

    fn aimed_shape(&self) -> String {
        match self.random.below(3) {
            0 => {
                let size = match self.random.below(3) {
                    0 => self.scale * self.random.log_between(1e-8, 1e3),
                    _ => self.step().abs().max(1e-3 * self.scale),
                };
                format!("0 {} {:e}", self.steps(3), size as f32)
            }
            1 => {
                let normal = [(); 3].map(|()| format!("{:e}", self.component() as f32));
                format!("1 {} {:e}", normal.join(" "), self.step() as f32)
            }
            _ => format!("2 {} 0 0 0 0", self.steps(9)),
        }
    }

    /// A number of at least 0.
    fn positive(&self, most: f64) -> String {
        if self.is_extreme() {
            return EXTREME[self.random.below(EXTREME.len())]
                .trim_start_matches('-')
                .to_owned();
        }
        match self.random.below(6) {
            0 => "0".to_owned(),
            1 => "1".to_owned(),
            _ => format!("{:e}", self.random.between(0.0, most) as f32),
        }
    }

    fn numbers(&self, count: usize) -> String {
        let all: Vec<_> = (0..count).map(|_| self.number()).collect();
        all.join(" ")
    }

    fn positives(&self, count: usize, most: f64) -> String {
        let all: Vec<_> = (0..count).map(|_| self.positive(most)).collect();
        all.join(" ")
    }

    fn material(&self) -> String {
        let colors = self.positives(9, 1.0);
        let (reflection, shininess) = (self.positive(1.0), self.positive(100.0));
        let (refraction, index) = (self.positive(1.0), self.positive(2.5));
        format!("{colors} {reflection} {shininess} {refraction} {index}")
    }

    fn object(&self, camera: &str) -> String {
        if self.aimed && self.random.below(3) > 0 {
            return format!("{} {}", self.aimed_shape(), self.material());
        }
        let shape = match self.random.below(4) {
            // Around the camera, as small as the rounding of its place or smaller.
            0 if self.random.below(3) == 0 => {
                let radius = self.scale * self.random.log_between(1e-9, 1e-1);
                format!("0 {camera} {radius:e}")
            }
            0 | 1 => format!("0 {} {}", self.numbers(3), self.positive(self.scale)),
            2 => format!("1 {} {}", self.numbers(3), self.number()),
            _ => format!("2 {} 0 0 0 0", self.numbers(9)),
        };
        format!("{shape} {}", self.material())
    }

    /// A scene of up to five objects, some of which may be none.
    pub fn scene(&self) -> String {
        let camera = self.numbers(3);
        let objects: Vec<_> = (0..=self.random.below(5))
            .map(|_| self.object(&camera))
            .collect();
        self.scene_of(&camera, &objects)
    }

    /// A scene of so many objects, that are accepted by a parser.
    pub fn crowd(&self, count: usize, is_scene: impl Fn(&str) -> bool) -> String {
        let camera = self.steps(3);
        let mut objects = Vec::with_capacity(count);
        while objects.len() < count {
            let object = self.object(&camera);
            if is_scene(&self.scene_of(&camera, std::slice::from_ref(&object))) {
                objects.push(object);
            }
        }
        self.scene_of(&camera, &objects)
    }

    fn scene_of(&self, camera: &str, objects: &[String]) -> String {
        format!(
            "{}\n{camera}\n4 3\n{} {}\n{}\n{}\n{}\n{}\n",
            objects.len(),
            self.steps(3),
            self.positives(6, 2.0),
            self.positive(1.0),
            self.random.below(2),
            self.positives(3, 1.0),
            objects.join("\n"),
        )
    }
}
