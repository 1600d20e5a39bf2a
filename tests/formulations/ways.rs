//! Every formulation with every method that fits it, behind one signature.

use ga_physics::algebra::Real;
use ga_physics::algebra::cga::Point;
use ga_physics::algebra::g3::{Bivector, Rotor, Vector};
use ga_physics::ode::lie::{CommutatorFree4, LieMethod, LieState, LieStepper, Rkmk4};
use ga_physics::ode::{
    Adaptive, CashKarp, Dop853, Embedded, Fixed, OdeError, Rk4, Stepper, Tableau, Tolerance, Tsit5, Work,
};
use ga_physics::rigid::{
    Bodies, Formulation, Inertia, Method, MotionError, Setup, Solver, System, matrix, motor, quaternion,
};

/// Bodies and what they are subject to.
#[derive(Clone, Debug)]
pub(crate) struct Case<T: Real> {
    pub(crate) setup: Setup<T>,
    pub(crate) bodies: Bodies<T>,
}

impl<T: Real> Case<T> {
    /// Its right-hand side.
    pub(crate) fn system(&self) -> System<T> {
        System::new(self.setup.clone(), &self.bodies, &Solver::fixed(Method::Rk4, 0.01)).unwrap()
    }
}

pub(crate) fn diagonal(moments: [f64; 3]) -> [[f64; 3]; 3] {
    std::array::from_fn(|r| std::array::from_fn(|c| if r == c { moments[r] } else { 0.0 }))
}

/// One body at the origin, its axes those of the world, with an angular velocity in its own frame.
pub(crate) fn spinning<T: Real>(mass: f64, moments: [f64; 3], omega_body: [f64; 3]) -> Case<T> {
    turned(mass, moments, omega_body, Rotor::default())
}

/// The same with another orientation.
pub(crate) fn turned<T: Real>(mass: f64, moments: [f64; 3], omega_body: [f64; 3], rotor: Rotor<T>) -> Case<T> {
    let inertia = Inertia::new(mass, diagonal(moments)).unwrap();
    let mut bodies = Bodies::default();
    let momentum = inertia.momentum_of(Bivector::from(omega_body.map(T::from_f64)));
    bodies.push(Point::origin(), rotor, Vector::default(), rotor.apply(momentum));
    Case { setup: Setup { inertias: vec![inertia], ..Setup::default() }, bodies }
}

/// How steps are chosen.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Pace {
    Fixed(f64),
    Tolerance(f64),
}

/// A run to a time: the bodies there, and what it cost.
pub(crate) type Solve<T> = fn(&Case<T>, Pace, f64) -> Result<(Bodies<T>, Work), OdeError<MotionError>>;

/// A formulation with a method.
#[derive(Clone, Copy)]
pub(crate) struct Way<T: Real> {
    pub(crate) form: &'static str,
    pub(crate) method: &'static str,
    pub(crate) order: u32,
    pub(crate) adaptive: bool,
    pub(crate) solve: Solve<T>,
}

impl<T: Real> Way<T> {
    pub(crate) fn name(&self) -> String {
        format!("{} {}", self.form, self.method)
    }

    pub(crate) fn run(&self, case: &Case<T>, pace: Pace, end_s: f64) -> Bodies<T> {
        (self.solve)(case, pace, end_s).unwrap_or_else(|error| panic!("{}: {error}", self.name())).0
    }
}

fn through<T: Real, F: Formulation<T>>(
    mut stepper: impl Stepper<System<T>, State = F, Error = MotionError>,
    case: &Case<T>,
    end_s: f64,
) -> Result<(Bodies<T>, Work), OdeError<MotionError>> {
    let mut system = case.system();
    let mut state = F::from_bodies(&case.bodies);
    stepper.stop_at(end_s);
    stepper.advance_to(&mut system, end_s, &mut state)?;
    let mut bodies = case.bodies.clone();
    state.write_to(&mut bodies);
    Ok((bodies, stepper.work()))
}

fn tolerance<T: Real>(size: f64) -> Tolerance<T> {
    Tolerance { rtol: T::from_f64(size), atol: T::from_f64(size) }
}

fn fixed<M: Tableau, F: Formulation<T>, T: Real>(
    case: &Case<T>,
    pace: Pace,
    end_s: f64,
) -> Result<(Bodies<T>, Work), OdeError<MotionError>>
where
    F::Rate: Clone,
{
    let start = F::from_bodies(&case.bodies);
    let rates = start.zero_rates();
    match pace {
        Pace::Fixed(h) => through(Fixed::<M, F, T>::new(0.0, start, rates, h).unwrap(), case, end_s),
        Pace::Tolerance(_) => panic!("a method without an estimate"),
    }
}

fn either<M: Embedded, F: Formulation<T>, T: Real>(
    case: &Case<T>,
    pace: Pace,
    end_s: f64,
) -> Result<(Bodies<T>, Work), OdeError<MotionError>>
where
    F::Rate: Clone,
{
    let start = F::from_bodies(&case.bodies);
    let rates = start.zero_rates();
    match pace {
        Pace::Fixed(h) => through(Fixed::<M, F, T>::new(0.0, start, rates, h).unwrap(), case, end_s),
        Pace::Tolerance(size) => {
            through(Adaptive::<M, F, T>::new(0.0, start, rates, tolerance(size)).unwrap(), case, end_s)
        }
    }
}

fn group<M: LieMethod, F: Formulation<T> + LieState<T>, T: Real>(
    case: &Case<T>,
    pace: Pace,
    end_s: f64,
) -> Result<(Bodies<T>, Work), OdeError<MotionError>>
where
    F::Rate: Clone,
{
    let start = F::from_bodies(&case.bodies);
    let rates = start.zero_rates();
    match pace {
        Pace::Fixed(h) => through(LieStepper::<M, F, T>::fixed(0.0, start, rates, h).unwrap(), case, end_s),
        Pace::Tolerance(size) => {
            through(LieStepper::<M, F, T>::adaptive(0.0, start, rates, tolerance(size)).unwrap(), case, end_s)
        }
    }
}

/// All of them.
pub(crate) fn ways<T: Real>() -> Vec<Way<T>> {
    fn vectors<F: Formulation<T>, T: Real>(form: &'static str) -> [Way<T>; 4]
    where
        F::Rate: Clone,
    {
        [
            Way { form, method: "rk4", order: 4, adaptive: false, solve: fixed::<Rk4, F, T> },
            Way { form, method: "cash_karp", order: 5, adaptive: true, solve: either::<CashKarp, F, T> },
            Way { form, method: "tsit5", order: 5, adaptive: true, solve: either::<Tsit5, F, T> },
            Way { form, method: "dop853", order: 8, adaptive: true, solve: either::<Dop853, F, T> },
        ]
    }
    fn groups<F: Formulation<T> + LieState<T>, T: Real>(form: &'static str) -> [Way<T>; 2]
    where
        F::Rate: Clone,
    {
        [
            Way { form, method: "rkmk4", order: 4, adaptive: true, solve: group::<Rkmk4, F, T> },
            Way { form, method: "commutator_free", order: 4, adaptive: true, solve: group::<CommutatorFree4, F, T> },
        ]
    }
    let mut ways = Vec::new();
    ways.extend(vectors::<matrix::State<T>, T>("matrix"));
    ways.extend(vectors::<quaternion::State<T>, T>("quaternion"));
    ways.extend(vectors::<Bodies<T>, T>("rotor"));
    ways.extend(vectors::<motor::State<T>, T>("motor"));
    ways.extend(groups::<Bodies<T>, T>("rotor"));
    ways.extend(groups::<motor::State<T>, T>("motor"));
    ways
}
