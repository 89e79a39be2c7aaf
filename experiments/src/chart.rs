//! `photonlab chart`: speed against accuracy of every method on a scene.

use crate::{Failure, command::Chart};

/// Says that the chart is not built yet.
pub(crate) fn chart(arguments: &Chart) -> Result<(), Failure> {
    let scene = arguments.scene.scene.display();
    Err(Failure::usage(format!(
        "photonlab chart {scene}: not built yet; compare methods with photonlab measure --method NAME"
    )))
}
