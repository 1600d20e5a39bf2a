//! A root of a function in a bracket, by the method of Alefeld, Potra and Shi 1995 (Algorithm 748, ACM Transactions on
//! Mathematical Software 21, 327-344; their algorithm 4.2): inverse cubic interpolation, safeguarded by quadratic
//! interpolation, a double-length secant step and bisection. The bracket at least halves with every four evaluations;
//! near a simple root three of them multiply the number of digits by more than four.

/// A round must shrink the bracket to this part, or a bisection follows (mu of the paper).
const ENOUGH: f64 = 0.5;

/// A bracket is done at this many spacings of its numbers: below, the function decides nothing.
const RESOLUTION_EPS: f64 = 2.0;

/// A place and the value there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Where.
    pub x: f64,
    /// What.
    pub f: f64,
}

/// A root between two samples of which one is negative and one positive, or one zero: of the ends of the last bracket
/// that with the smaller value. The bracket is then as narrow as the numbers resolve.
///
/// # Errors
/// Those of the function. It must not return NaN.
pub fn find<E>(mut f: impl FnMut(f64) -> Result<f64, E>, a: Sample, b: Sample) -> Result<Sample, E> {
    let mut search = Search::new(a, b);
    let mut next = search.secant();
    // The first interpolations have fewer points to go through.
    let mut round = 0;
    while !search.is_done() {
        let width = search.width();
        if round == 0 {
            search.shrink(next, &mut f)?;
            next = search.quadratic(2);
        }
        search.shrink(next, &mut f)?;
        next = search.cubic(3);
        search.shrink(next, &mut f)?;
        next = search.double_secant();
        search.shrink(next, &mut f)?;
        if search.width() > ENOUGH * width {
            search.shrink(search.middle(), &mut f)?;
        }
        next = search.cubic(2);
        round += 1;
    }
    Ok(search.best())
}

/// A bracket `[a, b]` and the two ends it had before, d the later.
struct Search {
    a: Sample,
    b: Sample,
    d: Option<Sample>,
    e: Option<Sample>,
}

impl Search {
    fn new(a: Sample, b: Sample) -> Self {
        let (a, b) = if a.x <= b.x { (a, b) } else { (b, a) };
        Self { a, b, d: None, e: None }
    }

    fn width(&self) -> f64 {
        self.b.x - self.a.x
    }

    fn resolution(&self) -> f64 {
        RESOLUTION_EPS * f64::EPSILON * self.a.x.abs().max(self.b.x.abs()).max(f64::MIN_POSITIVE)
    }

    fn is_done(&self) -> bool {
        self.a.f == 0.0 || self.b.f == 0.0 || self.width() <= 2.0 * self.resolution()
    }

    fn best(&self) -> Sample {
        if self.a.f.abs() <= self.b.f.abs() { self.a } else { self.b }
    }

    /// The bracket that a sample at x leaves; x is kept off the ends, where it would gain nothing.
    fn shrink<E>(&mut self, x: f64, f: &mut impl FnMut(f64) -> Result<f64, E>) -> Result<(), E> {
        if self.is_done() {
            return Ok(());
        }
        let margin = self.resolution();
        let x =
            if x > self.a.x && x < self.b.x { x.clamp(self.a.x + margin, self.b.x - margin) } else { self.middle() };
        let c = Sample { x, f: f(x)? };
        self.e = self.d;
        if (c.f > 0.0) == (self.b.f > 0.0) && c.f != 0.0 {
            self.d = Some(core::mem::replace(&mut self.b, c));
        } else {
            self.d = Some(core::mem::replace(&mut self.a, c));
        }
        Ok(())
    }

    fn middle(&self) -> f64 {
        self.a.x + 0.5 * self.width()
    }

    fn secant(&self) -> f64 {
        self.a.x - self.a.f * (self.width() / (self.b.f - self.a.f))
    }

    /// Twice the secant step from the better end: when that end hardly moves, the other one is brought over the root.
    fn double_secant(&self) -> f64 {
        let best = self.best();
        let x = best.x - 2.0 * best.f * (self.width() / (self.b.f - self.a.f));
        if (x - best.x).abs() > 0.5 * self.width() { self.middle() } else { x }
    }

    /// The root of the parabola through a, b, d, by Newton steps from the end where they cannot overshoot.
    fn quadratic(&self, newton_steps: u32) -> f64 {
        let (a, b) = (self.a, self.b);
        let Some(d) = self.d else { return self.secant() };
        let slope = (b.f - a.f) / (b.x - a.x);
        let bend = ((d.f - b.f) / (d.x - b.x) - slope) / (d.x - a.x);
        let mut x = if (bend > 0.0) == (a.f > 0.0) { a.x } else { b.x };
        for _ in 0..newton_steps {
            let value = a.f + (slope + bend * (x - b.x)) * (x - a.x);
            x -= value / (slope + bend * (2.0 * x - a.x - b.x));
        }
        if x > a.x && x < b.x { x } else { self.secant() }
    }

    /// The root of the inverse cubic through a, b, d, e; of the parabola where their values are not distinct.
    fn cubic(&self, newton_steps: u32) -> f64 {
        let (a, b, Some(d), Some(e)) = (self.a, self.b, self.d, self.e) else { return self.quadratic(newton_steps) };
        // Neville's scheme for x(f) at f = 0. Equal values make it infinite or no number, which is outside.
        let q11 = (d.x - e.x) * d.f / (e.f - d.f);
        let q21 = (b.x - d.x) * b.f / (d.f - b.f);
        let q31 = (a.x - b.x) * a.f / (b.f - a.f);
        let d21 = (b.x - d.x) * d.f / (d.f - b.f);
        let d31 = (a.x - b.x) * b.f / (b.f - a.f);
        let q22 = (d21 - q11) * b.f / (e.f - b.f);
        let q32 = (d31 - q21) * a.f / (d.f - a.f);
        let d32 = (d31 - q21) * d.f / (d.f - a.f);
        let q33 = (d32 - q22) * a.f / (e.f - a.f);
        let x = a.x + q31 + q32 + q33;
        if x > a.x && x < b.x { x } else { self.quadratic(newton_steps) }
    }
}
