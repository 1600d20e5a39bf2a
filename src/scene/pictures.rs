//! Solids of revolution as they are drawn: profiles (distance from the z axis, height), m, from the lowest point to the
//! highest, about the centre of mass. They are for the picture only; masses and inertias come from closed forms.

/// Points of a quarter circle.
const ARC: u32 = 8;

/// A cylinder along z with half a ball on each end.
pub(super) fn capsule(radius: f64, length: f64) -> Vec<[f64; 2]> {
    let half = 0.5 * length;
    let arc = |k: u32| std::f64::consts::FRAC_PI_2 * f64::from(k) / f64::from(ARC);
    // The ends are on the axis exactly: a ring of rounding size would be drawn with a hole.
    let at = |k: u32| if k == 0 { [0.0, half + radius] } else { [radius * arc(k).sin(), half + radius * arc(k).cos()] };
    let below = (0..=ARC).map(at).map(|[r, z]| [r, -z]);
    below.chain((0..=ARC).rev().map(at)).collect()
}

/// A cylinder along z.
pub(super) fn cylinder(radius: f64, length: f64) -> Vec<[f64; 2]> {
    let half = 0.5 * length;
    vec![[0.0, -half], [radius, -half], [radius, half], [0.0, half]]
}

/// A cone along z: its centre of mass is at a quarter of its height.
pub(super) fn cone(radius: f64, height: f64) -> Vec<[f64; 2]> {
    vec![[0.0, -0.25 * height], [radius, -0.25 * height], [0.0, 0.75 * height]]
}
