//! False colours with a legend.

use crate::{
    canvas::{Canvas, DOT, GLYPH},
    image::{Image, encode_png, percentile},
};

/// Pixels of the legend to the right of the image.
const LEGEND_WIDTH: usize = 150;
const MARGIN: usize = 12;
const BAR: usize = 18;
/// Marks on the legend's scale.
const MARKS: usize = 5;
/// A legend needs this height to be readable; smaller images are enlarged by whole factors.
const SMALLEST_HEIGHT: usize = 256;

/// An image of the mean of the channels, on a linear scale from 0 to `top` (else to the 99.5th percentile), with a legend
/// in its unit.
pub(crate) fn png(image: &Image, unit: &str, top: Option<f32>) -> anyhow::Result<Vec<u8>> {
    let zoom = SMALLEST_HEIGHT.div_ceil(image.height.max(1)).max(1);
    let (width, height) = (image.width * zoom + LEGEND_WIDTH, image.height * zoom);
    let mean = |pixel: &[f32; 3]| (pixel[0] + pixel[1] + pixel[2]) / 3.0;
    let top = top.unwrap_or_else(|| percentile(image.pixels.iter().map(mean), 0.995)).max(f32::MIN_POSITIVE);
    let mut canvas = Canvas::new(width, height);
    for y in 0..height {
        for x in 0..image.width * zoom {
            let value = mean(&image.pixels[(y / zoom) * image.width + x / zoom]);
            canvas.set(x, y, colour(value / top));
        }
    }
    draw_legend(&mut canvas, image.width * zoom + MARGIN, f64::from(top), unit);
    encode_png(width, height, &canvas.rgb)
}

fn draw_legend(canvas: &mut Canvas, left: usize, top: f64, unit: &str) {
    canvas.text(left, MARGIN, unit);
    let (first, last) = (MARGIN + 3 * GLYPH.1 * DOT, canvas.height - MARGIN - GLYPH.1 * DOT);
    for y in first..last {
        let share = (last - 1 - y) as f32 / (last - 1 - first) as f32;
        canvas.fill([left, y], [BAR, 1], colour(share));
    }
    for mark in 0..MARKS {
        let share = mark as f64 / (MARKS - 1) as f64;
        let y = last - 1 - (share * (last - 1 - first) as f64) as usize;
        canvas.text(left + BAR + MARGIN / 2, y - GLYPH.1 * DOT / 2, &short(share * top));
    }
}

/// Three digits, with an exponent where needed.
fn short(value: f64) -> String {
    let magnitude = if value == 0.0 { 0.0 } else { value.abs().log10().floor() };
    match magnitude {
        m if !(-3.0..5.0).contains(&m) => format!("{value:.2e}"),
        m => format!("{value:.*}", (2.0 - m).max(0.0) as usize),
    }
}

/// Dark blue over green to yellow: even steps in lightness, told apart by colour-blind readers (after viridis).
pub(crate) fn colour(share: f32) -> [u8; 3] {
    const STOPS: [[f32; 3]; 6] = [
        [68.0, 1.0, 84.0],
        [65.0, 68.0, 135.0],
        [42.0, 120.0, 142.0],
        [34.0, 168.0, 132.0],
        [122.0, 209.0, 81.0],
        [253.0, 231.0, 37.0],
    ];
    let at = share.clamp(0.0, 1.0) * (STOPS.len() - 1) as f32;
    let low = (at as usize).min(STOPS.len() - 2);
    let part = at - low as f32;
    std::array::from_fn(|c| (STOPS[low][c] + part * (STOPS[low + 1][c] - STOPS[low][c])).round() as u8)
}
