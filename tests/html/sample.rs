//! Playbacks to look at and to test with: closed-form motions, so that nothing here needs a simulator.
//!
//! Bodies bounce on z = 0 along parabolas with a loss at each impact, and turn about a fixed axis. They do not touch
//! each other: it is a picture to judge the viewer by, not physics.

use ga_physics::io::html::{
    BodyView, EnergySample, Guide, Link, LinkEnd, LinkKind, Mark, ParticlesView, Playback, Shape, Stretched,
};

const GRAVITY: f64 = 9.81;
const RESTITUTION: f64 = 0.8;

pub(crate) fn cube(half: f64) -> Shape {
    let vertices =
        (0..8).map(|i| [i & 1, i >> 1 & 1, i >> 2 & 1].map(|bit| if bit == 1 { half } else { -half })).collect();
    let triangles = vec![
        [0, 2, 1],
        [1, 2, 3],
        [4, 5, 6],
        [5, 7, 6],
        [0, 1, 4],
        [1, 5, 4],
        [2, 6, 3],
        [3, 6, 7],
        [0, 4, 2],
        [2, 4, 6],
        [1, 3, 5],
        [3, 7, 5],
    ];
    Shape::Mesh { vertices, triangles }
}

pub(crate) fn pyramid(half: f64) -> Shape {
    // The centre of mass is at a quarter of the height.
    let (low, high) = (-0.5 * half, 1.5 * half);
    let vertices =
        vec![[-half, -half, low], [half, -half, low], [half, half, low], [-half, half, low], [0.0, 0.0, high]];
    let triangles = vec![[0, 2, 1], [0, 3, 2], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
    Shape::Mesh { vertices, triangles }
}

/// One thrown body: where it starts, how fast, and how it turns.
pub(crate) struct Throw {
    pub(crate) name: String,
    pub(crate) shape: Shape,
    pub(crate) radius: f64,
    pub(crate) start: [f64; 3],
    pub(crate) velocity: [f64; 3],
    pub(crate) axis: [f64; 3],
    pub(crate) rate: f64,
}

impl Throw {
    /// Height and vertical velocity above the plane, and the impacts up to `time`: (time, speed before).
    fn vertical(&self, time: f64) -> (f64, f64, Vec<(f64, f64)>) {
        let (mut height, mut speed, mut since, mut impacts) =
            (self.start[2] - self.radius, self.velocity[2], 0.0, Vec::new());
        loop {
            let landing = (speed + (speed * speed + 2.0 * GRAVITY * height).sqrt()) / GRAVITY;
            if since + landing > time || landing < 1e-3 {
                let t = (time - since).min(landing);
                return (height + speed * t - 0.5 * GRAVITY * t * t, speed - GRAVITY * t, impacts);
            }
            since += landing;
            let before = GRAVITY * landing - speed;
            impacts.push((since, before));
            (height, speed) = (0.0, RESTITUTION * before);
        }
    }

    fn pose(&self, time: f64) -> [f64; 7] {
        let (height, _, _) = self.vertical(time);
        let [x, y, _] = self.start;
        // R = exp(-B phi/2) with B the unit bivector dual to the axis.
        let (sin, cos) = (0.5 * self.rate * time).sin_cos();
        let [a, b, c] = self.axis;
        let n = (a * a + b * b + c * c).sqrt();
        let [vx, vy, _] = self.velocity;
        [x + vx * time, y + vy * time, height + self.radius, cos, -a / n * sin, -b / n * sin, -c / n * sin]
    }
}

/// Bodies of 1 kg thrown above a plane, recorded at 60 Hz, the whole moved by `offset`.
pub(crate) fn thrown(scene: &str, throws: Vec<Throw>, duration: f64, offset: [f64; 3]) -> Playback<'_> {
    let frames = (duration * 60.0).round() as usize;
    let times: Vec<f64> = (0..=frames).map(|k| k as f64 / 60.0).collect();
    let moved = |p: [f64; 3]| [p[0] + offset[0], p[1] + offset[1], p[2] + offset[2]];
    let floor = [offset[0], offset[1], offset[2], 1.0, 0.0, 0.0, 0.0];
    let mut poses = vec![vec![floor]; times.len()];
    let mut energy: Vec<EnergySample> =
        times.iter().map(|&time_s| EnergySample { time_s, kinetic_j: 0.0, potential_j: 0.0, total_j: 0.0 }).collect();
    let mut marks = Vec::new();
    for throw in &throws {
        for ((frame, sample), &time) in poses.iter_mut().zip(&mut energy).zip(&times) {
            let pose = throw.pose(time);
            let [x, y, z] = moved([pose[0], pose[1], pose[2]]);
            frame.push([x, y, z, pose[3], pose[4], pose[5], pose[6]]);
            let (height, vz, _) = throw.vertical(time);
            let [vx, vy, _] = throw.velocity;
            sample.kinetic_j += 0.5 * (vx * vx + vy * vy + vz * vz) + 0.05 * throw.rate * throw.rate;
            sample.potential_j += GRAVITY * height;
        }
        for (time_s, speed) in throw.vertical(duration).2 {
            let pose = throw.pose(time_s);
            marks.push(Mark {
                time_s,
                a: "floor".to_owned(),
                b: throw.name.clone(),
                point: moved([pose[0], pose[1], 0.0]),
                normal: [0.0, 0.0, 1.0],
                impulse_n_s: (1.0 + RESTITUTION) * speed,
                kind: if speed < 1.5 { "contact_persists" } else { "impact" }.to_owned(),
            });
        }
    }
    for sample in &mut energy {
        sample.total_j = sample.kinetic_j + sample.potential_j;
    }
    let floor = BodyView { name: "floor".to_owned(), fixed: true, shape: Shape::Plane { normal: [0.0, 0.0, 1.0] } };
    let thrown = throws.into_iter().map(|t| BodyView { name: t.name, fixed: false, shape: t.shape });
    let bodies = core::iter::once(floor).chain(thrown).collect();
    Playback {
        scene,
        bodies,
        times_s: times,
        poses,
        stretched: vec![],
        links: vec![],
        particles: ParticlesView::default(),
        marks,
        energy,
    }
}

