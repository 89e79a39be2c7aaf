//! Pictures that a scene names: OpenEXR.

use std::path::{Path, PathBuf};

use exr::meta::MetaData;
use exr::prelude::{AnyChannels, FlatSamples, ReadChannels, ReadLayers, read};

use super::element::Element;
use super::error::{Fault, SceneError};
use super::names::quote;

/// Most pixels in a picture.
const LARGEST: usize = 1 << 26;

/// Columns, rows and the pixels row by row from the top, of the picture whose name is the element's value.
pub(super) fn picture(element: &Element) -> Result<(usize, usize, Vec<[f32; 3]>), SceneError> {
    let name = element.required("value");
    let path = beside(element, name);
    let about = |fault: Fault| element.error(format!("{} {}", quote(name), fault.what), fault.mend);
    if !path.is_file() {
        return Err(about(Fault::new(crate::absent::absent(&path), "name a file, relative to the scene's")));
    }
    if !path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("exr")) {
        return Err(about(Fault::new(
            "is no .exr; other pictures are known but not built yet",
            "convert it to OpenEXR",
        )));
    }
    read_exr(&path).map_err(about)
}

/// The path of a file that an element names: relative names stand beside the scene file.
pub(super) fn beside(element: &Element, name: &str) -> PathBuf {
    Path::new(&*element.place.file).parent().unwrap_or(Path::new("")).join(name)
}

fn read_exr(path: &Path) -> Result<(usize, usize, Vec<[f32; 3]>), Fault> {
    let broken = |error: exr::error::Error| Fault::new(format!("cannot be read: {error}"), "give a valid OpenEXR file");
    let meta = MetaData::read_from_file(path, false).map_err(broken)?;
    for header in &meta.headers {
        let pixels = header.layer_size.width().checked_mul(header.layer_size.height());
        if pixels.is_none_or(|pixels| pixels > LARGEST) {
            return Err(Fault::new(format!("has more than {LARGEST} pixels"), "give a smaller picture"));
        }
    }
    let layers = read().no_deep_data().largest_resolution_level().all_channels().first_valid_layer().all_attributes();
    let image = layers.from_file(path).map_err(broken)?;
    let (width, height) = (image.layer_data.size.width(), image.layer_data.size.height());
    if width == 0 || height == 0 {
        return Err(Fault::new("has no pixels", "give a picture of at least one"));
    }
    let channels = &image.layer_data.channel_data;
    let planes = match ["R", "G", "B"].map(|name| plane(channels, name)) {
        [Some(r), Some(g), Some(b)] => [r, g, b],
        _ => {
            let grey = plane(channels, "Y");
            let grey = grey.ok_or_else(|| Fault::new("has neither R, G, B nor Y", "save it with these channels"))?;
            [grey.clone(), grey.clone(), grey]
        }
    };
    let pixels: Vec<[f32; 3]> = (0..width * height).map(|i| [planes[0][i], planes[1][i], planes[2][i]]).collect();
    match pixels.iter().position(|pixel| pixel.iter().any(|x| !(x.is_finite() && *x >= 0.0))) {
        Some(at) => {
            let (column, row) = (at % width, at / width);
            let what = format!("has a value at column {column}, row {row} that is negative or no number");
            Err(Fault::new(what, "mend the picture"))
        }
        None => Ok((width, height, pixels)),
    }
}

fn plane(channels: &AnyChannels<FlatSamples>, name: &str) -> Option<Vec<f32>> {
    let channel = channels.list.iter().find(|channel| channel.name.eq_case_insensitive(name))?;
    Some(channel.sample_data.values_as_f32().collect())
}
