//! Results of many configurations, whose hashes are compared with golden.txt, because equal seeds must give equal bits. digest.js compares
//! the results of the JavaScript interface, in Node and in browsers.

mod configuration;
mod encoding;
mod simulations;

use encoding::{HashedPart, format_hex};
use sha2::{Digest, Sha256};

const DIGEST_DIRECTORY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/digest");

#[test]
fn the_same_seed_gives_the_same_bits() {
    let tested_configurations = configuration::parse_configurations();
    let golden_text = std::fs::read_to_string(format!("{DIGEST_DIRECTORY}/golden.txt")).expect("golden.txt");
    let mut differing_parts = Vec::new();
    for configuration in configuration::configurations_of(&tested_configurations) {
        let hashed_parts = match configuration.widget_tag {
            "banana-machine" => simulations::hash_banana_machine(&configuration),
            "map-squeeze" => simulations::hash_map_squeeze(&configuration),
            "alpha-calibrator" => simulations::hash_alpha_calibrator(&configuration),
            "dead-reckoning" => simulations::hash_dead_reckoning(&configuration),
            _ => continue,
        };
        let line_prefix = format!("{}/{} ", configuration.widget_tag, configuration.configuration_name);
        let golden_line = golden_text
            .lines()
            .find_map(|golden_line| golden_line.strip_prefix(&line_prefix))
            .unwrap_or_default();
        let has_golden_hash = |HashedPart(part_name, part_hash): &HashedPart| {
            golden_line.split(' ').any(|golden_hash| golden_hash == format!("{part_name}:{part_hash}"))
        };
        differing_parts.extend(
            hashed_parts
                .iter()
                .filter(|hashed_part| !has_golden_hash(hashed_part))
                .map(|hashed_part| format!("{line_prefix}{}", hashed_part.0)),
        );
    }
    assert!(
        differing_parts.is_empty(),
        "A seed gives other bits:\n{}\nIf that is intended, `UPDATE_DIGEST=1 node --test tests/node/digest.test.js` \
         writes golden.txt, and CHANGELOG.md says why.",
        differing_parts.join("\n")
    );
}

/// A changed digest affects users, because their seeds give other clouds. The changelog must therefore contain the digest.
#[test]
fn the_changelog_names_the_digest() {
    let golden_bytes = std::fs::read(format!("{DIGEST_DIRECTORY}/golden.txt")).expect("golden.txt");
    let golden_digest = format_hex(&Sha256::digest(&golden_bytes));
    let changelog_text =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/CHANGELOG.md")).expect("a changelog");
    let printed_digest = changelog_text
        .split(|c: char| !c.is_ascii_hexdigit())
        .find(|hexadecimal_digits| hexadecimal_digits.len() == golden_digest.len());
    assert_eq!(
        printed_digest,
        Some(golden_digest.as_str()),
        "a line under the newest heading of CHANGELOG.md has to say what changed, and that the digest is now {golden_digest}"
    );
}
