//! Numbers of a scene in JSON.

use scanray::{Color, Scalar, Vec3};
use serde::{Serialize, Serializer};

/// A number with the fewest digits that read back to the same bits of its type.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Number {
    pub(crate) value: f64,
    is_single: bool,
}

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        if self.is_single {
            to.serialize_f32(self.value as f32)
        } else {
            to.serialize_f64(self.value)
        }
    }
}

/// A vector or a colour.
pub(crate) type Triple = [Number; 3];

pub(crate) fn number<T: Scalar>(value: T) -> Number {
    Number {
        value: value.to_f64(),
        is_single: T::NAME == "f32",
    }
}

pub(crate) fn vector<T: Scalar>(v: Vec3<T>) -> Triple {
    [v.x, v.y, v.z].map(number)
}

pub(crate) fn color<T: Scalar>(c: Color<T>) -> Triple {
    [c.r, c.g, c.b].map(number)
}
