//! Evaluation of JavaScript expressions that call the interface.

use serde::de::DeserializeOwned;
use wasm_bindgen::prelude::*;

// The test runner serves the module with its bindings under this address.
#[wasm_bindgen(inline_js = r#"
import * as motion from '/wasm-bindgen-test';
const pick = (object, ...keys) => keys.map((key) => object[key]);
export const evaluate_js = (expression, it) =>
    new Function('motion', 'it', 'pick', `return (${expression})`)(motion, it, pick);
"#)]
extern "C" {
    #[wasm_bindgen(catch)]
    fn evaluate_js(expression: &str, object_it: &JsValue) -> Result<JsValue, JsValue>;
}

/// JavaScript value that expressions call `object_it`. In expressions, `motion` is the module under test, and `pick` returns some properties of an
/// object as an array.
pub struct JsObject(JsValue);

impl JsObject {
    pub fn new(expression: &str) -> Self {
        Self(Self(JsValue::UNDEFINED).evaluate(expression))
    }

    pub fn get<T: DeserializeOwned>(&self, expression: &str) -> T {
        serde_wasm_bindgen::from_value(self.evaluate(expression))
            .unwrap_or_else(|js_error| panic!("{expression}: {js_error}"))
    }

    pub fn run(&self, expression: &str) {
        self.evaluate(expression);
    }

    pub fn assert(&self, expression: &str) {
        assert!(self.get::<bool>(expression), "{expression}");
    }

    pub fn error(&self, expression: &str) -> String {
        match evaluate_js(expression, &self.0) {
            Ok(returned_value) => panic!("{expression} is {returned_value:?} and throws nothing"),
            Err(js_error) => js_error.unchecked_into::<js_sys::Error>().to_string().into(),
        }
    }

    /// Asserts that each expression throws the error in the line below it and does not change the state. A line with more
    /// indentation than the first continues the line before it.
    pub fn assert_refused(&self, state_expression: &str, expressions_and_errors: &str) {
        let indentation_of = |line: &str| line.len() - line.trim_start().len();
        let base_indentation =
            expressions_and_errors.lines().find(|line| !line.trim().is_empty()).map_or(0, indentation_of);
        let mut cases_and_errors: Vec<String> = Vec::new();
        for line in expressions_and_errors.lines().filter(|line| !line.trim().is_empty()) {
            match cases_and_errors.last_mut() {
                Some(previous_line) if indentation_of(line) > base_indentation => {
                    *previous_line += &format!(" {}", line.trim())
                }
                _ => cases_and_errors.push(line.trim().to_owned()),
            }
        }
        let state_expression = format!("JSON.stringify({state_expression})");
        let state_before: String = self.get(&state_expression);
        for [expression, js_error] in cases_and_errors.as_chunks().0 {
            assert_eq!(self.error(expression), *js_error, "{expression}");
            assert_eq!(self.get::<String>(&state_expression), state_before, "{expression}");
        }
    }

    fn evaluate(&self, expression: &str) -> JsValue {
        evaluate_js(expression, &self.0).unwrap_or_else(|js_error| panic!("{expression}: {js_error:?}"))
    }
}

impl<T: serde::Serialize> From<&T> for JsObject {
    fn from(returned_value: &T) -> Self {
        Self(serde_wasm_bindgen::to_value(returned_value).expect("a plain value"))
    }
}

pub fn get<T: DeserializeOwned>(expression: &str) -> T {
    JsObject(JsValue::UNDEFINED).get(expression)
}

pub fn assert_near<const N: usize>(actual_numbers: [f64; N], expected_numbers: [f64; N], tolerance: f64) {
    for (actual_number, expected_number) in actual_numbers.iter().zip(&expected_numbers) {
        assert!(
            (actual_number - expected_number).abs() <= tolerance,
            "{actual_numbers:?} is not {expected_numbers:?} to {tolerance}"
        );
    }
}
