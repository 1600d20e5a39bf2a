//! What a run leaves behind: frames, energies, events, drifts, a hash of the final state.

use super::{Event, World};
use crate::algebra::Real;
use crate::algebra::cga::Point;
use crate::algebra::g3::{Bivector, Rotor, Vector};
use crate::particle::{Particles, Totals};
use crate::rigid::{Bodies, Form};
use alloc::vec::Vec;

/// The state of one body, in f64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodySample {
    /// Centre of mass, m.
    pub position: Point<f64>,
    /// Orientation.
    pub rotor: Rotor<f64>,
    /// Where it is stored as a matrix: that, column by column, though it may be no rotation any more; `rotor` is the
    /// nearest one.
    pub matrix: Option<[[f64; 3]; 3]>,
    /// Velocity, m/s.
    pub velocity: Vector<f64>,
    /// Angular velocity, world, rad/s.
    pub omega_world: Bivector<f64>,
}

/// The state of one particle, in f64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParticleSample {
    /// m.
    pub position: Point<f64>,
    /// m/s.
    pub velocity: Vector<f64>,
}

/// All particles of a state.
fn particle_samples<T: Real>(state: &Particles<T>) -> Vec<ParticleSample> {
    let sample = |(position, velocity): (&Point<f64>, &Vector<T>)| ParticleSample {
        position: *position,
        velocity: velocity.map(Real::to_f64),
    };
    state.position.iter().zip(&state.velocity).map(sample).collect()
}

/// All bodies and particles at one instant.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// When, s.
    pub time_s: f64,
    /// One entry a body.
    pub bodies: Vec<BodySample>,
    /// One entry a particle.
    pub particles: Vec<ParticleSample>,
}

/// Energy and momenta at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergySample {
    /// When, s.
    pub time_s: f64,
    /// The sums.
    pub totals: Totals,
}

/// The largest relative departures from the start: see `summary.json`. `None` where the denominator is zero, or rounding.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Drifts {
    /// max|E - E0| / max(kinetic energy).
    pub energy: Option<f64>,
    /// max|P - P0| / max(sum |p_i|).
    pub momentum: Option<f64>,
    /// max|L - L0| / max(sum |L_i|), about the origin.
    pub angular_momentum: Option<f64>,
}

/// Everything that was recorded.
#[derive(Clone, Debug, Default)]
pub struct Record {
    /// States, the first and the last always included.
    pub frames: Vec<Frame>,
    /// Energies, at the same instants.
    pub energies: Vec<EnergySample>,
    /// Events, in order.
    pub events: Vec<Event>,
    start: Option<Totals>,
    energy_error: f64,
    momentum_error: f64,
    angular_momentum_error: f64,
    kinetic_scale: f64,
    momentum_scale: f64,
    angular_momentum_scale: f64,
    max_violation: Option<f64>,
    max_distortion: Option<f64>,
}

impl Record {
    /// Takes note of the state: for the drifts always, as a frame if asked.
    pub fn observe<T: Real>(&mut self, world: &mut World<T>, keep_frame: bool) {
        if let Some(violation_m) = world.worst_violation() {
            self.note_violation(violation_m);
        }
        self.max_distortion = distortion(world).map(|now| larger(self.max_distortion.unwrap_or_default(), now));
        self.note(world.time_s(), world.totals(), keep_frame, || frame(world));
    }

    /// Takes note of a state with these sums: for the drifts always, as a frame if asked.
    fn note(&mut self, time_s: f64, totals: Totals, keep_frame: bool, frame: impl FnOnce() -> Frame) {
        let start = *self.start.get_or_insert(totals);
        self.energy_error = larger(self.energy_error, (totals.energy() - start.energy()).abs());
        self.momentum_error = larger(self.momentum_error, (totals.momentum - start.momentum).norm_sq().sqrt());
        let turned = totals.angular_momentum - start.angular_momentum;
        self.angular_momentum_error = larger(self.angular_momentum_error, turned.norm_sq().sqrt());
        self.kinetic_scale = self.kinetic_scale.max(totals.kinetic);
        self.momentum_scale = self.momentum_scale.max(totals.momentum_scale);
        self.angular_momentum_scale = self.angular_momentum_scale.max(totals.angular_momentum_scale);
        let last = self.frames.last().map(|frame| frame.time_s);
        if keep_frame && last != Some(time_s) {
            self.frames.push(frame());
            self.energies.push(EnergySample { time_s, totals });
        }
    }

    /// Takes note of how far the constraints are violated, m.
    fn note_violation(&mut self, violation: f64) {
        self.max_violation = Some(self.max_violation.unwrap_or_default().max(violation));
    }

    /// The largest violation that was noted, m; none without constraints.
    #[must_use]
    pub fn max_violation(&self) -> Option<f64> {
        self.max_violation
    }

