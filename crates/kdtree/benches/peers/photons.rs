//! Photon sets and queries, made by stated formulas.

/// Positions with an RGB payload each, and queries distributed like them.
pub(crate) struct PhotonSet {
    pub(crate) name: &'static str,
    pub(crate) points: Vec<[f32; 3]>,
    pub(crate) payload: Vec<[f32; 3]>,
    /// In no order.
    pub(crate) random: Vec<[f32; 3]>,
    /// Runs of a dense set of queries along a Morton curve, as an image's tiles would ask.
    pub(crate) coherent: Vec<[f32; 3]>,
}

/// Splitmix64, as numbers below 1.
struct Draw(u64);

impl Draw {
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 40) as f32 / (1u64 << 24) as f32
    }
}

/// Uniform on five faces of the unit cube, the one at z = 1 left open.
fn walls(draw: &mut Draw) -> [f32; 3] {
    let (face, u, v) = ((draw.next() * 5.0) as usize, draw.next(), draw.next());
    [[u, v, 0.0], [0.0, u, v], [1.0, u, v], [u, 0.0, v], [u, 1.0, v]][face.min(4)]
}

/// 70 % on the floor y = 0 in a spot about (0.5, 0.4) of radius 0.05, uniform in radius and so bright in the
/// middle; the others on the walls.
fn caustic(draw: &mut Draw) -> [f32; 3] {
    if draw.next() < 0.7 {
        let (r, angle) = (0.05 * draw.next(), std::f32::consts::TAU * draw.next());
        [0.5 + r * angle.cos(), 0.0, 0.4 + r * angle.sin()]
    } else {
        walls(draw)
    }
}

/// Uniform in the unit cube.
fn volume(draw: &mut Draw) -> [f32; 3] {
    [draw.next(), draw.next(), draw.next()]
}

/// Draws a position.
type Place = fn(&mut Draw) -> [f32; 3];

/// The three sets of `count` photons, with `asked` queries in either order.
pub(crate) fn sets(count: usize, asked: usize) -> [PhotonSet; 3] {
    let kinds: [(_, Place); 3] = [("walls", walls), ("caustic", caustic), ("volume", volume)];
    kinds.map(|(name, place)| {
        let mut draw = Draw(1);
        let points: Vec<_> = (0..count).map(|_| place(&mut draw)).collect();
        let payload = (0..count).map(|_| [draw.next(), draw.next(), draw.next()]).collect();
        let random: Vec<_> = (0..asked).map(|_| place(&mut draw)).collect();
        let mut dense: Vec<_> = (0..20 * asked).map(|_| place(&mut draw)).collect();
        dense.sort_by_cached_key(|&query| morton(query));
        let run = asked / 10;
        let coherent = dense.chunks(20 * run).flat_map(|part| part[..run].to_vec()).collect();
        PhotonSet { name, points, payload, random, coherent }
    })
}

fn morton(point: [f32; 3]) -> u64 {
    let spread = |x: f32| {
        let cell = (x * 2047.0) as u64;
        (0..11).fold(0, |bits, bit| bits | (cell >> bit & 1) << (3 * bit))
    };
    spread(point[0]) | spread(point[1]) << 1 | spread(point[2]) << 2
}
