//! Same seed, same bits: everything that machines of many configurations tell, to the last bit, against golden.txt. The same
//! is asked of the JavaScript face in Node and in browsers, by digest.js.

mod alpha_calibrator;
mod arc_anatomy;
mod banana;
mod configuration;
mod dead_reckoning;
mod odometry_decomposer;
mod squeeze;
mod told;

use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use told::{Part, hex};

const DIRECTORY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/digest");

#[test]
fn the_same_seed_gives_the_same_bits() {
    let all = configuration::list();
    let lines: Vec<String> = configuration::each(&all)
        .map(|configuration| {
            let parts = match configuration.widget {
                "banana-machine" => banana::parts(&configuration),
                "map-squeeze" => squeeze::parts(&configuration),
                "alpha-calibrator" => alpha_calibrator::parts(&configuration),
                "arc-anatomy" => arc_anatomy::parts(&configuration),
                "dead-reckoning" => dead_reckoning::parts(&configuration),
                "odometry-decomposer" => odometry_decomposer::parts(&configuration),
                other => panic!("nobody here knows what <{other}> tells"),
            };
            let parts: Vec<String> = parts.iter().map(|Part(name, hash)| format!(" {name}:{hash}")).collect();
            format!("{}/{}{}", configuration.widget, configuration.name, parts.concat())
        })
        .collect();
    let computed: String = lines.iter().map(|line| format!("{line}\n")).collect();
    let path = format!("{DIRECTORY}/golden.txt");
    if std::env::var_os("UPDATE_DIGEST").is_some() {
        std::fs::write(&path, &computed).expect("golden.txt can be written");
    }
    let golden = std::fs::read_to_string(&path).unwrap_or_default();
    let differences = differences(&golden, &computed);
    assert!(
        differences.is_empty(),
        "A seed does not mean what it meant:\n{}\nWhere that is what you want, `UPDATE_DIGEST=1 cargo test --test native digest` \
         writes golden.txt anew, and CHANGELOG.md says why.",
        differences.join("\n")
    );
}

/// A change of the bits reaches readers: their seeds show other clouds.
#[test]
fn the_changelog_tells_the_digest() {
    let golden = std::fs::read(format!("{DIRECTORY}/golden.txt")).expect("golden.txt");
    let digest = hex(&Sha256::digest(&golden));
    let changelog =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/CHANGELOG.md")).expect("a changelog");
    // The newest stands first.
    let told = changelog.split(|c: char| !c.is_ascii_hexdigit()).find(|word| word.len() == digest.len());
    assert_eq!(
        told,
        Some(digest.as_str()),
        "a line under the newest heading of CHANGELOG.md has to say what changed, and that the digest is now {digest}"
    );
}

/// What is not the same, a line for each configuration.
fn differences(golden: &str, computed: &str) -> Vec<String> {
    let table = |text: &str| -> BTreeMap<String, Vec<String>> {
        text.lines()
            .filter_map(|line| line.split_once(' '))
            .map(|(name, parts)| (name.to_owned(), parts.split(' ').map(str::to_owned).collect()))
            .collect()
    };
    let (golden, computed) = (table(golden), table(computed));
    let mut found = Vec::new();
    for (name, parts) in &computed {
        let Some(expected) = golden.get(name) else {
            found.push(format!("{name} is not in golden.txt"));
            continue;
        };
        let other: Vec<&str> = parts
            .iter()
            .filter(|part| !expected.contains(part))
            .map(|part| part.split(':').next().unwrap_or(part))
            .collect();
        if !other.is_empty() || parts.len() != expected.len() {
            found.push(format!("{name}: {}", other.join(", ")));
        }
    }
    found.extend(
        golden.keys().filter(|name| !computed.contains_key(*name)).map(|name| format!("{name} is gone")),
    );
    found
}
