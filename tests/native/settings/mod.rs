//! Declared settings and the schema generated from them.

mod declared;
mod javascript;
