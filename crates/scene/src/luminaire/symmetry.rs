//! Tables that state a part of all directions, unfolded to all of them.

use super::LuminaireError;
use super::text::Short;

/// Which half-planes (C-planes) a table states, and how they stand for all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symmetry {
    /// Planes all around: from 0 to 360 degrees, or short of it, and then the first closes the turn.
    None,
    /// One plane for all.
    Rotational,
    /// Planes from 0 to 180 degrees; the others mirror them in the plane C0-C180.
    AboutC0,
    /// Planes from 90 to 270, or from -90 to 90 degrees; the others mirror them in the plane C90-C270.
    AboutC90,
    /// Planes from 0 to 90 degrees, mirrored in both.
    Quadrant,
}

impl Symmetry {
    /// At least as many planes as `count` of them unfold to; closing the turn adds two.
    pub(super) fn most_planes(self, count: usize) -> usize {
        let copies = match self {
            Symmetry::None | Symmetry::Rotational => 1,
            Symmetry::AboutC0 | Symmetry::AboutC90 => 2,
            Symmetry::Quadrant => 4,
        };
        count.saturating_mul(copies).saturating_add(2)
    }

    /// Planes for a whole turn from 0 to exactly 360 degrees, each as its angle and its intensities along gamma. The angles
    /// rise.
    pub(super) fn unfold(self, angles: &[f64], planes: &[&[f64]]) -> Result<(Vec<f64>, Vec<Vec<f64>>), LuminaireError> {
        let [Some(&first), Some(&last)] = [angles.first(), angles.last()] else {
            return Err(LuminaireError::new("has no horizontal angles", "give at least one"));
        };
        let turn = match (self, first, last) {
            (Symmetry::Rotational, ..) if angles.len() == 1 => vec![(0.0, 0)],
            (Symmetry::None, ..) if angles.len() > 1 && first >= 0.0 && last <= 360.0 => all(angles),
            (Symmetry::AboutC0, 0.0, 180.0) => mirrored(all(angles), 180.0),
            (Symmetry::AboutC90, 90.0, 270.0) => mirrored(all(angles), 270.0),
            (Symmetry::AboutC90, -90.0, 90.0) => mirrored(all(angles), 90.0),
            (Symmetry::Quadrant, 0.0, 90.0) => mirrored(mirrored(all(angles), 90.0), 180.0),
            _ => return Err(self.refuse(angles.len(), first, last)),
        };
        Ok(from_zero(turn, planes))
    }

    fn refuse(self, count: usize, first: f64, last: f64) -> LuminaireError {
        let what = format!("has {count} horizontal angles from {} to {} degrees", Short(first), Short(last));
        let mend = match self {
            Symmetry::None => "without symmetry give at least two from 0 to 360",
            Symmetry::Rotational => "with rotational symmetry give one",
            Symmetry::AboutC0 => "with symmetry about C0-C180 give them from 0 to 180",
            Symmetry::AboutC90 => "with symmetry about C90-C270 give them from 90 to 270 or from -90 to 90",
            Symmetry::Quadrant => "with symmetry about both planes give them from 0 to 90",
        };
        LuminaireError::new(what, mend)
    }
}

/// A plane's angle and the index of the plane that it repeats.
type Turn = Vec<(f64, usize)>;

fn all(angles: &[f64]) -> Turn {
    angles.iter().copied().zip(0..).collect()
}

/// The same with its mirror image in the plane at `mirror`, its last, added behind it.
fn mirrored(half: Turn, mirror: f64) -> Turn {
    let image: Turn = half.iter().rev().skip(1).map(|&(angle, plane)| (2.0 * mirror - angle, plane)).collect();
    half.into_iter().chain(image).collect()
}

