//! The kernels of the study with rivals that are no dependencies of the library: glam, and the formula written out.
//!
//! `cargo bench --bench algebra` times them, `cargo bench --bench instructions` counts them, and the workspace in
//! `benches/peers` adds further crates. A row of their tables is a line of [`KERNELS`].

mod glam;
mod hand;

use ga_physics::study::kernels::{self, Kernel, Way};

/// The kernels, each made when it is called for, with the number of its ways.
pub(crate) const KERNELS: [(fn() -> Kernel, usize); 17] = [
    (|| hand::rotor_times_rotor(glam::rotor_times_rotor(kernels::rotor_times_rotor())), 6),
    (|| hand::rotor_on_vector(glam::rotor_on_vector(kernels::rotor_on_vector())), 6),
    (|| hand::motor_on_point(glam::motor_on_point(kernels::motor_on_point())), 7),
    (|| hand::motor_times_motor(glam::motor_times_motor(kernels::motor_times_motor())), 6),
    (|| hand::motor_on_point(glam::motor_on_point(kernels::pose_on_point())), 7),
    (|| hand::motor_times_motor(glam::motor_times_motor(kernels::pose_times_pose())), 6),
    (|| hand::sphere_of_four_points(glam::sphere_of_four_points(kernels::sphere_of_four_points())), 6),
    (|| hand::circle_of_three_points(glam::circle_of_three_points(kernels::circle_of_three_points())), 7),
    (|| hand::line_meets_plane(glam::line_meets_plane(kernels::line_meets_plane())), 6),
    (|| hand::ray_meets_plane(glam::ray_meets_plane(kernels::ray_meets_plane())), 6),
    (|| hand::balls_overlap(glam::balls_overlap(kernels::balls_overlap())), 6),
    (kernels::conformal_on_point, 3),
    (kernels::conformal_times_conformal, 3),
    (kernels::even_product, 3),
    (kernels::even_product_split, 3),
    (kernels::general_product, 3),
    (kernels::general_product_split, 3),
];

/// The kernels, made and checked: all ways give the same results.
///
/// # Panics
/// Two ways disagree, or the list does not fit the study's.
pub(crate) fn checked() -> Vec<Kernel> {
    assert_eq!(KERNELS.len(), kernels::KERNELS.len(), "a kernel of the study is missing here");
    let check = |(make, n_ways): &(fn() -> Kernel, usize)| {
        let kernel = make();
        assert_eq!(kernel.ways.len(), *n_ways, "{}", kernel.name);
        kernel.check().unwrap_or_else(|error| panic!("{error}"));
        kernel
    };
    KERNELS.iter().map(check).collect()
}

/// The ways of all kernels, one after the other.
#[allow(dead_code, reason = "not every bench takes single ways")]
pub(crate) const N_WAYS: usize = {
    let (mut sum, mut index) = (0, 0);
    while index < KERNELS.len() {
        sum += KERNELS[index].1;
        index += 1;
    }
    sum
};

/// One way, without making the other kernels.
///
/// # Panics
/// There are fewer than `index` ways.
#[allow(dead_code, reason = "not every bench takes single ways")]
pub(crate) fn way(mut index: usize) -> Way {
    for (make, n_ways) in &KERNELS {
        if index < *n_ways {
            return make().ways.swap_remove(index);
        }
        index -= n_ways;
    }
    panic!("there are {N_WAYS} ways");
}
