//! Films: how many cells a sensor has. Everything else about them is this program's own.

use crate::Film;

use super::element::Element;
use super::error::SceneError;
use super::names::quote;
use super::number::Range;
use super::object::Object;
use super::plugins;
use super::scene::Builder;

/// Mitsuba's size of a film that does not say.
pub(super) const DEFAULT: Film = Film { width: 768, height: 576 };
/// Most cells along one side.
const SIDE_LIMIT: u32 = 65536;
/// Most cells.
const CELL_LIMIT: u64 = 1 << 28;

/// A film, and the part of it that is wanted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window {
    /// The whole film, for which fields of view are stated.
    pub(super) whole: Film,
    /// The part.
    pub(super) part: Film,
    /// First column and row of the part.
    pub(super) offset: [u32; 2],
}

impl Window {
    /// A film wanted as a whole.
    pub(super) fn of(whole: Film) -> Self {
        Window { whole, part: whole, offset: [0, 0] }
    }
}

/// Reads a film.
pub(super) fn film<'e>(element: &'e Element, builder: &mut Builder<'e>) -> Result<Window, SceneError> {
    let mut object = Object::open(element)?;
    plugins::check(&object)?;
    let film = Film {
        width: side(&mut object, "width")?.unwrap_or(DEFAULT.width),
        height: side(&mut object, "height")?.unwrap_or(DEFAULT.height),
    };
    if u64::from(film.width) * u64::from(film.height) > CELL_LIMIT {
        let what = format!("{} x {} cells are more than 2^28", film.width, film.height);
        return Err(element.error(what, "use a smaller film"));
    }
    let window = window(&mut object, film)?;
    output(&mut object, builder)?;
    if let Some(filter) = object.single(&["rfilter"])? {
        rfilter(filter, builder)?;
    }
    object.close(&[])?;
    Ok(window)
}

/// The part of a film that `crop_width` and its like cut out, all of it if they are absent.
fn window(object: &mut Object, whole: Film) -> Result<Window, SceneError> {
    let part = Film {
        width: side(object, "crop_width")?.unwrap_or(whole.width),
        height: side(object, "crop_height")?.unwrap_or(whole.height),
    };
    let offset = [object.integer("crop_offset_x")?.unwrap_or(0), object.integer("crop_offset_y")?.unwrap_or(0)];
    let ends = [offset[0].saturating_add(part.width.into()), offset[1].saturating_add(part.height.into())];
    match offset.map(u32::try_from) {
        [Ok(x), Ok(y)] if ends[0] <= whole.width.into() && ends[1] <= whole.height.into() => {
            Ok(Window { whole, part, offset: [x, y] })
        }
        _ => {
            let what = format!("the crop reaches beyond the film of {} x {}", whole.width, whole.height);
            Err(object.element.error(what, "make crop_width, crop_height and their offsets smaller"))
        }
    }
}

fn side(object: &mut Object, name: &'static str) -> Result<Option<u32>, SceneError> {
    let Some(number) = object.integer(name)? else {
        return Ok(None);
    };
    match u32::try_from(number) {
        Ok(cells @ 1..=SIDE_LIMIT) => Ok(Some(cells)),
        _ => Err(object.element.error(format!("{name} {number} is out of range"), format!("use 1 to {SIDE_LIMIT}"))),
    }
}

/// What the file asks of Mitsuba's output; images here are always linear 32-bit float OpenEXR.
fn output(object: &mut Object, builder: &mut Builder) -> Result<(), SceneError> {
    let formats = ["luminance", "luminance_alpha", "rgb", "rgba", "xyz", "xyza"];
    let pixel = object.choice("pixel_format", &formats)?.is_some_and(|format| format != "rgb");
    let components = ["float16", "float32", "uint32"];
    let component = object.choice("component_format", &components)?.is_some_and(|format| format != "float32");
    let files = ["openexr", "exr", "rgbe", "pfm"];
    let file = object.choice("file_format", &files)?.is_some_and(|format| !format.ends_with("exr"));
    if pixel || component || file {
        builder.note("the film's output format is superseded: images are R G B, 32-bit float, OpenEXR");
    }
    for name in ["sample_border", "compensate"] {
        if object.boolean(name)? == Some(true) {
            builder.note(&format!("the film's {name} has no effect with the box filter used here"));
        }
    }
    Ok(())
}

fn rfilter(element: &Element, builder: &mut Builder) -> Result<(), SceneError> {
    let mut filter = Object::open(element)?;
    plugins::check(&filter)?;
    let mut unlike_box = filter.plugin != "box";
    for name in ["radius", "stddev", "B", "C"] {
        unlike_box |= filter.float(name, Range::ANY)?.is_some_and(|number| number != 0.5);
    }
    unlike_box |= filter.integer("lobes")?.is_some();
    if unlike_box {
        builder.note(&format!("reconstruction filter {} is superseded by the box", quote(filter.plugin)));
    }
    filter.close(&[])
}
