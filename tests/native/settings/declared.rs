//! Messages about refused settings.

use motion::sim::banana::{BananaMachine, Settings};

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
