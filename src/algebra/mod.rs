//! Temporary hand-written stand-ins with the shape of the generated types.

/// G(3,0).
pub mod g3 {
    /// Vector.
    #[derive(Clone, Copy, Debug, PartialEq, Default)]
    #[allow(missing_docs, reason = "stand-in")]
    pub struct Vector<T = f64> {
        pub e1: T,
        pub e2: T,
        pub e3: T,
    }
}
/// G(4,1).
pub mod cga {
    /// Point.
    #[derive(Clone, Copy, Debug, PartialEq, Default)]
    #[allow(missing_docs, reason = "stand-in")]
    pub struct Point<T = f64> {
        pub x: T,
        pub y: T,
        pub z: T,
    }
}
