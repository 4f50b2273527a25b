//! Settings of every widget: a number is accepted, or refused with the name and the allowed range.

use super::doubles::{any_double, cases};
use motion::map::Sampler;
use motion::sim::settings::{Allowed, Rules, Setting, SettingsError};
use motion::sim::{alpha_calibrator, arc_anatomy, banana, dead_reckoning, odometry_decomposer, squeeze};
use proptest::prelude::*;
use std::ops::RangeInclusive;

/// Number among settings: name and range.
struct Place {
    name: String,
    allowed: RangeInclusive<f64>,
}

/// Sets the `index`th double of the settings; returns None past the last.
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

/// A number in its range is accepted; any other is refused with its name, its value and the range.
fn taken_or_named<S: Rules>(settings: &S, place: &Place, value: f64) -> Result<(), TestCaseError> {
    let Place { name, allowed } = place;
    let Err(error) = settings.check() else {
        prop_assert!(allowed.contains(&value), "{} is {}", name, value);
        return Ok(());
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
    Ok(())
}

/// Sets one number of the settings of a widget, and checks the error message.
fn number<S: Rules>(place: usize, value: f64) -> Result<(), TestCaseError> {
    let mut settings = S::default();
    let place = put(&mut settings, place % places::<S>(), value).expect("a place");
    taken_or_named(&settings, &place, value)
}

proptest! {
    #![proptest_config(cases(1000))]

    #[test]
    fn every_number_is_accepted_or_refused_by_name(widget in 0..6usize, place in 0..100usize, value in any_double()) {
        match widget {
            0 => number::<banana::Settings>(place, value)?,
            1 => number::<squeeze::Settings>(place, value)?,
            2 => number::<arc_anatomy::Settings>(place, value)?,
            3 => number::<odometry_decomposer::Settings>(place, value)?,
            4 => number::<dead_reckoning::Settings>(place, value)?,
            _ => number::<alpha_calibrator::Settings>(place, value)?,
        }
    }

    /// Counts and seeds, and the product of samples and parts.
    #[test]
    fn whole_numbers_are_accepted_or_refused_by_name(samples in wholes(), seed in wholes(), steps in wholes(), parts in any::<bool>(), isolate in proptest::option::of(wholes())) {
        let count = usize::try_from(samples).expect("64 bits");
        let isolate = isolate.map(|number| number as usize);
        let settings = banana::Settings { samples: count, seed, isolate, ..Default::default() };
        let good = [
            ("isolate", isolate.is_none_or(|number| (1..=6).contains(&number))),
            ("samples", (1..=banana::MAX_SAMPLES).contains(&count)),
            ("seed", seed < 1 << 53),
        ];
        named_in_order(&settings, &good)?;
        let steps = steps as u32;
        let sampler = if parts { Sampler::SubStepped(steps) } else { Sampler::WholeArc };
        let settings = squeeze::Settings { samples: count, seed, steps, sampler, ..Default::default() };
        let limit = squeeze::MAX_SAMPLES as u64;
        let good = [
            ("steps", (1..=squeeze::MAX_STEPS).contains(&u64::from(steps))),
            ("samples", (1..=limit).contains(&samples)),
            ("seed", seed < 1 << 53),
            ("samples", samples.saturating_mul(u64::from(settings.parts())) <= limit),
        ];
        named_in_order(&settings, &good)?;
        let step = isolate.unwrap_or(1) as u32;
        let settings = dead_reckoning::Settings { samples: count, seed, steps, step, ..Default::default() };
        let good = [
            ("steps", (1..=dead_reckoning::MAX_STEPS).contains(&u64::from(steps))),
            ("step", (1..=dead_reckoning::MAX_STEPS).contains(&u64::from(step))),
            ("samples", (1..=dead_reckoning::MAX_SAMPLES).contains(&count)),
            ("seed", seed < 1 << 53),
            ("step", step <= steps),
        ];
        named_in_order(&settings, &good)?;
        let settings = odometry_decomposer::Settings { samples: count, seed, ..Default::default() };
        let most = odometry_decomposer::MAX_SAMPLES;
        named_in_order(&settings, &[("samples", (1..=most).contains(&samples)), ("seed", seed < 1 << 53)])?;
    }
}

/// If several numbers are out of range, the error names the first one.
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
