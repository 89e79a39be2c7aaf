//! Saved photon maps: one versioned, checksummed file.
//!
//! Layout, little endian: `PHOTONLB`, version u32, channels u32, identity u128, seed u64, classes u32 (bits direct 1,
//! caustic 2, indirect 4), longest path u32 (0 is unlimited), longest specular run u32, lamps' ledger, photons on surfaces and
//! photons in media of each pass, and a 128-bit hash of all bytes before it. Trees are built when a map is read: that is faster than reading them.

use std::{
    io,
    path::{Path, PathBuf},
};

use photonlab_photometry::{Colour, PackedDirection, PathClass, Photon, VolumePhoton};
use photonlab_trace::{Book, Classes, Ledger, Limits, SurfaceBook, VolumeRecords};

use crate::{
    PassPhotons,
    checked_file::{Bytes, Hashing, partial_name},
};

pub(crate) const MAGIC: &[u8; 8] = b"PHOTONLB";
const VERSION: u32 = 2;

/// What a map is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MapHeader {
    /// Channels: 1 or 3.
    pub channels: u32,
    /// [`crate::scene_identity`] of its scene.
    pub identity: u128,
    /// The seed of its photons.
    pub seed: u64,
    /// Stored classes of photon.
    pub classes: Classes,
    /// When paths were ended.
    pub limits: Limits,
}

/// A saved map: the photons of every pass.
#[derive(Clone, Debug)]
pub struct MapFile<const C: usize> {
    /// What it is of.
    pub header: MapHeader,
    /// The replicates.
    pub passes: Vec<PassPhotons<C>>,
}

/// Why a map file cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum MapFileError {
    /// Reading or writing failed.
    #[error("{}: {cause}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system says.
        cause: io::Error,
    },
    /// Not a map, or not one of this version, or damaged.
    #[error("{}: {what}; build the map again with `photonlab map build`", path.display())]
    Unusable {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        what: String,
    },
}

impl MapHeader {
    /// Reads the header alone, after checking the whole file's hash.
    pub fn read(path: &Path) -> Result<Self, MapFileError> {
        header(&mut Bytes::of(path)?)
    }
}

impl<const C: usize> MapFile<C> {
    /// Writes the map beside its final name and renames it, so that no half-written map is left.
    pub fn save(&self, path: &Path) -> Result<(), MapFileError> {
        let io = |cause| MapFileError::Io { path: path.into(), cause };
        let partial = partial_name(path);
        let written = self.write(&partial).and_then(|()| std::fs::rename(&partial, path));
        written.map_err(|cause| {
            let _ = std::fs::remove_file(&partial);
            io(cause)
        })
    }

    /// Reads a map and checks it. The caller compares the header with the scene.
    pub fn load(path: &Path) -> Result<Self, MapFileError> {
        let mut bytes = Bytes::of(path)?;
        let header = header(&mut bytes)?;
        if header.channels as usize != C {
            return Err(bytes.unusable(&format!("it has {} channels and the scene {C}", header.channels)));
        }
        let surfaces = bytes.u32()? as usize;
        let passes = bytes.u32()?;
        let passes = (0..passes).map(|_| pass(&mut bytes, surfaces)).collect::<Result<_, _>>()?;
        if !bytes.is_at_end() {
            return Err(bytes.unusable("it is longer than its contents"));
        }
        Ok(Self { header, passes })
    }

    fn write(&self, path: &Path) -> io::Result<()> {
        let mut out = Hashing::create(path)?;
        let header = &self.header;
        out.put(MAGIC)?;
        out.put(&VERSION.to_le_bytes())?;
        out.put(&(C as u32).to_le_bytes())?;
        out.put(&header.identity.to_le_bytes())?;
        out.put(&header.seed.to_le_bytes())?;
        let bit = |class: PathClass| u32::from(header.classes.has(class)) << class as u32;
        out.put(&PathClass::ALL.into_iter().map(bit).sum::<u32>().to_le_bytes())?;
        out.put(&header.limits.max_segments.unwrap_or(0).to_le_bytes())?;
        out.put(&header.limits.max_specular.to_le_bytes())?;
        let surfaces = self.passes.first().map_or(0, |pass| pass.ledger.surfaces.len());
        out.put(&(surfaces as u32).to_le_bytes())?;
        out.put(&(self.passes.len() as u32).to_le_bytes())?;
        self.passes.iter().try_for_each(|pass| write_pass(&mut out, pass))?;
        out.finish()
    }
}

