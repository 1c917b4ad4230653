//! The objects of a scene: borrowed slices, one for each shape.

use super::{Kind, Object, Plane, Primitive, Sphere, Triangle, for_each_shape};
use crate::scalar::Scalar;

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
}

impl<T> Geometry<'_, T> {
    /// No objects.
    pub const NONE: Self = Self {
        spheres: &[],
        planes: &[],
        triangles: &[],
    };

    /// Number of objects of all kinds.
    pub const fn count(&self) -> usize {
        self.spheres.len() + self.planes.len() + self.triangles.len()
    }
}

impl<'a, T: Scalar> Geometry<'a, T> {
    /// Number of objects of a kind.
    pub fn count_of(&self, kind: Kind) -> usize {
        macro_rules! counts {
            ([$($shape:ident)*]) => { match kind { $(Kind::$shape => $shape::all(self).len(),)* } };
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
        let _ = index;
        None
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
        let _ = index;
        false
    }

    /// Calls a function with each object and its index, in their order.
    pub(crate) fn for_each(&self, mut each: impl FnMut(usize, Object<'a, T>)) {
        let mut index = 0;
        macro_rules! visit {
            ([$($shape:ident)*]) => {
                $(
                    for it in $shape::all(self) {
                        each(index, Object::$shape(it));
                        index += 1;
                    }
                )*
            };
        }
        for_each_shape!(visit);
        let _ = index;
    }

    /// The objects of all kinds, in the order of the text.
    pub fn in_text_order(&self) -> impl Iterator<Item = Object<'a, T>> + use<'a, T> {
        let geometry = *self;
        // How many of each kind have been told.
        let mut told = [0_usize; Kind::COUNT];
        core::iter::from_fn(move || {
            let mut next = None::<Object<'a, T>>;
            macro_rules! earliest {
                ([$($shape:ident)*]) => {
                    $(
                        if let Some(it) = $shape::all(&geometry).get(told[Kind::$shape.index()])
                            && next.is_none_or(|next| it.surface().number < next.surface().number)
                        {
                            next = Some(Object::$shape(it));
                        }
                    )*
                };
            }
            for_each_shape!(earliest);
            let next = next?;
            told[next.kind().index()] += 1;
            Some(next)
        })
    }
}
