//! Targets of cargo-fuzz, run natively on a corpus (inputs that together reach all code) and on seeded mutations of it.
//!
//! `fuzz/src` has the properties. A failure prints the bytes of its input, from which a test in `regressions!` is made.

#[path = "../fuzz/src/lib.rs"]
mod targets;

use crate::common::seeded_rng;
use rand::Rng;
use std::fs::read_to_string;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::Path;

type FuzzTarget = fn(&[u8]);

/// Defines a test for each target. It runs every n-th input of the corpus and a number of mutations, in about a tenth of a
/// second.
macro_rules! tests {
    ($($name:ident: $every:literal, $mutations:literal;)+) => {
        const TESTED_TARGETS: &[&str] = &[$(stringify!($name)),+];
        $(#[test]
        fn $name() {
            run_on_corpus_and_mutations(stringify!($name), targets::$name::check_input, $every, $mutations);
        })+
    };
}
tests! {
    anatomy: 1, 5_000;
    banana: 1, 2_000;
    calibrate: 6, 10;
    decomposer: 1, 5_000;
    grid: 1, 2_000;
    pgm: 1, 20_000;
    plan: 1, 1_000;
    png: 1, 2_000;
    reckoning: 1, 250;
    squeeze: 1, 500;
}

#[test]
#[ignore = "nightly: 200 calibrations"]
fn calibrate_runs_on_its_whole_corpus() {
    run_on_corpus_and_mutations("calibrate", targets::calibrate::check_input, 1, 100);
}

#[test]
fn every_target_of_cargo_fuzz_has_a_test() {
    let target_names: Vec<_> = targets::TARGETS.iter().map(|(target_name, _)| *target_name).collect();
    assert_eq!(target_names, TESTED_TARGETS);
}

macro_rules! regressions {
    ($($name:ident: $target:ident $hex:literal,)+) => {
        $(#[test]
        fn $name() {
            run_target(targets::$target::check_input, &parse_hex($hex));
        })+
    };
}
regressions! {
    error_without_a_standard_error_is_not_corrected: calibrate "71cb220e36b75baf10ffffff20ffffffffffffffffffffffffffda5dfff478",
    exact_covariances_are_symmetric: banana "5dd51609e9ffb2b2b20e093f0a31b25db2b2b2b22ce6",
    variances_of_the_cloud_are_not_negative: banana "26c02ffbc02ffbfb5d262100474747fb5d21e91c1c1c1c1c211c1c4d1c1c1cdbe9\
        26663f420100000001006000f526",
    gain_of_a_cloud_as_narrow_as_rounding_is_zero: banana "9a6f2c172991e65acbbe1567f08e8e41153ac1054f4fffff4f4f4f4f4f4f4f\
        ff66f0ffff8e8e1791e65acbbe1567f08eedec",
    command_of_negative_zero_replaces_one_of_zero: reckoning "009107c4c49191919121ffff91919191919191919191919191d9d9d9d991\
        919191d991919191919191919191919121ffff91919191919191919191919191919191d9d9d99191912cc400000000000091919191919191\
        919191bfff91919191c400ffd9116f9191919191919121ffff91919191919191919191919191d9d9d9d991919191d991919191919191",
}

fn run_on_corpus_and_mutations(name: &str, target: FuzzTarget, corpus_step: usize, mutation_count: u32) {
    let corpus_text =
        read_to_string(find_repository_root().join("fuzz/corpus").join(name).with_extension("txt"))
            .expect("a file");
    let corpus_inputs: Vec<_> = corpus_text.lines().map(parse_hex).collect();
    assert!(corpus_inputs.len() > 20, "{} inputs of {name}", corpus_inputs.len());
    corpus_inputs.iter().step_by(corpus_step).for_each(|input_bytes| run_target(target, input_bytes));
    let mut rng = seeded_rng(2911);
    for _ in 0..mutation_count {
        let mut mutated_input = choose_item(&corpus_inputs, &mut rng).clone();
        for _ in 0..=sample_below(4, &mut rng) {
            mutate_input(&mut mutated_input, &corpus_inputs, &mut rng);
        }
        run_target(target, &mutated_input);
    }
}

fn find_repository_root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn parse_hex(hex_digits: &str) -> Vec<u8> {
    let parse_byte_at = |i| u8::from_str_radix(&hex_digits[i..i + 2], 16).expect("two hexadecimal digits");
    (0..hex_digits.len()).step_by(2).map(parse_byte_at).collect()
}

fn run_target(target: FuzzTarget, input_bytes: &[u8]) {
    catch_unwind(AssertUnwindSafe(|| target(input_bytes))).unwrap_or_else(|panic_payload| {
        eprintln!("on the bytes {input_bytes:02x?}");
        resume_unwind(panic_payload);
    });
}

fn sample_below(exclusive_limit: usize, rng: &mut impl Rng) -> usize {
    rng.next_u32() as usize % exclusive_limit
}

fn choose_item<'a, T>(items: &'a [T], rng: &mut impl Rng) -> &'a T {
    &items[sample_below(items.len(), rng)]
}

/// Returns the input with one of the changes that libFuzzer makes.
fn mutate_input(mutated_bytes: &mut Vec<u8>, corpus_inputs: &[Vec<u8>], rng: &mut impl Rng) {
    const SPECIAL_BYTES: [u8; 9] = [0, 1, 16, 32, 48, 57, 127, 128, 255];
    let byte_count = mutated_bytes.len();
    let change_start = sample_below(byte_count + 1, rng);
    let change_length = sample_below(8, rng).min(byte_count - change_start);
    match sample_below(6, rng) {
        0 => mutated_bytes.insert(change_start, *choose_item(&SPECIAL_BYTES, rng)),
        1 => drop(mutated_bytes.drain(change_start..change_start + change_length)),
        2 => mutated_bytes.extend_from_within(change_start..change_start + change_length),
        3 => {
            let other_input = choose_item(corpus_inputs, rng);
            mutated_bytes.splice(
                change_start..,
                other_input[sample_below(other_input.len() + 1, rng)..].iter().copied(),
            );
        }
        _ if change_start == byte_count => mutated_bytes.push(rng.next_u32() as u8),
        4 => mutated_bytes[change_start] ^= 1 << sample_below(8, rng),
        _ => mutated_bytes[change_start] = rng.next_u32() as u8,
    }
}
