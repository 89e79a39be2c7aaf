//! Races of methods to a wanted error.

use photonlab_measure::{Stopped, binomial_upper_tail};
use photonlab_photometry::Colour;
use photonlab_readout::{Method, Settings};
use photonlab_reference::integrating_sphere::IntegratingSphere;
use photonlab_tests::{Family, LAMP_OVER_FLOOR, Lab, seed, settings};

fn all(seed: u64) -> Vec<Settings> {
    let methods = [
        Method::FinalGather { radius: None },
        Method::Radius { radius: None },
        Method::Adaptive,
        Method::Nearest { k: None },
        Method::Bins,
        Method::Path,
    ];
    methods.map(|method| settings(method, seed)).into()
}

fn sphere() -> (IntegratingSphere<1>, Lab) {
    let scene = IntegratingSphere::new(1.0, [0.3, -0.4, 0.35], Colour([1000.0]), Colour([0.5])).expect("in range");
    let lab = Lab::new(&scene.xml());
    (scene, lab)
}

/// Direct light alone: rays to the lamp find all of it.
#[test]
fn where_no_map_is_needed_none_is_used() {
    let raced = Lab::new(LAMP_OVER_FLOOR).race::<1>(&all(1), 0.01);
    assert_eq!(raced.entrants, 1);
    assert_eq!((raced.outcome.photons, raced.outcome.stopped), (0, Stopped::Target));
    let lit = Lab::new(&LAMP_OVER_FLOOR.replace("value=\"0\"", "value=\"0.5\"")).race::<1>(&all(1), 0.01);
    assert!(lit.entrants > 5, "a lamp that reflects makes light that only maps or paths find");
}

/// Who looks at a run between its passes does not change it, and what is looked at counts.
#[test]
fn a_run_that_was_looked_at_has_the_bits_of_one_that_was_not() {
    let (_, lab) = sphere();
    for settings in all(3) {
        let counts = [2000, 20, 30];
        let whole = lab.measure_looking::<1>(settings, counts, 0);
        for looks in [1, 7, 20] {
            let looked = lab.measure_looking::<1>(settings, counts, looks);
            assert_eq!(looked.passes, 20);
            assert_eq!(looked.cells[0].value[0], whole.cells[0].value[0], "{} after {looks}", settings.method.name());
        }
        let asked = lab.measure::<1>(settings, 2000 * 20, 20, 30 * 20);
        assert_eq!(asked.cells[0].value[0], whole.cells[0].value[0], "{}", settings.method.name());
    }
}

/// The choice looks at spreads and stops when one is small, so that chosen and stopped spreads are small by luck too: 95 % intervals must hold
/// all the same, and the target with them.
#[test]
fn a_race_meets_its_target_in_95_of_100() {
    let (scene, lab) = sphere();
    let truth = scene.mean_irradiance()[0];
    let (races, target) = (100, 0.002);
    let mut missed = 0;
    for number in 0..races {
        let raced = lab.race::<1>(&all(seed(4000 + number)), target);
        assert_eq!(raced.outcome.stopped, Stopped::Target);
        let value = raced.outcome.cells[0].value[0].mean().expect("a reading");
        missed += u64::from((value / truth - 1.0).abs() > target);
    }
    let mut family = Family::new("raced to a target");
    let p_value = binomial_upper_tail(missed, u64::from(races), 0.05);
    family.compare("misses", p_value, format!("{missed} of {races} runs, expected 5 % at most"));
    family.decide();
}
