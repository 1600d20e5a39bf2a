//! Bodies, joints and steppers that several tests use.

use ga_physics::algebra::Real;
use ga_physics::algebra::cga::Point;
use ga_physics::algebra::g3::{Bivector, Rotor, Vector};
use ga_physics::constraint::ProjectionError;
use ga_physics::ode::{Composition, Mechanics, RungeKutta, Stepper, Symplectic, System, Tableau};
use ga_physics::rigid::rotor::Rates;
use ga_physics::rigid::{Attachment, Bodies, Forces, Formulation, Held, Inertia, Joint, Wrenches, free, totals};

pub(crate) const GRAVITY: f64 = 9.81;

/// Bodies, what holds them, and what pulls.
#[derive(Clone, Debug, Default)]
pub(crate) struct Case {
    pub(crate) bodies: Bodies<f64>,
    pub(crate) inertias: Vec<Inertia<f64>>,
    pub(crate) joints: Vec<Joint<f64>>,
}

pub(crate) fn vector(x: [f64; 3]) -> Vector<f64> {
    Vector::from(x)
}

pub(crate) fn turned(axis: [f64; 3], angle_rad: f64) -> Rotor<f64> {
    Rotor::from_axis_angle(vector(axis), angle_rad).unwrap()
}

/// A symmetric matrix of given eigenvalues, its axes turned.
pub(crate) fn inertia_tensor(moments: [f64; 3], axes: Rotor<f64>) -> [[f64; 3]; 3] {
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|e| <[f64; 3]>::from(axes.apply(vector(e))));
    std::array::from_fn(|r| std::array::from_fn(|c| (0..3).map(|i| moments[i] * axes[i][r] * axes[i][c]).sum()))
}

impl Case {
    /// A body at rest; its index.
    pub(crate) fn body(&mut self, at: [f64; 3], rotor: Rotor<f64>, inertia: Inertia<f64>) -> usize {
        self.bodies.push(Point::from(at), rotor, Vector::default(), Bivector::default());
        self.inertias.push(inertia);
        self.inertias.len() - 1
    }

    /// The point of the world where it is now, on a body or in the world.
    pub(crate) fn end(&self, body: Option<usize>, point: [f64; 3]) -> Attachment<f64> {
        let point = Point::from(point);
        body.map_or(Attachment::World(point), |body_idx| Attachment::Body {
            body_idx,
            at_body: self.bodies.rotor[body_idx].rev().apply(self.bodies.position[body_idx].displacement_to(point)),
        })
    }

    fn direction(&self, body: Option<usize>, axis: [f64; 3]) -> Vector<f64> {
        body.map_or(vector(axis), |body_idx| self.bodies.rotor[body_idx].rev().apply(vector(axis)))
    }

    pub(crate) fn ball(&mut self, a: usize, b: Option<usize>, point: [f64; 3]) {
        self.joints.push(Joint::Ball { a: self.end(Some(a), point), b: self.end(b, point) });
    }

    pub(crate) fn hinge(&mut self, a: usize, b: Option<usize>, point: [f64; 3], axis: [f64; 3]) {
        self.joints.push(Joint::Hinge {
            a: self.end(Some(a), point),
            b: self.end(b, point),
            axis_a: self.direction(Some(a), axis),
            axis_b: self.direction(b, axis),
        });
    }

    pub(crate) fn distance(&mut self, a: usize, b: Option<usize>, at_a: [f64; 3], at_b: [f64; 3]) {
        let length = Point::from(at_a).distance_sq_to(Point::from(at_b)).sqrt();
        self.joints.push(Joint::Distance { a: self.end(Some(a), at_a), b: self.end(b, at_b), length });
    }

    /// Sets velocities; a projection makes them fit.
    pub(crate) fn moving(&mut self, body_idx: usize, velocity: [f64; 3], omega_world: [f64; 3]) {
        let inertia = self.inertias[body_idx];
        let rotor = self.bodies.rotor[body_idx];
        let omega_body = rotor.rev().apply(Bivector::from(omega_world));
        self.bodies.momentum[body_idx] = vector(velocity) * inertia.mass;
        self.bodies.angular_momentum[body_idx] = rotor.apply(inertia.momentum_of(omega_body));
    }

    /// On its joints.
    pub(crate) fn settled(mut self) -> Self {
        let mut held = Held::new(&self.joints, &self.bodies, &self.inertias, 1e-14).unwrap();
        held.project(&mut self.bodies).unwrap();
        self
    }

