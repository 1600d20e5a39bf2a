//! bytemuck: slices of values as slices of numbers, and back.

use crate::pga;
use bytemuck::Zeroable;
use ga_physics::algebra::cga::{Motor, Point};

#[test]
fn points_are_read_in_place() {
    let points: Vec<Point<f32>> = (0..100u8).map(|i| Point::new(f32::from(i), 0.5, -f32::from(i))).collect();
    let numbers: &[f32] = bytemuck::cast_slice(&points);
    assert_eq!(numbers.len(), 300);
    let again = numbers.chunks_exact(3).map(|xyz| Point::new(xyz[0], xyz[1], xyz[2]));
    assert!(again.eq(points.iter().copied()));
    let bytes: &[u8] = bytemuck::cast_slice(&points);
    let read = bytes.chunks_exact(12).map(bytemuck::pod_read_unaligned::<Point<f32>>);
    assert!(read.eq(points.iter().copied()));
}

#[test]
fn fields_stand_in_declared_order() {
    let mut motors = [Motor::<f64>::default(); 2];
    let numbers: &mut [f64] = bytemuck::cast_slice_mut(&mut motors);
    numbers[8..].copy_from_slice(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]);
    assert_eq!(<[f64; 8]>::from(motors[1]), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]);
    // A type of a user's algebra, and a scalar that is none of ours.
    assert_eq!(bytemuck::cast::<[i16; 3], pga::Line<i16>>([1, 2, 3]), pga::Line::new(1, 2, 3));
    assert_eq!(pga::Point::zeroed(), pga::Point::new(0.0, 0.0));
}