/// A cube, a pyramid and an ellipsoid above a plane.
pub(crate) fn tumbling(scene: &str, offset: [f64; 3]) -> Playback<'_> {
    let throw = |name: &str, shape, radius, start, velocity, axis, rate| Throw {
        name: name.to_owned(),
        shape,
        radius,
        start,
        velocity,
        axis,
        rate,
    };
    thrown(
        scene,
        vec![
            throw("tumbling cube", cube(0.3), 0.5, [-1.2, -0.4, 2.4], [0.5, 0.1, 0.5], [1.0, 1.0, 0.3], 2.1),
            throw("pyramid", pyramid(0.35), 0.5, [0.6, 0.7, 1.8], [-0.25, -0.1, 1.0], [0.2, -1.0, 0.6], -1.7),
            throw(
                "ellipsoid",
                Shape::Ellipsoid { semi_axes: [0.5, 0.3, 0.2] },
                0.5,
                [1.3, -0.8, 1.2],
                [-0.3, 0.25, 2.0],
                [0.0, 0.3, 1.0],
                3.0,
            ),
        ],
        4.0,
        offset,
    )
}

/// `n` cubes and ellipsoids in a square above a plane.
pub(crate) fn crowd(scene: &str, n: usize) -> Playback<'_> {
    let side = (n as f64).sqrt().ceil() as usize;
    let throws = (0..n)
        .map(|i| {
            let (column, row) = ((i % side) as f64, (i / side) as f64);
            let shape = if i % 2 == 0 { cube(0.25) } else { Shape::Ellipsoid { semi_axes: [0.35, 0.25, 0.15] } };
            Throw {
                name: format!("body {i}"),
                shape,
                radius: 0.43,
                start: [column, row, 1.0 + 0.3 * (0.7 * column).sin() + 0.3 * (0.9 * row).cos()],
                velocity: [0.0, 0.0, 3.0 + (0.8 * column + 0.5 * row).sin()],
                axis: [column + 1.0, row - 3.0, 2.0],
                rate: 2.0 + 0.1 * column,
            }
        })
        .collect();
    thrown(scene, throws, 5.0, [0.0; 3])
}

/// Round bodies and a cube that is no longer one, joined in every way.
pub(crate) fn linked(scene: &str, offset: [f64; 3]) -> Playback<'_> {
    let throw = |name: &str, shape, x: f64, rate| Throw {
        name: name.to_owned(),
        shape,
        radius: 0.4,
        start: [x, 0.0, 1.5],
        velocity: [0.0, 0.3 * x, 1.0],
        axis: [0.3, 1.0, 0.2 * x],
        rate,
    };
    let capsule = vec![[0.0, -0.5], [0.14, -0.44], [0.2, -0.3], [0.2, 0.3], [0.14, 0.44], [0.0, 0.5]];
    let cone = vec![[0.0, -0.15], [0.3, -0.15], [0.0, 0.45]];
    let throws = vec![
        throw("capsule", Shape::Revolution { profile: capsule }, -1.0, 2.0),
        throw("cone", Shape::Revolution { profile: cone }, 0.0, -1.5),
        throw("no cube", cube(0.3), 1.0, 1.0),
    ];
    let playback = thrown(scene, throws, 3.0, offset);
    let end = |body, point| LinkEnd::Body { body, point };
    // The floor comes first.
    let links = vec![
        Link { kind: LinkKind::Ball, ends: [end(1, [0.0, 0.0, 0.5]), end(2, [0.0, 0.0, 0.45])] },
        Link {
            kind: LinkKind::Hinge { axis: [0.0, 1.0, 0.0] },
            ends: [end(3, [0.3, 0.3, 0.3]), LinkEnd::World(offset)],
        },
        Link { kind: LinkKind::Distance, ends: [end(2, [0.0; 3]), end(3, [-0.3, 0.0, 0.0])] },
        Link {
            kind: LinkKind::Spring,
            ends: [LinkEnd::World([offset[0], offset[1], offset[2] + 3.0]), end(1, [0.0; 3])],
        },
    ];
    let shear = |frame: usize| {
        let f = frame as f64 / playback.times_s.len() as f64;
        [[1.0 - 0.5 * f, 0.6 * f, 0.0], [0.0, 1.0, 0.0], [0.3 * f, 0.0, 1.0 - 0.7 * f]]
    };
    let stretch = (0..playback.times_s.len()).map(shear).collect();
    Playback { stretched: vec![Stretched { body: 3, stretch }], links, ..playback }
}

