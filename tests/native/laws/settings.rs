//! Whole numbers among settings: accepted, or refused with the name. `tests/fuzz.rs` holds the same for all numbers of all widgets.

use super::doubles::cases;
use motion::map::Sampler;
use motion::sim::settings::Rules;
use motion::sim::{banana, dead_reckoning, odometry_decomposer, squeeze};
use proptest::prelude::*;

proptest! {
    #![proptest_config(cases(1000))]

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
