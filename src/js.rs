//! Declaration of results that JavaScript gets as objects.

/// Declares structs of results, which JavaScript gets as objects whose keys are the names of the fields in camel case. `as "Name"` after a
/// struct is the name of its TypeScript type. `as "Type"` after a field is the TypeScript type of the field, which `wasm::values::ToJs`
/// then converts. In native builds the structs have no conversion to JavaScript.
macro_rules! js_structs {
    ($(
        $(#[$meta:meta])*
        pub struct $name:ident $(as $ts_name:literal)? {
            $($(#[$field_meta:meta])* pub $field:ident: $type:ty $(as $ts_type:literal)?),+ $(,)?
        }
    )+) => {$(
        $(#[$meta])*
        #[cfg_attr(
            target_arch = "wasm32",
            derive(serde::Serialize, tsify::Tsify),
            serde(rename_all = "camelCase"),
            tsify(missing_as_null $(, rename = $ts_name)?)
        )]
        pub struct $name {
            $(
                $(#[$field_meta])*
                $(#[cfg_attr(
                    target_arch = "wasm32",
                    serde(serialize_with = "crate::wasm::values::serialize"),
                    tsify(type = $ts_type)
                )])?
                pub $field: $type,
            )+
        }
    )+};
}
pub(crate) use js_structs;