/// A recording of particles alone: where each is at a time, at 60 Hz.
fn moving(
    scene: &str,
    duration: f64,
    n: usize,
    position: impl Fn(usize, f64) -> [f64; 3],
    particles: ParticlesView,
) -> Playback<'_> {
    let times: Vec<f64> = (0..=(duration * 60.0).round() as usize).map(|k| k as f64 / 60.0).collect();
    let positions = times.iter().map(|&time| (0..n).map(|i| position(i, time)).collect()).collect();
    let energy = times.iter().map(|&time_s| {
        let kinetic_j = (3.0 * time_s).sin().powi(2);
        EnergySample { time_s, kinetic_j, potential_j: 1.0 - kinetic_j, total_j: 1.0 }
    });
    let names = (0..n).map(|i| format!("p.{i}")).collect();
    Playback {
        scene,
        bodies: vec![],
        stretched: vec![],
        links: vec![],
        energy: energy.collect(),
        poses: vec![vec![]; times.len()],
        times_s: times,
        particles: ParticlesView { names, positions, ..particles },
        marks: vec![],
    }
}

/// A row of particles that swing, each linked to the next, the first to a point.
pub(crate) fn pendulums(scene: &str, n: usize, offset: [f64; 3]) -> Playback<'_> {
    let position = |i: usize, time: f64| {
        let angle = 0.8 * (3.0 * time).cos() * (1.0 + 0.1 * i as f64);
        let r = 1.0 + 0.4 * i as f64;
        [offset[0] + r * angle.sin(), offset[1], offset[2] - r * angle.cos()]
    };
    let particles = ParticlesView {
        groups: vec![("first".to_owned(), 1), ("others".to_owned(), n - 1)],
        fixed: vec![false; n],
        masses: vec![1.0; n],
        links: (1..n).map(|i| [i - 1, i]).collect(),
        tethers: vec![(0, offset)],
        ..ParticlesView::default()
    };
    moving(scene, 3.0, n, position, particles)
}

/// A waving square sheet of side x side particles, fixed in two corners.
pub(crate) fn sheet(scene: &str, side: usize) -> Playback<'_> {
    let position = |i: usize, time: f64| {
        let (u, v) = ((i / side) as f64 / side as f64, (i % side) as f64 / side as f64);
        [2.0 * u - 1.0, 0.3 * v * (6.0 * (u + v) - 3.0 * time).sin(), -2.0 * v]
    };
    let n = side * side;
    let links = (0..n).flat_map(|i| {
        let right = (i + side < n).then_some([i, i + side]);
        let below = ((i + 1) % side > 0).then_some([i, i + 1]);
        [right, below].into_iter().flatten()
    });
    let particles = ParticlesView {
        groups: vec![("sheet".to_owned(), n)],
        fixed: (0..n).map(|i| i == 0 || i == n - side).collect(),
        masses: vec![0.01; n],
        links: links.collect(),
        ..ParticlesView::default()
    };
    moving(scene, 1.0, n, position, particles)
}

/// One particle on each kind of surface, two joined by a spring, one round a centre.
pub(crate) fn guides(scene: &str) -> Playback<'_> {
    let position = |i: usize, time: f64| {
        let (sin, cos) = (2.0 * time + i as f64).sin_cos();
        match i {
            0 => [cos, 0.0, sin],
            1 => [3.0 + 0.6 * cos * sin, 0.6 * cos * cos, 0.8 + 0.6 * sin],
            2 => [-3.0 + cos, 0.5 * cos, 0.5 * cos],
            3 => [0.5 * sin, 2.0 + cos, -1.5],
            4 => [3.0 + cos, 2.0, 1.0 + 0.2 * sin],
            _ => [4.0 + cos, 2.5, 1.0],
        }
    };
    let particles = ParticlesView {
        groups: ["bead", "ant", "slider", "puck", "left", "right"].map(|name| (name.to_owned(), 1)).into(),
        fixed: vec![false; 6],
        masses: vec![1.0, 8.0, 1.0, 0.1, 1.0, 1.0],
        springs: vec![[4, 5]],
        centres: vec![[0.0; 3]],
        guides: vec![
            Guide::Circle { centre: [0.0; 3], radius: 1.0, normal: [0.0, 1.0, 0.0] },
            Guide::Sphere { centre: [3.0, 0.0, 0.8], radius: 0.6 },
            Guide::Line { point: [-3.0, 0.0, 0.0], direction: [2.0, 1.0, 1.0] },
            Guide::Plane { point: [0.0, 0.0, -1.5], normal: [0.0, 0.0, 3.0] },
        ],
        ..ParticlesView::default()
    };
    moving(scene, 4.0, 6, position, particles)
}
