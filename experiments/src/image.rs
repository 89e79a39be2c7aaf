//! Images: EXR with error layers, PNG for looking at.

use std::{io::Cursor, path::Path};

use exr::meta::attribute::AttributeValue;
use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image as ExrImage, Layer, LayerAttributes, Text, WritableImage,
};

use crate::{Failure, exr_header::sort_attributes};

/// Three channels per pixel, row 0 on top.
pub(crate) struct Image {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) pixels: Vec<[f32; 3]>,
}

/// Everything that an image file holds.
pub(crate) struct Layers {
    pub(crate) value: Image,
    pub(crate) std_error: Image,
    pub(crate) bias_bound: Image,
    pub(crate) photons_used: Vec<f32>,
    pub(crate) unit: String,
    pub(crate) attributes: Vec<(String, String)>,
}

/// Refuses an output that could not be written, before any work is done for it.
pub(crate) fn is_writable(path: &Path) -> Result<(), Failure> {
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if !folder.is_dir() {
        return Err(Failure::usage(format!(
            "-o {}: the folder {} does not exist; make it first",
            path.display(),
            folder.display()
        )));
    }
    if path.is_dir() {
        return Err(Failure::usage(format!("-o {}: this is a folder; name a file in it", path.display())));
    }
    if path.exists() && !path.is_file() {
        return Err(Failure::usage(format!(
            "-o {}: this is a device or a pipe, which a file would replace; name a plain file",
            path.display()
        )));
    }
    crate::interrupt::try_writing(path)?;
    Ok(())
}

impl Layers {
    /// One part, 32-bit float, linear; channels `R G B`, `std_error.*`, `bias_bound.*`, `photons_used.Y`.
    pub(crate) fn to_exr(&self) -> anyhow::Result<Vec<u8>> {
        let mut channels = Vec::new();
        for (prefix, image) in [("", &self.value), ("std_error.", &self.std_error), ("bias_bound.", &self.bias_bound)] {
            for (c, name) in ["R", "G", "B"].into_iter().enumerate() {
                let samples = image.pixels.iter().map(|pixel| pixel[c]).collect();
                channels.push(AnyChannel::new(format!("{prefix}{name}").as_str(), FlatSamples::F32(samples)));
            }
        }
        channels.push(AnyChannel::new("photons_used.Y", FlatSamples::F32(self.photons_used.clone())));
        let mut attributes = LayerAttributes::default();
        for (name, value) in &self.attributes {
            let value = Text::new_or_none(value).unwrap_or_else(|| Text::from("not expressible"));
            attributes.other.insert(Text::from(name.as_str()), AttributeValue::Text(value));
        }
        encode_exr(&self.value, channels, attributes)
    }

    /// Tone-mapped for looking at: exposed so that the brightest percent saturates, sRGB curve.
    pub(crate) fn to_png(&self) -> anyhow::Result<Vec<u8>> {
        self.value.to_png(self.value.white())
    }

    /// Luminance in colours with a legend in its unit.
    pub(crate) fn to_false_colour_png(&self) -> anyhow::Result<Vec<u8>> {
        crate::false_colour::png(&self.value, &self.unit, None)
    }
}

impl Image {
    /// The value that the brightest percent of the pixels exceeds: white in a picture of it.
    pub(crate) fn white(&self) -> f32 {
        percentile(self.pixels.iter().map(|p| p.iter().copied().fold(0.0, f32::max)), 0.99)
    }

    /// Tone-mapped for looking at, `white` and above white.
    pub(crate) fn to_png(&self, white: f32) -> anyhow::Result<Vec<u8>> {
        let scale = if white > 0.0 { 1.0 / white } else { 1.0 };
        let rgb: Vec<u8> = self.pixels.iter().flat_map(|pixel| pixel.map(|x| srgb(x * scale))).collect();
        encode_png(self.width, self.height, &rgb)
    }

    /// The image alone as EXR, linear, 32-bit float.
    pub(crate) fn to_exr(&self) -> anyhow::Result<Vec<u8>> {
        let channel = |(c, name): (usize, &&str)| {
            AnyChannel::new(*name, FlatSamples::F32(self.pixels.iter().map(|pixel| pixel[c]).collect()))
        };
        encode_exr(self, ["R", "G", "B"].iter().enumerate().map(channel).collect(), LayerAttributes::default())
    }

    /// Several images of one height in a row, with a white gap of two pixels between them.
    pub(crate) fn side_by_side(images: &[&Image], white: f32) -> Image {
        const GAP: usize = 2;
        let height = images.first().map_or(0, |image| image.height);
        let width = images.iter().map(|image| image.width + GAP).sum::<usize>().saturating_sub(GAP);
        let mut row = Image { width, height, pixels: vec![[white; 3]; width * height] };
        let mut left = 0;
        for image in images {
            for y in 0..height {
                let from = y * image.width;
                row.pixels[y * width + left..][..image.width].copy_from_slice(&image.pixels[from..from + image.width]);
            }
            left += image.width + GAP;
        }
        row
    }
}

/// One part with the channels of an image's size.
fn encode_exr(
    image: &Image,
    channels: Vec<AnyChannel<FlatSamples>>,
    attributes: LayerAttributes,
) -> anyhow::Result<Vec<u8>> {
    let channels = AnyChannels::sort(channels.into_iter().collect());
    let layer = Layer::new((image.width, image.height), attributes, Encoding::FAST_LOSSLESS, channels);
    let mut bytes = Cursor::new(Vec::new());
    ExrImage::from_layer(layer).write().non_parallel().to_buffered(&mut bytes)?;
    let mut bytes = bytes.into_inner();
    sort_attributes(&mut bytes)?;
    Ok(bytes)
}

/// Writes an 8-bit RGB image.
pub(crate) fn encode_png(width: usize, height: usize, rgb: &[u8]) -> anyhow::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width as u32, height as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(rgb)?;
    writer.finish()?;
    Ok(bytes)
}

/// The value below which a share of the finite numbers lies.
pub(crate) fn percentile(values: impl Iterator<Item = f32>, share: f64) -> f32 {
    let mut sorted: Vec<f32> = values.filter(|x| x.is_finite()).collect();
    sorted.sort_by(f32::total_cmp);
    let last = sorted.len().saturating_sub(1);
    sorted.get((share * last as f64).round() as usize).copied().unwrap_or(0.0)
}

/// The sRGB transfer curve, to 8 bits.
fn srgb(linear: f32) -> u8 {
    let x = linear.clamp(0.0, 1.0);
    let curved = if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 };
    (curved * 255.0).round() as u8
}
