//! G(2,0,1): the projective geometry of the plane. Lines are vectors, points bivectors.
//!
//! The line `a x + b y + c = 0` is `a e1 + b e2 + c e0`, the point (x, y) is `e12 + x e20 + y e01`, so that
//! `P ^ l = (a x + b y + c) e012`. Then `^` intersects, and `&`, the regressive product, joins: `P & Q` is the line from P
//! to Q, positive on its left. `I = e012` squares to 0, so there is no dual.
//!
//! The motor `exp(-phi/2 P)`, with P a point of weight 1, turns by phi about it: `P² = -1`.

ga_physics::algebra! {
    pub algebra pga2;
    basis e0 = 0, e1 = 1, e2 = 1;
    pseudoscalar e012;

    /// The line `a x + b y + c = 0` as `a e1 + b e2 + c e0`.
    type Line = [e1, e2, e0];
    /// The point (x, y), of weight 1.
    type Point = e12 + x*e20 + y*e01;
    /// A point of any weight; without weight a direction: where parallels meet.
    type AnyPoint = [e12, e20, e01];
    /// A direction, a point of weight 0: the difference of two points.
    type Direction = [e20, e01];
    /// A translation `1 + (e20, e01)/2 . t`, along a line across t.
    type Translator: unit + versor = [s = 1, e20, e01];
    /// A rigid motion of the plane.
    type Motor: unit + versor = [s, e12, e20, e01];
    /// An even multivector.
    type Even = [s, e12, e20, e01];
    /// An odd multivector.
    type Odd = [e0, e1, e2, e012];
    /// A multiple of I.
    type Pseudoscalar = [e012];
    /// A general multivector.
    type Multivector = [s, e0, e1, e2, e12, e20, e01, e012];
}

/// Where two lines meet. Parallels meet in a direction, so the point comes with its weight.
#[ga_physics::formula(self, dynamic = intersection_dynamic)]
pub fn intersection(a: Line, b: Line) -> AnyPoint {
    a ^ b
}

/// The line through two points, from the first to the second; of the length of their distance, positive on its left.
#[ga_physics::formula(self, dynamic = join_dynamic)]
pub fn join(a: Point, b: Point) -> Line {
    a & b
}

/// The point of a line that is nearest to a point. The product `l (l | P)` has the weight `l²`.
#[ga_physics::formula(self, dynamic = foot_dynamic)]
pub fn foot(p: Point, line: Line) -> Point {
    (line * (line | p)).grade(2).normalised()
}

/// Twice the signed area of a triangle, positive counter-clockwise: `a & b & c`.
#[ga_physics::formula(self, dynamic = twice_area_dynamic)]
pub fn twice_area(a: Point, b: Point, c: Point) -> Scalar {
    (a & b) & c
}

/// The image of a point in a line, for a line of any length: `l P l / l²`, and the point faces the other way.
#[ga_physics::formula(self, dynamic = mirror_dynamic)]
pub fn mirror(line: Line, p: Point) -> Point {
    (line * p * line).normalised()
}

impl Motor {
    /// The rotation about a point by an angle in radians, counter-clockwise.
    pub fn about(centre: Point, radians: f64) -> Self {
        let (sin, cos) = (radians / 2.0).sin_cos();
        Self::new(cos, -sin, -sin * centre.x, -sin * centre.y)
    }
}
