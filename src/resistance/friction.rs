//! The friction line of the ITTC of 1957 and the two numbers of Froude and Reynolds.

/// Froude number Fn = U / sqrt(g L), of a speed [m/s], a length \[m\] and gravity [m/s^2].
#[must_use]
pub fn froude_number(speed: f64, length: f64, gravity: f64) -> f64 {
    speed / (gravity * length).sqrt()
}

/// Reynolds number Rn = U L / nu, of a speed [m/s], a length \[m\] and a kinematic viscosity [m^2/s].
#[must_use]
pub fn reynolds_number(speed: f64, length: f64, viscosity: f64) -> f64 {
    speed * length / viscosity
}

/// Frictional resistance coefficient C_F = 0.075 / (log10 Rn - 2)^2 of the model-ship correlation line (8th ITTC, Madrid
/// 1957); R_F = 1/2 rho U^2 S C_F. Not defined at Rn 100 and below: 0 there.
#[must_use]
pub fn ittc57(reynolds: f64) -> f64 {
    if reynolds > 100.0 { 0.075 / (reynolds.log10() - 2.0).powi(2) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_at_powers_of_ten() {
        assert!((ittc57(1e7) - 0.003).abs() < 1e-15);
        assert!((ittc57(1e9) - 0.075 / 49.0).abs() < 1e-15);
        assert!(ittc57(100.0) == 0.0 && ittc57(0.0) == 0.0);
        assert!((froude_number(9.81, 9.81, 9.81) - 1.0).abs() < 1e-15);
        assert!((reynolds_number(2.0, 3.0, 1e-6) - 6e6).abs() < 1e-8);
    }
}
