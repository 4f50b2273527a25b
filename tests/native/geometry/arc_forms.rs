//! Double-double arithmetic, compared with fifty-digit references.

use motion::geom::arc_forms::{DoubleDouble, form_errors};

/// Returns the rows of the reference table: an angle, and the high and low parts of its sine, cosine and sinc.
fn read_reference_rows() -> impl Iterator<Item = [f64; 7]> {
    include_str!("../../reference/double_double.csv")
        .lines()
        .filter(|csv_line| !csv_line.starts_with('#'))
        .skip(1)
        .map(|csv_line| {
            let mut row_numbers =
                csv_line.split(',').map(|number_text| number_text.parse().expect("a number"));
            std::array::from_fn(|_| row_numbers.next().expect("seven numbers"))
        })
}

/// Returns the absolute difference between a value and a reference, which consists of a high and a low part.
fn absolute_error_of(computed_value: DoubleDouble, reference_high: f64, reference_low: f64) -> f64 {
    (computed_value - DoubleDouble { high: reference_high, low: reference_low }).to_f64().abs()
}

#[test]
fn sine_cosine_and_sinc_match_fifty_digit_references() {
    let mut row_count = 0;
    for [angle, sin_high, sin_low, cos_high, cos_low, sinc_high, sinc_low] in read_reference_rows() {
        let angle = DoubleDouble::from(angle);
        let (sin, cos) = angle.sin_cos();
        assert!(absolute_error_of(sin, sin_high, sin_low) <= 1e-30, "sin {}", angle.high);
        assert!(absolute_error_of(cos, cos_high, cos_low) <= 1e-30, "cos {}", angle.high);
        assert!(absolute_error_of(angle.sinc(), sinc_high, sinc_low) <= 1e-30, "sinc {}", angle.high);
        row_count += 1;
    }
    assert!(row_count >= 60);
    assert_eq!(DoubleDouble::from(0.0).sinc().to_f64(), 1.0);
}

#[test]
fn errors_of_the_three_arc_forms_grow_as_their_formulas_say() {
    let errors = form_errors();
    // The chord form of the arc loses no digits. Its error is the rounding of a product and two sums.
    assert!(errors.chord.iter().all(|error_of_chord| *error_of_chord < 3e-17), "{:?}", errors.chord);
    for (i, omega) in errors.omega.iter().enumerate() {
        let straight_line_error = 0.5 * omega * 0.01;
        if (1e-9..1e-2).contains(omega) {
            assert!((errors.straight[i] / straight_line_error - 1.0).abs() < 1e-3, "{omega}: {errors:?}");
        }
        // The formula with the radius of the arc has an error of about ε/ω.
        let ratio_of_arc_errors = errors.arc[i] / (f64::EPSILON / omega);
        if (1e-11..0.1).contains(omega) {
            assert!((0.05..3.0).contains(&ratio_of_arc_errors), "{omega} {ratio_of_arc_errors}");
        }
    }
}
