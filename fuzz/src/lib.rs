//! Properties that hold for any input: a function for each fuzz target, called by cargo-fuzz and by the native tests.

pub mod assertions;
pub mod input;
pub mod settings;

macro_rules! targets {
    ($($name:ident),+) => {
        $(pub mod $name;)+

        /// Names and properties of the targets.
        pub const TARGETS: &[(&str, fn(&[u8]))] = &[$((stringify!($name), $name::run)),+];
    };
}
targets!(anatomy, banana, calibrate, decomposer, grid, pgm, plan, png, reckoning, squeeze);
