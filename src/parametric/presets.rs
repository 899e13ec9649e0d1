//! Presets by type of ship.

/// Types of ship that have a preset.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ShipType {
    /// Tanker or bulk carrier.
    BulkCarrier,
    /// Container ship.
    Container,
    /// General cargo ship or coaster.
    GeneralCargo,
    /// Ro-ro ship, ferry, cruise ship.
    RoRo,
    /// Tug.
    Tug,
    /// Fishing vessel.
    Fishing,
    /// Frigate, fast displacement ship.
    Frigate,
    /// Sailing yacht, canoe body.
    Yacht,
}

impl ShipType {
    /// Every type, in the order of lists.
    pub const ALL: [Self; 8] = [
        Self::BulkCarrier,
        Self::Container,
        Self::GeneralCargo,
        Self::RoRo,
        Self::Tug,
        Self::Fishing,
        Self::Frigate,
        Self::Yacht,
    ];

    /// The word in design files.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::BulkCarrier => "bulk-carrier",
            Self::Container => "container",
            Self::GeneralCargo => "general-cargo",
            Self::RoRo => "ro-ro",
            Self::Tug => "tug",
            Self::Fishing => "fishing",
            Self::Frigate => "frigate",
            Self::Yacht => "yacht",
        }
    }
}
