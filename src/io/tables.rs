//! The tables of a run as CSV: `trajectory.csv`, `energy.csv`, `events.csv`.
//!
//! Numbers have 17 significant digits, enough to give back the same f64.

use crate::simulation::{BodySample, EnergySample, Event, Frame, ParticleSample};
use std::io::{self, Write};

/// 17 significant digits.
fn number(value: f64) -> String {
    format!("{value:.16e}")
}

fn rows(out: &mut dyn Write, header: &[&str], rows: impl Iterator<Item = Vec<String>>) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    writer.write_record(header)?;
    for row in rows {
        writer.write_record(&row)?;
    }
    writer.flush()
}

/// One row a frame and body, then one a frame and particle, whose rotational columns are empty. `names` are of the
/// bodies, then of the particles.
///
/// # Errors
/// The output fails.
pub fn trajectory(out: &mut dyn Write, names: &[String], frames: &[Frame]) -> io::Result<()> {
    const HEADER: [&str; 15] = [
        "time_s",
        "body",
        "x_m",
        "y_m",
        "z_m",
        "r_1",
        "r_e23",
        "r_e31",
        "r_e12",
        "vx_m_s",
        "vy_m_s",
        "vz_m_s",
        "omega_e23_world",
        "omega_e31_world",
        "omega_e12_world",
    ];
    let body = |body: &BodySample| {
        let mut row = <[f64; 3]>::from(body.position).map(number).to_vec();
        row.extend(<[f64; 4]>::from(body.rotor).map(number));
        row.extend(<[f64; 3]>::from(body.velocity).map(number));
        row.extend(<[f64; 3]>::from(body.omega_world).map(number));
        row
    };
    let particle = |particle: &ParticleSample| {
        let mut row = <[f64; 3]>::from(particle.position).map(number).to_vec();
        row.extend(core::array::from_fn::<_, 4, _>(|_| String::new()));
        row.extend(<[f64; 3]>::from(particle.velocity).map(number));
        row.extend(core::array::from_fn::<_, 3, _>(|_| String::new()));
        row
    };
    let all = frames.iter().flat_map(|frame| {
        let states = frame.bodies.iter().map(body).chain(frame.particles.iter().map(particle));
        names.iter().zip(states).map(|(name, state)| {
            let mut row = vec![number(frame.time_s), name.clone()];
            row.extend(state);
            row
        })
    });
    rows(out, &HEADER, all)
}

/// One row a frame.
///
/// # Errors
/// The output fails.
pub fn energy(out: &mut dyn Write, samples: &[EnergySample]) -> io::Result<()> {
    const HEADER: [&str; 10] =
        ["time_s", "kinetic_j", "potential_j", "total_j", "px", "py", "pz", "l_e23", "l_e31", "l_e12"];
    rows(
        out,
        &HEADER,
        samples.iter().map(|EnergySample { time_s, totals }| {
            let mut row =
                [*time_s, totals.kinetic, totals.potential, totals.kinetic + totals.potential].map(number).to_vec();
            row.extend(<[f64; 3]>::from(totals.momentum).map(number));
            row.extend(<[f64; 3]>::from(totals.angular_momentum).map(number));
            row
        }),
    )
}

/// One row an event.
///
/// # Errors
/// The output fails.
pub fn events(out: &mut dyn Write, names: &[String], events: &[Event]) -> io::Result<()> {
    const HEADER: [&str; 12] =
        ["time_s", "kind", "a", "b", "x_m", "y_m", "z_m", "nx", "ny", "nz", "separation_m", "impulse_n_s"];
    rows(
        out,
        &HEADER,
        events.iter().map(|event| {
            let mut row =
                vec![number(event.time_s), event.kind.name().into(), names[event.a].clone(), names[event.b].clone()];
            row.extend(<[f64; 3]>::from(event.point).map(number));
            row.extend(<[f64; 3]>::from(event.normal).map(number));
            row.extend([event.separation, event.impulse].map(number));
            row
        }),
    )
}
