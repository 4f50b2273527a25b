#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| motion_fuzz::png::run(bytes));
