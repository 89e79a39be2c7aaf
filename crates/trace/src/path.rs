//! One photon's path.

use photonlab_photometry::{Colour, PackedDirection, PathClass, Photon, VolumePhoton};
use photonlab_sampling::{
    EmissionPlan, Flight, Followed, Interaction, Matte, Optics, Purpose, Stream, goes_through, scatter,
};
use photonlab_scene::{Hit, Ray, World};

use crate::{Job, SurfaceBook, Traced, counter::Witness, ledger::Book};

/// Which classes of photon are kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Classes {
    /// Straight from the lamp.
    pub direct: bool,
    /// Through specular surfaces alone.
    pub caustic: bool,
    /// After a diffuse interaction.
    pub indirect: bool,
}

impl Classes {
    /// Every class.
    pub const ALL: Classes = Classes { direct: true, caustic: true, indirect: true };
    /// No class: transport is only booked.
    pub const NONE: Classes = Classes { direct: false, caustic: false, indirect: false };

    /// True if a class is kept.
    pub fn has(&self, class: PathClass) -> bool {
        match class {
            PathClass::Direct => self.direct,
            PathClass::Caustic => self.caustic,
            PathClass::Indirect => self.indirect,
        }
    }

    /// True if every class of `other` is in this set.
    pub fn contains(&self, other: Classes) -> bool {
        PathClass::ALL.into_iter().all(|class| self.has(class) || !other.has(class))
    }
}

/// When a path ends before it is absorbed or escapes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Longest path in segments; `None` is unlimited.
    pub max_segments: Option<u32>,
    /// Longest run of lossless specular interactions.
    pub max_specular: u32,
}

impl Default for Limits {
    fn default() -> Self {
        Self { max_segments: None, max_specular: 1000 }
    }
}

/// Why photons cannot be followed to an end.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TraceError {
    /// A closed scene that absorbs nothing has no steady state.
    #[error(
        "a path lost no light over {LOSSLESS} diffuse interactions (the last in or on `{shape}`): light in this scene has no \
         steady state; lower a reflectance below 1, or limit the path with --max-depth"
    )]
    Lossless {
        /// The shape it was on, or the medium it was in.
        shape: String,
    },
}

/// Diffuse interactions without any loss after which a scene counts as lossless.
const LOSSLESS: u32 = 1_000_000;

struct Walk<'w, const C: usize> {
    ray: Ray,
    from: Option<u32>,
    /// What the ray flies through.
    medium: Option<u32>,
    flux: Colour<C>,
    class: PathClass,
    segments: u32,
    /// Lossless specular interactions in a row.
    specular_run: u32,
    /// Diffuse interactions since the path last lost light.
    lossless_run: u32,
    world: &'w World,
    optics: &'w Optics<C>,
}

enum Fate {
    GoesOn,
    Ended,
}

pub(crate) fn follow<const C: usize>(
    world: &World,
    optics: &Optics<C>,
    plan: &EmissionPlan<C>,
    job: &Job,
    index: u64,
    out: &mut Traced<C>,
    witness: &mut impl Witness<C>,
) -> Result<(), TraceError> {
    let mut stream = Stream::new(job.seed, Purpose::Photons, job.pass, index);
    let (lamp, emission, flux) = plan.emit(world, &optics.lamps, index, &mut stream);
    out.ledger.emitted += flux;
    // A ray that another lamp or nothing stands for.
    if flux.is_zero() {
        return Ok(());
    }
    let mut walk = Walk {
        ray: emission.ray,
        from: emission.from,
        medium: optics.lamps.lamps[lamp].medium,
        flux,
        class: PathClass::Direct,
        segments: 0,
        specular_run: 0,
        lossless_run: 0,
        world,
        optics,
    };
    while let Fate::GoesOn = walk.step(job, &mut stream, out, witness) {
        if walk.lossless_run >= LOSSLESS {
            let shape = match (walk.from, walk.medium) {
                (Some(primitive), _) => world.shape_of(primitive).id.clone(),
                (None, Some(medium)) => world.scene.media[medium as usize].id.clone(),
                (None, None) => String::new(),
            };
            return Err(TraceError::Lossless { shape });
        }
    }
    Ok(())
}

