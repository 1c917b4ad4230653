//! What a scene and its renderer take in the memory of a device with pointers of 32 bits.
//!
//! Entries, colours and frames hold no pointers, so that they have the same size here; what holds lengths and
//! pointers is put together from its fields, in the order that leaves no gaps, which is the compiler's.

use scanray::accel::{Bvh, BvhNode, Candidates, PlaneGrid};
use scanray::shape::{Plane, Sphere, Triangle};
use scanray::{
    Background, Camera, DEFAULT_MAX_DEPTH, Light, Material, Resolution, Scalar, Scene, Stages,
    Tracer,
};
use serde::Serialize;

/// Bytes of a pointer or length on the device.
const DEVICE_WORD: usize = 4;

/// Size and alignment of a type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Layout {
    size: usize,
    align: usize,
}

impl Layout {
    /// Of a type that has this layout everywhere.
    const fn of<E>() -> Self {
        Self {
            size: size_of::<E>(),
            align: align_of::<E>(),
        }
    }

    /// Of a number of words.
    const fn words(count: usize, word: usize) -> Self {
        Self {
            size: count * word,
            align: word,
        }
    }

    /// Of a structure of these fields.
    fn record(fields: &[Self]) -> Self {
        let align = fields.iter().map(|field| field.align).max().unwrap_or(1);
        let size: usize = fields.iter().map(|field| field.size).sum();
        Self {
            size: size.next_multiple_of(align),
            align,
        }
    }

    /// Of a `heapless::Vec` of so many entries: its length and an array.
    fn pool(self, capacity: usize, word: usize) -> Self {
        let entries = Self {
            size: self.size * capacity,
            align: self.align,
        };
        Self::record(&[Self::words(1, word), entries])
    }
}

/// A pool of the device.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub(crate) struct PoolMemory {
    /// What its entries are.
    pub(crate) pool: &'static str,
    /// How many the scene has.
    pub(crate) entries: usize,
    pub(crate) bytes_each: usize,
    pub(crate) bytes: usize,
    /// The picture is the same without it.
    pub(crate) for_speed_alone: bool,
    /// Its capacity is a parameter of `ScenePools` of its own.
    #[serde(skip)]
    has_parameter: bool,
    #[serde(skip)]
    entry: Layout,
}

/// A pool of entries that a scene cannot do without.
fn pool<E>(name: &'static str, entries: usize) -> PoolMemory {
    let entry = Layout::of::<E>();
    PoolMemory {
        pool: name,
        entries,
        bytes_each: entry.size,
        bytes: entry.size * entries,
        for_speed_alone: false,
        has_parameter: true,
        entry,
    }
}

impl PoolMemory {
    fn for_speed(self) -> Self {
        Self {
            for_speed_alone: true,
            ..self
        }
    }

    fn with_another(self) -> Self {
        Self {
            has_parameter: false,
            ..self
        }
    }
}

/// What a scene and its renderer take.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub(crate) struct DeviceMemory {
    pub(crate) pools: Vec<PoolMemory>,
    /// What a scene has one of: camera, background …
    pub(crate) settings: usize,
    /// `ScenePools` with all of it, lengths included.
    pub(crate) scene_pools: usize,
    /// The same scene baked into flash.
    pub(crate) baked: usize,
    pub(crate) tracer: usize,
    /// To draw in instalments.
    pub(crate) frame: usize,
    /// Each level of mirrored and refracted rays, on the call stack.
    pub(crate) stack_frame: usize,
    /// All of them.
    pub(crate) stack: usize,
    /// What a cut-off adds to them: a factor a level.
    pub(crate) cutoff_stack: usize,
}

impl DeviceMemory {
    /// What a scene takes with secondary rays to a depth.
    pub(crate) fn of<T: Scalar>(scene: &Scene<'_, T>, max_depth: usize) -> Self {
        Self::with_word(scene, max_depth, DEVICE_WORD)
    }

