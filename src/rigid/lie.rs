//! Rotors and motors as states on a group, for the steppers of [`crate::ode::lie`].
//!
//! Velocities stand on the right: `Rdot = R k` with `k = -1/2 Omega_body`, a bivector; `Mdot = M k` with
//! `k = -1/2 V_body = b + w ninf`, a twist. They are kept in the storage of rates, whose other numbers are then zero. Momenta,
//! and the positions of the rotor form, are vectors, and are added.

use super::motor::{self, parts};
use super::{Bodies, Formulation, rotor};
use crate::algebra::Real;
use crate::algebra::cga::{Motor, Twist};
use crate::algebra::g3::{Bivector, Even, Odd, Rotor, Vector};
use crate::ode::lie::LieState;

/// `sum h_i k_i` of one array of the rates.
#[inline]
fn sum<T, R, K>(terms: &[(T, &R)], part: impl Fn(&R) -> K) -> K
where
    T: Real,
    K: Default + core::ops::Add<Output = K> + core::ops::Mul<T, Output = K>,
{
    terms.iter().fold(K::default(), |sum, (h, rates)| sum + part(rates) * *h)
}

#[inline]
fn bivector<T: Real>(a: Even<T>) -> Bivector<T> {
    Bivector::new(a.e23, a.e31, a.e12)
}

#[inline]
fn even<T: Real>(b: Bivector<T>) -> Even<T> {
    Even::new(T::zero(), b.e23, b.e31, b.e12)
}

#[inline]
fn vector<T: Real>(a: Odd<T>) -> Vector<T> {
    Vector::new(a.e1, a.e2, a.e3)
}

#[inline]
fn odd<T: Real>(v: Vector<T>) -> Odd<T> {
    Odd::new(v.e1, v.e2, v.e3, T::zero())
}

/// `[a, b] = a b - b a`, twice the bivector part of the product.
#[inline]
fn bracket<T: Real>(a: Bivector<T>, b: Bivector<T>) -> Bivector<T> {
    bivector(a * b) * T::ratio(2, 1)
}

impl<T: Real> LieState<T> for Bodies<T> {
    fn to_velocity(&self, rate: &mut rotor::Rates<T>) {
        for (rotor, rate) in self.rotor.iter().zip(&mut rate.rotor) {
            *rate = even(bivector(rotor.rev() * *rate));
        }
    }

    fn to_rate(&self, velocity: &mut rotor::Rates<T>) {
        for (rotor, velocity) in self.rotor.iter().zip(&mut velocity.rotor) {
            *velocity = *rotor * bivector(*velocity);
        }
    }

    fn act(&mut self, terms: &[(T, &rotor::Rates<T>)]) {
        for body_idx in 0..self.position.len() {
            let moved = sum(terms, |rates| rates.position[body_idx]);
            self.position[body_idx] = self.position[body_idx].moved(moved.map(Real::to_f64));
            let turn = bivector(sum(terms, |rates| rates.rotor[body_idx]));
            self.rotor[body_idx] = self.rotor[body_idx] * Rotor::exp(turn);
            self.momentum[body_idx] += sum(terms, |rates| rates.momentum[body_idx]);
            self.angular_momentum[body_idx] += sum(terms, |rates| rates.angular_momentum[body_idx]);
        }
    }

    fn combine(terms: &[(T, &rotor::Rates<T>)], out: &mut rotor::Rates<T>) {
        for body_idx in 0..out.rotor.len() {
            out.position[body_idx] = sum(terms, |rates| rates.position[body_idx]);
            out.rotor[body_idx] = sum(terms, |rates| rates.rotor[body_idx]);
            out.momentum[body_idx] = sum(terms, |rates| rates.momentum[body_idx]);
            out.angular_momentum[body_idx] = sum(terms, |rates| rates.angular_momentum[body_idx]);
        }
    }

    fn add_bracket(out: &mut rotor::Rates<T>, scale: T, a: &rotor::Rates<T>, b: &rotor::Rates<T>) {
        for (out, (a, b)) in out.rotor.iter_mut().zip(a.rotor.iter().zip(&b.rotor)) {
            *out += even(bracket(bivector(*a), bivector(*b)) * scale);
        }
    }

