//! Laws of every formulation.
