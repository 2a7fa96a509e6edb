//! Random numbers by name.
//!
//! A draw of a world has a path, such as `bottle.x`. Its generator depends on the seed of the sweep,
//! the number of the world and the path, and on nothing else.

use rand_pcg::Pcg64;
use rand_pcg::rand_core::Rng;

/// Increment of SplitMix64: 2^64 divided by the golden ratio (Steele, Lea and Flood, "Fast
/// splittable pseudorandom number generators", 2014).
const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

/// One number of two: the seed of a world, from the seed of its sweep and its number. Each of the two
/// passes through the finaliser of SplitMix64.
pub(crate) fn mix(seed: u64, world: u64) -> u64 {
    finalised(finalised(seed.wrapping_add(GOLDEN)) ^ world.wrapping_mul(GOLDEN))
}

fn finalised(number: u64) -> u64 {
    let number = (number ^ (number >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let number = (number ^ (number >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    number ^ (number >> 31)
}

/// The hash FNV-1a of a path, 64 bits.
pub fn fnv1a(path: &str) -> u64 {
    path.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

/// The numbers of one path.
#[derive(Clone, Debug)]
pub struct Draws(Pcg64);

impl Draws {
    /// The numbers of a path in a world of a sweep with that seed.
    pub fn new(seed: u64, world: u64, path: &str) -> Self {
        Self(Pcg64::new(
            u128::from(mix(seed, world)),
            u128::from(fnv1a(path)),
        ))
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0.next_u64()
    }

    /// A number from 0 up to, but not including, 1, with 53 random bits.
    pub fn unit(&mut self) -> f64 {
        // 53 bits fit into a double exactly.
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Puts things into a random order: the method of Fisher and Yates.
    pub(crate) fn shuffle<T>(&mut self, things: &mut [T]) {
        for last in (1..things.len()).rev() {
            // The cast rounds down.
            let other = (self.unit() * (last + 1) as f64) as usize;
            things.swap(last, other);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The values that FNV's authors publish.
    #[test]
    fn paths_are_hashed_as_fnv_says() {
        assert_eq!(fnv1a(""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(fnv1a("a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(fnv1a("foobar"), 0x8594_4171_f739_67e8);
    }

    /// The first output of SplitMix64 with state 0 is the finaliser of its increment.
    #[test]
    fn the_finaliser_is_that_of_splitmix() {
        assert_eq!(finalised(GOLDEN), 0xe220_a839_7b1d_cdaf);
    }

    #[test]
    fn numbers_never_change() {
        let first = |seed, world, path| Draws::new(seed, world, path).bits();
        assert_eq!(mix(0, 0), MIXED[0]);
        assert_eq!(mix(42, 17), MIXED[1]);
        assert_eq!(first(42, 17, "bottle.x"), FIRST[0]);
        assert_eq!(first(42, 17, "bottle.y"), FIRST[1]);
        assert_eq!(first(42, 18, "bottle.x"), FIRST[2]);
        assert_eq!(first(43, 17, "bottle.x"), FIRST[3]);
    }

    /// Fixed once and for all: other numbers would be other worlds.
    const MIXED: [u64; 2] = [0x4821_8226_ff3c_d4bf, 0x8c42_7dfc_f954_94bd];
    const FIRST: [u64; 4] = [
        0x8687_609a_c2f9_d645,
        0x4fc1_02be_9221_bee4,
        0x958b_3eb5_eba3_177f,
        0x0ac4_7970_fb60_0d39,
    ];

    #[test]
    fn numbers_of_neighbouring_worlds_are_uniform() {
        let mut counts = [0_u32; 10];
        for world in 0..10_000 {
            counts[(Draws::new(1, world, "x").unit() * 10.0) as usize] += 1;
        }
        // The expected count is 1000, its standard deviation 30.
        assert!(
            counts.iter().all(|count| (880..1120).contains(count)),
            "{counts:?}"
        );
    }
}
