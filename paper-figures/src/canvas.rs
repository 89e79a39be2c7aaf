//! Lines, shapes and text in fractions of a pixel, drawn by plotters.
//!
//! plotters places things on whole units: a unit here is a tenth of a pixel, and the page scales it back. Its SVG
//! backend needs no font for that; the reader's own is used.

use plotters::drawing::{DrawingArea, DrawingAreaErrorKind, IntoDrawingArea};
use plotters::element::{Circle, DashedPathElement, PathElement, Polygon, Text};
use plotters::prelude::SVGBackend;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontStyle, IntoFont, RGBColor, ShapeStyle, TextStyle};

/// Units per pixel.
const UNITS: f64 = 10.0;

/// plotters writes a font's size divided by this into the SVG.
const FONT_SCALE: f64 = 1.24;

/// A point in pixels from the top left.
pub(crate) type Spot = (f64, f64);

/// Where text stands against its spot; vertically it is centred on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Anchor {
    /// It begins there.
    Start,
    /// It is centred there.
    Middle,
    /// It ends there.
    End,
}

/// A sheet to draw on.
pub(crate) struct Canvas<'a> {
    area: DrawingArea<SVGBackend<'a>, plotters::coord::Shift>,
}

/// Draws on a sheet of `width` x `height` pixels and returns the SVG text, titled for those who do not see it.
pub(crate) fn svg(width: f64, height: f64, title: &str, draw: impl FnOnce(&Canvas<'_>)) -> String {
    let mut text = String::new();
    let units = |pixels: f64| (pixels * UNITS).round() as u32;
    {
        let backend = SVGBackend::with_string(&mut text, (units(width), units(height)));
        let canvas = Canvas { area: backend.into_drawing_area() };
        draw(&canvas);
        done(canvas.area.present());
    }
    // plotters' own opening tag fixes the size in units; ours scales, and carries the title.
    let body = text.split_once('>').map_or("", |(_, body)| body);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {} {}\">\n<title>{}</title>{}",
        units(width),
        units(height),
        escape(title),
        body
    )
}

impl Canvas<'_> {
    /// An open line.
    pub(crate) fn line(&self, spots: &[Spot], colour: RGBColor, width: f64) {
        done(self.area.draw(&PathElement::new(on_grid(spots), stroke(colour, width))));
    }

    /// A dashed line; lengths in pixels.
    pub(crate) fn dashed(&self, spots: &[Spot], colour: RGBColor, width: f64, dash: f64, gap: f64) {
        let (dash, gap) = ((dash * UNITS) as i32, (gap * UNITS) as i32);
        done(self.area.draw(&DashedPathElement::new(on_grid(spots), dash, gap, stroke(colour, width))));
    }

    /// A filled shape; opacity in [0, 1].
    pub(crate) fn shape(&self, spots: &[Spot], colour: RGBColor, opacity: f64) {
        done(self.area.draw(&Polygon::new(on_grid(spots), colour.mix(opacity).filled())));
    }

    /// A filled disc.
    pub(crate) fn disc(&self, at: Spot, radius: f64, colour: RGBColor) {
        done(self.area.draw(&Circle::new(unit(at), (radius * UNITS).round() as i32, colour.filled())));
    }

    /// One line of text, `size` pixels high.
    pub(crate) fn text(&self, text: &str, at: Spot, size: f64, anchor: Anchor, colour: RGBColor, bold: bool) {
        let horizontal = match anchor {
            Anchor::Start => HPos::Left,
            Anchor::Middle => HPos::Center,
            Anchor::End => HPos::Right,
        };
        let weight = if bold { FontStyle::Bold } else { FontStyle::Normal };
        let style = TextStyle::from(("sans-serif", size * UNITS * FONT_SCALE).into_font().style(weight))
            .color(&colour)
            .pos(Pos::new(horizontal, VPos::Center));
        done(self.area.draw(&Text::new(text.to_owned(), unit(at), style)));
    }
}

/// plotters reports what its backend cannot write.
fn done<E: std::error::Error + Send + Sync>(drawn: Result<(), DrawingAreaErrorKind<E>>) {
    drawn.expect("a string takes all that is written");
}

fn unit(at: Spot) -> (i32, i32) {
    ((at.0 * UNITS).round() as i32, (at.1 * UNITS).round() as i32)
}

fn on_grid(spots: &[Spot]) -> Vec<(i32, i32)> {
    spots.iter().map(|&at| unit(at)).collect()
}

fn stroke(colour: RGBColor, width: f64) -> ShapeStyle {
    colour.stroke_width((width * UNITS).round() as u32)
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
