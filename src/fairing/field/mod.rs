//! A fair half-breadth field over a chart of few numbers.

pub mod bent;
pub mod chart;
pub mod choice;
pub mod likelihood;
pub mod net;
pub mod observed;
pub mod region;
pub mod surface;