    fn with_word<T: Scalar>(scene: &Scene<'_, T>, max_depth: usize, word: usize) -> Self {
        let objects = scene.object_count();
        let bounded = scene.spheres().len() + scene.triangles().len();
        let in_bvh = if bounded < Bvh::<T>::FEWEST_OBJECTS {
            0
        } else {
            bounded
        };
        // The grids have the capacity of the planes, the entries of the hierarchy that of its nodes.
        let pools = [
            pool::<Sphere<T>>("spheres", scene.spheres().len()),
            pool::<Plane<T>>("planes", scene.planes().len()),
            pool::<Triangle<T>>("triangles", scene.triangles().len()),
            pool::<Material<T>>("materials", scene.materials().len()),
            pool::<Light<T>>("lights", scene.lights().len()),
            pool::<[Candidates; 2]>("sides", objects).for_speed(),
            pool::<PlaneGrid<T>>("plane grids", scene.planes().len()).with_another(),
            pool::<BvhNode<T>>("bvh nodes", in_bvh).for_speed(),
            pool::<u32>("bvh entries", in_bvh)
                .for_speed()
                .with_another(),
        ];
        let plain = [
            Layout::of::<Camera<T>>(),
            Layout::of::<Resolution>(),
            Layout::of::<T>(),
            Layout::of::<Background<T>>(),
        ];
        let settings = Layout::record(&plain);
        let lists = pools
            .each_ref()
            .map(|pool| pool.entry.pool(pool.entries, word));
        // What is derived is a record of its own.
        let (own, derived) = lists.split_at(5);
        let is_clear = [Layout::of::<bool>()];
        let derived = Layout::record(&[derived, &is_clear].concat());
        let scene_pools = Layout::record(&[&[settings], own, &[derived]].concat());
        // A slice each, of stored objects two.
        let slices = [Layout::words(2, word); 11];
        let is_clear = [Layout::words(1, word)];
        let view = Layout::record(&[&plain[..], &slices, &is_clear].concat());
        let tracer = Layout::record(&[view, Layout::words(1, word), Layout::of::<T>()]);
        let stack_frame = Layout {
            size: Tracer::<T>::FRAME_BYTES,
            align: align_of::<T>(),
        };
        Self {
            baked: view.size + pools.iter().map(|pool| pool.bytes).sum::<usize>(),
            pools: pools.into(),
            settings: settings.size,
            scene_pools: scene_pools.size,
            tracer: tracer.size,
            frame: size_of::<scanray::render::Frame>(),
            stack_frame: stack_frame.size,
            // The refracted rays stand in a list of their own, with a length.
            stack: stack_frame.pool(max_depth, word).size + word,
            cutoff_stack: Layout::of::<T>().pool(max_depth, word).size,
        }
    }

    /// The type of the pools with just enough room.
    pub(crate) fn pools_type(&self, scalar: &str) -> String {
        let parameters = self.pools.iter().filter(|pool| pool.has_parameter);
        let mut capacities: Vec<_> = parameters.map(|pool| pool.entries).collect();
        // That of the tree is 0 unless it is written.
        if capacities.last() == Some(&0) {
            capacities.pop();
        }
        let capacities: Vec<_> = capacities.iter().map(usize::to_string).collect();
        format!("ScenePools<{scalar}, {}>", capacities.join(", "))
    }

    /// The same by name, with code for nothing that the scene does not need.
    pub(crate) fn declaration(&self, needs: Stages, scalar: &str) -> String {
        let of_scalar = if scalar == f32::NAME {
            String::new()
        } else {
            format!("<{scalar}>")
        };
        // The first pools are those of the scene itself.
        let pools: Vec<_> = self
            .pools
            .iter()
            .take(5)
            .filter(|pool| pool.entries > 0)
            .map(|pool| format!("{}: {}", pool.pool, pool.entries))
            .collect();
        let left_out = [
            ("reflection", Stages::REFLECTION),
            ("refraction", Stages::REFRACTION),
            ("specular", Stages::SPECULAR),
        ];
        let left_out: Vec<_> = left_out
            .iter()
            .filter(|(_, stage)| !needs.contains(*stage))
            .map(|(word, _)| *word)
            .collect();
        let without = if left_out.is_empty() {
            String::new()
        } else {
            format!(" without {}", left_out.join(", "))
        };
        format!(
            "scanray::scene_pools! {{ struct Pools{of_scalar} {{ {} }}{without} }}",
            pools.join(", ")
        )
    }

