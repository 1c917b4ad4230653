//! What instructions stand for in time: an estimate, as a range.
//!
//! The shares of instructions that take more than a cycle were counted with `firmware/tools/profiler.py` on
//! the scenes default, window-room and stage-3-mirrors; the least and the largest of the three are the ends.
//!
//! | takes cycles | lower end | upper end |
//! |---|---|---|
//! | float divide or root (M4F) | 14 | 14 |
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

use super::Core;

/// Cycles, or milliseconds, between two ends.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub(crate) struct Span {
    pub(crate) least: f64,
    pub(crate) most: f64,
}

/// Shares of a core's instructions, the least and the largest of the scenes that were counted; a load or
/// store of several registers counts each.
struct Mix {
    loads: [f64; 2],
    stores: [f64; 2],
    taken_branches: [f64; 2],
    divides_and_roots: [f64; 2],
    long_multiplications: [f64; 2],
    /// Bytes of an instruction, at most.
    bytes: f64,
}

/// Bytes of code that a read of the flash yields.
const FETCH_BYTES: f64 = 8.0;

fn mix(core: Core) -> Mix {
    match core {
        Core::M4f => Mix {
            loads: [0.096, 0.163],
            stores: [0.025, 0.067],
            taken_branches: [0.038, 0.069],
            divides_and_roots: [0.008, 0.011],
            long_multiplications: [0.0; 2],
            bytes: 4.0,
        },
        Core::M3 => Mix {
            loads: [0.133, 0.141],
            stores: [0.125, 0.132],
            taken_branches: [0.099, 0.107],
            divides_and_roots: [0.0; 2],
            long_multiplications: [0.007, 0.008],
            bytes: 4.0,
        },
        Core::M0 => Mix {
            loads: [0.195, 0.199],
            stores: [0.169, 0.173],
            taken_branches: [0.088, 0.095],
            divides_and_roots: [0.0; 2],
            long_multiplications: [0.0; 2],
            bytes: 2.0,
        },
    }
}

/// Cycles that instructions take on a core whose flash has wait states.
pub(crate) fn cycles(core: Core, instructions: f64, wait_states: u32) -> Span {
    let mix = mix(core);
    // Cycles beyond the first, at each end.
    let [load, store, branch] = match core {
        Core::M4f | Core::M3 => [[0.0, 1.0], [0.0, 1.0], [1.0, 3.0]],
        Core::M0 => [[1.0, 1.0], [1.0, 1.0], [2.0, 3.0]],
    };
    let [least, most] = [0, 1].map(|end| {
        1.0 + mix.loads[end] * load[end]
            + mix.stores[end] * store[end]
            + mix.taken_branches[end] * branch[end]
            + mix.divides_and_roots[end] * 13.0
            + mix.long_multiplications[end] * [2.0, 4.0][end]
    });
    let waiting = f64::from(wait_states) * (mix.bytes / FETCH_BYTES + mix.taken_branches[1]);
    Span {
        least: instructions * least,
        most: instructions * (most + waiting),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
