//! Parses a scene of many triangles on the board, which builds a tree of them, and draws it by the tree.

#![no_std]
#![no_main]

use board::stack;
use scanray::{ScenePools, Tracer};
use scanray_firmware::measure::{self, EMPTY_ROW, RESOLUTION, Row};

/// Room for so many triangles, a sphere, a plane, and a tree of all.
const TRIANGLES: usize = 80;
type Pools = ScenePools<f32, 1, 1, TRIANGLES, 4, 1, 0, { TRIANGLES + 1 }>;

board::entry!(program, (Pools, Row) = (Pools::new(), EMPTY_ROW));

const TEXT: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/scene.txt"));

fn program((pools, row): &mut (Pools, Row)) -> Result<(), &'static str> {
    stack::paint();
    if pools.parse(TEXT).is_err() {
        return Err("the scene was rejected");
    }
    let scene = pools.as_scene();
    if !scene.accel().bvh().is_some() {
        return Err("the scene has no tree");
    }
    let tracer = Tracer::new(scene).with_bvh();
    measure::picture(tracer.with_resolution(RESOLUTION), row);
    Ok(())
}
