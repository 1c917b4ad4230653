//! The order of the objects in a text decides between hits at exactly the same distance, and nothing else: all that happens to the
//! rays of random scenes, with their lines in another order.

use crate::common::random::Random;
use crate::common::random_texts::Writer;
use scanray::{
    Color, Ray, Scalar, Scene, ScenePools, Tracer, Vec3,
    parser::FromDecimal,
    ray::Side,
    shape::Kind,
    tracer::{Intersection, Observer, RayKind},
};

/// Room for twice the objects of a crowd.
type Pools<T> = ScenePools<T, 160, 160, 160, 160, 1, 32, 160>;

/// Lines of a text before its objects.
const HEADER: usize = 7;

fn bits<T: Scalar>(v: Vec3<T>) -> [u64; 3] {
    [v.x, v.y, v.z].map(|component| component.to_f64().to_bits())
}

/// What happens to the rays of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Event<T> {
    /// Why it is cast, its depth, its origin and its direction.
    Ray(RayKind, usize, [[u64; 3]; 2]),
    /// The object by its name, and how far away it is.
    Hit(usize, T),
    /// Of the hit by itself: with its shadows.
    Color([u64; 3]),
}

/// A scene of objects that have names, which they keep in other texts.
#[derive(Clone, Copy)]
struct Named<'a, T> {
    scene: Scene<'a, T>,
    /// Of the objects in the order of the text.
    names: &'a [usize],
}

impl<'a, T: Scalar> Named<'a, T> {
    fn without_accel(self) -> Self {
        Self {
            scene: self.scene.without_accel(),
            ..self
        }
    }

    fn name(&self, index: usize) -> usize {
        let object = self.scene.object(index).expect("an object");
        self.names[object.info().number as usize]
    }

    /// The place of a name in the text.
    fn place(&self, name: usize) -> usize {
        let mut names = self.names.iter();
        names.position(|it| *it == name).expect("a name")
    }

    fn index(&self, name: usize) -> usize {
        let mut all = 0..self.scene.object_count();
        all.find(|index| self.name(*index) == name)
            .expect("an object")
    }

    fn kind(&self, name: usize) -> Option<Kind> {
        let object = self.scene.object(self.index(name))?;
        Some(object.kind())
    }

    /// What a ray of another scene hits here first.
    fn nearest(&self, ray: &Ray<T>, from: &Self) -> Option<(usize, T)> {
        let leaves = match ray.leaves {
            Side::NOWHERE => Side::NOWHERE,
            side => {
                let name = from.name(side.object() as usize);
                Side::new(self.index(name) as u32, side.is_front())
            }
        };
        let nearest = Tracer::new(self.scene).nearest(&Ray { leaves, ..*ray })?;
        Some((self.name(nearest.index), nearest.t))
    }

    /// All that happens to the rays of a pixel, and the rays.
    fn watch(&self, x: u16, y: u16, by_hierarchy: bool) -> Log<'_, T> {
        let mut log = Log {
            names: self.names,
            events: Vec::new(),
            rays: Vec::new(),
        };
        let tracer = Tracer::new(self.scene);
        if by_hierarchy {
            let tracer = tracer.with_bvh();
            tracer.pixel_observed(&tracer.scanline(y), x, &mut log);
        } else {
            tracer.pixel_observed(&tracer.scanline(y), x, &mut log);
        }
        log
    }
}

struct Log<'l, T> {
    names: &'l [usize],
    events: Vec<Event<T>>,
    /// Those of the events.
    rays: Vec<Ray<T>>,
}

impl<T: Scalar> Observer<T> for Log<'_, T> {
    fn ray(&mut self, kind: RayKind, depth: usize, ray: &Ray<T>) {
        // Whether they are cast depends on what is derived from a scene.
        if kind == RayKind::Shadow {
            return;
        }
        let line = [ray.origin, ray.direction].map(bits);
        self.events.push(Event::Ray(kind, depth, line));
        self.rays.push(*ray);
    }

    fn intersection(&mut self, hit: &Intersection<'_, T>) {
        let name = self.names[hit.number as usize];
        self.events.push(Event::Hit(name, hit.t));
    }

    fn local_color(&mut self, Color { r, g, b }: Color<T>) {
        self.events.push(Event::Color(bits(Vec3::new(r, g, b))));
    }
}

impl<T: Scalar> Log<'_, T> {
    /// The ray before an event.
    fn ray_before(&self, at: usize) -> Ray<T> {
        let before = &self.events[..at];
        let rays = before.iter().filter(|it| matches!(it, Event::Ray(..)));
        self.rays[rays.count() - 1]
    }
}

