//! Pieces of Mitsuba 3 scene files, so that each scene can be written from the parameters that its answer uses.

mod fog;
mod place;

pub(crate) use fog::{Medium, fog_ball, fog_block, point_lamp_in_fog, radiance_meter_in_fog};
pub(crate) use place::{Place, flat};

use crate::catalogue::{Reads, meter};

/// Channel values as Mitsuba reads them: one grey value or three separated by commas.
pub(crate) fn channels(values: &[f64]) -> String {
    let words: Vec<String> = values.iter().map(f64::to_string).collect();
    words.join(", ")
}

/// `<tag x=.. y=.. z=../>` for a named point or vector.
fn triple(tag: &str, name: &str, [x, y, z]: [f64; 3]) -> String {
    format!("<{tag} name=\"{name}\" x=\"{x}\" y=\"{y}\" z=\"{z}\"/>")
}

/// A whole file around its emitters, shapes and sensors; light paths of any length.
pub(crate) fn scene(body: &str) -> String {
    scene_to_depth(None, body)
}

/// The same with light paths of at most `depth` segments, the last one to the sensor included.
pub(crate) fn scene_to_depth(depth: Option<u32>, body: &str) -> String {
    let depth = depth.map_or(-1, i64::from);
    let integrator = if body.contains("<medium ") { "volpath" } else { "path" };
    format!(
        "<scene version=\"3.0.0\">\n  \
         <integrator type=\"{integrator}\"><integer name=\"max_depth\" value=\"{depth}\"/></integrator>\n{body}</scene>\n"
    )
}

/// An isotropic point lamp of this intensity.
pub(crate) fn point_lamp(position: [f64; 3], intensity: &[f64]) -> String {
    let (position, intensity) = (triple("point", "position", position), channels(intensity));
    format!("  <emitter type=\"point\">{position}<rgb name=\"intensity\" value=\"{intensity}\"/></emitter>\n")
}

/// A point lamp whose intensity falls like `cos^exponent` of the angle from `direction`, 0 behind; this one on its axis.
pub(crate) fn lobe_lamp(position: [f64; 3], direction: [f64; 3], exponent: f64, intensity: &[f64]) -> String {
    let (position, direction) = (triple("point", "position", position), triple("vector", "direction", direction));
    let intensity = channels(intensity);
    format!(
        "  <emitter type=\"point\">{position}{direction}<float name=\"exponent\" value=\"{exponent}\"/>\
         <rgb name=\"intensity\" value=\"{intensity}\"/></emitter>\n"
    )
}

/// A point lamp whose intensities stand in a luminaire file beside the scene, its axis turned along `direction`.
pub(crate) fn file_lamp(position: [f64; 3], direction: [f64; 3], file: &str) -> String {
    let (position, direction) = (triple("point", "position", position), triple("vector", "direction", direction));
    format!("  <emitter type=\"ies\">{position}{direction}<string name=\"filename\" value=\"{file}\"/></emitter>\n")
}

/// Parallel light from infinity.
pub(crate) fn parallel_light(direction: [f64; 3], irradiance: &[f64]) -> String {
    let (direction, irradiance) = (triple("vector", "direction", direction), channels(irradiance));
    format!("  <emitter type=\"directional\">{direction}<rgb name=\"irradiance\" value=\"{irradiance}\"/></emitter>\n")
}

/// A diffuse coating.
pub(crate) fn diffuse(reflectance: &[f64]) -> String {
    let reflectance = channels(reflectance);
    format!("<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"{reflectance}\"/></bsdf>")
}

/// A clear dielectric in vacuum.
pub(crate) fn dielectric(index: f64) -> String {
    format!(
        "<bsdf type=\"dielectric\"><float name=\"int_ior\" value=\"{index}\"/><float name=\"ext_ior\" value=\"1\"/></bsdf>"
    )
}

/// A clear pane without thickness, all reflections between its two faces included.
pub(crate) fn thin_dielectric(index: f64) -> String {
    dielectric(index).replacen("dielectric", "thindielectric", 1)
}

