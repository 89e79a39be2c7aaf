//! Which method reaches a wanted error soonest.
//!
//! Methods that could read the cells run a few short passes on the scene itself, unless another is done before that tells anything. What they
//! show of noise, bias and time is carried on to the wanted error by the laws of each method; the slow ones are dropped, the others go on
//! (successive halving, Jamieson and Talwalkar 2016). The winner's passes count in its result where they need not be longer.
#![forbid(unsafe_code)]

mod candidate;
mod entry;
mod field;
mod forecast;
mod gain;
mod going_on;
mod plan;
mod planner;
mod trial;

pub use candidate::{Balance, Candidate};
pub use forecast::Forecast;
pub use plan::{Entrant, Plan, Standing, Why};
pub use planner::{Planner, PlanningError};
