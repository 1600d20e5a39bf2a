//! Scenes: what a TOML scene file says, and what is wrong with it.
//!
//! [`load`] reads a file, applies `--set path=value` overrides, and returns a [`Scene`] whose
//! single values are sound, or every mistake it found as [`Diagnostic`]s that point at the value
//! and name a remedy. The stages:
//!
//! 1. `source`: the file becomes text, the text a TOML document; `overrides` edits the document;
//! 2. `read`: the document becomes the structs of [`description`], going on after a mistake;
//! 3. `check`: mistakes that need no geometry (a negative mass, an unknown body).
//!
//! Geometry (volumes, overlap at the start) is judged later, by whoever builds the bodies; that
//! stage reports with the same [`Diagnostic`].
//!
//! # Editors
//!
//! [`schema`] is a JSON schema (draft-07) of the file. It lies beside the shipped scenes as
//! `scene.schema.json`; for scenes elsewhere, write it next to them:
//!
//! ```text
//! ga-physics schema > scene.schema.json
//! ```
//!
//! With this first line in a scene Taplo (`taplo lint scene.toml`, tried with its package 0.7.0) and
//! the editor plug-ins built on it ("Even Better TOML") complete keys, show units and underline
//! mistakes while you type:
//!
//! ```toml
//! #:schema ./scene.schema.json
//! ```

mod bodies;
pub mod build;
mod check;
pub mod description;
mod diagnostic;
mod overrides;
mod particles;
mod pictures;
pub mod plan;
mod read;
mod schema;
mod source;
mod suggest;
mod surfaces;
mod translate;
mod values;

pub use check::MAX_STEPS;
pub use description::Scene;
pub use diagnostic::{Diagnostic, stderr_wants_colour};
pub use schema::schema;
pub use source::{Rejected, SceneSource, load, parse};
pub use values::{Inertia, Numbers, Vertices};
