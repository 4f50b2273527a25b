//! Settings: any number in any place is taken, or refused by name with what is allowed; who refuses stays as it was.

use super::doubles::{any_double, cases};
use motion::map::Sampler;
use motion::sim::banana::{self, BananaMachine, ModelKind};
use motion::sim::settings::{Allowed, Rules, Setting, SettingsError};
use motion::sim::squeeze::{self, MapSqueeze};
use proptest::prelude::*;
use std::ops::RangeInclusive;

/// A number among settings: its name, and what it may be.
struct Place {
    name: String,
    allowed: RangeInclusive<f64>,
}

/// Puts a number where settings have their `index`th double; None past the last.
fn put<S: Rules>(settings: &mut S, index: usize, value: f64) -> Option<Place> {
    let (mut place, mut next) = (None, 0);
    let mut here = |name: String, slot: &mut f64, allowed: &RangeInclusive<f64>| {
        if next == index {
            *slot = value;
            place = Some(Place { name, allowed: allowed.clone() });
        }
        next += 1;
    };
    let _: Result<(), ()> = settings.try_each(|declaration, setting| {
        let key = declaration.key;
        match setting {
            Setting::Number(slot, allowed) => here(key.to_owned(), slot, &allowed),
            Setting::Numbers(slots, allowed) => {
                slots
                    .iter_mut()
                    .enumerate()
                    .for_each(|(i, slot)| here(format!("{key}[{i}]"), slot, &allowed));
            }
            Setting::Group(group) => {
                for (i, field) in group.fields().iter().enumerate() {
                    here(format!("{key}.{}", field.declaration.key), group.number(i), &field.allowed);
                }
            }
            _ => {}
        }
        Ok(())
    });
    place
}

fn places<S: Rules>() -> usize {
    (0..).take_while(|index| put(&mut S::default(), *index, 0.0).is_some()).count()
}

/// Taken, or refused in full; whether it is taken.
fn taken_or_named<S: Rules>(settings: &S, place: &Place, value: f64) -> Result<bool, TestCaseError> {
    let Place { name, allowed } = place;
    let Err(error) = settings.check() else {
        prop_assert!(allowed.contains(&value), "{} is {}", name, value);
        return Ok(true);
    };
    prop_assert!(!allowed.contains(&value), "{}", error);
    let message = error.to_string();
    let SettingsError { field, value: told, allowed: range } = error;
    prop_assert_eq!(&field, name);
    prop_assert_eq!(told.to_bits(), value.to_bits());
    prop_assert_eq!(range, Allowed::Real(allowed.clone()));
    prop_assert!(
        message.starts_with(&format!("{name} is ")) && message.contains("; allowed is a number from "),
        "{}",
        message
    );
    Ok(false)
}

fn few_robots() -> banana::Settings {
    banana::Settings { samples: 9, ..banana::Settings::default() }
}

fn few_attempts() -> squeeze::Settings {
    squeeze::Settings { samples: 9, ..squeeze::Settings::default() }
}

proptest! {
    #![proptest_config(cases(1000))]

    #[test]
    fn the_banana_machine_takes_a_number_or_names_it(place in 0..places::<banana::Settings>(), value in any_double(), odometry in any::<bool>()) {
        let mut settings = few_robots();
        if odometry {
            settings.model = ModelKind::Odometry;
        }
        // The odometry model has two noise parameters less.
        let mut machine = BananaMachine::new(settings).expect("the opening state");
        let (before, poses) = (*machine.settings(), machine.poses().collect::<Vec<_>>());
        let Some(place) = put(&mut settings, place, value) else { return Ok(()) };
        let taken = taken_or_named(&settings, &place, value)?;
        prop_assert_eq!(machine.configure(settings).is_ok(), taken);
        prop_assert_eq!(BananaMachine::empty(settings).is_ok(), taken);
        let finite = machine.poses().all(|pose| pose.x().is_finite() && pose.y().is_finite());
        prop_assert!(finite && machine.shown() == 9);
        if !taken {
            prop_assert_eq!(*machine.settings(), before);
            prop_assert_eq!(machine.poses().collect::<Vec<_>>(), poses);
        }
    }

    #[test]
    fn map_squeeze_takes_a_number_or_names_it(place in 0..places::<squeeze::Settings>(), value in any_double()) {
        let mut settings = few_attempts();
        let mut machine = MapSqueeze::new(settings).expect("the opening state");
        let (before, attempts) = (*machine.settings(), machine.attempts().to_vec());
        let place = put(&mut settings, place, value).expect("a place");
        let taken = taken_or_named(&settings, &place, value)?;
        prop_assert_eq!(machine.configure(settings).is_ok(), taken);
        if taken {
            prop_assert_eq!(machine.attempts().len(), 9);
        } else {
            prop_assert_eq!(*machine.settings(), before);
            prop_assert_eq!(machine.attempts(), attempts);
        }
    }

    /// Counts and seeds, and how many samples there may be of how many parts.
    #[test]
    fn whole_numbers_are_taken_or_named(samples in wholes(), seed in wholes(), steps in wholes(), parts in any::<bool>(), isolate in proptest::option::of(wholes())) {
        let count = usize::try_from(samples).expect("64 bits");
        let isolate = isolate.map(|number| number as usize);
        let settings = banana::Settings { samples: count, seed, isolate, ..few_robots() };
        let good = [
            ("isolate", isolate.is_none_or(|number| (1..=6).contains(&number))),
            ("samples", (1..=banana::MAX_SAMPLES).contains(&count)),
            ("seed", seed < 1 << 53),
        ];
        named_in_order(&settings, &good)?;
        let steps = steps as u32;
        let sampler = if parts { Sampler::SubStepped(steps) } else { Sampler::WholeArc };
        let settings = squeeze::Settings { samples: count, seed, steps, sampler, ..few_attempts() };
        let limit = squeeze::MAX_SAMPLES as u64;
        let good = [
            ("steps", (1..=squeeze::MAX_STEPS).contains(&u64::from(steps))),
            ("samples", (1..=limit).contains(&samples)),
            ("seed", seed < 1 << 53),
            ("samples", samples.saturating_mul(u64::from(settings.parts())) <= limit),
        ];
        named_in_order(&settings, &good)?;
    }
}

/// Of several that are out of range the first is named.
fn named_in_order<S: Rules>(settings: &S, good: &[(&str, bool)]) -> Result<(), TestCaseError> {
    let first = good.iter().find(|(_, good)| !good).map(|(key, _)| (*key).to_owned());
    prop_assert_eq!(settings.check().err().map(|error| error.field), first);
    Ok(())
}

fn wholes() -> impl Strategy<Value = u64> {
    const EDGES: [u64; 8] = [0, 1, 6, 1000, 1_000_000, 10_000_000, (1 << 53) - 1, u64::MAX - 1];
    prop_oneof![
        4 => 1..2000u64,
        2 => (0..EDGES.len(), 0..=1u64).prop_map(|(i, beyond)| EDGES[i] + beyond),
        1 => any::<u64>(),
    ]
}