impl<const C: usize> Walk<'_, C> {
    /// Follows one segment and what happens at its end.
    fn step(&mut self, job: &Job, stream: &mut Stream, out: &mut Traced<C>, witness: &mut impl Witness<C>) -> Fate {
        if job.limits.max_segments.is_some_and(|max| self.segments >= max) {
            self.book(out).cut_off += self.flux;
            return Fate::Ended;
        }
        let hit = self.world.cast(&self.ray, self.from, f64::INFINITY);
        if let Some(medium) = self.medium {
            let reach = hit.map_or(f64::INFINITY, |hit| hit.distance);
            let Flight { collision, factor } = self.optics.volume(medium).fly(self.flux, reach, stream);
            self.reweight(factor, out);
            if let Some(distance) = collision {
                return self.collide(medium, distance, job, stream, out);
            }
        }
        let Some(hit) = hit else {
            self.book(out).escaped += self.flux;
            witness.left(self.ray.direction, self.flux);
            return Fate::Ended;
        };
        self.from = Some(hit.point.primitive);
        witness.arrived(&hit, self.flux);
        let (interaction, opacity) = self.optics.interaction(self.world, &hit);
        if matches!(interaction, Interaction::Matte(_)) || self.world.is_metered(hit.point.primitive) {
            self.store(&hit, self.segments + 1, job, out);
        }
        if matches!(interaction, Interaction::Passed) || goes_through(opacity, stream) {
            self.medium = self.world.medium_beside(hit.point.primitive, !hit.front, self.medium);
            self.ray = Ray::new(hit.point.position, self.ray.direction);
            return Fate::GoesOn;
        }
        self.segments += 1;
        self.surface(&hit, out).incident += self.flux;
        match interaction {
            Interaction::Absorbed | Interaction::Passed => {
                self.absorb(&hit, self.flux, out);
                Fate::Ended
            }
            Interaction::Matte(matte) => self.reflect(&hit, matte, job, stream, out),
            Interaction::Followed(followed) => self.pass_on(&hit, followed, job, stream, out),
            Interaction::Dispersed(dispersive) => {
                let (followed, factor) = dispersive.settle(self.flux, stream);
                self.reweight(factor, out);
                self.pass_on(&hit, &followed, job, stream, out)
            }
        }
    }

    fn store(&self, hit: &Hit, segments: u32, job: &Job, out: &mut Traced<C>) {
        if job.keep.has(self.class) {
            out.positions.push(self.world.stored(hit.point.position));
            out.photons.push(Photon {
                flux: self.flux.to_f32(),
                direction: PackedDirection::pack(self.ray.direction.to_array()),
                normal: PackedDirection::pack(hit.facing_normal().to_array()),
                class: self.class,
                segments: segments.min(u32::from(u16::MAX)) as u16,
            });
        }
    }

    /// Light enters a matte body and leaves it in any direction, unless its coat mirrors it.
    fn reflect(&mut self, hit: &Hit, matte: &Matte<C>, job: &Job, stream: &mut Stream, out: &mut Traced<C>) -> Fate {
        let normals = hit.facing_normals();
        let arriving = normals.tilt(-self.ray.direction);
        if arriving == 0.0 {
            return self.lose(hit, out);
        }
        let (mirrored, share) = matte.enter(&self.ray, hit, stream);
        if mirrored {
            return match Matte::<C>::mirrored(&self.ray, hit) {
                Some((ray, tilt)) => self.go_on(hit, ray, share * tilt, job, stream, out),
                None => self.lose(hit, out),
            };
        }
        self.lossless_run = if matte.is_lossless() { self.lossless_run + 1 } else { 0 };
        self.specular_run = 0;
        if let Fate::Ended = self.thin_out(hit, share * arriving, stream, out) {
            return Fate::Ended;
        }
        let (crosses, factor) = matte.side(stream);
        self.reweight(factor, out);
        self.class = PathClass::Indirect;
        let side = if crosses { normals.turned() } else { normals };
        let Some((direction, tilt)) = matte.leave(&side, stream) else { return self.lose(hit, out) };
        if tilt != 1.0 {
            self.keep_share(hit, Colour::splat(tilt), out);
        }
        self.leave(hit, Ray::new(hit.point.position, direction), out);
        Fate::GoesOn
    }

    fn pass_on(
        &mut self,
        hit: &Hit,
        followed: &Followed<C>,
        job: &Job,
        stream: &mut Stream,
        out: &mut Traced<C>,
    ) -> Fate {
        match followed.draw(&self.ray, hit, stream) {
            Some(onward) => {
                let was = self.class;
                let fate = self.go_on(hit, onward.ray, onward.share * onward.tilt, job, stream, out);
                // Through a pane light comes as directly as before.
                if onward.straight && self.optics.is_pane(self.world, hit.point.primitive) {
                    self.class = was;
                }
                fate
            }
            None => self.lose(hit, out),
        }
    }

    /// A share of the light goes on along a ray after a specular interaction.
    fn go_on(
        &mut self,
        hit: &Hit,
        ray: Ray,
        share: Colour<C>,
        job: &Job,
        stream: &mut Stream,
        out: &mut Traced<C>,
    ) -> Fate {
        self.specular_run = if share == Colour::ONE { self.specular_run + 1 } else { 0 };
        if self.specular_run > job.limits.max_specular {
            self.book(out).cut_off += self.flux;
            out.ledger.trapped_paths += 1;
            return Fate::Ended;
        }
        if let Fate::Ended = self.thin_out(hit, share, stream, out) {
            return Fate::Ended;
        }
        if self.class == PathClass::Direct {
            self.class = PathClass::Caustic;
        }
        self.leave(hit, ray, out);
        Fate::GoesOn
    }

    /// Absorbs what the coating does not hand on, by roulette: the survivor's strongest channel keeps the strength it had,
    /// so photons stay of like flux, and no channel's mean is changed.
    fn thin_out(&mut self, hit: &Hit, share: Colour<C>, stream: &mut Stream, out: &mut Traced<C>) -> Fate {
        let before = self.flux.max();
        self.keep_share(hit, share, out);
        self.roulette(self.flux.max() / before, stream, out)
    }

    /// Multiplies the flux by a factor of mean one; what it adds or takes is roulette's.
    fn reweight(&mut self, factor: Colour<C>, out: &mut Traced<C>) {
        if factor == Colour::ONE {
            return;
        }
        let after = self.flux * factor;
        let change = after - self.flux;
        self.book(out).roulette_gain += change.map(|x| x.max(0.0));
        self.book(out).roulette_loss += change.map(|x| (-x).max(0.0));
        self.flux = after;
    }

    /// Absorbs what the coating does not hand on. A mesh that stands for a smooth surface hands on more than arrives at some
    /// angles and less at others: what it absorbs can be negative.
    fn keep_share(&mut self, hit: &Hit, share: Colour<C>, out: &mut Traced<C>) {
        let kept = self.flux * share;
        self.absorb(hit, self.flux - kept, out);
        self.flux = kept;
    }

    /// Ends the path with probability 1 - survival or strengthens it by 1 / survival.
    fn roulette(&mut self, survival: f64, stream: &mut Stream, out: &mut Traced<C>) -> Fate {
        if survival >= 1.0 {
            return Fate::GoesOn;
        }
        if stream.next() >= survival {
            self.book(out).roulette_loss += self.flux;
            return Fate::Ended;
        }
        let stronger = self.flux * (1.0 / survival);
        self.book(out).roulette_gain += stronger - self.flux;
        self.flux = stronger;
        Fate::GoesOn
    }

    /// Meets the matter of a medium, which absorbs a part and scatters the rest.
    fn collide(&mut self, medium: u32, distance: f64, job: &Job, stream: &mut Stream, out: &mut Traced<C>) -> Fate {
        let volume = self.optics.volume(medium);
        self.segments += 1;
        if job.keep.has(self.class) && volume.scatters() {
            self.store_in_medium(medium, distance, out);
        }
        self.class = PathClass::Indirect;
        self.specular_run = 0;
        self.lossless_run = if volume.albedo == Colour::ONE { self.lossless_run + 1 } else { 0 };
        let before = self.flux.max();
        let kept = self.flux * volume.albedo;
        self.book(out).absorbed += self.flux - kept;
        self.flux = kept;
        if let Fate::Ended = self.roulette(self.flux.max() / before, stream, out) {
            return Fate::Ended;
        }
        let direction = scatter(volume.phase, self.ray.direction, stream);
        (self.ray, self.from) = (Ray::new(self.ray.at(distance), direction), None);
        Fate::GoesOn
    }

    fn store_in_medium(&self, medium: u32, distance: f64, out: &mut Traced<C>) {
        out.volume.positions.push(self.world.stored(self.ray.at(distance)));
        out.volume.photons.push(VolumePhoton {
            flux: self.flux.to_f32(),
            direction: PackedDirection::pack(self.ray.direction.to_array()),
            medium,
            class: self.class,
            segments: self.segments.min(u32::from(u16::MAX)) as u16,
        });
    }

    fn leave(&mut self, hit: &Hit, ray: Ray, out: &mut Traced<C>) {
        self.surface(hit, out).outgoing += self.flux;
        let front = ray.direction.dot(hit.point.normal) > 0.0;
        self.medium = self.world.medium_beside(hit.point.primitive, front, self.medium);
        self.ray = ray;
    }

    /// Absorbs everything.
    fn lose(&self, hit: &Hit, out: &mut Traced<C>) -> Fate {
        self.absorb(hit, self.flux, out);
        Fate::Ended
    }

    fn absorb(&self, hit: &Hit, flux: Colour<C>, out: &mut Traced<C>) {
        self.book(out).absorbed += flux;
        self.surface(hit, out).absorbed += flux;
    }

    fn book<'a>(&self, out: &'a mut Traced<C>) -> &'a mut Book<C> {
        &mut out.ledger.classes[self.class as usize]
    }

    fn surface<'a>(&self, hit: &Hit, out: &'a mut Traced<C>) -> &'a mut SurfaceBook<C> {
        let shape = self.world.primitives[hit.point.primitive as usize].shape;
        &mut out.ledger.surfaces[shape as usize]
    }
}
