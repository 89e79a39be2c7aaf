//! Why a scene needs what it needs.

use crate::{Bsdf, Geometry, Needs, Receiver, Scene};

/// A share of light that is little beside what came.
const LITTLE: f64 = 1e-3;

/// Kinds of light paths in the notation of Heckbert 1990 (L lamp, S specular, D diffuse, V scattered in a medium; + once or more, * any number):
/// those that exist, and those that do not.
pub(crate) fn path_classes(needs: &Needs) -> (String, String) {
    let classes = [
        (needs.direct, "LD straight from a lamp"),
        (needs.caustic, "LS+D by specular surfaces alone"),
        (needs.indirect, "L(S|D)*D(S|D)*D from a diffuse surface on"),
        (needs.in_scattering, "L..V.. by way of a medium"),
    ];
    let of = |exists: bool| -> Vec<&str> {
        classes.iter().filter(|(present, _)| *present == exists).map(|(_, class)| *class).collect()
    };
    (of(true).join(", "), of(false).join(", "))
}

/// How many bounces can still change a reading, and why; or why none can.
pub(crate) fn bounces(scene: &Scene, needs: &Needs) -> Result<String, &'static str> {
    if !(needs.caustic || needs.indirect || needs.in_scattering) {
        return Err("no light that a surface or a medium hands on can reach a surface that is read");
    }
    if let Some(segments) = scene.max_depth {
        return Ok(format!("up to {} between lamp and reading: the file's max_depth", segments.saturating_sub(1)));
    }
    let surfaces = || scene.shapes.iter().map(|shape| (shape, most_handed_on(&shape.bsdf)));
    let unknown = surfaces().find(|(_, most)| most.is_none()).map(|(shape, _)| shape.id.as_str());
    let scattering = scene.media.iter().find(|medium| medium.scatters()).map(|medium| medium.id.as_str());
    if let Some(id) = unknown.or(scattering) {
        return Ok(format!(
            "as many as come (how much `{id}` hands on is not looked into); roulette ends paths without bias"
        ));
    }
    let most = surfaces().filter_map(|(_, most)| most).fold(0.0, f64::max);
    if most >= 1.0 {
        return Ok("as many as come: a surface hands on all light; roulette ends paths without bias".into());
    }
    let count = (LITTLE.ln() / most.ln()).ceil();
    Ok(format!(
        "each hands on at most {:.1} %, so that {count} leave less than {} %; roulette ends paths without bias",
        100.0 * most,
        100.0 * LITTLE
    ))
}

/// The largest share of light that leaves a surface again; `None` where that is not looked into.
fn most_handed_on(bsdf: &Bsdf) -> Option<f64> {
    Some(match bsdf {
        Bsdf::Diffuse { reflectance } | Bsdf::Mirror { reflectance } => reflectance.max(),
        Bsdf::Transmitter { reflectance, transmittance } => reflectance.max_of_sum(transmittance),
        Bsdf::TwoSided { front, back } => most_handed_on(front)?.max(most_handed_on(back)?),
        Bsdf::Mask { surface, .. } => most_handed_on(surface)?,
        Bsdf::Null => 0.0,
        Bsdf::Plastic { .. } | Bsdf::Dielectric(_) | Bsdf::ThinDielectric { .. } | Bsdf::Conductor(_) => return None,
    })
}

/// A glass that refracts wavelengths differently.
pub(crate) fn dispersing(scene: &Scene) -> Option<&str> {
    scene.shapes.iter().find(|shape| shape.bsdf.disperses()).map(|shape| shape.id.as_str())
}

/// Why light is followed by wavelength.
pub(crate) fn spectral_reason(scene: &Scene) -> String {
    let by_wavelength = |shape: &&crate::Shape| shape.bsdf.spectra().iter().any(|spectrum| spectrum.is_curve());
    if let Some(id) = dispersing(scene) {
        return format!("`{id}` refracts wavelengths differently");
    }
    match scene.shapes.iter().find(by_wavelength) {
        Some(shape) => format!("the coating of `{}` is given by wavelength", shape.id),
        None => "a lamp is given by wavelength".into(),
    }
}

pub(crate) fn first_specular(scene: &Scene) -> Option<&str> {
    scene.shapes.iter().find(|shape| shape.bsdf.is_specular()).map(|shape| shape.id.as_str())
}

/// Why light that was scattered in all directions can reach a surface that is read, if it can.
pub(crate) fn indirect_reason(scene: &Scene) -> Option<String> {
    if let Some(medium) = scene.media.iter().find(|medium| medium.scatters()) {
        return Some(format!("`{}` scatters light, which can reach any surface", medium.id));
    }
    let reflecting: Vec<usize> =
        (0..scene.shapes.len()).filter(|&index| scene.shapes[index].bsdf.is_diffuse()).collect();
    let &first = reflecting.first()?;
    // One flat face cannot light itself. If nothing else reflects or is metered, its light is never seen again.
    let flat = matches!(scene.shapes[first].geometry, Geometry::Rectangle { .. } | Geometry::Disk { .. });
    let metered_elsewhere = scene.sensors.iter().any(|sensor| match &sensor.receiver {
        Receiver::Meter(meter) => meter.shape().is_some_and(|shape| shape != first),
        Receiver::Camera(_) => false,
    });
    let alone = reflecting.len() == 1 && flat && first_specular(scene).is_none() && !metered_elsewhere;
    (!alone).then(|| {
        format!("`{}` reflects diffusely, and its light can reach a surface that is read", scene.shapes[first].id)
    })
}
