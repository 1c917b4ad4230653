//! The picture's hash: the CRC-32 of zlib, PNG and IEEE 802.3 over the RGB888 bytes of all pixels, row by row from the
//! top. That is `zlib.crc32` of a binary PPM's pixels, so that anyone can check a board's figure with the standard tools.

/// A CRC-32 so far. No table: 1 KB of flash would be more than the renderer's shader.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Crc32(u32);

impl Crc32 {
    /// Of no bytes.
    pub const fn new() -> Self {
        Self(!0)
    }

    /// Takes one more byte.
    pub const fn byte(&mut self, byte: u8) {
        self.0 ^= byte as u32;
        let mut bit = 0;
        while bit < 8 {
            let carry = 0_u32.wrapping_sub(self.0 & 1);
            self.0 = (self.0 >> 1) ^ (0xEDB8_8320 & carry);
            bit += 1;
        }
    }

    /// The figure.
    pub const fn value(self) -> u32 {
        !self.0
    }
}

impl Default for Crc32 {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::Crc32;

    #[test]
    fn is_the_published_check_value() {
        let mut crc = Crc32::new();
        for byte in *b"123456789" {
            crc.byte(byte);
        }
        assert_eq!(crc.value(), 0xCBF4_3926);
    }
}