fn write_pass<const C: usize>(out: &mut Hashing, pass: &PassPhotons<C>) -> io::Result<()> {
    out.put(&pass.emitted.to_le_bytes())?;
    for flux in ledger_fields(&mut pass.ledger.clone()) {
        for value in flux.0 {
            out.put(&value.to_le_bytes())?;
        }
    }
    out.put(&pass.ledger.trapped_paths.to_le_bytes())?;
    out.put(&(pass.photons.len() as u64).to_le_bytes())?;
    for (position, photon) in pass.positions.iter().zip(&pass.photons) {
        let Photon { flux, direction, normal, class, segments } = photon;
        write_record(out, position, flux, [direction.to_bits(), normal.to_bits(), way(*class, *segments)])?;
    }
    out.put(&(pass.volume.photons.len() as u64).to_le_bytes())?;
    for (position, photon) in pass.volume.positions.iter().zip(&pass.volume.photons) {
        let VolumePhoton { flux, direction, medium, class, segments } = photon;
        write_record(out, position, flux, [direction.to_bits(), *medium, way(*class, *segments)])?;
    }
    Ok(())
}

fn write_record(out: &mut Hashing, position: &[f32; 3], flux: &[f32], rest: [u32; 3]) -> io::Result<()> {
    position.iter().chain(flux).try_for_each(|value| out.put(&value.to_le_bytes()))?;
    rest.iter().try_for_each(|value| out.put(&value.to_le_bytes()))
}

/// Class and segments of a path in one number.
fn way(class: PathClass, segments: u16) -> u32 {
    u32::from(segments) | (class as u32) << 16
}

/// One record: position, flux, two numbers, and its way.
type Record<const C: usize> = ([f32; 3], [f32; C], [u32; 2], PathClass, u16);

fn read_record<const C: usize>(bytes: &mut Bytes) -> Result<Record<C>, MapFileError> {
    let position = [bytes.f32()?, bytes.f32()?, bytes.f32()?];
    let mut flux = [0.0; C];
    for value in &mut flux {
        *value = bytes.f32()?;
    }
    let numbers = [bytes.u32()?, bytes.u32()?];
    let way = bytes.u32()?;
    let Some(&class) = PathClass::ALL.get((way >> 16) as usize) else {
        return Err(bytes.unusable("it holds a path class that this program does not know"));
    };
    Ok((position, flux, numbers, class, way as u16))
}

/// Every flux of a ledger, in the order of the file.
fn ledger_fields<const C: usize>(ledger: &mut Ledger<C>) -> Vec<&mut Colour<C>> {
    let mut fields = vec![&mut ledger.emitted];
    for Book { absorbed, escaped, cut_off, roulette_gain, roulette_loss } in &mut ledger.classes {
        fields.extend([absorbed, escaped, cut_off, roulette_gain, roulette_loss]);
    }
    for SurfaceBook { incident, outgoing, absorbed } in &mut ledger.surfaces {
        fields.extend([incident, outgoing, absorbed]);
    }
    fields
}

fn header(bytes: &mut Bytes) -> Result<MapHeader, MapFileError> {
    let _magic: [u8; 8] = bytes.take()?;
    let version = bytes.u32()?;
    if version != VERSION {
        return Err(bytes.unusable(&format!("its version is {version} and this program reads {VERSION}")));
    }
    let channels = bytes.u32()?;
    let identity = u128::from_le_bytes(bytes.take()?);
    let seed = bytes.u64()?;
    let bits = bytes.u32()?;
    let has = |class: PathClass| bits >> (class as u32) & 1 == 1;
    let classes = Classes {
        direct: has(PathClass::Direct),
        caustic: has(PathClass::Caustic),
        indirect: has(PathClass::Indirect),
    };
    let max_segments = Some(bytes.u32()?).filter(|&n| n > 0);
    let max_specular = bytes.u32()?;
    Ok(MapHeader { channels, identity, seed, classes, limits: Limits { max_segments, max_specular } })
}

fn pass<const C: usize>(bytes: &mut Bytes, surfaces: usize) -> Result<PassPhotons<C>, MapFileError> {
    let emitted = bytes.u64()?;
    let mut ledger = Ledger {
        emitted: Colour::ZERO,
        classes: [Book::default(); 3],
        surfaces: vec![SurfaceBook::default(); surfaces],
        trapped_paths: 0,
    };
    for field in ledger_fields(&mut ledger) {
        for channel in 0..C {
            field[channel] = bytes.take().map(f64::from_le_bytes)?;
        }
    }
    ledger.trapped_paths = bytes.u64()?;
    let count = bytes.u64()? as usize;
    let (mut positions, mut photons) = (Vec::new(), Vec::new());
    for _ in 0..count {
        let (position, flux, [direction, normal], class, segments) = read_record(bytes)?;
        let [direction, normal] = [direction, normal].map(PackedDirection::from_bits);
        positions.push(position);
        photons.push(Photon { flux, direction, normal, class, segments });
    }
    let mut volume = VolumeRecords::default();
    for _ in 0..bytes.u64()? {
        let (position, flux, [direction, medium], class, segments) = read_record(bytes)?;
        let direction = PackedDirection::from_bits(direction);
        volume.positions.push(position);
        volume.photons.push(VolumePhoton { flux, direction, medium, class, segments });
    }
    Ok(PassPhotons { positions, photons, volume, ledger, emitted })
}