/// The planes turned to [0, 360]. Where none stands at 0 one is put there, which changes nothing between the others.
fn from_zero(turn: Turn, planes: &[&[f64]]) -> (Vec<f64>, Vec<Vec<f64>>) {
    let closed = turn.last().is_some_and(|last| turn.len() > 1 && last.0 - turn[0].0 >= 360.0);
    let explicit = closed && turn[0].0 == 0.0;
    // The closing plane of a turn that starts elsewhere repeats its first.
    let distinct = if closed && !explicit { &turn[..turn.len() - 1] } else { &turn[..] };
    let within = |angle: f64| if explicit { angle } else { angle.rem_euclid(360.0) };
    let mut sorted: Turn = distinct.iter().map(|&(angle, plane)| (within(angle), plane)).collect();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut angles: Vec<f64> = sorted.iter().map(|plane| plane.0).collect();
    let mut unfolded: Vec<Vec<f64>> = sorted.iter().map(|plane| planes[plane.1].to_vec()).collect();
    if explicit {
        return (angles, unfolded);
    }
    let before = angles[angles.len() - 1] - 360.0;
    let share = -before / (angles[0] - before);
    if angles[0] > 0.0 {
        let ends = unfolded[unfolded.len() - 1].iter().zip(&unfolded[0]);
        let seam = ends.map(|(a, b)| a + share * (b - a)).collect();
        angles.insert(0, 0.0);
        unfolded.insert(0, seam);
    }
    angles.push(360.0);
    unfolded.push(unfolded[0].clone());
    (angles, unfolded)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Unfolds planes whose single intensity is their index.
    fn unfold(symmetry: Symmetry, angles: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let values: Vec<[f64; 1]> = (0..angles.len()).map(|i| [i as f64]).collect();
        let planes: Vec<&[f64]> = values.iter().map(|v| &v[..]).collect();
        let (angles, planes) = symmetry.unfold(angles, &planes).unwrap();
        (angles, planes.concat())
    }

    #[test]
    fn every_symmetry_covers_a_turn() {
        let quarters = vec![0.0, 90.0, 180.0, 270.0, 360.0];
        assert_eq!(unfold(Symmetry::Rotational, &[0.0]), (vec![0.0, 360.0], vec![0.0; 2]));
        assert_eq!(unfold(Symmetry::Quadrant, &[0.0, 90.0]), (quarters.clone(), vec![0.0, 1.0, 0.0, 1.0, 0.0]));
        let about_c0 = unfold(Symmetry::AboutC0, &[0.0, 90.0, 180.0]);
        assert_eq!(about_c0, (quarters.clone(), vec![0.0, 1.0, 2.0, 1.0, 0.0]));
        let about_c90 = unfold(Symmetry::AboutC90, &[90.0, 180.0, 270.0]);
        assert_eq!(about_c90, (quarters.clone(), vec![1.0, 0.0, 1.0, 2.0, 1.0]));
        let about_c90 = unfold(Symmetry::AboutC90, &[-90.0, 0.0, 90.0]);
        assert_eq!(about_c90, (quarters.clone(), vec![1.0, 2.0, 1.0, 0.0, 1.0]));
        assert_eq!(unfold(Symmetry::None, &[0.0, 90.0, 180.0, 270.0]).1, [0.0, 1.0, 2.0, 3.0, 0.0]);
        assert_eq!(unfold(Symmetry::None, &quarters).1, [0.0, 1.0, 2.0, 3.0, 4.0]);
        // Without a plane at 0: a plane a third of the way from 330 to 60 stands there.
        let (angles, planes) = unfold(Symmetry::None, &[60.0, 330.0]);
        assert_eq!(angles, [0.0, 60.0, 330.0, 360.0]);
        assert!((planes[0] - 2.0 / 3.0).abs() < 1e-15 && planes[0] == planes[3]);
        let (angles, planes) = unfold(Symmetry::AboutC90, &[90.0, 160.0, 200.0, 270.0]);
        assert_eq!(angles, [0.0, 20.0, 90.0, 160.0, 200.0, 270.0, 340.0, 360.0]);
        assert_eq!(planes, [1.5, 1.0, 0.0, 1.0, 2.0, 3.0, 2.0, 1.5]);
    }

    #[test]
    fn other_ranges_are_refused() {
        for (symmetry, angles) in [
            (Symmetry::Rotational, &[0.0, 90.0][..]),
            (Symmetry::AboutC0, &[0.0, 170.0]),
            (Symmetry::AboutC90, &[0.0, 180.0]),
            (Symmetry::Quadrant, &[0.0, 180.0]),
            (Symmetry::None, &[0.0]),
            (Symmetry::None, &[0.0, 370.0]),
            (Symmetry::None, &[]),
        ] {
            let planes = vec![&[1.0][..]; angles.len()];
            assert!(symmetry.unfold(angles, &planes).is_err(), "{symmetry:?} {angles:?}");
        }
    }
}