    pub(crate) fn world(&self) -> World {
        let held = Held::new(&self.joints, &self.bodies, &self.inertias, 1e-12).unwrap();
        World { inertias: self.inertias.clone(), held, wrenches: weights(&self.inertias), redirected: 0 }
    }

    pub(crate) fn energy(&self, bodies: &Bodies<f64>) -> f64 {
        totals(bodies, &self.inertias, &gravity()).energy()
    }
}

/// The same in f32.
pub(crate) fn single(case: &Case) -> (Bodies<f32>, Vec<Inertia<f32>>, Vec<Joint<f32>>) {
    let down = |x: Vector<f64>| x.map(f32::from_f64);
    let end = |end: Attachment<f64>| match end {
        Attachment::Body { body_idx, at_body } => Attachment::Body { body_idx, at_body: down(at_body) },
        Attachment::World(point) => Attachment::World(point),
    };
    let joint = |joint: &Joint<f64>| match *joint {
        Joint::Ball { a, b } => Joint::Ball { a: end(a), b: end(b) },
        Joint::Distance { a, b, length } => Joint::Distance { a: end(a), b: end(b), length },
        Joint::Hinge { a, b, axis_a, axis_b } => {
            Joint::Hinge { a: end(a), b: end(b), axis_a: down(axis_a), axis_b: down(axis_b) }
        }
    };
    let inertias = case.inertias.iter().map(|inertia| Inertia::new(inertia.mass, inertia.inertia_body).unwrap());
    let mut bodies = Bodies::default();
    for i in 0..case.bodies.len() {
        let of = &case.bodies;
        let (rotor, spin) = (of.rotor[i].map(f32::from_f64), of.angular_momentum[i].map(f32::from_f64));
        bodies.push(of.position[i], rotor, down(of.momentum[i]), spin);
    }
    (bodies, inertias.collect(), case.joints.iter().map(joint).collect())
}

/// What moves.
pub(crate) struct World {
    pub(crate) inertias: Vec<Inertia<f64>>,
    pub(crate) held: Held<f64>,
    wrenches: Wrenches<f64>,
    pub(crate) redirected: u32,
}

fn gravity() -> Forces<f64> {
    Forces { gravity: vector([0.0, 0.0, -GRAVITY]), forces: vec![] }
}

fn weights(inertias: &[Inertia<f64>]) -> Wrenches<f64> {
    let force = inertias.iter().map(|inertia| vector([0.0, 0.0, -GRAVITY]) * inertia.mass).collect();
    Wrenches { force, torque: vec![Bivector::default(); inertias.len()] }
}

impl System<Bodies<f64>, f64> for World {
    type Error = ProjectionError;

    fn rate(&mut self, _: f64, state: &Bodies<f64>, rates: &mut Rates<f64>) -> Result<(), ProjectionError> {
        self.wrenches = weights(&self.inertias);
        self.held.constrain(state, &self.inertias, &mut self.wrenches)?;
        state.rhs(&self.inertias, &self.wrenches, rates);
        Ok(())
    }

    fn settle(&mut self, _: f64, state: &mut Bodies<f64>) -> Result<bool, ProjectionError> {
        state.renormalise().unwrap();
        self.held.project(state)?;
        Ok(true)
    }
}

impl Mechanics<Bodies<f64>, f64> for World {
    type Error = ProjectionError;
    type Acceleration = Wrenches<f64>;

    fn acceleration(&mut self, _: f64, _: &Bodies<f64>, out: &mut Wrenches<f64>) -> Result<(), ProjectionError> {
        *out = weights(&self.inertias);
        Ok(())
    }

    fn kick(&mut self, state: &mut Bodies<f64>, h_s: f64, wrenches: &Wrenches<f64>) {
        for (momentum, force) in state.momentum.iter_mut().zip(&wrenches.force) {
            *momentum += *force * h_s;
        }
    }

    fn drift(&mut self, _: f64, state: &mut Bodies<f64>, h_s: f64) -> Result<(), ProjectionError> {
        let straight = self.held.shake(state, &self.inertias, h_s, fly)?;
        self.redirected += u32::from(!straight);
        Ok(())
    }

    fn settle(&mut self, _: f64, state: &mut Bodies<f64>, _: f64) -> Result<(), ProjectionError> {
        Ok(self.held.project_velocities(state)?)
    }
}