    fn log_from(&self, start: &Self, out: &mut rotor::Rates<T>) {
        for body_idx in 0..self.position.len() {
            let moved = start.position[body_idx].displacement_to(self.position[body_idx]);
            out.position[body_idx] = moved.map(T::from_f64);
            out.rotor[body_idx] = even((start.rotor[body_idx].rev() * self.rotor[body_idx]).log());
            out.momentum[body_idx] = self.momentum[body_idx] - start.momentum[body_idx];
            out.angular_momentum[body_idx] = self.angular_momentum[body_idx] - start.angular_momentum[body_idx];
        }
    }
}

impl<T: Real> LieState<T> for motor::State<T> {
    /// `~M Mdot`, with `~M = ~r + m' ninf`: a reversed vector times ninf changes sign, a trivector does not.
    fn to_velocity(&self, rate: &mut motor::Rates<T>) {
        for (motor, (rdot, mdot)) in self.motor.iter().zip(rate.even.iter_mut().zip(&mut rate.odd)) {
            let (r, m) = parts(*motor);
            let reversed = Odd::new(-m.e1, -m.e2, -m.e3, m.e123);
            *mdot = odd(vector(r.rev() * *mdot + reversed * *rdot));
            *rdot = even(bivector(r.rev() * *rdot));
        }
    }

    fn to_rate(&self, velocity: &mut motor::Rates<T>) {
        for (motor, (b, w)) in self.motor.iter().zip(velocity.even.iter_mut().zip(&mut velocity.odd)) {
            let (r, m) = parts(*motor);
            *w = m * bivector(*b) + r * vector(*w);
            *b = r * bivector(*b);
        }
    }

    fn act(&mut self, terms: &[(T, &motor::Rates<T>)]) {
        for body_idx in 0..self.motor.len() {
            let b = sum(terms, |rates| rates.even[body_idx]);
            let w = sum(terms, |rates| rates.odd[body_idx]);
            let step = Motor::exp(Twist::new(b.e23, b.e31, b.e12, w.e1, w.e2, w.e3));
            self.motor[body_idx] = self.motor[body_idx] * step;
            self.momentum[body_idx] += sum(terms, |rates| rates.momentum[body_idx]);
            self.angular_momentum[body_idx] += sum(terms, |rates| rates.angular_momentum[body_idx]);
        }
    }

    fn combine(terms: &[(T, &motor::Rates<T>)], out: &mut motor::Rates<T>) {
        for body_idx in 0..out.even.len() {
            out.even[body_idx] = sum(terms, |rates| rates.even[body_idx]);
            out.odd[body_idx] = sum(terms, |rates| rates.odd[body_idx]);
            out.momentum[body_idx] = sum(terms, |rates| rates.momentum[body_idx]);
            out.angular_momentum[body_idx] = sum(terms, |rates| rates.angular_momentum[body_idx]);
        }
    }

    /// `[b1 + w1 ninf, b2 + w2 ninf] = [b1, b2] + 2 (w1 . b2 - w2 . b1) ninf`
    fn add_bracket(out: &mut motor::Rates<T>, scale: T, a: &motor::Rates<T>, b: &motor::Rates<T>) {
        for body_idx in 0..out.even.len() {
            let (b1, w1) = (bivector(a.even[body_idx]), vector(a.odd[body_idx]));
            let (b2, w2) = (bivector(b.even[body_idx]), vector(b.odd[body_idx]));
            out.even[body_idx] += even(bracket(b1, b2) * scale);
            let crossed = ((w1 | b2) - (w2 | b1)) * (scale * T::ratio(2, 1));
            out.odd[body_idx] += odd(crossed);
        }
    }

    fn log_from(&self, start: &Self, out: &mut motor::Rates<T>) {
        for body_idx in 0..self.motor.len() {
            // Anchors may have moved; their difference is taken in f64.
            let between = start.position(body_idx).displacement_to(self.position(body_idx)).map(T::from_f64);
            let (from, to) = (start.motor[body_idx].rotor(), self.motor[body_idx].rotor());
            let relative = Motor::from_parts(from.rev().apply(between), from.rev() * to);
            let log = relative.log();
            out.even[body_idx] = even(Bivector::new(log.e23, log.e31, log.e12));
            out.odd[body_idx] = odd(Vector::new(log.e1_ninf, log.e2_ninf, log.e3_ninf));
            out.momentum[body_idx] = self.momentum[body_idx] - start.momentum[body_idx];
            out.angular_momentum[body_idx] = self.angular_momentum[body_idx] - start.angular_momentum[body_idx];
        }
    }
}
