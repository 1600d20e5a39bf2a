//! Symbolic geometric algebra.
