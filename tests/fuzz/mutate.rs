//! Mutations of files, from single bits to parts of other files.

use super::Seed;

/// Mutator of files; the same seed makes the same files.
pub struct Mutator {
    state: u64,
}

/// Numbers that often reveal errors in sizes, counts and offsets.
const NUMBERS: [&str; 14] = [
    "0",
    "-1",
    "1",
    "255",
    "65535",
    "65536",
    "2147483647",
    "4294967295",
    "4294967296",
    "18446744073709551615",
    "1e39",
    "0.5",
    "null",
    "[]",
];

impl Mutator {
    pub fn new(seed: u64) -> Self {
        Self { state: seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1 }
    }

    /// A random number below `bound` (xorshift).
    fn below(&mut self, bound: usize) -> usize {
        self.state ^= self.state << 13;
        self.state ^= self.state >> 7;
        self.state ^= self.state << 17;
        (self.state >> 11) as usize % bound.max(1)
    }

    /// A position in a file, often near its start, where headers are.
    fn place(&mut self, length: usize) -> usize {
        let reach = if self.below(2) == 0 { length.min(256) } else { length };
        self.below(reach)
    }

    /// A copy of `bytes` with one to four changes. Changes of a GLB usually stay within one of its chunks, and the
    /// lengths in its header are corrected, so that the changes reach the data behind the header.
    pub fn mutate(&mut self, bytes: &[u8], others: &[Seed]) -> Vec<u8> {
        let Some((mut json, mut binary)) = chunks(bytes).filter(|_| self.below(8) > 0) else {
            return self.changed(bytes.to_vec(), others);
        };
        if binary.is_empty() || self.below(2) == 0 {
            json = self.changed(json, others);
        } else {
            binary = self.changed(binary, others);
        }
        glb(&json, &binary)
    }

    fn changed(&mut self, mut bytes: Vec<u8>, others: &[Seed]) -> Vec<u8> {
        let changes = 1 << self.below(3);
        for _ in 0..changes {
            if !bytes.is_empty() {
                self.change(&mut bytes, others);
            }
        }
        bytes
    }

    fn change(&mut self, bytes: &mut Vec<u8>, others: &[Seed]) {
        let at = self.place(bytes.len());
        match self.below(10) {
            0 => bytes[at] ^= 1 << self.below(8),
            1 => bytes[at] = self.below(256) as u8,
            2 => {
                // The change is a little-endian word at a limit.
                let words = [0, 1, u32::MAX, i32::MAX as u32, 0x1_0000, self.state as u32];
                let word = words[self.below(words.len())].to_le_bytes();
                for (byte, new) in bytes[at..].iter_mut().zip(word) {
                    *byte = new;
                }
            }
            3 => bytes.truncate(at),
            4 => {
                let end = (at + 1 + self.below(64)).min(bytes.len());
                bytes.drain(at..end);
            }
            5 => {
                let end = (at + 1 + self.below(64)).min(bytes.len());
                let copy = bytes[at..end].to_vec();
                let to = self.place(bytes.len());
                bytes.splice(to..to, copy);
            }
            6 => {
                let end = (at + 1 + self.below(64)).min(bytes.len());
                let copy = bytes[at..end].to_vec();
                let to = self.below(bytes.len());
                for (byte, new) in bytes[to..].iter_mut().zip(copy) {
                    *byte = new;
                }
            }
            7 => {
                let other = &others[self.below(others.len())].bytes;
                let from = self.below(other.len());
                let to = (from + 1 + self.below(128)).min(other.len());
                bytes.splice(at..at, other[from..to].iter().copied());
            }
            _ => self.change_number(bytes, at),
        }
    }

    /// Replaces the first number in text from `at` on, so that the text stays a document.
    fn change_number(&mut self, bytes: &mut Vec<u8>, at: usize) {
        let is_number = |byte: &u8| byte.is_ascii_digit() || b"-.".contains(byte);
        let Some(start) = bytes[at..].iter().position(is_number).map(|i| at + i) else {
            return;
        };
        let length = bytes[start..].iter().take_while(|b| is_number(b)).count();
        let number = NUMBERS[self.below(NUMBERS.len())].as_bytes().to_vec();
        if self.below(2) == 0 {
            // The length stays the same, so that the chunk of a GLB stays valid.
            let padded = number.into_iter().chain(std::iter::repeat(b' ')).take(length);
            bytes.splice(start..start + length, padded.collect::<Vec<_>>());
        } else {
            bytes.splice(start..start + length, number);
        }
    }
}

/// JSON and binary chunk of a GLB.
fn chunks(bytes: &[u8]) -> Option<(Vec<u8>, Vec<u8>)> {
    let word = |at: usize| {
        let word = bytes.get(at..at + 4)?.try_into().ok()?;
        Some(u32::from_le_bytes(word) as usize)
    };
    let json_end = 20 + word(12).filter(|_| bytes.starts_with(b"glTF"))?;
    let json = bytes.get(20..json_end)?.to_vec();
    let binary = word(json_end).and_then(|length| bytes.get(json_end + 8..json_end + 8 + length));
    Some((json, binary.unwrap_or_default().to_vec()))
}

/// A GLB with two chunks.
pub fn glb(json: &[u8], binary: &[u8]) -> Vec<u8> {
    let mut glb = b"glTF".to_vec();
    let length = 12 + 8 + json.len() + 8 + binary.len();
    glb.extend([2, length as u32].iter().flat_map(|word| word.to_le_bytes()));
    for (chunk, kind) in [(json, b"JSON"), (binary, b"BIN\0")] {
        glb.extend((chunk.len() as u32).to_le_bytes());
        glb.extend(kind);
        glb.extend(chunk);
    }
    glb
}
