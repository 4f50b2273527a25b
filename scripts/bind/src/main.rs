//! `bind MODULE DIRECTORY`: makes the JavaScript glue (bindings) of the core. It writes `motion_bg.wasm`, the glue `motion_bg.js`, and
//! `motion.d.ts`, the types of the core's exports.

use std::error::Error;
use std::path::PathBuf;
use wasm_bindgen_cli_support::Bindgen;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args_os().skip(1).map(PathBuf::from);
    let (Some(module_path), Some(output_directory), None) =
        (arguments.next(), arguments.next(), arguments.next())
    else {
        return Err("usage: bind MODULE DIRECTORY".into());
    };
    let mut glue_generator = Bindgen::new();
    glue_generator.input_path(&module_path).out_name("motion").typescript(true);
    glue_generator.omit_default_module_path(true).remove_producers_section(true);
    glue_generator.bundler(true)?.generate(&output_directory)?;
    Ok(())
}
