//! Scenes of many objects, against other ray tracers and against brute force.

use std::path::Path;

use cpu_time::ProcessTime;
use scanray::{Resolution, Scene, Tracer};

use crate::peers::Peer;
use crate::run::{median, scanray};
use crate::scenes::{LARGE, generate, name, pools};

/// Pictures of each program, but for POV-Ray, which takes long: one.
const ROUNDS: usize = 5;

const SIZE: Resolution = Resolution {
    width: 800,
    height: 600,
};

pub(crate) fn run() {
    let peers: Vec<Peer> = Peer::ALL
        .into_iter()
        .filter(|peer| {
            let is_measured = cfg!(unix) && peer.is_installed();
            if !is_measured {
                println!("{} is skipped: it is not installed", peer.name());
            }
            is_measured
        })
        .collect();
    println!(
        "ns of CPU time a pixel on one thread, 800x600 pixels; medians of {ROUNDS} pictures in turn, one by POV-Ray\n"
    );
    print!("{:<18} {:>8}", "scene", "scanray");
    for peer in &peers {
        print!("   {:>8}  ratio", peer.name());
    }
    println!("   brute force / tree, in the core");
    let mut times = Vec::new();
    for (kind, count) in LARGE {
        let file = generate(kind, count);
        let mut pools = pools();
        let text = std::fs::read(&file).expect("the scene was written");
        pools.parse(&text).expect("it is a scene");
        let scene = pools.as_scene();
        let exported: Vec<_> = peers
            .iter()
            .map(|peer| (*peer, peer.export(&file, &scene)))
            .collect();
        let mut own = Vec::new();
        let mut others = vec![Vec::new(); peers.len()];
        for round in 0..ROUNDS {
            own.push(scanray(&file, &["--threads", "1"]).cpu);
            for ((peer, exported), times) in exported.iter().zip(&mut others) {
                if round == 0 || !matches!(peer, Peer::PovRay) {
                    times.push(time(*peer, exported));
                }
            }
        }
        let own = median(own);
        times.push(own);
        print!("{:<18} {own:>8.1}", name(kind, count));
        for other in others {
            let other = median(other);
            print!("   {other:>8.1}  {:>5.2}", own / other);
        }
        println!("   {:>8.1}", gain(scene));
    }
    println!(
        "\n100,000 spheres take {:.2} times as long as 1,000; 81,920 triangles {:.2} times as long as 1,280",
        times[2] / times[0],
        times[5] / times[3]
    );
}

#[cfg(unix)]
fn time(peer: Peer, scene: &Path) -> f64 {
    peer.time(scene)
}

#[cfg(not(unix))]
fn time(_: Peer, _: &Path) -> f64 {
    f64::NAN
}

/// How many times as long the core takes without the tree: for 48 pixels all over the picture, ray by ray.
fn gain(scene: Scene<'_>) -> f64 {
    let brute_force = scene.without_accel();
    let time = |scene, repeats: u32| {
        let tracer = Tracer::new(scene).with_bvh().with_resolution(SIZE);
        let start = ProcessTime::now();
        for _ in 0..repeats {
            for y in (50..600).step_by(100) {
                for x in (50..800).step_by(100) {
                    std::hint::black_box(tracer.pixel(x, y));
                }
            }
        }
        start.elapsed().as_secs_f64() / f64::from(repeats)
    };
    time(brute_force, 1) / time(scene, 100)
}
