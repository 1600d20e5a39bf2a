//! What a run leaves behind: frames, energies, events, drifts, a hash of the final state.

use super::{Event, World};
use crate::algebra::Real;
use crate::algebra::cga::Point;
use crate::algebra::g3::{Bivector, Rotor, Vector};
use crate::rigid::{Bodies, Totals};
use alloc::vec::Vec;

/// The state of one body, in f64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodySample {
    /// Centre of mass, m.
    pub position: Point<f64>,
    /// Orientation.
    pub rotor: Rotor<f64>,
    /// Velocity, m/s.
    pub velocity: Vector<f64>,
    /// Angular velocity, world, rad/s.
    pub omega_world: Bivector<f64>,
}

/// All bodies at one instant.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// When, s.
    pub time_s: f64,
    /// One entry a body.
    pub bodies: Vec<BodySample>,
}

/// Energy and momenta at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergySample {
    /// When, s.
    pub time_s: f64,
    /// The sums.
    pub totals: Totals,
}

/// The largest relative departures from the start: see `summary.json`. `None` where the denominator is zero.
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
}

impl Record {
    /// Takes note of the state: for the drifts always, as a frame if asked.
    pub fn observe<T: Real>(&mut self, world: &World<T>, keep_frame: bool) {
        let totals = world.totals();
        let start = *self.start.get_or_insert(totals);
        let energy = |t: &Totals| t.kinetic + t.potential;
        self.energy_error = self.energy_error.max((energy(&totals) - energy(&start)).abs());
        self.momentum_error = self.momentum_error.max((totals.momentum - start.momentum).norm_sq().sqrt());
        let turned = totals.angular_momentum - start.angular_momentum;
        self.angular_momentum_error = self.angular_momentum_error.max(turned.norm_sq().sqrt());
        self.kinetic_scale = self.kinetic_scale.max(totals.kinetic);
        self.momentum_scale = self.momentum_scale.max(totals.momentum_scale);
        self.angular_momentum_scale = self.angular_momentum_scale.max(totals.angular_momentum_scale);
        let last = self.frames.last().map(|frame| frame.time_s);
        if keep_frame && last != Some(world.time_s()) {
            self.frames.push(frame(world));
            self.energies.push(EnergySample { time_s: world.time_s(), totals });
        }
    }

    /// The drifts so far.
    #[must_use]
    pub fn drifts(&self) -> Drifts {
        let relative = |error: f64, scale: f64| (scale > 0.0).then(|| error / scale);
        Drifts {
            energy: relative(self.energy_error, self.kinetic_scale),
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

fn frame<T: Real>(world: &World<T>) -> Frame {
    let (bodies, inertias) = (world.bodies(), world.inertias());
    let sample = |index: usize| BodySample {
        position: bodies.position[index],
        rotor: bodies.rotor[index].map(Real::to_f64),
        velocity: bodies.velocity(index, &inertias[index]).map(Real::to_f64),
        omega_world: bodies.omega_world(index, &inertias[index]).map(Real::to_f64),
    };
    Frame { time_s: world.time_s(), bodies: (0..bodies.len()).map(sample).collect() }
}

/// FNV-1a over the bits of the state: equal states, equal hashes, on every machine.
#[must_use]
pub fn state_hash<T: Real>(bodies: &Bodies<T>) -> u64 {
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
    hash
}
