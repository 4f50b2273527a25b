//! Helpers of the tests: reference tables, seeded randomness, and the arithmetic of statistical tolerances.

pub mod density;
pub mod distance;
pub mod text;

use motion::NoiseKind;
use motion::geom::se2::{SE2, wrap_angle};
use motion::sim::settings::SettingRules;
use nalgebra::{Matrix3, Vector3};
use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

pub const NOISE_KINDS: [NoiseKind; 2] = [NoiseKind::Normal, NoiseKind::Triangular];

pub const SAMPLE_COUNT: usize = 100_000;

/// Maximum deviation of an estimate, in standard errors. It is so large that only one comparison in 150 000 would fail by chance.
pub const MAX_STANDARD_ERRORS: f64 = 4.5;

pub fn seeded_rng(seed: u64) -> Xoshiro256PlusPlus {
    Xoshiro256PlusPlus::seed_from_u64(seed)
}

pub fn sample_uniform(rng: &mut impl Rng, range_start: f64, range_end: f64) -> f64 {
    range_start + (range_end - range_start) * (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64
}

/// Returns a number of either sign, whose magnitude is log-uniform in the range.
pub fn sample_signed_log_uniform(rng: &mut impl Rng, range_start: f64, range_end: f64) -> f64 {
    let log_uniform_magnitude = sample_uniform(rng, range_start.ln(), range_end.ln()).exp();
    if rng.next_u64() >> 63 == 0 { log_uniform_magnitude } else { -log_uniform_magnitude }
}

/// Returns the largest absolute difference of two poses in x, y and heading. Headings are compared on the circle.
pub fn max_difference(a: &SE2, b: &SE2) -> f64 {
    let heading_difference = (a.theta() - b.theta()).sin().atan2((a.theta() - b.theta()).cos());
    (a.x() - b.x()).abs().max((a.y() - b.y()).abs()).max(heading_difference.abs())
}

/// Returns the derivative of a pose with respect to three standardized noises (variance 1), by central differences. `pose_of_noise` returns
/// the pose for given noises.
pub fn derivative_by_noise(unit_noise: [f64; 3], pose_of_noise: impl Fn([f64; 3]) -> SE2) -> Matrix3<f64> {
    const DIFFERENCE_STEP: f64 = 1e-5;
    Matrix3::from_columns(&[0, 1, 2].map(|noise_axis| {
        let [pose_after, pose_before] = [DIFFERENCE_STEP, -DIFFERENCE_STEP].map(|noise_step| {
            let mut unit_noise = unit_noise;
            unit_noise[noise_axis] += noise_step;
            pose_of_noise(unit_noise)
        });
        let heading_difference = wrap_angle(pose_after.theta() - pose_before.theta());
        Vector3::new(pose_after.x() - pose_before.x(), pose_after.y() - pose_before.y(), heading_difference)
            / (2.0 * DIFFERENCE_STEP)
    }))
}

pub fn settings_of_preset<S: SettingRules>(preset_name: &str) -> S {
    S::PRESETS.iter().find(|named_preset| named_preset.0 == preset_name).expect("a preset of that name").1
}

pub fn is_point_inside(closed_outline: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let winding_count: i32 = closed_outline
        .windows(2)
        .map(|segment_ends| {
            let [[start_x, start_y], [end_x, end_y]] = [segment_ends[0], segment_ends[1]];
            let is_left_of_edge = (end_x - start_x) * (y - start_y) > (x - start_x) * (end_y - start_y);
            i32::from(start_y <= y && end_y > y && is_left_of_edge)
                - i32::from(start_y > y && end_y <= y && !is_left_of_edge)
        })
        .sum();
    winding_count != 0
}

/// Table of reference values from a file in tests/reference, which generate.py writes.
pub struct ReferenceTable {
    column_names: Vec<&'static str>,
    csv_rows: Vec<Vec<&'static str>>,
}

pub struct ReferenceRow<'a> {
    reference_table: &'a ReferenceTable,
    row_cells: &'a [&'static str],
}

impl ReferenceTable {
    pub fn parse(csv_text: &'static str) -> Self {
        let mut line_fields = csv_text.lines().map(|csv_line| csv_line.split(',').collect::<Vec<_>>());
        let column_names = line_fields.next().expect("a header");
        let rows: Vec<_> = line_fields.collect();
        assert!(!rows.is_empty(), "a table without rows");
        Self { column_names, csv_rows: rows }
    }

