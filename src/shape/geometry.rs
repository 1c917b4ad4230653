//! The objects of a scene: borrowed slices, one for each shape.

use super::{
    Kind, ListedShape, Object, Plane, Primitive, Sphere, Stored, Triangle, for_each_shape,
    for_each_stored_shape,
};
use crate::scalar::Scalar;
use crate::stages::Stages;

/// The objects of a scene, kind by kind.
///
/// An object's *index* counts through all kinds in the order of [`Kind::ALL`]; within a kind the objects are in the order of
/// the text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Geometry<'a, T = f32> {
    /// Spheres.
    pub spheres: &'a [Sphere<T>],
    /// Planes.
    pub planes: &'a [Plane<T>],
    /// Triangles.
    pub triangles: &'a [Triangle<T>],
    /// Objects of the shapes that few scenes have.
    pub stored: Stored<'a, T>,
}

impl<T> Geometry<'_, T> {
    /// No objects.
    pub const NONE: Self = Self {
        spheres: &[],
        planes: &[],
        triangles: &[],
        stored: Stored::NONE,
    };

    /// Number of objects of all kinds.
    pub const fn count(&self) -> usize {
        self.spheres.len() + self.planes.len() + self.triangles.len() + self.stored.entries.len()
    }
}

impl<'a, T: Scalar> Geometry<'a, T> {
    /// Number of objects of a kind.
    pub fn count_of(&self, kind: Kind) -> usize {
        macro_rules! counts {
            ([$($shape:ident)*]) => {
                match kind {
                    $(Kind::$shape => $shape::all(self).len(),)*
                    _ => self.stored.count_of(kind),
                }
            };
        }
        for_each_shape!(counts)
    }

    /// The object of an index.
    pub fn object(&self, index: usize) -> Option<Object<'a, T>> {
        let mut index = index;
        macro_rules! among {
            ([$($shape:ident)*]) => {
                $(
                    let all = $shape::all(self);
                    if let Some(it) = all.get(index) {
                        return Some(Object::$shape(it));
                    }
                    index = index.wrapping_sub(all.len());
                )*
            };
        }
        for_each_shape!(among);
        self.stored.get(index).map(Object::Stored)
    }

    /// Whether there is an object of an index that a ray which leaves it cannot hit again.
    pub(crate) fn is_flat(&self, index: usize) -> bool {
        let mut index = index;
        macro_rules! among {
            ([$($shape:ident)*]) => {
                $(
                    let count = $shape::all(self).len();
                    if index < count {
                        return <$shape<T> as Primitive<T>>::IS_FLAT;
                    }
                    index -= count;
                )*
            };
        }
        for_each_shape!(among);
        macro_rules! among_stored {
            ([$($shape:ident)*]) => {
                match self.stored.entries.get(index).map(|entry| entry.kind) {
                    $(Some(Kind::$shape) => <super::$shape<T> as Primitive<T>>::IS_FLAT,)*
                    _ => false,
                }
            };
        }
        for_each_stored_shape!(among_stored)
    }

    /// The objects of all kinds, in the order of their indices.
    pub fn objects(&self) -> impl Iterator<Item = Object<'a, T>> + use<'a, T> {
        let geometry = *self;
        (0..self.count()).filter_map(move |index| geometry.object(index))
    }

    /// The objects of all kinds, in the order of the text.
    pub fn in_text_order(&self) -> impl Iterator<Item = Object<'a, T>> + use<'a, T> {
        let geometry = *self;
        // How many of each listed kind have been told, and of the stored ones.
        let mut told = [0_usize; Kind::COUNT];
        let mut stored = 0;
        core::iter::from_fn(move || {
            let mut next = None::<Object<'a, T>>;
            macro_rules! earliest {
                ([$($shape:ident)*]) => {
                    $(
                        if let Some(it) = $shape::all(&geometry).get(told[Kind::$shape.index()])
                            && next.is_none_or(|next| it.info().number < next.info().number)
                        {
                            next = Some(Object::$shape(it));
                        }
                    )*
                };
            }
            for_each_shape!(earliest);
            if let Some(object) = geometry.stored.get(stored)
                && next.is_none_or(|next| object.entry.info.number < next.info().number)
            {
                stored += 1;
                return Some(Object::Stored(object));
            }
            let next = next?;
            told[next.kind().index()] += 1;
            Some(next)
        })
    }
}

impl<T> Geometry<'_, T> {
    /// The stages that draw these objects.
    pub const fn stages(&self) -> Stages {
        let mut stages = Stages::NONE
            .with_if(Stages::SPHERES, !self.spheres.is_empty())
            .with_if(Stages::PLANES, !self.planes.is_empty())
            .with_if(Stages::TRIANGLES, !self.triangles.is_empty())
            .with_if(Stages::SEVERAL_SPHERES, self.spheres.len() > 1)
            .with_if(Stages::SEVERAL_PLANES, self.planes.len() > 1)
            .with_if(Stages::SEVERAL_TRIANGLES, self.triangles.len() > 1);
        let mut i = 0;
        while i < self.stored.entries.len() {
            stages = stages.union(self.stored.entries[i].kind.stage());
            i += 1;
        }
        stages
    }
}
