//! Where all flux went.

use photonlab_photometry::{Colour, PathClass};
use photonlab_scene::World;

/// Flux by fate, W or lm per channel.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Book<const C: usize> {
    /// Left at surfaces.
    pub absorbed: Colour<C>,
    /// Left the scene.
    pub escaped: Colour<C>,
    /// Given up by a limit on the path's length.
    pub cut_off: Colour<C>,
    /// Added by surviving roulette.
    pub roulette_gain: Colour<C>,
    /// Taken by losing roulette.
    pub roulette_loss: Colour<C>,
}

impl<const C: usize> Book<C> {
    /// Gain less loss: zero on average.
    pub fn roulette(&self) -> Colour<C> {
        self.roulette_gain - self.roulette_loss
    }

    /// The emitted flux that these fates account for: absorbed + escaped + cut off - roulette.
    pub fn accounted(&self) -> Colour<C> {
        self.absorbed + self.escaped + self.cut_off - self.roulette()
    }

    fn add(&mut self, other: &Self) {
        self.absorbed += other.absorbed;
        self.escaped += other.escaped;
        self.cut_off += other.cut_off;
        self.roulette_gain += other.roulette_gain;
        self.roulette_loss += other.roulette_loss;
    }
}

/// Flux that arrived at and left one shape, counted ray by ray and apart from the [`Book`].
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct SurfaceBook<const C: usize> {
    /// Flux of all rays that arrived.
    pub incident: Colour<C>,
    /// Flux of all rays that left, after roulette.
    pub outgoing: Colour<C>,
    /// Absorbed by the coating: not a difference of the other two, which roulette makes random. Negative where a mesh's smooth normals hand on more than arrives.
    pub absorbed: Colour<C>,
}

/// The books of a run.
///
/// Promise: emitted + roulette = absorbed + escaped + cut off, in every channel, up to rounding.
#[derive(Clone, Debug, PartialEq)]
pub struct Ledger<const C: usize> {
    /// Flux of all photons at their start.
    pub emitted: Colour<C>,
    /// Flux by the class that the path had reached at its fate, indexed by [`PathClass`].
    pub classes: [Book<C>; 3],
    /// One per shape of the scene.
    pub surfaces: Vec<SurfaceBook<C>>,
    /// Paths ended by the limit on lossless specular events in a row.
    pub trapped_paths: u64,
}

impl<const C: usize> Ledger<C> {
    /// Empty books for a world.
    pub fn new(world: &World) -> Self {
        Self {
            emitted: Colour::ZERO,
            classes: [Book::default(); 3],
            surfaces: vec![SurfaceBook::default(); world.scene.shapes.len()],
            trapped_paths: 0,
        }
    }

    /// The sum over the classes.
    pub fn total(&self) -> Book<C> {
        let mut total = Book::default();
        for book in &self.classes {
            total.add(book);
        }
        total
    }

    /// Adds another run's books.
    pub fn add(&mut self, other: &Self) {
        self.emitted += other.emitted;
        for class in PathClass::ALL {
            self.classes[class as usize].add(&other.classes[class as usize]);
        }
        for (mine, theirs) in self.surfaces.iter_mut().zip(&other.surfaces) {
            mine.incident += theirs.incident;
            mine.outgoing += theirs.outgoing;
            mine.absorbed += theirs.absorbed;
        }
        self.trapped_paths += other.trapped_paths;
    }

    /// All flux times a factor: the mean of several runs from their sum.
    pub fn scaled(&self, factor: f64) -> Self {
        self.map(|flux| flux * factor)
    }

    /// All flux turned into something else.
    pub fn map(&self, turn: impl Fn(Colour<C>) -> Colour<C>) -> Self {
        let mut turned = self.clone();
        let books = turned.classes.iter_mut().flat_map(|book| {
            [&mut book.absorbed, &mut book.escaped, &mut book.cut_off, &mut book.roulette_gain, &mut book.roulette_loss]
        });
        let surfaces = turned
            .surfaces
            .iter_mut()
            .flat_map(|surface| [&mut surface.incident, &mut surface.outgoing, &mut surface.absorbed]);
        for flux in books.chain(surfaces).chain([&mut turned.emitted]) {
            *flux = turn(*flux);
        }
        turned
    }
}
