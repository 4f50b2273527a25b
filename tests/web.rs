//! The core as WebAssembly, in a real browser.
#![cfg(target_arch = "wasm32")]

use wasm_bindgen_test::{wasm_bindgen_test, wasm_bindgen_test_configure};

wasm_bindgen_test_configure!(run_in_browser);

#[wasm_bindgen_test]
fn entropy_is_there() {
    assert_ne!(getrandom::u64().unwrap(), getrandom::u64().unwrap());
}
