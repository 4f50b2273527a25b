//! Equal seeds give equal bits: poses, statistics, outlines, pixels and fits of many configurations are compared with golden.txt.
//! digest.js compares all results of all simulations of the JavaScript interface, in Node and in browsers.

mod configuration;
mod encoding;
mod simulations;

use encoding::{HashedPart, hex};
use sha2::{Digest, Sha256};

const DIRECTORY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/digest");

#[test]
fn the_same_seed_gives_the_same_bits() {
    let configurations = configuration::parsed_configurations();
    let golden = std::fs::read_to_string(format!("{DIRECTORY}/golden.txt")).expect("golden.txt");
    let mut differences = Vec::new();
    for configuration in configuration::configurations_of(&configurations) {
        let parts = match configuration.widget {
            "banana-machine" => simulations::banana_machine(&configuration),
            "map-squeeze" => simulations::map_squeeze(&configuration),
            "alpha-calibrator" => simulations::alpha_calibrator(&configuration),
            "dead-reckoning" => simulations::dead_reckoning(&configuration),
            _ => continue,
        };
        let name = format!("{}/{} ", configuration.widget, configuration.name);
        let line = golden.lines().find_map(|line| line.strip_prefix(&name)).unwrap_or_default();
        let is_known = |HashedPart(part, hash): &HashedPart| {
            line.split(' ').any(|known| known == format!("{part}:{hash}"))
        };
        differences
            .extend(parts.iter().filter(|part| !is_known(part)).map(|part| format!("{name}{}", part.0)));
    }
    assert!(
        differences.is_empty(),
        "A seed gives other bits:\n{}\nIf that is intended, `UPDATE_DIGEST=1 node --test tests/node/digest.test.js` \
         writes golden.txt, and CHANGELOG.md says why.",
        differences.join("\n")
    );
}

/// A change of the digest affects users, because their seeds give other clouds. The changelog must therefore contain it.
#[test]
fn the_changelog_names_the_digest() {
    let golden = std::fs::read(format!("{DIRECTORY}/golden.txt")).expect("golden.txt");
    let digest = hex(&Sha256::digest(&golden));
    let changelog =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/CHANGELOG.md")).expect("a changelog");
    // The newest digest comes first.
    let printed = changelog.split(|c: char| !c.is_ascii_hexdigit()).find(|word| word.len() == digest.len());
    assert_eq!(
        printed,
        Some(digest.as_str()),
        "a line under the newest heading of CHANGELOG.md has to say what changed, and that the digest is now {digest}"
    );
}
