//! The example log says the same, to the last bit, as `tests/node/calibrate.test.js` is told: both are held to `golden.txt`.

use motion::NoiseKind;
use motion::calibrate::{
    Calibration, LegLength, Model, Options, ReferenceError, Robust, Trajectory, calibrate,
};
use motion::geom::se2::SE2;
use motion::models::OdometryRule;
use std::fmt::Write;

const GOLDEN: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/calibrate/golden.txt");

fn read(name: &str) -> Trajectory {
    let path = format!("{}/examples/calibration/{name}.csv", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).expect("the example is there");
    let rows = text.lines().skip(1).map(|line| {
        let mut numbers = line.split(',').map(|number| number.parse::<f64>().expect("a number"));
        let [t, x, y, theta] = std::array::from_fn(|_| numbers.next().expect("four of them"));
        (t, SE2::new(x, y, theta))
    });
    Trajectory::new(rows).expect("times rise")
}

/// The bits of all that is told of a log, but NaN, which has many.
fn bits(told: &Calibration) -> String {
    let mut numbers: Vec<f64> = told.estimate.alphas.clone();
    numbers.extend(told.estimate.intervals.iter().flatten().flatten());
    numbers.extend(told.bootstrap.iter().flatten().flatten());
    numbers.extend([
        told.estimate.log_likelihood,
        told.doubts.held_out.coverage,
        told.doubts.held_out.squared_error,
    ]);
    numbers.extend(told.doubts.kinds.iter().flat_map(|kind| [kind.kurtosis, kind.autocorrelation]));
    numbers.extend(&told.inflation.log_likelihood);
    numbers.extend(told.judged.iter().map(|leg| leg.squared_error));
    for (at, bootstrap) in told.by_length.iter().filter_map(|at| Some((at.estimate.as_ref()?, &at.bootstrap)))
    {
        numbers.extend(&at.alphas);
        numbers.extend(at.intervals.iter().chain(bootstrap).flatten().flatten());
    }
    numbers.retain(|number| !number.is_nan());
    numbers.iter().fold(String::new(), |mut text, number| {
        write!(text, " {:016x}", number.to_bits()).expect("a string takes all");
        text
    })
}

#[test]
fn the_example_says_the_same_everywhere() {
    let [odometry, reference] = ["odometry", "reference"].map(read);
    let mut lines = String::new();
    for (name, model) in [
        ("table", Model::Odometry(OdometryRule::Table)),
        ("nav2", Model::Odometry(OdometryRule::Nav2)),
        ("beluga", Model::Odometry(OdometryRule::Beluga)),
        ("omni", Model::Odometry(OdometryRule::Omni)),
        ("velocity", Model::Velocity),
    ] {
        for (word, noise) in [("normal", NoiseKind::Normal), ("triangular", NoiseKind::Triangular)] {
            let options = Options {
                model,
                legs: LegLength::AMCL,
                noise,
                robust: Robust::Estimated,
                remove: [true; 6],
                reference_error: ReferenceError { position: 1e-4, heading: 1e-4 },
                seed: 3,
                by_length: true,
            };
            let told = calibrate(&odometry, &reference, &options).expect("legs enough");
            writeln!(lines, "{name} {word}{}", bits(&told)).expect("a string takes all");
        }
    }
    if std::env::var_os("UPDATE_DIGEST").is_some() {
        std::fs::write(GOLDEN, &lines).expect("tests/ can be written to");
    }
    // Not by assert_eq, which would print all of them.
    assert!(
        std::fs::read_to_string(GOLDEN).expect("it is there") == lines,
        "UPDATE_DIGEST=1 writes the new ones"
    );
}
