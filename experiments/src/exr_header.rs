//! The order of attributes in an EXR header.

use anyhow::{Context, bail};

/// Sorts a one-part file's attributes by name. The library keeps ours in a map of random order, and the same image must
/// give the same bytes; the order means nothing to readers, and no byte changes its distance from the pixels.
pub(crate) fn sort_attributes(bytes: &mut [u8]) -> anyhow::Result<()> {
    const FIRST: usize = 8; // magic number and version
    let mut attributes = Vec::new();
    let mut at = FIRST;
    while bytes.get(at).copied().context("EXR header without an end")? != 0 {
        let name_end = at + text_length(bytes, at)?;
        let type_end = name_end + 1 + text_length(bytes, name_end + 1)?;
        let size: [u8; 4] = bytes.get(type_end + 1..type_end + 5).context("EXR header cut short")?.try_into()?;
        let end = type_end + 5 + u32::from_le_bytes(size) as usize;
        attributes.push(bytes.get(at..end).context("EXR attribute cut short")?.to_vec());
        at = end;
    }
    attributes.sort();
    bytes[FIRST..at].copy_from_slice(&attributes.concat());
    Ok(())
}

fn text_length(bytes: &[u8], at: usize) -> anyhow::Result<usize> {
    match bytes.get(at..).and_then(|rest| rest.iter().position(|&byte| byte == 0)) {
        Some(length) => Ok(length),
        None => bail!("EXR name without an end"),
    }
}
