//! The version of the format: 2 and 3 mean the same; before, properties had other names.

use super::error::Fault;
use super::names::quote;

/// Checks the version of the format that a `scene` states.
pub(super) fn check_version(version: Option<&str>, required: bool) -> Result<(), Fault> {
    let mend = "write <scene version=\"3.0.0\">, after bringing an older scene up to Mitsuba 3";
    let Some(version) = version else {
        return if required { Err(Fault::new("attribute version is missing", mend)) } else { Ok(()) };
    };
    let parts: Option<Vec<u32>> = version.split('.').map(|part| part.parse().ok()).collect();
    match parts.as_deref() {
        Some([2 | 3, rest @ ..]) if rest.len() <= 2 => Ok(()),
        Some([0 | 1, ..]) => Err(Fault::new(format!("version {} is older than Mitsuba 2", quote(version)), mend)),
        Some([(4..), ..]) => Err(Fault::new(format!("version {} is newer than Mitsuba 3", quote(version)), mend)),
        _ => Err(Fault::new(format!("version {} is not a version of Mitsuba", quote(version)), mend)),
    }
}
