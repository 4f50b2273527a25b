//! Runs the target that the environment variable `FUZZ_TARGET` names on the inputs of libFuzzer.

#![no_main]

use std::sync::LazyLock;

static TARGET: LazyLock<fn(&[u8])> = LazyLock::new(|| {
    let name = std::env::var("FUZZ_TARGET").expect("FUZZ_TARGET names the target");
    let target = motion_fuzz::TARGETS.iter().find(|(known_name, _)| *known_name == name);
    target.expect("FUZZ_TARGET is a module of fuzz/src").1
});

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| TARGET(bytes));
