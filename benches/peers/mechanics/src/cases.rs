//! The cases: positions, masses and links, the same for every peer. They know no engine and no method.
//!
//! SI units; gravity is along -z; all start at rest unless said otherwise.

/// A position or velocity.
pub type Vector = [f64; 3];

const GRAVITY_M_S2: Vector = [0.0, 0.0, -9.81];

/// Particles on massless inextensible links.
#[derive(Clone)]
pub struct Case {
    pub name: &'static str,
    pub position_m: Vec<Vector>,
    pub mass_kg: Vec<f64>,
    pub fixed: Vec<bool>,
    pub links: Vec<Link>,
    pub gravity_m_s2: Vector,
    pub dt_s: f64,
    pub steps: usize,
}

/// Two particles at a constant distance.
#[derive(Clone, Copy)]
pub struct Link {
    pub a: usize,
    pub b: usize,
    pub length_m: f64,
}

impl Case {
    pub fn duration_s(&self) -> f64 {
        self.steps as f64 * self.dt_s
    }

    pub fn lasting(self, steps: usize, name: &'static str) -> Self {
        Self { steps, name, ..self }
    }

    /// Particles at their places, every link at its length in the start position.
    fn new(name: &'static str, position_m: Vec<Vector>, mass_kg: f64, links: Vec<(usize, usize)>) -> Self {
        let length = |&(a, b): &(usize, usize)| Link { a, b, length_m: distance(position_m[a], position_m[b]) };
        Self {
            name,
            mass_kg: vec![mass_kg; position_m.len()],
            fixed: vec![false; position_m.len()],
            links: links.iter().map(length).collect(),
            position_m,
            gravity_m_s2: GRAVITY_M_S2,
            dt_s: 0.0,
            steps: 0,
        }
    }

    fn pinned(mut self, particles: impl IntoIterator<Item = usize>) -> Self {
        particles.into_iter().for_each(|particle| self.fixed[particle] = true);
        self
    }

    fn stepped(self, rate_hz: usize, duration_s: usize) -> Self {
        Self { dt_s: 1.0 / rate_hz as f64, steps: rate_hz * duration_s, ..self }
    }
}

/// The angle of the pendulums from the vertical at the start.
pub const PENDULUM_RAD: f64 = 0.7;

/// A straight chain from the origin, its first particle pinned; links of `length_m`, at `angle_rad` from the vertical.
fn hung(name: &'static str, links: usize, length_m: f64, mass_kg: f64, angle_rad: f64) -> Case {
    let place = |i: usize| {
        let along = i as f64 * length_m;
        [along * angle_rad.sin(), 0.0, -along * angle_rad.cos()]
    };
    Case::new(name, (0..=links).map(place).collect(), mass_kg, (0..links).map(|i| (i, i + 1)).collect()).pinned([0])
}

/// Two particles of 1 kg on links of 1 m, 10 s at 60 Hz.
pub fn double_pendulum() -> Case {
    hung("double pendulum", 2, 1.0, 1.0, PENDULUM_RAD).stepped(60, 10)
}

/// Twenty links, 10 s at 240 Hz.
pub fn chain(name: &'static str, length_m: f64, angle_rad: f64) -> Case {
    hung(name, 20, length_m, 1.0, angle_rad).stepped(240, 10)
}

/// How a net is held.
#[derive(Clone, Copy, PartialEq)]
pub enum Pins {
    /// The two ends of the first row.
    Corners,
    /// All of the first row.
    FirstRow,
}

/// Distance of neighbours in a net.
const SPACING_M: f64 = 0.1;
const NET_PARTICLE_KG: f64 = 0.01;

/// The fold of the accordion: the pinned corners are at half the width of the flat net.
pub const FOLD_RAD: f64 = std::f64::consts::FRAC_PI_3;

/// A square net that lies in the plane z = 0, linked along rows (x) and columns (y), pinned in its first row. A fold makes
/// each row a zigzag: steps of `SPACING_M` at `fold_rad` to the x axis, up and down in turn.
pub fn net(name: &'static str, side: usize, fold_rad: f64, pins: Pins) -> Case {
    let index = |column: usize, row: usize| row * side + column;
    let place = |column: usize, row: usize| {
        let up = (column % 2) as f64 * fold_rad.sin();
        [column as f64 * SPACING_M * fold_rad.cos(), row as f64 * SPACING_M, up * SPACING_M]
    };
    let mut position_m = Vec::new();
    let mut links = Vec::new();
    for row in 0..side {
        for column in 0..side {
            position_m.push(place(column, row));
            links.extend((column > 0).then(|| (index(column - 1, row), index(column, row))));
            links.extend((row > 0).then(|| (index(column, row - 1), index(column, row))));
        }
    }
    let held: Vec<usize> = match pins {
        Pins::Corners => vec![0, side - 1],
        Pins::FirstRow => (0..side).collect(),
    };
    Case::new(name, position_m, NET_PARTICLE_KG, links).pinned(held)
}

/// 32 x 32, folded, 240 Hz.
pub fn folded_net(duration_s: usize) -> Case {
    net("folded net 32 x 32", 32, FOLD_RAD, Pins::Corners).stepped(240, duration_s)
}

/// 100 x 100 at 60 Hz; flat where the first row is pinned, folded where its corners are (flat, the first row would be a
/// straight chain pinned at both ends: its multipliers are not unique).
pub fn large_net(pins: Pins) -> Case {
    match pins {
        Pins::FirstRow => net("net 100 x 100, first row pinned", 100, 0.0, pins),
        Pins::Corners => net("folded net 100 x 100, corners pinned", 100, FOLD_RAD, pins),
    }
    .stepped(60, 2)
}

/// Nets from 1e3 to 1e5 particles at 60 Hz, flat, the first row pinned.
pub fn growing_nets() -> Vec<Case> {
    [32, 100, 316].map(|side| Case { steps: 30, ..net("", side, 0.0, Pins::FirstRow).stepped(60, 1) }).into()
}

pub fn distance(a: Vector, b: Vector) -> f64 {
    ((a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2) + (a[2] - b[2]).powi(2)).sqrt()
}
