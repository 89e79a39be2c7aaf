//! What a reading is, and its unit.

use serde::{Deserialize, Serialize};

/// Whether results are in watts or in lumens.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum UnitSystem {
    /// W, W/m^2, W/sr, W/(m^2 sr).
    #[default]
    Radiometric,
    /// lm, lx, cd, cd/m^2.
    Photometric,
}

/// The measured quantity, with the names of both systems.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Quantity {
    /// Flux per area that arrives at a surface, W/m^2.
    #[serde(rename = "irradiance")]
    Irradiance,
    /// Flux per area and solid angle along a ray, W/(m^2 sr).
    #[serde(rename = "radiance")]
    Radiance,
    /// Irradiance weighted by the eye, lx.
    #[serde(rename = "illuminance")]
    Illuminance,
    /// Radiance weighted by the eye, cd/m^2.
    #[serde(rename = "luminance")]
    Luminance,
    /// Flux, W.
    #[serde(rename = "flux")]
    Flux,
    /// Flux weighted by the eye, lm.
    #[serde(rename = "luminous flux")]
    LuminousFlux,
    /// Flux per solid angle far away, W/sr.
    #[serde(rename = "intensity")]
    Intensity,
    /// Intensity weighted by the eye, cd.
    #[serde(rename = "luminous intensity")]
    LuminousIntensity,
}

impl Quantity {
    /// The same quantity in the wanted system.
    pub fn in_system(self, system: UnitSystem) -> Self {
        match (self, system) {
            (Quantity::Irradiance | Quantity::Illuminance, UnitSystem::Radiometric) => Quantity::Irradiance,
            (Quantity::Irradiance | Quantity::Illuminance, UnitSystem::Photometric) => Quantity::Illuminance,
            (Quantity::Radiance | Quantity::Luminance, UnitSystem::Radiometric) => Quantity::Radiance,
            (Quantity::Radiance | Quantity::Luminance, UnitSystem::Photometric) => Quantity::Luminance,
            (Quantity::Flux | Quantity::LuminousFlux, UnitSystem::Radiometric) => Quantity::Flux,
            (Quantity::Flux | Quantity::LuminousFlux, UnitSystem::Photometric) => Quantity::LuminousFlux,
            (Quantity::Intensity | Quantity::LuminousIntensity, UnitSystem::Radiometric) => Quantity::Intensity,
            (Quantity::Intensity | Quantity::LuminousIntensity, UnitSystem::Photometric) => Quantity::LuminousIntensity,
        }
    }

    /// Its unit.
    pub fn unit(self) -> Unit {
        match self {
            Quantity::Irradiance => Unit::WattPerSquareMetre,
            Quantity::Radiance => Unit::WattPerSquareMetreSteradian,
            Quantity::Illuminance => Unit::Lux,
            Quantity::Luminance => Unit::CandelaPerSquareMetre,
            Quantity::Flux => Unit::Watt,
            Quantity::LuminousFlux => Unit::Lumen,
            Quantity::Intensity => Unit::WattPerSteradian,
            Quantity::LuminousIntensity => Unit::Candela,
        }
    }
}

/// A unit, written as the contract writes it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Unit {
    /// W/m^2
    #[serde(rename = "W/m^2")]
    WattPerSquareMetre,
    /// W/(m^2 sr)
    #[serde(rename = "W/(m^2 sr)")]
    WattPerSquareMetreSteradian,
    /// lx
    #[serde(rename = "lx")]
    Lux,
    /// cd/m^2
    #[serde(rename = "cd/m^2")]
    CandelaPerSquareMetre,
    /// W
    #[serde(rename = "W")]
    Watt,
    /// lm
    #[serde(rename = "lm")]
    Lumen,
    /// W/sr
    #[serde(rename = "W/sr")]
    WattPerSteradian,
    /// cd
    #[serde(rename = "cd")]
    Candela,
}

impl Unit {
    /// The unit's symbol.
    pub fn symbol(self) -> &'static str {
        match self {
            Unit::WattPerSquareMetre => "W/m^2",
            Unit::WattPerSquareMetreSteradian => "W/(m^2 sr)",
            Unit::Lux => "lx",
            Unit::CandelaPerSquareMetre => "cd/m^2",
            Unit::Watt => "W",
            Unit::Lumen => "lm",
            Unit::WattPerSteradian => "W/sr",
            Unit::Candela => "cd",
        }
    }
}

impl std::fmt::Display for Unit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.symbol())
    }
}
