//! `bind MODULE DIRECTORY`: makes the JavaScript glue of the core. It writes `motion_bg.wasm`, its glue as a module of
//! JavaScript, `motion_bg.js`, and `motion.d.ts`, the types of the core's exports.

use std::error::Error;
use std::path::PathBuf;
use wasm_bindgen_cli_support::Bindgen;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args_os().skip(1).map(PathBuf::from);
    let (Some(module), Some(directory), None) = (arguments.next(), arguments.next(), arguments.next()) else {
        return Err("usage: bind MODULE DIRECTORY".into());
    };
    let mut bindgen = Bindgen::new();
    bindgen.input_path(&module).out_name("motion").typescript(true);
    bindgen.omit_default_module_path(true).remove_producers_section(true);
    bindgen.bundler(true)?.generate(&directory)?;
    Ok(())
}