/// A mirror that loses nothing.
pub(crate) const PERFECT_MIRROR: &str = "<bsdf type=\"conductor\"><string name=\"material\" value=\"none\"/></bsdf>";

/// The same radiance from all directions.
pub(crate) fn constant_light(radiance: &[f64]) -> String {
    let radiance = channels(radiance);
    format!("  <emitter type=\"constant\"><rgb name=\"radiance\" value=\"{radiance}\"/></emitter>\n")
}

/// A sky over the plane z = 0 with this radiance at the zenith, +z: the traditional overcast one (1:3), or one of the
/// general skies by its number.
pub(crate) fn sky(general: Option<u8>, zenith: f64) -> String {
    let law = match general {
        None => "<string name=\"distribution\" value=\"overcast\"/>".to_owned(),
        Some(kind) => {
            format!("<string name=\"distribution\" value=\"general\"/><integer name=\"cie_type\" value=\"{kind}\"/>")
        }
    };
    format!("  <emitter type=\"sky\">{law}<rgb name=\"radiance\" value=\"{zenith}\"/></emitter>\n")
}

/// Aims the environment's light through the rectangle it is put on, along its normal (an extension).
pub(crate) const PORTAL: &str = "<emitter type=\"portal\"/>";

/// Turns the shape it is put on into a lamp.
pub(crate) fn area_lamp(radiance: &[f64]) -> String {
    format!("<emitter type=\"area\"><rgb name=\"radiance\" value=\"{}\"/></emitter>", channels(radiance))
}

/// A cube around the origin, seen from inside.
pub(crate) fn inside_cube(id: &str, half_edge: f64, on_it: &str) -> String {
    format!(
        "  <shape type=\"cube\" id=\"{id}\"><transform name=\"to_world\"><scale value=\"{half_edge}\"/></transform>\
         <boolean name=\"flip_normals\" value=\"true\"/>{on_it}</shape>\n"
    )
}

/// A box of these half-edges, seen from outside.
pub(crate) fn block(id: &str, [cx, cy, cz]: [f64; 3], [x, y, z]: [f64; 3], on_it: &str) -> String {
    format!(
        "  <shape type=\"cube\" id=\"{id}\"><transform name=\"to_world\"><scale x=\"{x}\" y=\"{y}\" z=\"{z}\"/>\
         <translate x=\"{cx}\" y=\"{cy}\" z=\"{cz}\"/></transform>{on_it}</shape>\n"
    )
}

/// A perfect paraboloid mirror `z = r^2 / (4 f)` up to its rim, which opens towards +z, moved to its `vertex`.
pub(crate) fn paraboloid(id: &str, [x, y, z]: [f64; 3], focal_length: f64, rim: f64) -> String {
    format!(
        "  <shape type=\"paraboloid\" id=\"{id}\"><float name=\"focal_length\" value=\"{focal_length}\"/>\
         <float name=\"aperture\" value=\"{rim}\"/><transform name=\"to_world\">\
         <translate x=\"{x}\" y=\"{y}\" z=\"{z}\"/></transform>{PERFECT_MIRROR}</shape>\n"
    )
}

/// A sphere; `inside` turns its normals inwards.
pub(crate) fn sphere(id: &str, centre: [f64; 3], radius: f64, inside: bool, on_it: &str) -> String {
    let centre = triple("point", "center", centre);
    format!(
        "  <shape type=\"sphere\" id=\"{id}\">{centre}<float name=\"radius\" value=\"{radius}\"/>\
         <boolean name=\"flip_normals\" value=\"{inside}\"/>{on_it}</shape>\n"
    )
}

/// The lateral surface of a cylinder between two points of its axis, facing outwards.
pub(crate) fn cylinder(id: &str, [from, to]: [[f64; 3]; 2], radius: f64, on_it: &str) -> String {
    let (from, to) = (triple("point", "p0", from), triple("point", "p1", to));
    format!(
        "  <shape type=\"cylinder\" id=\"{id}\">{from}{to}<float name=\"radius\" value=\"{radius}\"/>{on_it}</shape>\n"
    )
}

