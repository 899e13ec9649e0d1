//! The formats that a hull is exported to.

/// What is exported.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ExportFormat {
    /// STEP AP214, a closed solid.
    Step,
    /// IGES 5.3, the same solid.
    Iges,
    /// 3DM of Rhino 5, the same solid.
    Rhino,
    /// DXF: the curves of the lines plan in space.
    Dxf,
    /// Binary STL.
    Stl,
    /// ASCII STL with a named solid for each region.
    StlAscii,
    /// Wavefront OBJ with groups.
    Obj,
    /// PLY.
    Ply,
    /// Binary glTF 2.0.
    Glb,
    /// 3MF.
    ThreeMf,
    /// Legacy VTK with the number of the region of each triangle.
    Vtk,
    /// gmsh 2.2 with regions as physical groups.
    Msh,
    /// Panels of WAMIT.
    Gdf,
    /// Panels of NEMOH.
    Nemoh,
    /// Panels of HAMS.
    Pnl,
    /// Sections for GHS.
    Ghs,
    /// Sections as BRITFAIR offsets.
    Britfair,
    /// Sections for PIAS.
    Pias,
    /// Immersed sections for PDSTRIP.
    Pdstrip,
    /// Sections as the text that FREE!ship and DELFTship import.
    Freeship,
    /// Half-breadths over stations and waterlines as the table of DELFTship.
    Delftship,
    /// The control net of a subdivision surface for FREE!ship and DELFTship.
    Ftm,
    /// Half-breadths below the draught for Michlet.
    Michlet,
    /// Half-breadths over stations and waterlines as CSV.
    Csv,
    /// The same as a workbook.
    Xlsx,
    /// DXF: the three views of the lines plan, flat.
    DxfPlan,
}

impl ExportFormat {
    /// All of them.
    pub const ALL: [Self; 26] = [
        Self::Step,
        Self::Iges,
        Self::Rhino,
        Self::Dxf,
        Self::Stl,
        Self::StlAscii,
        Self::Obj,
        Self::Ply,
        Self::Glb,
        Self::ThreeMf,
        Self::Vtk,
        Self::Msh,
        Self::Gdf,
        Self::Nemoh,
        Self::Pnl,
        Self::Ghs,
        Self::Britfair,
        Self::Pias,
        Self::Pdstrip,
        Self::Freeship,
        Self::Delftship,
        Self::Ftm,
        Self::Michlet,
        Self::Csv,
        Self::Xlsx,
        Self::DxfPlan,
    ];

    /// The name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Step => "step",
            Self::Iges => "iges",
            Self::Rhino => "3dm",
            Self::Dxf => "dxf",
            Self::Stl => "stl",
            Self::StlAscii => "stl-ascii",
            Self::Obj => "obj",
            Self::Ply => "ply",
            Self::Glb => "glb",
            Self::ThreeMf => "3mf",
            Self::Vtk => "vtk",
            Self::Msh => "msh",
            Self::Gdf => "gdf",
            Self::Nemoh => "nemoh",
            Self::Pnl => "pnl",
            Self::Ghs => "ghs",
            Self::Britfair => "britfair",
            Self::Pias => "pias",
            Self::Pdstrip => "pdstrip",
            Self::Freeship => "freeship",
            Self::Delftship => "delftship",
            Self::Ftm => "ftm",
            Self::Michlet => "michlet",
            Self::Csv => "csv",
            Self::Xlsx => "xlsx",
            Self::DxfPlan => "dxf-plan",
        }
    }

    /// What is appended to the name of the hull.
    pub(super) const fn ending(self) -> &'static str {
        match self {
            Self::Step => ".step",
            Self::Iges => ".igs",
            Self::Rhino => ".3dm",
            Self::Dxf => ".dxf",
            Self::Stl => ".stl",
            Self::StlAscii => "-ascii.stl",
            Self::Obj => ".obj",
            Self::Ply => ".ply",
            Self::Glb => ".glb",
            Self::ThreeMf => ".3mf",
            Self::Vtk => ".vtk",
            Self::Msh => ".msh",
            Self::Gdf => ".gdf",
            Self::Nemoh => ".mar",
            Self::Pnl => ".pnl",
            Self::Ghs => ".gf",
            Self::Britfair => ".bri",
            Self::Pias => "-pias.txt",
            Self::Pdstrip => "-pdstrip.txt",
            Self::Freeship => "-freeship.txt",
            Self::Delftship => "-delftship.txt",
            Self::Ftm => ".ftm",
            Self::Michlet => ".mlt",
            Self::Csv => ".csv",
            Self::Xlsx => ".xlsx",
            Self::DxfPlan => "-plan.dxf",
        }
    }

    /// The format that the ending of a name of a file says, where only one has it; tables (`.csv`, `.xlsx`) are not
    /// among them.
    #[must_use]
    pub fn from_ending(name: &str) -> Option<Self> {
        let name = name.to_ascii_lowercase();
        let others = [(".stp", Self::Step), (".iges", Self::Iges)];
        let known = Self::ALL.into_iter().map(|format| (format.ending(), format));
        let own = known.filter(|(ending, format)| ending.starts_with('.') && !matches!(format, Self::Csv | Self::Xlsx));
        own.chain(others).find(|(ending, _)| name.ends_with(ending)).map(|(_, format)| format)
    }

    pub(in crate::report) const fn is_mesh(self) -> bool {
        matches!(
            self,
            Self::Stl | Self::StlAscii | Self::Obj | Self::Ply | Self::Glb | Self::ThreeMf | Self::Vtk | Self::Msh
        )
    }

    pub(super) const fn is_sections(self) -> bool {
        matches!(self, Self::Ghs | Self::Britfair | Self::Pias | Self::Pdstrip | Self::Freeship)
    }

    /// Whether the file goes up to a waterline or names one, so that it needs a draught.
    pub(in crate::report) const fn needs_draught(self) -> bool {
        self.is_panels() || matches!(self, Self::Pdstrip | Self::Michlet | Self::Delftship)
    }

    pub(super) const fn is_solid(self) -> bool {
        matches!(self, Self::Step | Self::Iges | Self::Rhino)
    }

    pub(super) const fn is_panels(self) -> bool {
        matches!(self, Self::Gdf | Self::Nemoh | Self::Pnl)
    }
}
