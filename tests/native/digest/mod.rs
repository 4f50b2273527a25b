//! Same seed, same bits: results of machines of many configurations, to the last bit, against golden.txt. digest.js compares
//! all machines of the JavaScript face, in Node and in browsers; here are those that draw samples or fit.

mod alpha_calibrator;
mod banana;
mod configuration;
mod dead_reckoning;
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
        .filter_map(|configuration| {
            let parts = match configuration.widget {
                "banana-machine" => banana::parts(&configuration),
                "map-squeeze" => squeeze::parts(&configuration),
                "alpha-calibrator" => alpha_calibrator::parts(&configuration),
                "dead-reckoning" => dead_reckoning::parts(&configuration),
                _ => return None,
            };
            let parts: Vec<String> = parts.iter().map(|Part(name, hash)| format!(" {name}:{hash}")).collect();
            Some(format!("{}/{}{}", configuration.widget, configuration.name, parts.concat()))
        })
        .collect();
    let computed: String = lines.iter().map(|line| format!("{line}\n")).collect();
    let path = format!("{DIRECTORY}/golden.txt");
    let golden = std::fs::read_to_string(&path).expect("golden.txt");
    let differences = differences(&golden, &computed);
    assert!(
        differences.is_empty(),
        "A seed gives other bits:\n{}\nIf that is intended, `UPDATE_DIGEST=1 node --test tests/node/digest.test.js` \
         writes golden.txt, and CHANGELOG.md says why.",
        differences.join("\n")
    );
}

/// A change of the digest affects readers: their seeds give other clouds.
#[test]
fn the_changelog_names_the_digest() {
    let golden = std::fs::read(format!("{DIRECTORY}/golden.txt")).expect("golden.txt");
    let digest = hex(&Sha256::digest(&golden));
    let changelog =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/CHANGELOG.md")).expect("a changelog");
    // The newest digest comes first.
    let told = changelog.split(|c: char| !c.is_ascii_hexdigit()).find(|word| word.len() == digest.len());
    assert_eq!(
        told,
        Some(digest.as_str()),
        "a line under the newest heading of CHANGELOG.md has to say what changed, and that the digest is now {digest}"
    );
}

/// Returns the differences, one line for each configuration.
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
    found
}