/// The free motion of all bodies.
pub(crate) fn fly(bodies: &mut Bodies<f64>, inertias: &[Inertia<f64>], h_s: f64) {
    for (body_idx, inertia) in inertias.iter().enumerate() {
        let velocity = bodies.velocity(body_idx, inertia);
        bodies.position[body_idx] = bodies.position[body_idx].moved(velocity * h_s);
        let (rotor, momentum) = (bodies.rotor[body_idx], bodies.angular_momentum[body_idx]);
        bodies.rotor[body_idx] = free::turn(inertia, rotor, momentum, h_s);
    }
}

/// Steps of a Runge-Kutta method, with or without projection.
pub(crate) fn run<M: Tableau>(case: &Case, (h_s, steps): (f64, u32), project: bool) -> Bodies<f64> {
    let (mut bodies, mut world) = (case.bodies.clone(), case.world());
    let mut method = RungeKutta::<M, _, f64>::new(bodies.clone(), Rates::zeros(bodies.len()));
    for _ in 0..steps {
        method.step(&mut bodies, 0.0, h_s, &mut world).unwrap();
        if project {
            System::settle(&mut world, 0.0, &mut bodies).unwrap();
        }
    }
    bodies
}

/// RATTLE and its compositions.
pub(crate) fn rattle(
    case: &Case,
    composition: Composition,
    h_s: f64,
) -> (Symplectic<Bodies<f64>, f64, Wrenches<f64>>, World) {
    let world = case.world();
    (Symplectic::new(composition, 0.0, case.bodies.clone(), weights(&case.inertias), h_s).unwrap(), world)
}

pub(crate) fn after(case: &Case, composition: Composition, h_s: f64, steps: u32) -> Bodies<f64> {
    let (mut stepper, mut world) = rattle(case, composition, h_s);
    for _ in 0..steps {
        Stepper::step(&mut stepper, &mut world).unwrap();
    }
    assert_eq!(world.redirected, 0);
    ga_physics::ode::Run::state(&stepper).clone()
}

/// One step of them.
pub(crate) fn rattle_step(world: &mut World, bodies: &mut Bodies<f64>, composition: Composition, h_s: f64) {
    let wrenches = weights(&world.inertias);
    let mut stepper = Symplectic::new(composition, 0.0, bodies.clone(), wrenches, h_s).unwrap();
    Stepper::step(&mut stepper, world).unwrap();
    bodies.clone_from(ga_physics::ode::Run::state(&stepper));
}

/// How far apart two states are: positions, and points a metre from the centre of each body.
pub(crate) fn distance(a: &Bodies<f64>, b: &Bodies<f64>) -> f64 {
    let mut most = 0.0_f64;
    for i in 0..a.len() {
        most = most.max(a.position[i].distance_sq_to(b.position[i]).sqrt());
        for axis in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]] {
            most = most.max((a.rotor[i].apply(vector(axis)) - b.rotor[i].apply(vector(axis))).norm_sq().sqrt());
        }
    }
    most
}

/// Everything that a joint can be, at odd angles: three bodies and the world, each with inertias that are skew to it.
pub(crate) fn medley() -> Case {
    let mut case = Case::default();
    let skew = |moments, angle| Inertia::new(2.0, inertia_tensor(moments, turned([1.0, 2.0, -1.0], angle))).unwrap();
    let a = case.body([0.4, 0.1, -0.3], turned([0.3, 1.0, 0.2], 0.7), skew([0.1, 0.2, 0.25], 0.5));
    let b = case.body([0.9, -0.2, -0.5], turned([1.0, 0.1, 0.4], -1.1), skew([0.05, 0.3, 0.32], 1.5));
    let c = case.body([1.2, 0.3, -1.0], turned([-1.0, 0.5, 0.4], 2.1), skew([0.2, 0.3, 0.4], -0.8));
    case.ball(a, None, [0.1, 0.0, 0.1]);
    case.hinge(b, Some(a), [0.6, 0.0, -0.4], [1.0, -2.0, 0.5]);
    case.distance(c, Some(b), [1.0, 0.2, -0.9], [1.1, -0.3, -0.4]);
    case.moving(a, [0.3, -0.5, 0.2], [1.0, 2.0, -1.5]);
    case.moving(b, [-0.3, 0.4, 0.9], [-2.0, 1.0, 0.5]);
    case.moving(c, [0.6, 0.1, -0.8], [0.5, -1.0, 3.0]);
    case.settled()
}
