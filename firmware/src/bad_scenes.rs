//! Scene texts that must be rejected. The host's reference includes this file too.

/// One mistake each; the last has one sphere more than [`SPHERES`].
pub const BAD_SCENES: [&[u8]; 4] = [
    b"",
    b"0\n0 0 0\n160 120\n0 9 0 1 1 1 1 1 1\n0.1 dark\n",
    b"1\n0 0 0\n160 120\n0 9 0 1 1 1 1 1 1\n0.1\n1\n0 0 0\n3 0 0 0\n",
    b"2\n0 0 0\n160 120\n0 9 0 1 1 1 1 1 1\n0.1\n1\n0 0 0\n\
      0 0 0 5 1  1 1 1 1 1 1 1 1 1 0 0 0 0\n0 0 1 5 1  1 1 1 1 1 1 1 1 1 0 0 0 0\n",
];

/// Capacity of the pool of spheres that they are read into.
pub const SPHERES: usize = 1;
