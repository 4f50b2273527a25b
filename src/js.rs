//! Declaration of results that JavaScript gets as objects.

/// Declares structs that become objects in JavaScript, with the names of the fields in camel case as keys. `as "Name"` after a
/// struct names its TypeScript type. `as "Type"` after a field is its TypeScript type, and `wasm::values::ToJs` converts it.
/// Without JavaScript they are plain structs.
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
