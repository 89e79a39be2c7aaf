//! Numbers as the command line takes them.

/// A count: `4096`, `1e6`.
pub(crate) fn count(text: &str) -> Result<u64, String> {
    if let Ok(count) = text.parse::<u64>() {
        return Ok(count);
    }
    let value: f64 = text.parse().map_err(|_| "not a count; write it like 4096 or 1e6".to_string())?;
    if value.fract() == 0.0 && (0.0..=1e18).contains(&value) {
        Ok(value as u64)
    } else {
        Err("not a whole number between 0 and 1e18".into())
    }
}

/// A count above zero.
pub(crate) fn positive_count(text: &str) -> Result<u64, String> {
    count(text).and_then(|n| if n > 0 { Ok(n) } else { Err("must be at least 1".into()) })
}

/// A count above zero that fits 32 bits.
pub(crate) fn small_count(text: &str) -> Result<u32, String> {
    let n = positive_count(text)?;
    u32::try_from(n).map_err(|_| "must be below 2^32".into())
}

/// Threads: at least one, and no more than any machine that this program was made for has.
pub(crate) fn threads(text: &str) -> Result<u32, String> {
    small_count(text).and_then(|n| if n <= 1024 { Ok(n) } else { Err("must be at most 1024".into()) })
}

/// A share: `0.01` or `1%`; above 0.
pub(crate) fn share(text: &str) -> Result<f64, String> {
    let (digits, unit) = match text.strip_suffix('%') {
        Some(digits) => (digits, 0.01),
        None => (text, 1.0),
    };
    let value: f64 = digits.trim().parse().map_err(|_| "not a share; write it like 1% or 0.01".to_string())?;
    let value = value * unit;
    if value > 0.0 && value.is_finite() { Ok(value) } else { Err("must be above 0".into()) }
}

/// A probability strictly between 0 and 1.
pub(crate) fn probability(text: &str) -> Result<f64, String> {
    share(text).and_then(|p| if p < 1.0 { Ok(p) } else { Err("must be below 1 (100 %)".into()) })
}

/// A length or a duration: finite and above 0.
pub(crate) fn positive(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "not a number".to_string())?;
    if value > 0.0 && value.is_finite() { Ok(value) } else { Err("must be finite and above 0".into()) }
}

/// `NAME=VALUE`.
pub(crate) fn definition(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, value)) if !name.is_empty() => Ok((name.into(), value.into())),
        _ => Err("write it like NAME=VALUE".into()),
    }
}

/// `WxH`.
pub(crate) fn size(text: &str) -> Result<[u32; 2], String> {
    let parsed = text.split_once('x').and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    match parsed {
        Some([w, h])
            if (1..=65_536).contains(&w) && (1..=65_536).contains(&h) && u64::from(w) * u64::from(h) <= 1 << 28 =>
        {
            Ok([w, h])
        }
        Some(_) => Err("each side must be 1 to 65536, and the image at most 2^28 pixels".into()),
        None => Err("write it like 640x480".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_as_the_contract_says() {
        assert_eq!(count("1e6"), Ok(1_000_000));
        assert_eq!(share("1%"), Ok(0.01));
        assert_eq!(share("0.01"), Ok(0.01));
        assert_eq!(size("640x480"), Ok([640, 480]));
        assert_eq!(definition("rho=0.5"), Ok(("rho".into(), "0.5".into())));
        for wrong in ["1.5", "-1", "nan", "", "1e19"] {
            assert!(count(wrong).is_err(), "{wrong}");
        }
        for wrong in ["0", "-1%", "nan", "inf", "x"] {
            assert!(share(wrong).is_err(), "{wrong}");
        }
        for wrong in ["0x5", "5", "70000x1", "-1x2"] {
            assert!(size(wrong).is_err(), "{wrong}");
        }
    }
}
