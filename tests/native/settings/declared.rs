//! Descriptions of settings, and the values that they take.

use motion::sim::banana::{BananaMachine, Settings};
use motion::sim::settings::{Declared, Setting};
use motion::sim::squeeze;
use std::ops::ControlFlow;

/// A setting takes each of its words and no other.
#[test]
fn a_word_setting_accepts_its_words_only() {
    fn check(mut settings: impl Declared) -> usize {
        let mut seen = 0;
        let _ = settings.each(&mut |declaration, setting| {
            if let Setting::Word(word) = setting {
                for known in word.all() {
                    assert!(word.set(known), "{} takes {known}", declaration.key);
                    assert_eq!(word.get(), known);
                    for other in ["", "Normal", "normal ", "toString"] {
                        assert!(!word.set(other), "{} does not take {other}", declaration.key);
                        assert_eq!(word.get(), known, "and stays as it was");
                    }
                    seen += 1;
                }
            }
            ControlFlow::Continue(())
        });
        seen
    }
    assert!(check(Settings::default()) > 3);
    assert!(check(squeeze::Settings::default()) > 2);
}

/// Numbers in messages are those of JavaScript, where most who read them are.
#[test]
fn numbers_in_messages_are_formatted_as_in_javascript() {
    for (number, told) in [
        (f64::INFINITY, "Infinity"),
        (f64::NEG_INFINITY, "-Infinity"),
        (f64::NAN, "NaN"),
        (1e6 + 0.5, "1000000.5"),
        (-1e20, "-100000000000000000000"),
        (1e21, "1e21"),
        (-2.5e300, "-2.5e300"),
    ] {
        let mut settings = Settings::default();
        settings.command.v = number;
        let error = BananaMachine::new(settings).expect_err(told);
        assert!(error.to_string().starts_with(&format!("command.v is {told}; ")), "{error}");
    }
    for (seconds, told) in [(0.0, "0"), (-0.000_001, "-0.000001"), (5e-7, "5e-7"), (-1e-300, "-1e-300")] {
        let mut settings = Settings::default();
        settings.command.dt = seconds;
        let error = BananaMachine::new(settings).expect_err(told);
        assert!(error.to_string().starts_with(&format!("command.dt is {told}; ")), "{error}");
    }
}
