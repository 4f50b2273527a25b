//! Runs the target that the environment variable `FUZZ_TARGET` names on the inputs of libFuzzer.

#![no_main]

use std::sync::LazyLock;

static SELECTED_TARGET: LazyLock<fn(&[u8])> = LazyLock::new(|| {
    let target_name = std::env::var("FUZZ_TARGET").expect("FUZZ_TARGET names the target");
    let named_target = motion_fuzz::TARGETS.iter().find(|(known_name, _)| *known_name == target_name);
    named_target.expect("FUZZ_TARGET is a module of fuzz/src").1
});

libfuzzer_sys::fuzz_target!(|input_bytes: &[u8]| SELECTED_TARGET(input_bytes));