/// The same facing inwards.
pub(crate) fn inside_cylinder(id: &str, ends: [[f64; 3]; 2], radius: f64, on_it: &str) -> String {
    let flipped = "<boolean name=\"flip_normals\" value=\"true\"/>".to_string() + on_it;
    cylinder(id, ends, radius, &flipped)
}

/// The square `[-1, 1]^2` at z = 0 facing +z after these transforms (XML, may be empty).
pub(crate) fn rectangle(id: &str, transform: &str, on_it: &str) -> String {
    let to_world = format!("<transform name=\"to_world\">{transform}</transform>");
    format!("  <shape type=\"rectangle\" id=\"{id}\">{to_world}{on_it}</shape>\n")
}

/// A film and its sampler.
fn film(size: usize, samples: usize) -> String {
    format!(
        "<film type=\"hdrfilm\"><integer name=\"width\" value=\"{size}\"/><integer name=\"height\" value=\"{size}\"/>\
         <string name=\"pixel_format\" value=\"rgb\"/><string name=\"component_format\" value=\"float32\"/>\
         <rfilter type=\"box\"/></film>\
         <sampler type=\"independent\"><integer name=\"sample_count\" value=\"{samples}\"/></sampler>"
    )
}

/// A meter that reads the radiance towards `origin` along the line from `target`.
pub(crate) fn radiance_meter(id: &str, origin: [f64; 3], target: [f64; 3]) -> String {
    let (look, film) = (look_at(origin, target, "0 0.6 0.8"), film(1, 4096));
    format!("  <sensor type=\"radiancemeter\" id=\"{id}\">{look}{film}</sensor>\n")
}

/// A meter that reads the mean irradiance over the shape it is put on.
pub(crate) fn irradiance_meter(id: &str) -> String {
    format!("<sensor type=\"irradiancemeter\" id=\"{id}\">{}</sensor>", film(1, 4096))
}

/// A meter that reads the whole flux on the shape it is put on.
pub(crate) fn flux_meter(id: &str) -> String {
    format!("<sensor type=\"fluxmeter\" id=\"{id}\">{}</sensor>", film(1, 4096))
}

/// A meter of irradiance or flux in `size` by `size` equal cells of the shape it is put on.
pub(crate) fn film_meter(reads: Reads, id: &str, size: usize) -> String {
    meter(reads, id).replace(&film(1, 4096), &film(size, 4096))
}

/// A camera on the z axis looking down at the floor's cells: `size` by `size` over `[-half_width, half_width]^2`, +y up.
pub(crate) fn floor_camera(height: f64, half_width: f64, size: usize) -> String {
    let look = look_at([0.0, 0.0, height], [0.0; 3], "0 1 0");
    let (fov, film) = (2.0 * (half_width / height).atan().to_degrees(), film(size, 64));
    format!(
        "  <sensor type=\"perspective\" id=\"view\">{look}<float name=\"fov\" value=\"{fov}\"/>\
         <string name=\"fov_axis\" value=\"x\"/><float name=\"near_clip\" value=\"0.0001\"/>{film}</sensor>\n"
    )
}

fn look_at([ox, oy, oz]: [f64; 3], [tx, ty, tz]: [f64; 3], up: &str) -> String {
    format!(
        "<transform name=\"to_world\"><lookat origin=\"{ox} {oy} {oz}\" target=\"{tx} {ty} {tz}\" up=\"{up}\"/></transform>"
    )
}

#[cfg(test)]
pub(crate) fn assert_balanced(xml: &str) {
    let mut open: Vec<&str> = Vec::new();
    for tag in xml.split('<').skip(1) {
        let (tag, text) = tag.split_once('>').expect("every tag is closed");
        assert!(text.trim().is_empty(), "stray text {text:?}");
        assert_eq!(tag.matches('"').count() % 2, 0, "{tag}");
        let name = tag.trim_start_matches('/').split(' ').next().unwrap_or_default();
        if tag.starts_with('/') {
            assert_eq!(open.pop(), Some(name));
        } else if !tag.ends_with('/') {
            open.push(name);
        }
    }
    assert!(open.is_empty(), "{open:?} left open");
    assert!(!xml.contains("NaN") && !xml.contains("inf"), "{xml}");
}
