#![doc = include_str!("../docs/picture.md")]
