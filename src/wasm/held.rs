//! What JavaScript holds a handle of.

use std::cell::RefCell;

/// A simulation that is borrowed for Rust's own work alone.
///
/// What is read of JavaScript may run the caller's code, which may throw or call the same simulation, and what is made for
/// JavaScript may fail. An exception that passes through Rust leaves every borrow in place for good. So the methods of
/// handles take `&self`, which may be borrowed any number of times, read all arguments before [`Held::with`] and make
/// values for JavaScript after it. What they are given by reference cannot get in, nor anything borrowed out: it is not
/// `'static`.
pub struct Held<T>(RefCell<T>);

impl<T> Held<T> {
    pub fn new(simulation: T) -> Self {
        Self(RefCell::new(simulation))
    }

    /// What the simulation answers. A trap in it is its end: whatever it is asked for then traps as well.
    pub fn with<R: 'static>(&self, work: impl FnOnce(&mut T) -> R + 'static) -> R {
        work(&mut self.0.borrow_mut())
    }
}
