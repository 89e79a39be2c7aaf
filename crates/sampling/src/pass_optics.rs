//! The optics of each pass.

use std::borrow::Cow;

use photonlab_photometry::{Channels, Palette, Response};
use photonlab_scene::World;

use crate::{Optics, Purpose, Stream, WavelengthPlan};

/// One set of optics for all passes, or one for each where wavelengths are drawn.
#[derive(Clone, Debug)]
pub struct PassOptics<const C: usize> {
    /// Those of every pass without wavelengths; else those of some pass, which has every lamp.
    any: Optics<C>,
    plan: Option<WavelengthPlan>,
    response: Response,
}

/// Nothing that the lamps emit counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "no lamp emits light that counts: give one an emission above 0 at wavelengths that the eye sees, or read watts"
)]
pub struct NothingCounts;

impl<const C: usize> PassOptics<C> {
    /// Of a scene with `C` channels. What light counts for matters to scenes with wavelengths alone.
    pub fn new(world: &World, response: Response) -> Result<Self, NothingCounts> {
        if world.scene.channels() != Channels::Spectral {
            return Ok(Self { any: Optics::new(world, Palette::Channels), plan: None, response });
        }
        let plan = WavelengthPlan::new(&world.scene, response).ok_or(NothingCounts)?;
        Ok(Self { any: Optics::new(world, plan.draw(0.5)), plan: Some(plan), response })
    }

    /// Those of a pass of a run.
    pub fn of_pass(&self, world: &World, seed: u64, pass: u32) -> Cow<'_, Optics<C>> {
        match &self.plan {
            None => Cow::Borrowed(&self.any),
            Some(plan) => {
                let xi = Stream::new(seed, Purpose::Wavelengths, pass, 0).next();
                Cow::Owned(Optics::new(world, plan.draw(xi)))
            }
        }
    }

    /// Those of some pass: the lamps are the same in all, their strengths are not.
    pub fn any(&self) -> &Optics<C> {
        &self.any
    }

    /// Results for each place: one or three without wavelengths, else as the response asks.
    pub fn results(&self) -> usize {
        self.plan.as_ref().map_or(C, |_| self.response.results())
    }
}
