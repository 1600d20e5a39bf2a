//! rapier3d-f64: each particle a body without collider and without rotation, links as rope joints or as edges of a soft body.
//!
//! Damping is zero (rapier's default), nothing may sleep, there are no colliders and so no contacts. rapier has no joint that
//! keeps a distance from both sides: a rope only forbids to stretch. Solver iterations are rapier's defaults (4 substeps of
//! one iteration and one stabilisation), as are the settings of soft bodies except the softness of the edges, which is
//! that of its joints (1e6 Hz, damping ratio 1: as stiff as the step allows).

use crate::cases::{Case, Vector};
use crate::measure::{Engine, Way};
use rapier3d_f64::prelude::{
    PhysicsWorld, RigidBodyBuilder, RigidBodyHandle, RopeJointBuilder, SoftBodyBuilder, SoftBodyHandle,
    SoftBodyMaterial, SoftBodyParticleSettings, SpringCoefficients, Vector as RapierVector,
};

/// Rope joints with rapier's defaults.
pub fn ropes() -> Way {
    Way::new("rapier ropes", |case| Ok(Box::new(Ropes::new(case))))
}

/// The edges of a soft body: distances kept from both sides.
pub fn soft_edges() -> Way {
    Way::new("rapier soft edges", |case| Ok(Box::new(SoftEdges::new(case))))
}

fn to_rapier(v: Vector) -> RapierVector {
    RapierVector::new(v[0], v[1], v[2])
}

fn world(case: &Case) -> PhysicsWorld {
    let mut world = PhysicsWorld::new();
    world.gravity = to_rapier(case.gravity_m_s2);
    world.integration_parameters.dt = case.dt_s;
    world
}

struct Ropes {
    world: PhysicsWorld,
    bodies: Vec<RigidBodyHandle>,
}

impl Ropes {
    fn new(case: &Case) -> Self {
        let mut world = world(case);
        let insert = |i: usize| {
            let builder = if case.fixed[i] {
                RigidBodyBuilder::fixed()
            } else {
                RigidBodyBuilder::dynamic().additional_mass(case.mass_kg[i]).lock_rotations().can_sleep(false)
            };
            world.insert_body(builder.translation(to_rapier(case.position_m[i])))
        };
        let bodies: Vec<_> = (0..case.position_m.len()).map(insert).collect();
        for link in &case.links {
            let rope = RopeJointBuilder::new(link.length_m).contacts_enabled(false);
            world.insert_impulse_joint(bodies[link.a], bodies[link.b], rope);
        }
        Self { world, bodies }
    }
}

impl Engine for Ropes {
    fn step(&mut self) -> Result<(), String> {
        self.world.step();
        Ok(())
    }

    fn read(&self, position_m: &mut Vec<Vector>, velocity_m_s: &mut Vec<Vector>) {
        let bodies = || self.bodies.iter().map(|&handle| &self.world.bodies[handle]);
        position_m.clear();
        position_m.extend(bodies().map(|body| <[f64; 3]>::from(body.translation())));
        velocity_m_s.clear();
        velocity_m_s.extend(bodies().map(|body| <[f64; 3]>::from(body.linvel())));
    }
}

struct SoftEdges {
    world: PhysicsWorld,
    body: SoftBodyHandle,
}

impl SoftEdges {
    fn new(case: &Case) -> Self {
        let mut world = world(case);
        let pinned = (0_u32..).zip(&case.fixed).filter_map(|(i, &fixed)| fixed.then_some(i));
        let mut builder = SoftBodyBuilder::new(case.position_m.iter().map(|&p| to_rapier(p)).collect())
            .masses(case.mass_kg.clone())
            .pinned_particles(pinned)
            .edges(case.links.iter().map(|link| [link.a as u32, link.b as u32]).collect())
            .material(SoftBodyMaterial::uniform(SpringCoefficients::joint_defaults()));
        builder.particle_settings = SoftBodyParticleSettings { can_sleep: false, ..Default::default() };
        builder.collider_template = None;
        let body = world.insert_soft_body(builder);
        Self { world, body }
    }
}

impl Engine for SoftEdges {
    fn step(&mut self) -> Result<(), String> {
        self.world.step();
        Ok(())
    }

    fn read(&self, position_m: &mut Vec<Vector>, velocity_m_s: &mut Vec<Vector>) {
        let body = &self.world.soft_bodies[self.body];
        position_m.clear();
        position_m.extend(body.particle_positions().map(<[f64; 3]>::from));
        velocity_m_s.clear();
        velocity_m_s.extend(body.particle_velocities().map(<[f64; 3]>::from));
    }
}
