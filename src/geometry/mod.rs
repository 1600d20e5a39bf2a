//! Points, flats and rounds of Euclidean space on the conformal algebra; meshes and what is computed from them.
//!
//! The [`formulas`] are unchecked; here they are wrapped: a construction either succeeds or names the degenerate case
//! ([`Degenerate`]). Every round is built in the local frame of one of its own points ("difference first"); only
//! [`circle_parts`] takes a blade as it is. Where a sign alone decides, [`predicates`] knows it exactly. Geometry knows no
//! time.

#[cfg(feature = "study")]
pub mod cell_counting;
mod degenerate;
mod disjoint_sets;
mod double_double;
pub mod enclosing_sphere;
mod facet;
mod flats;
pub mod formulas;
pub mod mass_properties;
mod meets;
pub mod mesh;
pub mod mesh_checks;
mod mesh_convexity;
mod mesh_findings;
mod mesh_topology;
mod points;
pub mod predicates;
mod reflections;
mod rounds;
mod scaled;
pub mod solids;

pub use degenerate::Degenerate;
pub use facet::{Crossing, Facet};
pub use flats::{line_through, plane_through};
pub use meets::{SpheresMeet, line_meets_plane, planes_meet, spheres_meet};
pub use reflections::{closest_point_on_line, invert_in_sphere, reflect_in_line, reflect_in_plane};
pub use rounds::{CircleParts, circle_parts, circle_through, inside_is_negative, sphere_through, sphere_through_pair};
