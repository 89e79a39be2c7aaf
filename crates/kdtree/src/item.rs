//! Points while a tree is built.

use crate::bounds::Bounds;

/// A point on its way to its leaf: the coordinates, and the bits of the original index.
pub(crate) type Item = [f32; 4];

/// Point `index` of those given.
pub(crate) fn item(points: &[[f32; 3]], index: u32) -> Item {
    let [x, y, z] = points[index as usize];
    [x, y, z, f32::from_bits(index)]
}

/// Where the point stood in the order given.
pub(crate) fn index(item: &Item) -> u32 {
    item[3].to_bits()
}

/// Rises with the coordinate in the order of [`f32::total_cmp`], then with the original index.
#[inline(always)]
pub(crate) fn key(item: &Item, axis: usize) -> u64 {
    let bits = item[axis].to_bits();
    let ordered = bits ^ (((bits as i32 >> 31) as u32) | 1 << 31);
    u64::from(ordered) << 32 | u64::from(index(item))
}

/// The tight box. Four points at once, or each minimum would wait for the one before; the fourth lanes mean nothing.
pub(crate) fn bounds(items: &[Item]) -> Bounds {
    let (mut lo, mut hi) = ([[f32::INFINITY; 4]; 4], [[f32::NEG_INFINITY; 4]; 4]);
    let (fours, rest) = items.as_chunks::<4>();
    for four in fours {
        for i in 0..4 {
            extend(&mut lo[i], &mut hi[i], &four[i]);
        }
    }
    let ends = [lo, hi];
    let (mut lo, mut hi) = (lo[0], hi[0]);
    for item in rest.iter().chain(ends.as_flattened()) {
        if item[0].is_finite() {
            extend(&mut lo, &mut hi, item);
        }
    }
    Bounds { lo: [lo[0], lo[1], lo[2]], hi: [hi[0], hi[1], hi[2]] }
}

#[inline(always)]
fn extend(lo: &mut Item, hi: &mut Item, item: &Item) {
    for lane in 0..4 {
        lo[lane] = if item[lane] < lo[lane] { item[lane] } else { lo[lane] };
        hi[lane] = if item[lane] > hi[lane] { item[lane] } else { hi[lane] };
    }
}
