//! Contacts between two bodies: vertices within bodies, then edges through facets (report, Figs. 7 and 10).
//!
//! The second body is brought into the frame of the first by the relative motor. If a vertex of one lies in the other,
//! the contacts are those vertices, with the normals of the nearest facets. Otherwise an edge that passes through a
//! facet has passed through an edge: the sharp edge nearest to the crossing, found by reflecting the crossing in each
//! edge's line; the normal is common to the two edges.
//!
//! Meant for bodies that have only just met: the time of impact is found first, so that depths are tiny. Bodies of
//! which one swallows the other whole are seen (all its vertices lie within), but get the normals of nearest facets.

use super::{Contact, Polyhedron, balls_overlap};
use crate::algebra::Real;
use crate::algebra::cga::{Infinity, Line, Motor, Plane, Point};
use crate::algebra::g3::Vector;
use crate::geometry::closest_point_on_line;
use crate::rigid::{Bodies, Inertia};
use alloc::vec::Vec;

/// Edges whose directions differ by less than this many epsilons (as the sine of their angle) are parallel: their common
/// normal would be made of the roundings of the cross product, at most 5 unit roundoffs for each of two products.
const PARALLEL_EPSILONS: f64 = 8.0;

/// What a body is to collision tests.
#[derive(Clone, Debug, PartialEq)]
pub enum Collider<T> {
    /// Nothing: it passes through everything.
    None,
    /// A convex polyhedron in the body frame.
    Convex(Polyhedron<T>),
    /// The half-space behind a plane through the body's origin with this unit normal, body frame.
    HalfSpace(Vector<T>),
}

/// Which contacts are wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reach {
    /// Those of bodies that overlap.
    Overlapping,
    /// Those, and vertices within `SIMULTANEOUS` of the surface besides: they are struck at the same instant.
    Simultaneous,
}

/// A vertex this close to the other body when a first contact is made, as a share of its own body's size, touches at the
/// same instant. The corners of a box that lands flat come down within the rounding of its attitude, which grows by an
/// epsilon or so a step: far below this share for any run, while nothing that is modelled is as fine as a nanometre on a
/// metre. Without it a flat landing is a clatter of a hundred impacts, one of each corner after the other.
const SIMULTANEOUS: f64 = 1e-9;

/// In f32 the coordinates themselves are coarser than that: a vertex is good to a few epsilons of the size.
const SIMULTANEOUS_EPSILONS: f64 = 16.0;

fn margin<T: Real>(reach: Reach, body: &Polyhedron<T>) -> T {
    let share = T::from_f64(SIMULTANEOUS).max(T::from_f64(SIMULTANEOUS_EPSILONS) * T::EPSILON);
    match reach {
        Reach::Overlapping => T::zero(),
        Reach::Simultaneous => share * body.bound.rho_sq.sqrt(),
    }
}

/// All bodies as collision tests see them. Every list has one entry a body.
#[derive(Clone, Copy, Debug)]
pub struct Scenery<'a, T: Real> {
    /// Their states.
    pub bodies: &'a Bodies<T>,
    /// Their masses and inertias: how fast a point of a body moves decides which face it came through.
    pub inertias: &'a [Inertia<T>],
    /// Their shapes.
    pub colliders: &'a [Collider<T>],
}

impl<T: Real> Scenery<'_, T> {
    /// The depth up to which two bodies only touch, m: what counts as simultaneous for the larger of them.
    #[must_use]
    pub fn slack(&self, a: usize, b: usize) -> T {
        let of = |index: usize| match &self.colliders[index] {
            Collider::Convex(body) => margin(Reach::Simultaneous, body),
            _ => T::zero(),
        };
        of(a).max(of(b))
    }
}

/// Detects contacts; holds scratch storage.
#[derive(Clone, Debug, Default)]
pub struct NarrowPhase<T> {
    moved: Vec<Point<T>>,
    /// Pairs of edges that have met already, in the order (lower body, higher body): an edge passes through both facets
    /// beside the edge that it struck, and is met again with the roles exchanged.
    met: Vec<[usize; 2]>,
}

impl<T: Real> NarrowPhase<T> {
    /// Appends the contacts of a pair, a below b.
    pub fn contacts(&mut self, all: Scenery<'_, T>, (a, b): (usize, usize), reach: Reach, found: &mut Vec<Contact<T>>) {
        match (&all.colliders[a], &all.colliders[b]) {
            (Collider::Convex(first), Collider::Convex(second)) => {
                let frames = Frame::both(all, (a, first), (b, second));
                self.convex_pair(&frames, reach, found);
            }
            (Collider::Convex(body), Collider::HalfSpace(normal)) => {
                half_space(all.bodies, (a, body), (b, *normal), reach, found);
            }
            (Collider::HalfSpace(normal), Collider::Convex(body)) => {
                half_space(all.bodies, (b, body), (a, *normal), reach, found);
            }
            _ => {}
        }
    }

