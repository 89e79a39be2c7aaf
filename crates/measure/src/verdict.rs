//! What an experiment concludes about a claim.

use serde::{Deserialize, Serialize};

/// The verdict on a claim; written in these words everywhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Verdict {
    /// What the paper says was measured.
    #[serde(rename = "holds")]
    Holds,
    /// It holds under conditions, which the reason names.
    #[serde(rename = "holds within limits")]
    HoldsWithinLimits,
    /// Something else was measured.
    #[serde(rename = "does not hold")]
    DoesNotHold,
    /// The measurement's own error cannot be bounded.
    #[serde(rename = "not certifiable")]
    NotCertifiable,
    /// The run was too short for the claim, or was not made.
    #[serde(rename = "not measured")]
    NotMeasured,
}

impl Verdict {
    /// Every verdict, best known first.
    pub const ALL: [Verdict; 5] = [
        Verdict::Holds,
        Verdict::HoldsWithinLimits,
        Verdict::DoesNotHold,
        Verdict::NotCertifiable,
        Verdict::NotMeasured,
    ];

    /// Its words.
    pub fn words(self) -> &'static str {
        match self {
            Verdict::Holds => "holds",
            Verdict::HoldsWithinLimits => "holds within limits",
            Verdict::DoesNotHold => "does not hold",
            Verdict::NotCertifiable => "not certifiable",
            Verdict::NotMeasured => "not measured",
        }
    }
}

impl std::fmt::Display for Verdict {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.words())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_and_people_read_the_same_words() {
        for verdict in Verdict::ALL {
            assert_eq!(serde_json::to_value(verdict).unwrap(), verdict.words());
        }
    }
}