    /// How far an orientation was from a rotation at most; none without bodies.
    #[must_use]
    pub fn max_distortion(&self) -> Option<f64> {
        self.max_distortion
    }

    /// The drifts so far.
    #[must_use]
    pub fn drifts(&self) -> Drifts {
        let relative = |error: f64, scale: f64| (scale > 0.0).then(|| error / scale);
        // A kinetic energy below the rounding of the sum is that of bodies that are held still.
        let energy = self.start.as_ref().map_or(0.0, |start| start.energy().abs());
        let moves = self.kinetic_scale > f64::EPSILON * energy;
        Drifts {
            energy: relative(self.energy_error, self.kinetic_scale).filter(|_| moves),
            momentum: relative(self.momentum_error, self.momentum_scale),
            angular_momentum: relative(self.angular_momentum_error, self.angular_momentum_scale),
        }
    }

    /// The deepest overlap at any contact, m; 0 without contacts.
    #[must_use]
    pub fn max_penetration(&self) -> f64 {
        self.events.iter().map(|event| -event.separation).fold(0.0, f64::max)
    }
}

/// The larger error; infinite for one that is no number, which a maximum would forget.
fn larger(known: f64, error: f64) -> f64 {
    if error.is_nan() { f64::INFINITY } else { known.max(error) }
}

/// The orientation of a body as it is stored, if it is stored as a matrix, column by column.
fn matrix<T: Real>(world: &World<T>, body_idx: usize) -> Option<[[f64; 3]; 3]> {
    let bodies = world.bodies();
    let matrix = bodies.matrix.get(body_idx).filter(|_| world.motion().form_of(body_idx) == Form::Matrix)?;
    Some(core::array::from_fn(|column| core::array::from_fn(|row| matrix[(row, column)].to_f64())))
}

/// How far orientations are from rotations: the largest entry of |R^T R - 1| of a matrix, ||R|² - 1| of a rotor.
fn distortion<T: Real>(world: &World<T>) -> Option<f64> {
    let of_rotor = |rotor: Rotor<f64>| {
        let Rotor { s, e23, e31, e12 } = rotor;
        (s * s + e23 * e23 + e31 * e31 + e12 * e12 - 1.0).abs()
    };
    let of_matrix = |columns: [[f64; 3]; 3]| {
        let dot = |a: usize, b: usize| (0..3).map(|row| columns[a][row] * columns[b][row]).sum::<f64>();
        let entry = |a: usize, b: usize| (dot(a, b) - if a == b { 1.0 } else { 0.0 }).abs();
        (0..3).flat_map(|a| (0..3).map(move |b| (a, b))).fold(0.0, |worst, (a, b)| larger(worst, entry(a, b)))
    };
    let of_body = |body_idx: usize| match matrix(world, body_idx) {
        Some(columns) => of_matrix(columns),
        None => of_rotor(world.bodies().rotor[body_idx].map(Real::to_f64)),
    };
    (0..world.bodies().len()).map(of_body).reduce(larger)
}

fn frame<T: Real>(world: &World<T>) -> Frame {
    let (bodies, inertias) = (world.bodies(), world.motion().inertias());
    let sample = |index: usize| BodySample {
        position: bodies.position[index],
        rotor: bodies.rotor[index].map(Real::to_f64),
        matrix: matrix(world, index),
        velocity: bodies.velocity(index, &inertias[index]).map(Real::to_f64),
        omega_world: bodies.omega_world(index, &inertias[index]).map(Real::to_f64),
    };
    let particles = world.particles().map(|particles| particle_samples(particles.state())).unwrap_or_default();
    Frame { time_s: world.time_s(), bodies: (0..bodies.len()).map(sample).collect(), particles }
}

/// FNV-1a over the bits of the state, bodies first: equal states, equal hashes, on every machine.
#[must_use]
pub fn state_hash<T: Real>(bodies: &Bodies<T>, particles: &Particles<T>) -> u64 {
    let mut hash: u64 = 0xcbf2_9ce4_8422_2325;
    let mut feed = |value: f64| {
        for byte in value.to_bits().to_le_bytes() {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    };
    for index in 0..bodies.len() {
        <[f64; 3]>::from(bodies.position[index]).into_iter().for_each(&mut feed);
        <[f64; 4]>::from(bodies.rotor[index].map(Real::to_f64)).into_iter().for_each(&mut feed);
        <[f64; 3]>::from(bodies.momentum[index].map(Real::to_f64)).into_iter().for_each(&mut feed);
        <[f64; 3]>::from(bodies.angular_momentum[index].map(Real::to_f64)).into_iter().for_each(&mut feed);
    }
    for (position, velocity) in particles.position.iter().zip(&particles.velocity) {
        <[f64; 3]>::from(*position).into_iter().for_each(&mut feed);
        <[f64; 3]>::from(velocity.map(Real::to_f64)).into_iter().for_each(&mut feed);
    }
    hash
}
