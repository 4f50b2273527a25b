//! Runner with which `cargo test` runs WebAssembly tests in a browser.

fn main() -> impl std::process::Termination {
    env_logger::init();
    wasm_bindgen_cli::wasm_bindgen_test_runner::run_cli_with_args(std::env::args_os())
}
