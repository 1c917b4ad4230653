//! What holds for every text that is printed, for the fuzz target and for fuzzing.rs, as properties.rs has it for the rest: this
//! needs the feature `print`.

use scanray::{Scalar, ScenePools, parser::FromDecimal};

use super::properties::read;

/// What is printed of a scene is read back as the same scene, and printed the same again.
pub(crate) fn print(text: &[u8]) {
    print_and_read::<f32>(text);
    print_and_read::<f64>(text);
}

fn print_and_read<T: Scalar + FromDecimal>(text: &[u8]) {
    let Some(pools) = read::<T>(text) else { return };
    let scene = pools.as_scene();
    let printed = scanray::print(&scene).unwrap().to_string();
    let mut again = Box::new(ScenePools::<T>::new());
    if let Err(error) = again.parse(printed.as_bytes()) {
        panic!("{error}\n{printed}");
    }
    // The debug format tells −0 from 0.
    assert_eq!(
        format!("{scene:?}"),
        format!("{:?}", again.as_scene()),
        "{printed}"
    );
    let once_more = scanray::print(&again.as_scene()).unwrap().to_string();
    assert_eq!(printed, once_more);
}
