//! PPM, the binary variant P6.

use std::io::{self, Write};

pub(super) fn write(
    file: &mut dyn Write,
    width: u16,
    height: u16,
    rows: &mut dyn Iterator<Item = Vec<u8>>,
) -> io::Result<()> {
    write!(file, "P6\n{width} {height}\n255\n")?;
    for row in rows {
        file.write_all(&row)?;
    }
    Ok(())
}
