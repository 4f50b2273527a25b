//! Macros that declare the JavaScript classes of simulations.

#![allow(unused_macros, unused_imports)]

/// Declares the JavaScript class of a simulation, with its constructor, `configure`, `config`, `read` and getters. `$options` is the
/// TypeScript type of the settings argument, whose keys are optional.
///
/// A getter has a name (`as` gives the name in JavaScript, if it differs), a TypeScript type, and the expression for its value. The method
/// `read` returns an object with the settings and the values of the first list of getters. `$view` is the TypeScript type of that object.
macro_rules! simulation_class {
    (
        $(#[$doc:meta])+
        $class:ident($simulation:ident), $name:literal, $settings:literal, $options:literal, |$this:ident|
        $(#[$read_doc:meta])+
        read as $view:literal {
            $($(#[$view_doc:meta])* $view_getter:ident $(as $view_key:literal)?: $view_type:literal = $view_value:expr;)+
        }
        others {
            $($(#[$other_doc:meta])* $other_getter:ident $(as $other_key:literal)?: $other_type:literal = $other_value:expr;)*
        }
    ) => {
        $(#[$read_doc])+
        #[derive(serde::Serialize, tsify::Tsify)]
        #[tsify(rename = $view)]
        pub struct SimulationView {
            #[serde(with = "serde_wasm_bindgen::preserve")]
            #[tsify(type = $settings)]
            config: JsValue,
            $(
                $(#[$view_doc])*
                #[serde($(rename = $view_key,)? with = "serde_wasm_bindgen::preserve")]
                #[tsify(type = $view_type)]
                $view_getter: JsValue,
            )+
        }

        $(#[$doc])+
        /// All units are metres, radians and seconds. An argument out of range throws a TypeError or RangeError that names the field,
        /// and changes nothing.
        #[wasm_bindgen(js_name = $name)]
        pub struct $class($simulation);

        #[wasm_bindgen(js_class = $name)]
        impl $class {
            /// Creates the simulation. Settings that are left out have their initial values.
            #[wasm_bindgen(constructor)]
            pub fn new(
                #[wasm_bindgen(unchecked_optional_param_type = $options)] options: &JsValue,
            ) -> Result<Self, JsValue> {
                Ok(Self($simulation::new($crate::wasm::fields::read_initial_settings(options)?)?))
            }

            /// Changes the given settings; the others stay. Draws all samples again before it returns. Returns all settings.
            #[wasm_bindgen(unchecked_return_type = $settings)]
            pub fn configure(
                &mut self,
                #[wasm_bindgen(unchecked_param_type = $options)] settings: &JsValue,
            ) -> Result<JsValue, JsValue> {
                let settings = $crate::wasm::fields::read_settings(self.0.settings(), settings)?;
                self.0.configure(settings)?;
                Ok(self.config())
            }

            /// Copy of the settings. Changing it does not change the simulation.
            #[wasm_bindgen(getter, unchecked_return_type = $settings)]
            pub fn config(&self) -> JsValue {
                $crate::wasm::values::to_plain_js(self.0.settings())
            }

            $(#[$read_doc])+
            #[wasm_bindgen(unchecked_return_type = $view)]
            pub fn read(&self) -> JsValue {
                $crate::wasm::values::to_plain_js(&SimulationView {
                    config: self.config(),
                    $($view_getter: self.$view_getter()),+
                })
            }

            $(
                $(#[$view_doc])*
                #[wasm_bindgen(getter, $(js_name = $view_key,)? unchecked_return_type = $view_type)]
                pub fn $view_getter(&self) -> JsValue {
                    let $this = &self.0;
                    $view_value.into()
                }
            )+

            $(
                $(#[$other_doc])*
                #[wasm_bindgen(getter, $(js_name = $other_key,)? unchecked_return_type = $other_type)]
                pub fn $other_getter(&self) -> JsValue {
                    let $this = &self.0;
                    $other_value.into()
                }
            )*
        }
    };
}

/// Declares the JavaScript class of a simulation with a cloud of at most `$max_samples` samples. The class has the members of
/// [`simulation_class`] and the members for a cloud.
macro_rules! cloud_simulation_class {
    (
        $(#[$doc:meta])+
        $class:ident($simulation:ident), $name:literal, $settings:literal, $options:literal, $max_samples:expr, |$this:ident|
        $(#[$read_doc:meta])+
        read as $view:literal { $($view_getters:tt)+ }
        others { $($other_getters:tt)* }
    ) => {
        $crate::wasm::simulation_class::simulation_class! {
            $(#[$doc])+
            $class($simulation), $name, $settings, $options, |$this|
            $(#[$read_doc])+
            read as $view {
                /// Number of samples shown, 0 to `config.samples`.
                shown_count as "shown": "number" = $this.shown_count();
                /// Number of samples that `addSamples` adds within a few milliseconds.
                block_size as "block": "number" = $this.block_size();
                $($view_getters)+
            }
            others { $($other_getters)* }
        }

        #[wasm_bindgen(js_class = $name)]
        impl $class {
            /// Creates a simulation as the constructor does, but without samples.
            pub fn empty(
                #[wasm_bindgen(unchecked_optional_param_type = $options)] options: &JsValue,
            ) -> Result<Self, JsValue> {
                Ok(Self($simulation::with_shown_count($crate::wasm::fields::read_initial_settings(options)?, 0)?))
            }

            /// Changes the given settings and returns all settings. Shows the first block of `goal` samples (Infinity: all samples) within
            /// a few milliseconds; `addSamples` shows the remaining samples.
            #[wasm_bindgen(js_name = configureFirst, unchecked_return_type = $settings)]
            pub fn configure_first(
                &mut self,
                #[wasm_bindgen(unchecked_param_type = $options)] settings: &JsValue,
                goal: f64,
            ) -> Result<JsValue, JsValue> {
                let settings = $crate::wasm::fields::read_settings(self.0.settings(), settings)?;
                // The cast saturates: infinity stands for all samples.
                self.0.configure_first(settings, goal as usize)?;
                Ok(self.config())
            }

            /// Shows up to `count` more samples. Returns the total number of samples shown.
            #[wasm_bindgen(js_name = addSamples)]
            pub fn add_samples(&mut self, count: f64) -> Result<usize, JsValue> {
                let count = $crate::wasm::fields::read_integer("count", count, 0..=$max_samples as u64)?;
                Ok(self.0.add_samples(count as usize))
            }
        }
    };
}

pub(super) use {cloud_simulation_class, simulation_class};
