//! The targets of cargo-fuzz without it: on the inputs that fuzzing found worth keeping, and on seeded mutations of them.
//!
//! `fuzz/src` holds what is to be true of any bytes. A failure names the bytes; they are to be kept in `fuzz/corpus`.
#![allow(
    clippy::disallowed_methods,
    reason = "an expected value may come from the platform's own mathematics"
)]

mod common;
#[path = "../fuzz/src/lib.rs"]
mod targets;

use common::seeded;
use rand::Rng;
use std::fs::{read, read_dir};
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::{Path, PathBuf};

type Target = fn(&[u8]);

/// A test for each target, with how many mutations it takes: a second's worth.
macro_rules! tests {
    ($($name:ident: $mutations:literal,)+) => {
        const NAMES: &[&str] = &[$(stringify!($name)),+];
        $(#[test]
        fn $name() {
            on_corpus_and_mutations(stringify!($name), targets::$name::run, $mutations);
        })+
    };
}
tests! {
    anatomy: 50_000,
    banana: 15_000,
    calibrate: 400,
    decomposer: 50_000,
    grid: 15_000,
    pgm: 200_000,
    plan: 10_000,
    reckoning: 2_000,
    squeeze: 5_000,
}

#[test]
fn no_target_is_left_out() {
    let found: Vec<_> = files("fuzz/fuzz_targets").iter().map(|file| file.with_extension("")).collect();
    let known: Vec<_> = NAMES.iter().map(|name| root().join("fuzz/fuzz_targets").join(name)).collect();
    assert_eq!(found, known);
}

/// Of legs that triangles fit without an error nothing is likely but the maximum: an interval that is halved on its way there takes 810 steps.
#[test]
fn an_interval_of_next_to_nothing_is_found_soon() {
    let file = root().join("fuzz/corpus/calibrate/3df166ae2b8057eb97f03d5ff645de1d3ac00c7a");
    let steps = targets::calibrate::steps_of(&read(file).expect("a file"));
    assert!((1..600).contains(&steps), "{steps}");
}

fn on_corpus_and_mutations(name: &str, target: Target, mutations: u32) {
    let corpus = corpus(name);
    corpus.iter().for_each(|bytes| run(target, bytes));
    let mut rng = seeded(2911);
    for _ in 0..mutations {
        let mut bytes = pick(&corpus, &mut rng).clone();
        for _ in 0..=below(4, &mut rng) {
            mutate(&mut bytes, &corpus, &mut rng);
        }
        run(target, &bytes);
    }
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// In the same order everywhere.
fn files(directory: &str) -> Vec<PathBuf> {
    let all = read_dir(root().join(directory)).expect("a directory");
    let mut files: Vec<_> = all.map(|entry| entry.expect("a file").path()).collect();
    files.sort();
    files
}

fn corpus(name: &str) -> Vec<Vec<u8>> {
    let files = files(&format!("fuzz/corpus/{name}"));
    assert!(files.len() > 20, "{} files of {name}", files.len());
    files.iter().map(|file| read(file).expect("a file")).collect()
}

fn run(target: Target, bytes: &[u8]) {
    catch_unwind(AssertUnwindSafe(|| target(bytes))).unwrap_or_else(|panic| {
        eprintln!("on the bytes {bytes:?}");
        resume_unwind(panic);
    });
}

fn below(count: usize, rng: &mut impl Rng) -> usize {
    rng.next_u32() as usize % count
}

fn pick<'a, T>(all: &'a [T], rng: &mut impl Rng) -> &'a T {
    &all[below(all.len(), rng)]
}

/// One of the changes that libFuzzer makes.
fn mutate(bytes: &mut Vec<u8>, corpus: &[Vec<u8>], rng: &mut impl Rng) {
    const BYTES: [u8; 9] = [0, 1, 16, 32, 48, 57, 127, 128, 255];
    let end = bytes.len();
    let at = below(end + 1, rng);
    let length = below(8, rng).min(end - at);
    match below(6, rng) {
        0 => bytes.insert(at, *pick(&BYTES, rng)),
        1 => drop(bytes.drain(at..at + length)),
        2 => bytes.extend_from_within(at..at + length),
        3 => {
            let other = pick(corpus, rng);
            bytes.splice(at.., other[below(other.len() + 1, rng)..].iter().copied());
        }
        _ if at == end => bytes.push(rng.next_u32() as u8),
        4 => bytes[at] ^= 1 << below(8, rng),
        _ => bytes[at] = rng.next_u32() as u8,
    }
}
