//! Methods that several machines have in JavaScript.

// The module of a single figure needs some of them.
#![allow(unused_macros, unused_imports)]

/// Constructor, `configure` and `config` of a class.
///
/// `$options` is the TypeScript type of what a caller may leave out in part.
macro_rules! configured {
    ($(#[$doc:meta])+ $class:ident, $machine:ident, $name:literal, $settings:literal, $options:literal) => {
        $(#[$doc])+
        /// Metres, radians, seconds throughout. Whatever is out of range throws a TypeError or RangeError that names the field,
        /// and changes nothing.
        #[wasm_bindgen(js_name = $name)]
        pub struct $class($machine);

        #[wasm_bindgen(js_class = $name)]
        impl $class {
            /// Settings that are left out are as the widget opens.
            #[wasm_bindgen(constructor)]
            pub fn new(
                #[wasm_bindgen(unchecked_optional_param_type = $options)] options: &JsValue,
            ) -> Result<Self, JsValue> {
                Ok(Self($machine::new($crate::wasm::fields::read_opening(options)?)?))
            }

            /// Changes the settings that are named. A complete cloud stays complete.
            pub fn configure(
                &mut self,
                #[wasm_bindgen(unchecked_param_type = $options)] settings: &JsValue,
            ) -> Result<(), JsValue> {
                let settings = $crate::wasm::fields::read_settings(self.0.settings(), settings)?;
                Ok(self.0.configure(settings)?)
            }

            /// A copy; changing it changes nothing.
            #[wasm_bindgen(getter, unchecked_return_type = $settings)]
            pub fn config(&self) -> JsValue {
                $crate::wasm::values::settings_to_js(self.0.settings())
            }
        }
    };
}

/// `empty` and `begin` of a class whose machine works in slices.
macro_rules! sliced {
    ($class:ident, $machine:ident, $name:literal, $options:literal) => {
        #[wasm_bindgen(js_class = $name)]
        impl $class {
            /// A machine as the constructor makes it, which shows nothing yet.
            pub fn empty(
                #[wasm_bindgen(unchecked_optional_param_type = $options)] options: &JsValue,
            ) -> Result<Self, JsValue> {
                Ok(Self($machine::empty($crate::wasm::fields::read_opening(options)?)?))
            }

            /// As `configure`, in slices: `advance` is to be called until it says true. Until then the figures are the former
            /// ones.
            pub fn begin(
                &mut self,
                #[wasm_bindgen(unchecked_param_type = $options)] settings: &JsValue,
            ) -> Result<(), JsValue> {
                let settings = $crate::wasm::fields::read_settings(self.0.settings(), settings)?;
                Ok(self.0.begin(settings)?)
            }
        }
    };
}

/// `progress` and `stop` of a class whose slices can be given up.
macro_rules! stoppable {
    ($class:ident, $name:literal) => {
        #[wasm_bindgen(js_class = $name)]
        impl $class {
            /// Share of the work that is done, from 0 to 1.
            #[wasm_bindgen(getter)]
            pub fn progress(&self) -> f64 {
                self.0.progress()
            }

            /// Gives up what was begun: settings and figures are the former ones.
            pub fn stop(&mut self) {
                self.0.stop();
            }
        }
    };
}

/// `shown`, `grow` and `restart` of a class whose machine shows a cloud of at most `$most` samples.
macro_rules! cloud {
    ($class:ident, $name:literal, $most:expr) => {
        #[wasm_bindgen(js_class = $name)]
        impl $class {
            /// Largest `samples`.
            #[wasm_bindgen(getter, js_name = maxSamples)]
            pub fn max_samples() -> f64 {
                $most as f64
            }

            /// Number of samples shown, 0 to `config.samples`.
            #[wasm_bindgen(getter)]
            pub fn shown(&self) -> usize {
                self.0.shown()
            }

            /// Shows up to `count` samples more. Returns how many are shown then.
            pub fn grow(&mut self, count: f64) -> Result<usize, JsValue> {
                let count = $crate::wasm::fields::whole("count", count, 0..=$most as u64)?;
                Ok(self.0.grow(count as usize))
            }

            /// As `grow`, in slices like `begin`, where the machine works in slices.
            #[wasm_bindgen(js_name = beginToGrow)]
            pub fn begin_to_grow(&mut self, count: f64) -> Result<(), JsValue> {
                let count = $crate::wasm::fields::whole("count", count, 0..=$most as u64)?;
                self.0.begin_to_grow(count as usize);
                Ok(())
            }

            /// Shows none; the same samples come again.
            pub fn restart(&mut self) {
                self.0.restart();
            }
        }
    };
}

/// `advance` of a class whose machine works in slices; `$work` names what they are counted in.
macro_rules! advancing {
    ($class:ident, $name:literal, $work:ident) => {
        #[wasm_bindgen(js_class = $name)]
        impl $class {
            /// Works on what was begun, for about so much; whether all is done.
            pub fn advance(&mut self, $work: f64) -> Result<bool, JsValue> {
                let most = $crate::sim::settings::MAX_SEED;
                let work = $crate::wasm::fields::whole(stringify!($work), $work, 1..=most)?;
                Ok(self.0.advance(usize::try_from(work).unwrap_or(usize::MAX)))
            }
        }
    };
}

pub(super) use {advancing, cloud, configured, sliced, stoppable};
