//! One scene with what its meters must read.

use crate::mitsuba::{self, Place};
use crate::vector::Vector;

/// What a meter reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reads {
    /// Flux per area arriving on the front side, mean over the meter's shape: W/m^2 or lx.
    Irradiance,
    /// Radiance along one line: W/(m^2 sr) or cd/m^2.
    Radiance,
    /// Flux arriving on the whole front side: W or lm.
    Flux,
}

/// What a meter of the scene must read.
#[derive(Clone, Debug, PartialEq)]
pub struct Expected {
    /// The sensor's id in the scene.
    pub sensor: String,
    /// The quantity.
    pub reads: Reads,
    /// The value of each channel.
    pub value: Vec<f64>,
    /// How far an exact simulation of the scene as written may be from any of these values: the answer's own precision
    /// plus what the truncation of an infinite extent costs. Absolute, in the unit of the value.
    pub uncertainty: f64,
}

/// A scene of the catalogue with its answers.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// The parameters in words, unique within its entry.
    pub name: String,
    /// The scene as Mitsuba 3 XML.
    pub xml: String,
    /// Files that the scene names, each with its text, to be put beside it.
    pub files: Vec<(String, String)>,
    /// One per sensor.
    pub expected: Vec<Expected>,
}

/// A case being written: each meter enters the scene and the list of answers together.
#[derive(Default)]
pub(crate) struct Draft {
    body: String,
    files: Vec<(String, String)>,
    expected: Vec<Expected>,
    depth: Option<u32>,
}

impl Draft {
    /// A scene that starts with these elements.
    pub(crate) fn with(body: String) -> Self {
        Draft { body, ..Draft::default() }
    }

    /// Adds an element.
    pub(crate) fn add(&mut self, element: &str) {
        self.body += element;
    }

    /// Adds a black wall.
    pub(crate) fn wall(&mut self, place: Place) {
        let id = format!("black-{}", self.body.matches("id=\"black-").count());
        self.add(&mitsuba::flat("rectangle", &id, place, &mitsuba::diffuse(&[0.0])));
    }

    /// Puts a file beside the scene.
    pub(crate) fn file(&mut self, name: &str, text: String) {
        self.files.push((name.to_string(), text));
    }

    /// Cuts paths off after this many segments, the last one to the meter included.
    pub(crate) fn max_depth(&mut self, segments: u32) {
        self.depth = Some(segments);
    }

    /// Notes what the sensor of this id must read in each channel.
    pub(crate) fn expect(&mut self, sensor: &str, reads: Reads, value: &[f64], uncertainty: f64) {
        let (sensor, value) = (sensor.to_string(), value.to_vec());
        self.expected.push(Expected { sensor, reads, value, uncertainty });
    }

    /// A black flat receiver of this shape (`rectangle` or `disk`) with a meter on its front.
    pub(crate) fn receiver(&mut self, reads: Reads, shape: &str, place: Place, value: f64, uncertainty: f64) {
        let id = format!("meter-{}", self.expected.len());
        let on_it = mitsuba::diffuse(&[0.0]) + &meter(reads, &id);
        self.body += &mitsuba::flat(shape, &format!("receiver-{}", self.expected.len()), place, &on_it);
        self.expect(&id, reads, &[value], uncertainty);
    }

    /// A flat shape with this coating or lamp on it, and a meter on its front.
    pub(crate) fn metered(&mut self, reads: Reads, place: Place, on_it: &str, value: f64, uncertainty: f64) {
        let id = format!("meter-{}", self.expected.len());
        let on_it = on_it.to_string() + &meter(reads, &id);
        self.body += &mitsuba::flat("rectangle", &format!("wall-{}", self.expected.len()), place, &on_it);
        self.expect(&id, reads, &[value], uncertainty);
    }

    /// A black square receiver for the mean irradiance, which is computed from the irradiance at points of it.
    pub(crate) fn square(&mut self, place: Place, uncertainty: f64, at: impl Fn(Vector) -> f64) {
        let value = crate::quadrature::mean_over(place, at);
        self.receiver(Reads::Irradiance, "rectangle", place, value, uncertainty);
    }

    /// A radiance meter at `origin` that looks at `target`.
    pub(crate) fn radiance(&mut self, origin: Vector, target: Vector, value: &[f64], uncertainty: f64) {
        let id = format!("meter-{}", self.expected.len());
        self.body += &mitsuba::radiance_meter(&id, origin, target);
        self.expect(&id, Reads::Radiance, value, uncertainty);
    }

    /// The same inside the scene's medium.
    pub(crate) fn radiance_in_fog(&mut self, origin: Vector, target: Vector, value: f64, uncertainty: f64) {
        let id = format!("meter-{}", self.expected.len());
        self.body += &mitsuba::radiance_meter_in_fog(&id, origin, target);
        self.expect(&id, Reads::Radiance, &[value], uncertainty);
    }

    /// The finished case.
    pub(crate) fn case(self, name: impl Into<String>) -> Case {
        let xml = mitsuba::scene_to_depth(self.depth, &self.body);
        Case { name: name.into(), xml, files: self.files, expected: self.expected }
    }
}

/// The sensor that reads this on the shape it is put on.
pub(crate) fn meter(reads: Reads, id: &str) -> String {
    match reads {
        Reads::Irradiance | Reads::Radiance => mitsuba::irradiance_meter(id),
        Reads::Flux => mitsuba::flux_meter(id),
    }
}
