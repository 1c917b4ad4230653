use scanray::*;
use std::io::Write;
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let text = std::fs::read(&a[1]).unwrap();
    let mut pools: ScenePools = ScenePools::new();
    if let Err(e) = pools.parse(&text) {
        println!("{e}");
        return;
    }
    let t = Tracer::new(pools.as_scene());
    let r = t.resolution();
    let start = std::time::Instant::now();
    let mut out = format!("P6\n{} {}\n255\n", r.width, r.height).into_bytes();
    let picture = Picture::<_, Exact<embedded_graphics::pixelcolor::Rgb888>>::new(&t);
    use embedded_graphics::prelude::*;
    for y in 0..r.height {
        for x in 0..r.width {
            let c = picture.pixel(x, y);
            out.extend([c.r(), c.g(), c.b()]);
        }
    }
    println!(
        "{:.1} ns/px",
        start.elapsed().as_nanos() as f64 / (r.width as f64 * r.height as f64)
    );
    std::fs::File::create(&a[2])
        .unwrap()
        .write_all(&out)
        .unwrap();
}
