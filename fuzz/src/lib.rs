//! Properties that hold for any input. Each fuzz target is a function that cargo-fuzz and the native tests call.

pub mod assertions;
pub mod input;
pub mod settings;

macro_rules! targets {
    ($($name:ident),+) => {
        $(pub mod $name;)+

        /// Names and functions of the fuzz targets.
        pub const TARGETS: &[(&str, fn(&[u8]))] = &[$((stringify!($name), $name::check_input)),+];
    };
}
targets!(anatomy, banana, calibrate, decomposer, grid, pgm, plan, png, reckoning, squeeze);
