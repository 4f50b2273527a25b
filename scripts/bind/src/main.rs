//! `bind MODULE DIRECTORY`: what JavaScript needs to call the core. Into the directory go `motion_bg.wasm`, its glue as
//! a script, `motion.js`, with types of it, and `core.d.ts`, the types of what the core exports, as a module has them.

use std::error::Error;
use std::path::{Path, PathBuf};
use wasm_bindgen_cli_support::Bindgen;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args_os().skip(1).map(PathBuf::from);
    let (Some(module), Some(directory), None) = (arguments.next(), arguments.next(), arguments.next()) else {
        return Err("usage: bind MODULE DIRECTORY".into());
    };
    // The glue of a module would be there once for all who import it, and with it one instance of the core.
    binding(&module).no_modules(true)?.generate(&directory)?;
    let as_module = binding(&module).bundler(true)?.generate_output()?;
    let types = as_module.ts().ok_or("no types")?;
    std::fs::write(directory.join("core.d.ts"), types)?;
    Ok(())
}

fn binding(module: &Path) -> Bindgen {
    let mut bindgen = Bindgen::new();
    bindgen.input_path(module).out_name("motion").typescript(true);
    bindgen.omit_default_module_path(true).remove_producers_section(true);
    bindgen
}
