//! What instructions stand for in time: an estimate, as a range.
//!
//! The shares of instructions that take more than a cycle are those of `mix.txt`, which
//! `firmware/tools/instruction_mix.py` counted on three scenes; the least and the largest of the three are the ends.
//!
//! | takes cycles | lower end | upper end |
//! |---|---|---|
//! | float divide or root (M4F) | 14 | 14 |
//! | float multiply-accumulate (M4F) | 3 | 3 |
//! | integer divide: M4F and M3 | 2 | 12 |
//! | load, each register: M4F and M3 | 1, pipelined | 2 |
//! | store, each register: M4F and M3 | 1, buffered | 2 |
//! | load or store, each register: M0 | 2 | 2 |
//! | taken branch: M4F and M3 | 2 | 4 |
//! | taken branch: M0 | 3 | 4 |
//! | long multiplication: M3 | 3 | 5 |
//! | anything else | 1 | 1 |
//! | wait states | none: a cache or accelerator hides them | for each 8 bytes of code and each taken branch |
//!
//! Sources: the instruction timing of the Technical Reference Manuals of Cortex-M4, M3 and M0 (its multiplier
//! of one cycle). Interrupts, buses shared with DMA and time for the display are not in it.

use std::sync::LazyLock;

use super::Core;
use scanray_host::cost::{Rows, parse_table};

/// Cycles, or milliseconds, between two ends.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub(crate) struct Span {
    pub(crate) least: f64,
    pub(crate) most: f64,
}

/// Bytes of code that a read of the flash yields.
const FETCH_BYTES: f64 = 8.0;

/// Shares of each core's instructions, the least and the largest of the scenes that were counted; a load or
/// store of several registers counts each.
static MIX: LazyLock<Rows> =
    LazyLock::new(|| parse_table(include_str!("mix.txt")).unwrap_or_default());

/// Cycles beyond the first of each kind of instruction, at the lower and at the upper end.
fn beyond_the_first(core: Core) -> [(&'static str, [f64; 2]); 7] {
    let [load, store, branch] = match core {
        Core::M4f | Core::M3 => [[0.0, 1.0], [0.0, 1.0], [1.0, 3.0]],
        Core::M0 => [[1.0, 1.0], [1.0, 1.0], [2.0, 3.0]],
    };
    [
        ("loads", load),
        ("stores", store),
        ("taken_branches", branch),
        ("divides_and_roots", [13.0, 13.0]),
        ("multiply_accumulates", [2.0, 2.0]),
        ("integer_divides", [1.0, 11.0]),
        (
            "long_multiplications",
            match core {
                Core::M3 => [2.0, 4.0],
                Core::M4f | Core::M0 => [0.0, 0.0],
            },
        ),
    ]
}

/// The least and the largest share of a kind.
fn shares(core: Core, kind: &str) -> [f64; 2] {
    ["least", "most"].map(|end| {
        let name = format!("{kind}_{end}");
        let row = MIX.iter().find(|(other, _)| *other == name);
        row.map_or(0.0, |(_, shares)| shares[core as usize])
    })
}

/// Bytes of an instruction, at most.
fn bytes(core: Core) -> f64 {
    match core {
        Core::M4f | Core::M3 => 4.0,
        Core::M0 => 2.0,
    }
}

/// Cycles that instructions take on a core whose flash has wait states.
pub(crate) fn cycles(core: Core, instructions: f64, wait_states: u32) -> Span {
    let [mut least, mut most] = [1.0, 1.0];
    for (kind, cycles) in beyond_the_first(core) {
        let shares = shares(core, kind);
        least += shares[0] * cycles[0];
        most += shares[1] * cycles[1];
    }
    let [_, taken_branches] = shares(core, "taken_branches");
    let waiting = f64::from(wait_states) * (bytes(core) / FETCH_BYTES + taken_branches);
    Span {
        least: instructions * least,
        most: instructions * (most + waiting),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_kind_has_its_shares() {
        for core in Core::ALL {
            for (kind, _) in beyond_the_first(core) {
                let rows = MIX.iter().filter(|(name, _)| {
                    name.strip_suffix("_least") == Some(kind)
                        || name.strip_suffix("_most") == Some(kind)
                });
                assert_eq!(rows.count(), 2, "{kind}");
                let [least, most] = shares(core, kind);
                assert!(least <= most && most < 1.0, "{core}: {kind}");
            }
            assert!(shares(core, "loads")[0] > 0.0, "{core}");
        }
    }

    #[test]
    fn wait_states_move_the_upper_end_alone() {
        for core in Core::ALL {
            let [none, some] = [0, 5].map(|wait_states| cycles(core, 1000.0, wait_states));
            assert!(
                none.least > 1000.0 && none.most < 2000.0,
                "{core}: {none:?}"
            );
            assert_eq!(none.least, some.least);
            assert!(some.most > none.most + 5.0 * 250.0, "{core}: {some:?}");
        }
    }
}
