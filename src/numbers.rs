//! Conversion of numbers to text, for messages.

/// Returns a number as text, with an exponent if it is very large or very small. In WebAssembly, JavaScript formats the number, because
/// Rust's code for printing doubles would take an eighth of the module.
pub(crate) fn format_number(number: f64) -> String {
    #[cfg(target_arch = "wasm32")]
    return js_sys::Number::from(number)
        .to_string_with_radix(10)
        .map_or_else(|_| String::new(), String::from);
    #[cfg(not(target_arch = "wasm32"))]
    if number == 0.0 || !number.is_finite() || (1e-6..1e21).contains(&number.abs()) {
        number.to_string()
    } else {
        format!("{number:e}")
    }
}