    /// The tracer that has the depth, for a scene in pools.
    pub(crate) fn tracer_expression(&self, max_depth: usize) -> String {
        let new = "Tracer::new(pools.as_scene())";
        match max_depth {
            DEFAULT_MAX_DEPTH => new.to_owned(),
            ..DEFAULT_MAX_DEPTH => format!("{new}.with_stack::<{max_depth}>()"),
            _ => format!("{new}.with_stack::<{max_depth}>().with_max_depth({max_depth})?"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scanray::{ScenePools, parser::FromDecimal};

    /// On this machine a word has its own size, and the compiler knows the rest.
    fn agrees<
        T: Scalar + FromDecimal,
        const SPHERES: usize,
        const PLANES: usize,
        const TRIANGLES: usize,
        const MATERIALS: usize,
        const SIDES: usize,
        const TREE: usize,
    >(
        text: &str,
        name: &str,
    ) {
        type Pools<
            T,
            const A: usize,
            const B: usize,
            const C: usize,
            const D: usize,
            const E: usize,
            const F: usize,
        > = ScenePools<T, A, B, C, D, 1, E, F>;
        let mut pools =
            Box::new(Pools::<T, SPHERES, PLANES, TRIANGLES, MATERIALS, SIDES, TREE>::new());
        pools.parse(text.as_bytes()).unwrap();
        let scene = pools.as_scene();
        let memory = DeviceMemory::with_word(&scene, 5, size_of::<usize>());
        assert_eq!(memory.pools_type(T::NAME), name);
        assert_eq!(
            memory.scene_pools,
            size_of::<Pools<T, SPHERES, PLANES, TRIANGLES, MATERIALS, SIDES, TREE>>(),
            "{name}"
        );
        assert_eq!(memory.tracer, size_of::<Tracer<'_, T>>());
        for use_ in pools.usage() {
            let pool = memory
                .pools
                .iter()
                .find(|pool| pool.pool == use_.pool.name())
                .unwrap();
            assert_eq!((pool.entries, pool.bytes), (use_.capacity, use_.bytes));
            assert_eq!(use_.used, use_.capacity, "just enough room");
        }
        let nodes = size_of_val(scene.accel().bvh().entries);
        assert_eq!(memory.pools.last().map(|pool| pool.bytes), Some(nodes));
    }

    #[test]
    fn sizes_are_those_of_the_types() {
        let default = include_str!("../../scenes/default.txt");
        agrees::<f32, 5, 1, 1, 5, 7, 0>(default, "ScenePools<f32, 5, 1, 1, 5, 1, 7>");
        agrees::<f64, 5, 1, 1, 5, 7, 0>(default, "ScenePools<f64, 5, 1, 1, 5, 1, 7>");
        let reflective = include_str!("../../scenes/reflective.txt");
        agrees::<f32, 8, 1, 3, 11, 12, 0>(reflective, "ScenePools<f32, 8, 1, 3, 11, 1, 12>");
        // Enough for a tree.
        let mut many = "60\n0 0 0\n8 6\n5 5 -5 1 1 1 1 1 1\n0.1\n1\n0 0 0\n".to_owned();
        for i in 0..60 {
            many += &format!("0 {i} 0 9 .4 .8 .2 .2 .5 .5 .5 1 1 1 0 50 0 0\n");
        }
        agrees::<f32, 60, 0, 0, 1, 60, 60>(&many, "ScenePools<f32, 60, 0, 0, 1, 1, 60, 60>");
        agrees::<f64, 60, 0, 0, 1, 60, 60>(&many, "ScenePools<f64, 60, 0, 0, 1, 1, 60, 60>");
    }
}
