//! What the simulations compute, to the last bit, condensed to a number or two a setting: the same native and in a
//! browser.

use motion::NoiseKind;
use motion::VelocityCmd;
use motion::map::Sampler;
use motion::sim::View;
use motion::sim::banana::{BananaMachine, Executed, ModelKind, Settings};
use motion::sim::squeeze::{self, MapSqueeze};
use motion::sim::views::Grid;

/// Both models, both kinds of noise, spins, reverse, an isolated α, and a cloud grown in batches.
pub fn settings() -> [Settings; 6] {
    let opening = Settings { samples: 5000, seed: 7, ..Settings::default() };
    [
        opening,
        Settings { noise: NoiseKind::Triangular, seed: (1 << 53) - 1, ..opening },
        Settings { model: ModelKind::Odometry, seed: 0, ..opening },
        Settings {
            model: ModelKind::Odometry,
            noise: NoiseKind::Triangular,
            command: command(-0.7, 1.3, 1.1),
            ..opening
        },
        Settings { command: command(0.0, -2.0, 0.9), isolate: Some(6), ..opening },
        Settings {
            command: command(-1.2, 0.0, 2.0),
            velocity_alphas: [0.2, 0.1, 0.3, 0.2, 0.0, 0.0],
            ..opening
        },
    ]
}

/// [`fingerprint`] of each of [`settings`]: of the cloud and of what is said about it. A change of the first means that a
/// reader's seed no longer shows the reader's cloud.
pub const FINGERPRINTS: [[u64; 2]; 6] = [
    [0x5c96_4259_28e2_6f98, 0x6bee_c22b_1355_c484],
    [0xf78e_5070_9e91_7a3f, 0x1265_b1db_c182_e35c],
    [0x118a_5b5b_9c1a_a8b8, 0x5ecc_e7f7_fda6_5901],
    [0x25f9_dcd8_0cd0_242a, 0x8a30_d900_9346_dbe3],
    [0x7f76_dd4f_9317_ca7d, 0x690e_dc45_a06e_4be3],
    [0xac8a_c528_3d92_d92a, 0x5e80_2b34_b0b7_16aa],
];

fn command(v: f64, omega: f64, dt: f64) -> VelocityCmd {
    VelocityCmd { v, omega, dt }
}

/// Hashes (FNV-1a) of every bit of the poses, and of every bit of coordinates, figures, contours and curves.
pub fn fingerprint(settings: Settings) -> [u64; 2] {
    let mut machine = BananaMachine::new(settings).expect("a valid setting");
    machine.restart();
    while machine.grow(777) < settings.samples {}

    let mut cloud = Fnv::new();
    machine.poses().for_each(|pose| cloud.numbers(&[pose.x(), pose.y(), pose.theta()]));
    let mut hash = Fnv::new();
    machine.twists().for_each(|twist| hash.numbers(twist.as_slice()));
    let figures = machine.figures();
    for (mean, cov) in [
        (figures.cartesian.mean, figures.cartesian.cov),
        (figures.exponential.mean, figures.exponential.cov),
        (machine.exact().mean, machine.exact().cov),
        (machine.linearized().mean, machine.linearized().cov),
    ] {
        hash.numbers(mean.as_slice());
        hash.numbers(cov.as_slice());
    }
    let track = figures.cross_track;
    hash.numbers(&[track.skew, track.skew_error, track.rho_heading, figures.gaussian_skew]);
    hash.numbers(&[figures.inside_ellipse, figures.inside_exponential, machine.exact().cross_track_skew]);
    let exact = machine.table().exact;
    for gain in [figures.gain.value, figures.gain.error, exact.likelihood_gain] {
        hash.numbers(&[gain.pose, gain.floor]);
    }
    hash.numbers(&[figures.area_ratio, exact.area_ratio]);
    hash.numbers(&machine.skew_curve(-3.0, 3.0, 25));
    let contours = machine.contours();
    for outline in [
        &contours.command,
        &contours.ellipse,
        &contours.linearized,
        &contours.exponential,
        &contours.twist_ellipse,
    ] {
        hash.numbers(outline.as_flattened());
    }
    let grid = Grid { min: [-3.0, -2.0], max: [3.0, 2.0], columns: 60, rows: 40 };
    for view in [View::Plane, View::Twist] {
        machine.density(view, &grid).unwrap().into_iter().for_each(|count| hash.bytes(u64::from(count)));
        hash.bytes(machine.nearest(view, [0.5, 0.2], [0.5, 0.5]).map_or(u64::MAX, |index| index as u64));
    }
    for index in (0..settings.samples).step_by(501) {
        match machine.inspect(index).expect("a sample that is shown").executed {
            Executed::Arc { arc, .. } => hash.numbers(&[arc.v_hat, arc.omega_hat, arc.gamma_hat]),
            Executed::Legs(legs) => hash.numbers(&[legs.rot1, legs.trans, legs.rot2]),
        }
    }
    [cloud.0, hash.0]
}

/// Map Squeeze under each sampler, in a curve, in reverse, and where nothing is judged.
pub fn squeeze_settings() -> [squeeze::Settings; 5] {
    let opening = squeeze::Settings { samples: 3000, ..squeeze::Settings::default() };
    let [_, (_, wall), (_, corridor)] = squeeze::PRESETS;
    [
        opening,
        squeeze::Settings { sampler: Sampler::WholeArc, start: wall, seed: (1 << 53) - 1, ..opening },
        squeeze::Settings { sampler: Sampler::SubStepped(5), start: corridor, seed: 0, ..opening },
        squeeze::Settings { command: command(-0.8, 1.1, 1.7), clearance: 0.2, ..opening },
        squeeze::Settings { command: command(0.4, -2.5, 3.0), conditioned: false, ..opening },
    ]
}

/// [`squeeze_fingerprint`] of each of [`squeeze_settings`].
pub const SQUEEZE_FINGERPRINTS: [u64; 5] = [
    0x919e_8606_c94f_d4c6,
    0x4c1e_5c98_76af_edb8,
    0xb228_686e_93cb_30b6,
    0x2f6f_f73d_c908_a640,
    0x6ad2_5d4b_66d1_072e,
];

/// A hash of every pose, verdict and count, and of some of the paths.
pub fn squeeze_fingerprint(settings: squeeze::Settings) -> u64 {
    let machine = MapSqueeze::new(settings).expect("a valid setting");
    let mut hash = Fnv::new();
    for attempt in machine.attempts() {
        let (pose, verdicts) = (attempt.pose, [attempt.accepted, attempt.end_free, attempt.path_free]);
        hash.numbers(&[pose.x(), pose.y(), pose.theta()]);
        hash.numbers(&verdicts.map(f64::from));
    }
    let tally = machine.tally();
    [tally.draws, tally.wall_tests, tally.accepted, tally.through_wall]
        .into_iter()
        .for_each(|count| hash.bytes(count as u64));
    hash.numbers(&tally.through_wall_interval());
    for index in (0..settings.samples).step_by(101) {
        machine.arcs(index).iter().for_each(|arc| hash.numbers(arc.points().as_flattened()));
    }
    hash.0
}

struct Fnv(u64);

impl Fnv {
    fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    /// NaNs count alike, whatever bits a machine puts in them; so do the two zeros, which nothing here tells apart.
    fn numbers(&mut self, values: &[f64]) {
        for value in values {
            self.bytes(if value.is_nan() { u64::MAX } else { (value + 0.0).to_bits() });
        }
    }

    fn bytes(&mut self, word: u64) {
        for byte in word.to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3);
        }
    }
}