    /// How deep a pair overlaps that is to be apart, m; `None` where it does not, or only touches: contacts that are all
    /// shallower than the share of the size that counts as simultaneous, between edges or on either side of a face.
    pub fn overlap(&mut self, all: Scenery<'_, T>, (a, b): (usize, usize)) -> Option<T> {
        let mut found = Vec::new();
        self.contacts(all, (a, b), Reach::Overlapping, &mut found);
        let depth = found.iter().map(|contact| -contact.separation).reduce(T::max)?;
        let slack = all.slack(a, b);
        if depth > slack {
            return Some(depth);
        }
        let (Collider::Convex(first), Collider::Convex(second)) = (&all.colliders[a], &all.colliders[b]) else {
            return None;
        };
        let frames = Frame::both(all, (a, first), (b, second));
        let by_edges = !self.met.is_empty();
        let touching = by_edges || frames.iter().any(|frame| frame.separated_by_face(slack));
        (!touching).then_some(depth)
    }

    fn convex_pair(&mut self, frames: &[Frame<'_, T>; 2], reach: Reach, found: &mut Vec<Contact<T>>) {
        self.met.clear();
        let [in_first, in_second] = frames;
        if !balls_overlap(in_first.host.1.bound, in_first.pose.apply(in_first.guest.1.bound)) {
            return;
        }
        let before = found.len();
        for frame in frames {
            self.move_vertices(frame);
            frame.vertices_within(&self.moved, reach, found);
        }
        if found[before..].iter().any(|contact| contact.separation <= T::zero()) {
            return;
        }
        for frame in [in_second, in_first] {
            self.move_vertices(frame);
            frame.edges_through(&self.moved, &mut self.met, found);
        }
    }

    fn move_vertices(&mut self, frame: &Frame<'_, T>) {
        self.moved.clear();
        self.moved.extend(frame.guest.1.vertices.iter().map(|vertex| frame.pose.apply(*vertex)));
    }
}

/// A pair of bodies seen from the frame of one of them, the host.
struct Frame<'a, T: Real> {
    all: Scenery<'a, T>,
    host: (usize, &'a Polyhedron<T>),
    guest: (usize, &'a Polyhedron<T>),
    /// From the guest's frame to the host's.
    pose: Motor<T>,
}

impl<'a, T: Real> Frame<'a, T> {
    /// The pair as each of them sees it.
    fn both(all: Scenery<'a, T>, first: (usize, &'a Polyhedron<T>), second: (usize, &'a Polyhedron<T>)) -> [Self; 2] {
        let pose = all.bodies.relative_pose(first.0, second.0);
        [Frame { all, host: first, guest: second, pose }, Frame { all, host: second, guest: first, pose: pose.rev() }]
    }

    /// A contact given in the host's frame, the normal pointing out of the host. `a` is always the lower index.
    fn contact(&self, point: Point<T>, outward: Vector<T>, separation: T) -> Contact<T> {
        let (host, guest) = (self.host.0, self.guest.0);
        let rotor = self.all.bodies.rotor[host];
        let arm_host = rotor.apply(point.position());
        let between = self.all.bodies.position[host].displacement_to(self.all.bodies.position[guest]).map(T::from_f64);
        let arm_guest = arm_host - between;
        let normal = rotor.apply(outward);
        if host < guest {
            Contact { a: host, b: guest, arm_a: arm_host, arm_b: arm_guest, normal, separation }
        } else {
            Contact { a: guest, b: host, arm_a: arm_guest, arm_b: arm_host, normal: -normal, separation }
        }
    }

    fn vertices_within(&self, moved: &[Point<T>], reach: Reach, found: &mut Vec<Contact<T>>) {
        let margin = margin(reach, self.guest.1);
        let inside = moved.iter().filter(|vertex| !self.host.1.excludes(**vertex, margin));
        found.extend(inside.filter_map(|vertex| self.vertex_contact(*vertex)));
    }

    /// The contact of a vertex with the nearest face. Where several are equally near, to within what counts as
    /// simultaneous, with the one that it came through: of their planes that it is crossing inwards, the one it crossed
    /// last, `-height / speed` ago. So the corners of aligned boxes, which slide in the planes beside the struck face at
    /// height 0 by rounding or exactly, get the normal of that face. A vertex that slides along the nearest came
    /// through another face, however deep behind it it is by now.
    fn vertex_contact(&self, vertex: Point<T>) -> Option<Contact<T>> {
        let (highest, nearest) = self.host.1.height(vertex)?;
        let near = highest - margin(Reach::Simultaneous, self.host.1).max(margin(Reach::Simultaneous, self.guest.1));
        if let Some(contact) = self.last_crossed(vertex, near) {
            return Some(contact);
        }
        let contact = self.contact(vertex, nearest.plane.normal(), highest);
        let (bodies, inertias) = (self.all.bodies, self.all.inertias);
        let slides = contact.approach_speed(bodies, inertias) >= -contact.speed_rounding(bodies, inertias);
        let through = slides.then(|| self.last_crossed(vertex, T::from_f64(f64::NEG_INFINITY))).flatten();
        Some(through.unwrap_or(contact))
    }

    /// The contact with the face that a vertex crossed last, of those whose planes it is above `lowest` of, inwards.
    fn last_crossed(&self, vertex: Point<T>, lowest: T) -> Option<Contact<T>> {
        let crossed = self.host.1.facets.iter().filter_map(|facet| {
            let height = facet.height(vertex);
            let contact = (height >= lowest).then(|| self.contact(vertex, facet.plane.normal(), height))?;
            let speed = contact.approach_speed(self.all.bodies, self.all.inertias);
            let inwards = speed > contact.speed_rounding(self.all.bodies, self.all.inertias);
            inwards.then(|| (-height / speed, contact))
        });
        crossed.reduce(|last, next| if next.0 < last.0 { next } else { last }).map(|(_, contact)| contact)
    }

    /// Do all vertices of the guest lie before the plane of one of the host's facets, to within `slack`?
    fn separated_by_face(&self, slack: T) -> bool {
        let moved: Vec<Point<T>> = self.guest.1.vertices.iter().map(|vertex| self.pose.apply(*vertex)).collect();
        self.host.1.facets.iter().any(|facet| moved.iter().all(|vertex| facet.height(*vertex) >= -slack))
    }

    fn edges_through(&self, moved: &[Point<T>], met: &mut Vec<[usize; 2]>, found: &mut Vec<Contact<T>>) {
        for (guest_edge, edge) in self.guest.1.edges.iter().enumerate() {
            let [start, end] = edge.map(|index| moved[index]);
            for facet in &self.host.1.facets {
                let Some(crossing) = facet.crossing(start, end) else { continue };
                let Some(host_edge) = self.nearest_edge(crossing.point) else { continue };
                let pair = if self.host.0 < self.guest.0 { [host_edge, guest_edge] } else { [guest_edge, host_edge] };
                if !met.contains(&pair) {
                    met.push(pair);
                    found.push(self.edge_contact(host_edge, start, end, crossing.point, facet.plane));
                }
            }
        }
    }

    /// The host's sharp edge that is nearest to a point, by the point's reflection in each edge's line.
    fn nearest_edge(&self, point: Point<T>) -> Option<usize> {
        let host = self.host.1;
        let distances = host.edges.iter().enumerate().filter_map(|(index, edge)| {
            let [from, to] = edge.map(|vertex| host.vertices[vertex]);
            let line: Line<T> = from ^ to ^ Infinity;
            let foot = closest_point_on_line(point, line).ok()?;
            Some((point.distance_sq_to(foot), index))
        });
        distances.reduce(|best, next| if next.0 < best.0 { next } else { best }).map(|(_, index)| index)
    }

    /// The contact of the guest's edge with one of the host's, at the crossing; the normal is common to both edges.
    fn edge_contact(
        &self,
        host_edge: usize,
        start: Point<T>,
        end: Point<T>,
        crossing: Point<T>,
        plane: Plane<T>,
    ) -> Contact<T> {
        let [from, to] = self.host.1.edges[host_edge].map(|vertex| self.host.1.vertices[vertex]);
        let (edge, other) = (from.displacement_to(to), start.displacement_to(end));
        let plane_of_both = edge ^ other;
        let norm = plane_of_both.norm_sq().sqrt();
        let parallel_below = T::from_f64(PARALLEL_EPSILONS) * T::EPSILON * (edge.norm_sq() * other.norm_sq()).sqrt();
        // Parallel edges have no common normal of their own; the facet's is one that both share.
        let mut normal = if norm > parallel_below {
            Vector::new(plane_of_both.e23, plane_of_both.e31, plane_of_both.e12) / norm
        } else {
            plane.normal()
        };
        // Out of the host: its centre of mass, the origin of this frame, lies behind every supporting plane.
        if (normal | from.position()) < T::zero() {
            normal = -normal;
        }
        self.contact(crossing, normal, normal | from.displacement_to(start))
    }
}

/// Vertices behind a plane. The height of the body's centre is formed in f64.
fn half_space<T: Real>(
    bodies: &Bodies<T>,
    (body_idx, body): (usize, &Polyhedron<T>),
    (plane_idx, normal): (usize, Vector<T>),
    reach: Reach,
    found: &mut Vec<Contact<T>>,
) {
    let margin = margin(reach, body);
    let normal = bodies.rotor[plane_idx].apply(normal);
    let from_plane = bodies.position[plane_idx].displacement_to(bodies.position[body_idx]);
    let height = T::from_f64(normal.map(Real::to_f64) | from_plane);
    let normal_body = bodies.rotor[body_idx].rev().apply(normal);
    for vertex in &body.vertices {
        let separation = height + (normal_body | vertex.position());
        if separation < margin {
            let arm = bodies.rotor[body_idx].apply(vertex.position());
            let from_plane = from_plane.map(T::from_f64) + arm;
            found.push(if body_idx < plane_idx {
                Contact { a: body_idx, b: plane_idx, arm_a: arm, arm_b: from_plane, normal: -normal, separation }
            } else {
                Contact { a: plane_idx, b: body_idx, arm_a: from_plane, arm_b: arm, normal, separation }
            });
        }
    }
}
