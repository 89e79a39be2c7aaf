//! Luminaire files: what they say, what their tables integrate to, and every way for them to be wrong.

mod broken;
mod eulumdat;
mod goniometer;
mod hostile;
mod lm63;
mod placed;
mod samples;
mod table;
mod written;
