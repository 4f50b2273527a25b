//! Results of the core as JavaScript gets them.

/// Declares structs of which JavaScript gets objects. The keys are the names of the fields in camel case, and the TypeScript type of
/// the object is that of `as "Name"`. A field with `as "Type"` has that TypeScript type, and is converted by `wasm::values::ToJs`.
/// Natively the structs are plain ones.
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
