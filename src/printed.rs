//! Numbers as error messages show them: as JavaScript prints them, but for the + of an exponent.

/// By JavaScript itself where there is one: Rust's way takes a tenth of the module.
#[cfg(target_arch = "wasm32")]
pub fn printed(number: f64) -> String {
    // Only another radix could throw.
    let text =
        js_sys::Number::from(number).to_string_with_radix(10).map_or_else(|_| String::new(), String::from);
    text.chars().filter(|character| *character != '+').collect()
}

#[cfg(not(target_arch = "wasm32"))]
pub fn printed(number: f64) -> String {
    if number.is_infinite() {
        return if number > 0.0 { "Infinity" } else { "-Infinity" }.to_owned();
    }
    let plain = number.abs() >= 1e-6 && number.abs() < 1e21;
    if number == 0.0 {
        // −0 has no sign there.
        "0".to_owned()
    } else if plain || number.is_nan() {
        number.to_string()
    } else {
        format!("{number:e}")
    }
}

/// Several of them: "[0, 0.5, 1]".
pub fn printed_all(numbers: &[f64]) -> String {
    let texts: Vec<String> = numbers.iter().copied().map(printed).collect();
    format!("[{}]", texts.join(", "))
}
