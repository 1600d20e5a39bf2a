//! What links bodies, in the page, and bodies that are no longer rigid.

use super::{BASE64, Playback, f32_bytes};
use base64::Engine as _;
use serde_json::{Value, json};

/// A body whose recorded orientation is a matrix that is no rotation any more: it is drawn as that matrix leaves it.
#[derive(Debug, Clone)]
pub struct Stretched {
    /// Which body.
    pub body: usize,
    /// Per frame: S, row by row. A point x of the body is drawn at the centre of mass plus R (S x), R the rotor of the pose.
    pub stretch: Vec<[[f64; 3]; 3]>,
}

/// A joint or spring.
#[derive(Debug, Clone)]
pub struct Link {
    /// What it is.
    pub kind: LinkKind,
    /// What it links.
    pub ends: [LinkEnd; 2],
}

/// What links bodies.
#[derive(Debug, Clone, Copy)]
pub enum LinkKind {
    /// A ball joint: a dot.
    Ball,
    /// A hinge: a dot on a line along its axis.
    Hinge {
        /// In the frame of the first end.
        axis: [f64; 3],
    },
    /// A distance: a line.
    Distance,
    /// A spring: a zigzag.
    Spring,
}

/// The end of a joint or spring.
#[derive(Debug, Clone, Copy)]
pub enum LinkEnd {
    /// On a body.
    Body {
        /// Which.
        body: usize,
        /// Where, in its frame, m.
        point: [f64; 3],
    },
    /// On the world, m.
    World([f64; 3]),
}

/// The links; points of the world relative to the scene's centre.
pub(super) fn index(links: &[Link], centre: [f64; 3]) -> Value {
    let end = |end: &LinkEnd| match *end {
        LinkEnd::Body { body, point } => json!({ "body": body, "point": point }),
        LinkEnd::World(point) => json!({ "point": core::array::from_fn::<f64, 3, _>(|i| point[i] - centre[i]) }),
    };
    let link = |link: &Link| {
        let (kind, axis) = match link.kind {
            LinkKind::Ball => ("ball", None),
            LinkKind::Hinge { axis } => ("hinge", Some(axis)),
            LinkKind::Distance => ("distance", None),
            LinkKind::Spring => ("spring", None),
        };
        json!({ "kind": kind, "axis": axis, "ends": link.ends.each_ref().map(end) })
    };
    links.iter().map(link).collect()
}

/// Nine numbers a frame of each stretched body; NaN, and so none, where the recording has none.
pub(super) fn stretches(playback: &Playback<'_>) -> Value {
    let rows = |stretched: &Stretched| {
        let of_frame = |frame| stretched.stretch.get(frame).copied().unwrap_or([[f64::NAN; 3]; 3]);
        let numbers = (0..playback.times_s.len()).flat_map(of_frame).flatten();
        json!({ "body": stretched.body, "rows": BASE64.encode(f32_bytes(numbers)) })
    };
    playback.stretched.iter().map(rows).collect()
}
