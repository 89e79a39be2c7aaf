//! Random numbers that depend on (seed, purpose, pass, index, dimension) and on nothing else.

/// What a stream of random numbers is for; streams of different purposes never share a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Purpose {
    /// Photon paths; the index is the photon's.
    Photons = 0,
    /// Reading; the index counts cells and samples.
    Readout = 1,
    /// Offsets of quasi-random point sets; the index is the cell's.
    Offsets = 2,
    /// Rays from lamps towards a meter; the index counts cells and rays.
    Probes = 4,
    /// Wavelengths of a pass.
    Wavelengths = 5,
    /// Walks that look for ways out; the index is the walk's.
    Enclosure = 6,
    /// Looks at what an aim's rays carry; the index is the aim's.
    Aims = 7,
    /// How a pass's quasi-random photons are scrambled; the index is the source's.
    Scrambles = 8,
    /// Rays of an irradiance cache; the index is the site's.
    Cache = 9,
    /// Anything else: synthetic photons of experiments and tests.
    Synthetic = 3,
}

/// Philox4x32-10 (Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", SC 2011).
pub fn philox4x32(mut counter: [u32; 4], mut key: [u32; 2]) -> [u32; 4] {
    for _ in 0..10 {
        let left = u64::from(counter[0]) * 0xD251_1F53;
        let right = u64::from(counter[2]) * 0xCD9E_8D57;
        counter = [
            (right >> 32) as u32 ^ counter[1] ^ key[0],
            right as u32,
            (left >> 32) as u32 ^ counter[3] ^ key[1],
            left as u32,
        ];
        key = [key[0].wrapping_add(0x9E37_79B9), key[1].wrapping_add(0xBB67_AE85)];
    }
    counter
}

/// The random numbers of one photon, or of one sample of one cell.
///
/// Counter: (block, pass, index). *Numerics*: numbers are odd multiples of 2^-33, so neither 0 nor 1 occurs; a stream
/// has 2^34 of them.
#[derive(Clone, Debug)]
pub struct Stream {
    key: [u32; 2],
    counter: [u32; 4],
    block: [u32; 4],
    used: usize,
    prefix: [f64; Stream::PREFIX],
    prefix_left: usize,
}

impl Stream {
    /// How many leading numbers a quasi-random point can replace.
    pub const PREFIX: usize = 5;

    /// The stream of one index (below 2^60) of one pass.
    pub fn new(seed: u64, purpose: Purpose, pass: u32, index: u64) -> Self {
        debug_assert!(index < 1 << 60);
        Self {
            key: [seed as u32, (seed >> 32) as u32],
            counter: [0, pass, index as u32, (index >> 32) as u32 | (purpose as u32) << 28],
            block: [0; 4],
            used: 4,
            prefix: [0.0; Self::PREFIX],
            prefix_left: 0,
        }
    }

    /// The same stream with its leading numbers replaced by a point of a quasi-random set.
    pub fn with_prefix(mut self, point: [f64; Self::PREFIX]) -> Self {
        self.lead_with(point);
        self
    }

    /// Lets the point of a quasi-random set come before what else is left.
    pub(crate) fn lead_with(&mut self, point: [f64; Self::PREFIX]) {
        self.prefix = point;
        self.prefix_left = Self::PREFIX;
    }

    /// The next number in (0, 1).
    #[expect(clippy::should_implement_trait, reason = "an iterator's next may end; a stream's does not")]
    #[inline]
    pub fn next(&mut self) -> f64 {
        if self.prefix_left > 0 {
            self.prefix_left -= 1;
            return self.prefix[Self::PREFIX - 1 - self.prefix_left];
        }
        (f64::from(self.word()) + 0.5) / 4_294_967_296.0
    }

    /// The next 32 bits, after a prefix.
    #[inline]
    pub(crate) fn word(&mut self) -> u32 {
        if self.used == 4 {
            self.block = philox4x32(self.counter, self.key);
            self.counter[0] = self.counter[0].wrapping_add(1);
            self.used = 0;
        }
        let word = self.block[self.used];
        self.used += 1;
        word
    }

    /// The next two numbers.
    #[inline]
    pub fn next2(&mut self) -> [f64; 2] {
        [self.next(), self.next()]
    }

    /// Skips what is left of the quasi-random point, so that what follows starts at the same place whatever came before.
    pub fn leave_prefix(&mut self) {
        self.prefix_left = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The known answers published with Random123.
    #[test]
    fn philox_gives_the_published_answers() {
        assert_eq!(philox4x32([0; 4], [0; 2]), [0x6627_e8d5, 0xe169_c58d, 0xbc57_ac4c, 0x9b00_dbd8]);
        assert_eq!(philox4x32([u32::MAX; 4], [u32::MAX; 2]), [0x408f_276d, 0x41c8_3b0e, 0xa20b_c7c6, 0x6d54_51fd]);
        assert_eq!(
            philox4x32([0x243f_6a88, 0x85a3_08d3, 0x1319_8a2e, 0x0370_7344], [0xa409_3822, 0x299f_31d0]),
            [0xd16c_fe09, 0x94fd_cceb, 0x5001_e420, 0x2412_6ea1]
        );
    }

    #[test]
    fn streams_differ_and_repeat() {
        let take = |seed, purpose, pass, index| {
            let mut stream = Stream::new(seed, purpose, pass, index);
            [stream.next(), stream.next(), stream.next(), stream.next(), stream.next()]
        };
        let base = take(1, Purpose::Photons, 0, 0);
        assert_eq!(base, take(1, Purpose::Photons, 0, 0));
        for other in [
            take(2, Purpose::Photons, 0, 0),
            take(1, Purpose::Readout, 0, 0),
            take(1, Purpose::Photons, 1, 0),
            take(1, Purpose::Photons, 0, 1 << 33),
        ] {
            assert!(base.iter().all(|x| !other.contains(x)));
        }
    }

    #[test]
    fn a_prefix_comes_first_and_then_the_stream_goes_on() {
        let mut plain = Stream::new(7, Purpose::Readout, 3, 5);
        let mut led = plain.clone().with_prefix([0.25; Stream::PREFIX]);
        assert_eq!([led.next(), led.next()], [0.25, 0.25]);
        led.leave_prefix();
        assert_eq!(led.next(), plain.next());
    }
}
