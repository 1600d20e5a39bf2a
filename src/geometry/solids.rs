//! Volume, centre of mass and inertia of the ball, box, capsule, cylinder and cone, in closed form.
//!
//! Axes of revolution lie along z. Ball, box, capsule and cylinder are centred at the origin; the cone has its base in
//! z = 0 and its apex at z = height, its centre of mass at height/4. Inertia is about the centre of mass at density
//! 1 kg/m³, as everywhere in [`mass_properties`](crate::geometry::mass_properties); for another density multiply by it.
//!
//! With r the radius, l the length of a cylinder (of a capsule's straight part), h the height, V the volume:
//!
//! ```text
//! ball      V = 4/3 pi r³     I = 2/5 V r²
//! box       V = a b c         I_xx = V (b² + c²)/12, and so on
//! cylinder  V = pi r² l       I_zz = V r²/2          I_xx = V (r²/4 + l²/12)
//! cone      V = pi r² h/3     I_zz = 3/10 V r²       I_xx = V (3/20 r² + 3/80 h²)
//! capsule   a cylinder (V) and two halves of a ball (W = 4/3 pi r³), moved along the axis:
//!                             I_zz = V r²/2 + 2/5 W r²
//!                             I_xx = V (r²/4 + l²/12) + W (2/5 r² + 3/8 r l + l²/4)
//! ```
//!
//! All terms are positive, so nothing cancels: every number is right to a few units in its last place, from needles to
//! laminae. Source: Goldstein, *Classical Mechanics*, 1980, chapter 5; the half ball's centre lies 3/8 r from its face.

use crate::algebra::cga::Point;
use crate::geometry::mass_properties::{MassProperties, REACH_M};
use core::f64::consts::PI;

/// Why sizes make no solid.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SolidError {
    /// Zero, negative, infinite or not a number.
    #[error("the {size} is {value:?} m: it must be a positive, finite number")]
    NotPositive {
        /// Which size.
        size: &'static str,
        /// What was given (m).
        value: f64,
    },
    /// The fifth power leaves the range of f64, or comes near.
    #[error("the {size} is {value:?} m: between 1e-50 m and 1e50 m is supported; change the unit")]
    OutOfRange {
        /// Which size.
        size: &'static str,
        /// What was given (m).
        value: f64,
    },
}

/// The solid ball about the origin.
///
/// # Errors
/// [`SolidError`]: the radius is not positive or out of range.
pub fn ball(radius: f64) -> Result<MassProperties, SolidError> {
    let r = checked("radius", radius)?;
    let volume = 4.0 / 3.0 * PI * (r * r * r);
    Ok(of_revolution(volume, 0.0, [0.4 * volume * (r * r); 2]))
}

/// The box about the origin with these edges along the axes.
///
/// # Errors
/// [`SolidError`]: an edge is not positive or out of range.
pub fn cuboid(size: [f64; 3]) -> Result<MassProperties, SolidError> {
    let [a, b, c] =
        [checked("size along x", size[0])?, checked("size along y", size[1])?, checked("size along z", size[2])?];
    let volume = a * b * c;
    let moment = |p: f64, q: f64| volume * (p * p + q * q) / 12.0;
    Ok(diagonal(volume, 0.0, [moment(b, c), moment(c, a), moment(a, b)]))
}

/// The capsule about the origin: all points within `radius` of a segment of `length` along z.
///
/// # Errors
/// [`SolidError`]: a size is not positive or out of range.
pub fn capsule(radius: f64, length: f64) -> Result<MassProperties, SolidError> {
    let (r, l) = (checked("radius", radius)?, checked("length", length)?);
    let (straight, ends) = (PI * (r * r) * l, 4.0 / 3.0 * PI * (r * r * r));
    let axial = straight * (0.5 * (r * r)) + ends * (0.4 * (r * r));
    let transverse =
        straight * (0.25 * (r * r) + l * l / 12.0) + ends * (0.4 * (r * r) + 0.375 * (r * l) + 0.25 * (l * l));
    Ok(of_revolution(straight + ends, 0.0, [transverse, axial]))
}

/// The solid cylinder about the origin, its axis along z.
///
/// # Errors
/// [`SolidError`]: a size is not positive or out of range.
pub fn cylinder(radius: f64, length: f64) -> Result<MassProperties, SolidError> {
    let (r, l) = (checked("radius", radius)?, checked("length", length)?);
    let volume = PI * (r * r) * l;
    Ok(of_revolution(volume, 0.0, [volume * (0.25 * (r * r) + l * l / 12.0), volume * (0.5 * (r * r))]))
}

/// The solid cone with its base in the plane z = 0 and its apex at z = `height`.
///
/// # Errors
/// [`SolidError`]: a size is not positive or out of range.
pub fn cone(radius: f64, height: f64) -> Result<MassProperties, SolidError> {
    let (r, h) = (checked("radius", radius)?, checked("height", height)?);
    let volume = PI * (r * r) * h / 3.0;
    Ok(of_revolution(volume, 0.25 * h, [volume * (0.15 * (r * r) + 0.0375 * (h * h)), volume * (0.3 * (r * r))]))
}

fn checked(size: &'static str, value: f64) -> Result<f64, SolidError> {
    if !(value > 0.0 && value.is_finite()) {
        return Err(SolidError::NotPositive { size, value });
    }
    if !REACH_M.contains(&value) {
        return Err(SolidError::OutOfRange { size, value });
    }
    Ok(value)
}

fn of_revolution(volume: f64, centre_z: f64, [transverse, axial]: [f64; 2]) -> MassProperties {
    diagonal(volume, centre_z, [transverse, transverse, axial])
}

fn diagonal(volume: f64, centre_z: f64, [xx, yy, zz]: [f64; 3]) -> MassProperties {
    let inertia_unit_density = [[xx, 0.0, 0.0], [0.0, yy, 0.0], [0.0, 0.0, zz]];
    MassProperties { volume, centre: Point { x: 0.0, y: 0.0, z: centre_z }, inertia_unit_density }
}