    pub fn rows(&self) -> impl Iterator<Item = ReferenceRow<'_>> {
        self.csv_rows.iter().map(|row_cells| ReferenceRow { reference_table: self, row_cells })
    }
}

impl ReferenceRow<'_> {
    pub fn cell_text(&self, column_name: &str) -> &'static str {
        let column_index =
            self.reference_table.column_names.iter().position(|known_name| *known_name == column_name);
        self.row_cells[column_index.unwrap_or_else(|| panic!("no column {column_name}"))]
    }

    pub fn cell_number(&self, column_name: &str) -> f64 {
        self.cell_text(column_name).parse().expect("a number")
    }

    pub fn cell_numbers<const N: usize>(&self, column_names: [&str; N]) -> [f64; N] {
        column_names.map(|column_name| self.cell_number(column_name))
    }

    pub fn noise_kind(&self) -> NoiseKind {
        match self.cell_text("kind") {
            "normal" => NoiseKind::Normal,
            "triangular" => NoiseKind::Triangular,
            unknown_column => panic!("unknown kind {unknown_column}"),
        }
    }

    /// Returns the absolute error of `computed_value`. The reference is the sum of two columns: the nearest double and a remainder (`_lo`).
    pub fn deviation_of(&self, column_name: &str, computed_value: f64) -> f64 {
        ((computed_value - self.cell_number(column_name)) - self.cell_number(&format!("{column_name}_lo")))
            .abs()
    }
}

/// Limit of √n times the Kolmogorov–Smirnov distance. The distance exceeds it with probability 2·exp(−2·1.95²) = 0.001.
pub const MAX_KS_STATISTIC: f64 = 1.95;

/// Returns √n times the Kolmogorov–Smirnov distance between a sample of n numbers and a distribution function.
pub fn scaled_ks_distance(mut sample_values: Vec<f64>, probability_below: impl Fn(f64) -> f64) -> f64 {
    sample_values.sort_by(f64::total_cmp);
    let n = sample_values.len() as f64;
    let max_cdf_difference = sample_values.iter().enumerate().map(|(i, &sample_value)| {
        let cumulative_probability = probability_below(sample_value);
        (cumulative_probability - i as f64 / n).max((i + 1) as f64 / n - cumulative_probability)
    });
    max_cdf_difference.fold(0.0, f64::max) * n.sqrt()
}

/// Returns P(Z < z) for noise Z with variance 1, by formulas that src/ does not use.
pub fn unit_cdf(noise_kind: NoiseKind, z: f64) -> f64 {
    match noise_kind {
        NoiseKind::Normal => 0.5 * libm::erfc(-z / 2f64.sqrt()),
        NoiseKind::Triangular => {
            let support_end = 6f64.sqrt();
            let tail_probability = (support_end - z.abs()).max(0.0).powi(2) / 12.0;
            if z < 0.0 { tail_probability } else { 1.0 - tail_probability }
        }
    }
}

/// Returns the χ² value that `cell_count` cells exceed with probability 1e-4 (Wilson and Hilferty, z = 3.719). There is one degree of
/// freedom less than cells, because the total is fixed.
pub fn chi_square_limit(cell_count: usize) -> f64 {
    let k = (cell_count - 1) as f64;
    k * (1.0 - 2.0 / (9.0 * k) + 3.719 * (2.0 / (9.0 * k)).sqrt()).powi(3)
}

pub fn mean_of(averaged_numbers: &[f64]) -> f64 {
    averaged_numbers.iter().sum::<f64>() / averaged_numbers.len() as f64
}

pub fn variance_of(averaged_numbers: &[f64]) -> f64 {
    let mean_value = mean_of(averaged_numbers);
    averaged_numbers.iter().map(|averaged_number| (averaged_number - mean_value).powi(2)).sum::<f64>()
        / (averaged_numbers.len() - 1) as f64
}

/// Returns a statistic of a sample and its standard error, from the spread of the statistic over 100 equal batches.
pub fn estimate_with_standard_error<T>(sample: &[T], compute_statistic: impl Fn(&[T]) -> f64) -> (f64, f64) {
    let batch_size = sample.len() / 100;
    let batch_statistics: Vec<f64> = sample.chunks_exact(batch_size).map(&compute_statistic).collect();
    (compute_statistic(sample), (variance_of(&batch_statistics) / batch_statistics.len() as f64).sqrt())
}
