//! Images as they are in the file, and our own metric of their difference.

use std::path::Path;

use exr::prelude::{FlatSamples, read_all_flat_layers_from_file};

/// A layer of an OpenEXR file.
pub struct Exr {
    /// Columns and rows.
    pub size: [usize; 2],
    /// Names and samples, row by row, in the order of the file.
    pub channels: Vec<(String, Vec<f32>)>,
    /// Attributes that hold text.
    pub attributes: Vec<(String, String)>,
}

/// Why images cannot be compared.
#[derive(Debug, PartialEq, Eq)]
pub enum ImageError {
    /// Sizes or channels differ.
    Different(String),
    /// A sample is NaN or infinite, so that no difference means anything.
    NotFinite(String),
}

impl Exr {
    /// Reads a file of one part with 32-bit channels.
    ///
    /// # Panics
    /// If it is anything else.
    pub fn read(path: &Path) -> Self {
        let file = read_all_flat_layers_from_file(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let [layer] = file.layer_data.as_slice() else {
            panic!("{}: {} parts", path.display(), file.layer_data.len());
        };
        let channels = layer.channel_data.list.iter().map(|channel| match &channel.sample_data {
            FlatSamples::F32(samples) => (channel.name.to_string(), samples.clone()),
            _ => panic!("{}: {} is not 32-bit float", path.display(), channel.name),
        });
        let texts = layer.attributes.other.iter().filter_map(|(name, value)| match value {
            exr::meta::attribute::AttributeValue::Text(text) => Some((name.to_string(), text.to_string())),
            _ => None,
        });
        Self { size: [layer.size.0, layer.size.1], channels: channels.collect(), attributes: texts.collect() }
    }

    /// The samples of a channel.
    ///
    /// # Panics
    /// If there is no such channel.
    pub fn channel(&self, name: &str) -> &[f32] {
        let found = self.channels.iter().find(|(known, _)| known == name);
        &found.unwrap_or_else(|| panic!("no channel {name}")).1
    }

    /// Root of the mean squared difference over all samples of all channels.
    pub fn rms_difference(&self, other: &Self) -> Result<f64, ImageError> {
        let names = |image: &Self| image.channels.iter().map(|(name, _)| name.clone()).collect::<Vec<_>>();
        if self.size != other.size || names(self) != names(other) {
            return Err(ImageError::Different(format!(
                "{:?} {:?} against {:?} {:?}",
                self.size,
                names(self),
                other.size,
                names(other)
            )));
        }
        let (mut squares, mut count) = (0.0, 0);
        for ((name, a), (_, b)) in self.channels.iter().zip(&other.channels) {
            for (&a, &b) in a.iter().zip(b) {
                if !(a.is_finite() && b.is_finite()) {
                    return Err(ImageError::NotFinite(format!("{name}: {a} against {b}")));
                }
                squares += (f64::from(a) - f64::from(b)).powi(2);
                count += 1;
            }
        }
        Ok((squares / f64::from(count)).sqrt())
    }
}