/// Whether two logs may be different from an event on.
type IsTie<T> = fn([&Named<'_, T>; 2], [&Log<'_, T>; 2], usize) -> bool;

/// A ray that hits two objects of a kind at exactly the same distance hits in each scene the one that comes first in its text.
fn is_exact_tie<T: Scalar>(
    [first, second]: [&Named<'_, T>; 2],
    [a, b]: [&Log<'_, T>; 2],
    at: usize,
) -> bool {
    let (Some(Event::Hit(one, t)), Some(Event::Hit(other, same))) =
        (a.events.get(at), b.events.get(at))
    else {
        return false;
    };
    let ray = a.ray_before(at);
    t == same
        && first.nearest(&ray, first) == Some((*one, *t))
        && second.nearest(&ray, first) == Some((*other, *t))
        && first.kind(*one) == first.kind(*other)
        && first.place(*one) < first.place(*other)
        && second.place(*other) < second.place(*one)
}

/// A ray that leaves a flat object, which it cannot hit again, hits its twin in the second scene: it runs along both, so that only
/// rounding says on which side it is.
fn leaves_the_twin<T: Scalar>(
    [first, second]: [&Named<'_, T>; 2],
    [_, b]: [&Log<'_, T>; 2],
    at: usize,
) -> bool {
    let Some(Event::Hit(twin, _)) = b.events.get(at) else {
        return false;
    };
    let ray = b.ray_before(at);
    if ray.leaves == Side::NOWHERE || first.names.contains(twin) {
        return false;
    }
    let left = second.name(ray.leaves.object() as usize);
    *twin == left + first.names.len() && second.kind(left) != Some(Kind::Sphere)
}

#[derive(Default)]
struct Count {
    scenes: usize,
    pixels: usize,
    ties: usize,
    faults: Vec<String>,
}

impl Count {
    /// Compares all that happens in two scenes; what may be the first difference in a pixel, `is_tie` says of both logs.
    fn compare<T: Scalar>(
        &mut self,
        [first, second]: [Named<'_, T>; 2],
        by_hierarchy: bool,
        is_tie: IsTie<T>,
        what: &str,
    ) {
        for (x, y) in (0..3).flat_map(|y| (0..4).map(move |x| (x, y))) {
            self.pixels += 1;
            let scenes = [&first, &second];
            let logs = scenes.map(|scene| scene.watch(x, y, by_hierarchy));
            let [a, b] = logs.each_ref().map(|log| &log.events);
            if a == b {
                continue;
            }
            let at = a.iter().zip(b).take_while(|(a, b)| a == b).count();
            if is_tie(scenes, logs.each_ref(), at) {
                self.ties += 1;
            } else {
                let [a, b] = [a.get(at), b.get(at)];
                let place = format!("pixel {x},{y}, event {at}");
                self.faults.push(format!("{place}: {a:?}, {b:?}\n{what}"));
            }
        }
    }

    /// With what is derived from the scenes, with the hierarchy, and without any of it.
    fn compare_in_all_ways<T: Scalar>(
        &mut self,
        scenes: [Named<'_, T>; 2],
        is_tie: IsTie<T>,
        what: &str,
    ) {
        self.scenes += 1;
        self.compare(scenes, false, is_tie, what);
        if scenes[0].scene.accel().bvh().is_some() {
            let what = format!("By the hierarchy:\n{what}");
            self.compare(scenes, true, is_tie, &what);
        }
        let plain = scenes.map(Named::without_accel);
        self.compare(plain, false, is_tie, &format!("Not prepared:\n{what}"));
    }

    fn check(&self) {
        println!(
            "{} scenes, {} pixels, {} ties",
            self.scenes, self.pixels, self.ties
        );
        for fault in self.faults.iter().take(8) {
            println!("{fault}");
        }
        assert!(self.faults.is_empty(), "{} pixels", self.faults.len());
    }
}

/// Runs through random texts that are scenes, of a few objects or of many; gives each as its lines before the objects, and the
/// objects'.
fn texts<T: Scalar + FromDecimal>(
    random: &Random,
    rounds: usize,
    aimed: bool,
    mut then: impl FnMut(&[&str], &[&str]),
) {
    let mut pools = Box::new(Pools::<T>::new());
    for round in 0..rounds {
        let writer = Writer {
            random,
            extreme: 0,
            scale: random.log_between(1e-2, 1e3),
            aimed,
        };
        let mut is_scene = |text: &str| pools.parse(text.as_bytes()).is_ok();
        let text = if round % 16 == 0 {
            let is_scene = std::cell::RefCell::new(&mut is_scene);
            let count = 6 + random.below(75);
            writer.crowd(count, |text| (is_scene.borrow_mut())(text))
        } else {
            writer.scene()
        };
        if is_scene(&text) {
            let lines: Vec<&str> = text.lines().collect();
            let (header, objects) = lines.split_at(HEADER);
            then(header, objects);
        }
    }
}

/// Pools of a text.
fn parse<T: Scalar + FromDecimal>(header: &[&str], objects: &[&str]) -> Box<Pools<T>> {
    let count = objects.len().to_string();
    let header = std::iter::once(&*count).chain(header[1..].iter().copied());
    let lines: Vec<&str> = header.chain(objects.iter().copied()).collect();
    let mut pools = Box::new(Pools::<T>::new());
    pools.parse(lines.join("\n").as_bytes()).expect("a scene");
    pools
}

/// Permutes the objects of random scenes.
fn permute<T: Scalar + FromDecimal>(seed: u64, rounds: usize, aimed: bool) -> Count {
    let random = Random::of_test(seed);
    let mut count = Count::default();
    texts::<T>(&random, rounds, aimed, |header, objects| {
        let in_order: Vec<usize> = (0..objects.len()).collect();
        let mut order = in_order.clone();
        random.shuffle(&mut order);
        let permuted: Vec<&str> = order.iter().map(|name| objects[*name]).collect();
        let (first, second) = (parse::<T>(header, objects), parse::<T>(header, &permuted));
        let first = Named {
            scene: first.as_scene(),
            names: &in_order,
        };
        let second = Named {
            scene: second.as_scene(),
            names: &order,
        };
        let lines = [header, objects].concat().join("\n");
        let what = format!("In the order {order:?}:\n{lines}");
        count.compare_in_all_ways([first, second], is_exact_tie, &what);
    });
    count.check();
    count
}

#[test]
fn the_order_of_the_objects_decides_exact_ties_alone() {
    permute::<f32>(301, 3_000, false);
    permute::<f64>(302, 1_000, false);
    // Coincident and touching objects have many.
    let aimed = permute::<f32>(303, 3_000, true);
    assert!(aimed.ties > 10);
}

/// `SCENES=2000000` makes it that many texts, of which half are scenes.
#[test]
#[ignore = "takes long: .ci/run runs it"]
fn the_order_of_the_objects_of_many_scenes_decides_exact_ties_alone() {
    let rounds = Random::count(20_000);
    permute::<f32>(304, rounds, false);
    permute::<f32>(305, rounds, true);
}

/// Objects with twins in the same place that come later in the text, and cast no shadow.
fn add_twins<T: Scalar + FromDecimal>(seed: u64, rounds: usize, aimed: bool) {
    const MATERIAL: &str = "1 0 1 0 0 0 1 0 1 0 0 0 1";
    let random = Random::of_test(seed);
    let mut count = Count::default();
    texts::<T>(&random, rounds, aimed, |header, objects| {
        let mut names: Vec<usize> = (0..objects.len()).collect();
        let mut twice: Vec<String> = objects.iter().map(|it| (*it).to_owned()).collect();
        for (name, object) in objects.iter().enumerate() {
            let numbers: Vec<&str> = object.split(' ').collect();
            let shape = numbers[..numbers.len() - 13].join(" ");
            let place = names.iter().position(|it| *it == name).expect("a name");
            let place = place + 1 + random.below(twice.len() - place);
            twice.insert(place, format!("{shape} {MATERIAL}"));
            names.insert(place, objects.len() + name);
        }
        let twice: Vec<&str> = twice.iter().map(|it| &**it).collect();
        let in_order: Vec<usize> = (0..objects.len()).collect();
        let (first, second) = (parse::<T>(header, objects), parse::<T>(header, &twice));
        let first = Named {
            scene: first.as_scene(),
            names: &in_order,
        };
        let second = Named {
            scene: second.as_scene(),
            names: &names,
        };
        let what = [header, &twice].concat().join("\n");
        count.compare_in_all_ways([first, second], leaves_the_twin, &what);
    });
    count.check();
}

#[test]
fn of_twins_the_first_in_the_text_is_hit() {
    add_twins::<f32>(306, 1_000, false);
    add_twins::<f32>(307, 1_000, true);
}
