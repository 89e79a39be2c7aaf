//! What surfaces do to light: `bsdf` and `ref`.

use crate::Bsdf;

use super::element::Element;
use super::error::SceneError;
use super::index::{EXTERIOR, INTERIOR, index};
use super::names::{nearest_first, quote};
use super::number::Range;
use super::object::Object;
use super::plugins;
use super::scene::Builder;

/// The tags that may stand where a surface is described.
pub(super) const TAGS: [&str; 2] = ["bsdf", "ref"];

/// Reads a `bsdf`, or finds the one that a `ref` names.
pub(super) fn bsdf<'e>(element: &'e Element, builder: &mut Builder<'e>) -> Result<Bsdf, SceneError> {
    if element.tag.name == "ref" {
        return reference(element, builder);
    }
    let object = Object::open(element)?;
    let bsdf = match object.plugin {
        "diffuse" => diffuse(object),
        "dielectric" => dielectric(object),
        "conductor" => conductor(object),
        "twosided" => twosided(object, builder),
        _ => Err(plugins::refuse(&object)),
    }?;
    if let Some(id) = element.attribute("id") {
        builder.bsdfs.insert(id, bsdf.clone());
    }
    Ok(bsdf)
}

fn reference(element: &Element, builder: &Builder) -> Result<Bsdf, SceneError> {
    let id = element.required("id");
    if let Some(bsdf) = builder.bsdfs.get(id) {
        return Ok(bsdf.clone());
    }
    let name = quote(id);
    Err(match builder.ids.get(id) {
        Some((place, "bsdf")) => {
            element.error(format!("{name} is defined only later, at {place}"), "move it above the first ref to it")
        }
        Some((place, tag)) => element.error(format!("{name} is the {tag} at {place}, not a bsdf"), "refer to a bsdf"),
        None => {
            let known = nearest_first(id, builder.bsdfs.keys().copied());
            element.error(format!("no bsdf has the id {name}"), format!("bsdfs defined so far: {known}"))
        }
    })
}

fn diffuse(mut object: Object) -> Result<Bsdf, SceneError> {
    let reflectance = object.colour("reflectance", Range::SHARE)?.unwrap_or([0.5; 3]);
    object.close(&[])?;
    Ok(Bsdf::Diffuse { reflectance })
}

fn dielectric(mut object: Object) -> Result<Bsdf, SceneError> {
    let tags = ["float", "integer", "string"];
    let interior_index = object.take("int_ior", &tags)?.map(index).transpose()?.unwrap_or(INTERIOR);
    let exterior_index = object.take("ext_ior", &tags)?.map(index).transpose()?.unwrap_or(EXTERIOR);
    for name in ["specular_reflectance", "specular_transmittance"] {
        if object.colour(name, Range::ANY)?.is_some_and(|factor| factor != [1.0; 3]) {
            let what = format!("{name} other than 1 is known but not built yet");
            return Err(object.element.error(what, "remove it: Fresnel's equations give the shares"));
        }
    }
    object.close(&["eta"])?;
    Ok(Bsdf::Dielectric { interior_index, exterior_index })
}

/// Mitsuba's default conductor, material "none", is a perfect mirror.
fn conductor(mut object: Object) -> Result<Bsdf, SceneError> {
    let material = object.string("material")?;
    if let Some(metal) = material.filter(|material| !material.eq_ignore_ascii_case("none")) {
        let what = format!("material {} is known but not built yet", quote(metal));
        return Err(object.element.error(what, "use material none, a perfect mirror, for now"));
    }
    let reflectance = object.colour("specular_reflectance", Range::SHARE)?.unwrap_or([1.0; 3]);
    object.close(&["eta", "k"])?;
    Ok(Bsdf::Mirror { reflectance })
}

fn twosided<'e>(mut object: Object<'e>, builder: &mut Builder<'e>) -> Result<Bsdf, SceneError> {
    let children = object.objects(&TAGS);
    let element = object.element;
    object.close(&[])?;
    let sides = children.iter().map(|child| one_side(child, builder)).collect::<Result<Vec<Bsdf>, SceneError>>()?;
    match &sides[..] {
        [both] => Ok(Bsdf::TwoSided { front: Box::new(both.clone()), back: Box::new(both.clone()) }),
        [front, back] => Ok(Bsdf::TwoSided { front: Box::new(front.clone()), back: Box::new(back.clone()) }),
        [] => Err(element.error("twosided holds no bsdf", "put one or two into it")),
        _ => Err(children[2].error("twosided holds more than two bsdfs", "keep one or two")),
    }
}

/// The surface that one side of a `twosided` shows: of another `twosided`, its front.
fn one_side<'e>(element: &'e Element, builder: &mut Builder<'e>) -> Result<Bsdf, SceneError> {
    match bsdf(element, builder)? {
        Bsdf::Dielectric { .. } => {
            Err(element.error("a dielectric cannot be two-sided: light passes it", "use it without twosided"))
        }
        Bsdf::TwoSided { front, .. } => Ok(*front),
        opaque => Ok(opaque),
    }
}
