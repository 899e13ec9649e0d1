//! STEP AP214 (ISO 10303-21, -42, -214): a closed solid of B-spline faces, named and coloured.

use std::fmt::Write as _;

mod faces;
mod geometry;
mod read;
mod unit;

pub(in super::super) use read::{is_step, read_step};

use super::{CadUnit, multiplicities, real};
use crate::hull::{Region, Solid};
use crate::spline::{BsplineCurve, BsplineSurface};

/// Numbered instances.
struct Data {
    text: String,
    last: usize,
    scale: f64,
}

impl Data {
    fn add(&mut self, instance: &str) -> usize {
        self.last += 1;
        let _ = writeln!(self.text, "#{}={instance};", self.last);
        self.last
    }

    fn point(&mut self, point: [f64; 3]) -> usize {
        let [x, y, z] = point.map(|c| real(c * self.scale));
        self.add(&format!("CARTESIAN_POINT('',({x},{y},{z}))"))
    }

    fn curve(&mut self, curve: &BsplineCurve<3>) -> usize {
        let points: Vec<usize> = curve.points().iter().map(|&point| self.point(point)).collect();
        let (times, knots) = knots(curve.knots().knots());
        let degree = curve.knots().degree();
        let list = references(&points);
        self.add(&format!(
            "B_SPLINE_CURVE_WITH_KNOTS('',{degree},{list},.UNSPECIFIED.,.F.,.F.,{times},{knots},.UNSPECIFIED.)"
        ))
    }

    fn surface(&mut self, surface: &BsplineSurface<3>, name: &str) -> usize {
        let points: Vec<usize> = surface.points().iter().map(|&point| self.point(point)).collect();
        let rows: Vec<String> = points.chunks(surface.shape()[1]).map(references).collect();
        let [p, q] = [surface.u().degree(), surface.v().degree()];
        let ((u_times, us), (v_times, vs)) = (knots(surface.u().knots()), knots(surface.v().knots()));
        let rows = rows.join(",");
        self.add(&format!(
            "B_SPLINE_SURFACE_WITH_KNOTS('{name}',{p},{q},({rows}),.UNSPECIFIED.,.F.,.F.,.F.,{u_times},{v_times},{us},{vs},\
             .UNSPECIFIED.)"
        ))
    }
}

fn references(list: &[usize]) -> String {
    let list: Vec<String> = list.iter().map(|number| format!("#{number}")).collect();
    format!("({})", list.join(","))
}

/// Multiplicities and knots as lists.
fn knots(knots: &[f64]) -> (String, String) {
    let list = multiplicities(knots);
    let times: Vec<String> = list.iter().map(|(_, times)| times.to_string()).collect();
    let values: Vec<String> = list.iter().map(|(knot, _)| real(*knot)).collect();
    (format!("({})", times.join(",")), format!("({})", values.join(",")))
}

/// Colours (red, green, blue).
fn colour(region: Region) -> [f64; 3] {
    match region {
        Region::Hull => [0.0, 0.35, 0.55],
        Region::Bottom => [0.55, 0.15, 0.1],
        Region::Transom => [0.4, 0.6, 0.75],
        Region::Bow => [0.25, 0.45, 0.65],
        Region::Deck | Region::Centreplane => [0.85, 0.8, 0.7],
    }
}

/// A text as it stands between quotes: what is not printable ASCII as `\X2\`, four hexadecimal digits a character, or
/// beyond 16 bits as `\X4\`, eight.
fn encoded(text: &str) -> String {
    let (mut written, mut open) = (String::new(), "");
    for c in text.chars() {
        let directive = match u32::from(c) {
            0x20..=0x7e => "",
            0..=0xffff => "\\X2\\",
            _ => "\\X4\\",
        };
        if directive != open {
            written.push_str(if open.is_empty() { "" } else { "\\X0\\" });
            written.push_str(directive);
            open = directive;
        }
        match (directive, c) {
            ("", '\'' | '\\') => written.extend([c, c]),
            ("", _) => written.push(c),
            ("\\X2\\", _) => written.push_str(&format!("{:04X}", u32::from(c))),
            _ => written.push_str(&format!("{:08X}", u32::from(c))),
        }
    }
    written.push_str(if open.is_empty() { "" } else { "\\X0\\" });
    written
}

/// Text of a STEP file of the solid.
#[must_use]
pub fn write_step(solid: &Solid, name: &str, unit: CadUnit) -> String {
    let name = encoded(name);
    let mut data = Data { text: String::new(), last: 0, scale: unit.in_a_metre() };
    let context = data.add("APPLICATION_CONTEXT('core data for automotive mechanical design processes')");
    data.add(&format!("APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,#{context})"));
    let product_context = data.add(&format!("PRODUCT_CONTEXT('',#{context},'mechanical')"));
    let product = data.add(&format!("PRODUCT('{name}','{name}','',(#{product_context}))"));
    let formation = data.add(&format!("PRODUCT_DEFINITION_FORMATION('','',#{product})"));
    let definition_context = data.add(&format!("PRODUCT_DEFINITION_CONTEXT('part definition',#{context},'design')"));
    let definition = data.add(&format!("PRODUCT_DEFINITION('design','',#{formation},#{definition_context})"));
    let shape = data.add(&format!("PRODUCT_DEFINITION_SHAPE('','',#{definition})"));
    data.add(&format!("PRODUCT_RELATED_PRODUCT_CATEGORY('part','',(#{product}))"));
    let prefix = match unit {
        CadUnit::Metre => "$",
        CadUnit::Millimetre => ".MILLI.",
    };
    let length = data.add(&format!("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT({prefix},.METRE.))"));
    let angle = data.add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))");
    let solid_angle = data.add("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())");
    let uncertainty = data.add(&format!(
        "UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE({}),#{length},'distance_accuracy_value','')",
        real(1e-9 * unit.in_a_metre())
    ));
    let space = data.add(&format!(
        "(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#{uncertainty}))\
         GLOBAL_UNIT_ASSIGNED_CONTEXT((#{length},#{angle},#{solid_angle}))REPRESENTATION_CONTEXT('',''))"
    ));
    let origin = data.point([0.0; 3]);
    let up = data.add("DIRECTION('',(0.,0.,1.))");
    let forward = data.add("DIRECTION('',(1.,0.,0.))");
    let axes = data.add(&format!("AXIS2_PLACEMENT_3D('',#{origin},#{up},#{forward})"));
    let vertices: Vec<usize> = solid
        .vertices
        .iter()
        .map(|&vertex| {
            let point = data.point(vertex);
            data.add(&format!("VERTEX_POINT('',#{point})"))
        })
        .collect();
    let edges: Vec<usize> = solid
        .edges
        .iter()
        .map(|edge| {
            let curve = data.curve(&edge.curve);
            data.add(&format!("EDGE_CURVE('',#{},#{},#{curve},.T.)", vertices[edge.from], vertices[edge.to]))
        })
        .collect();
    let mut faces = Vec::new();
    for face in &solid.faces {
        let surface = data.surface(&face.surface, &face.name);
        let list: Vec<usize> = face
            .boundary
            .iter()
            .map(|&(edge, along)| {
                let sense = if along { ".T." } else { ".F." };
                data.add(&format!("ORIENTED_EDGE('',*,*,#{},{sense})", edges[edge]))
            })
            .collect();
        let edge_loop = data.add(&format!("EDGE_LOOP('',{})", references(&list)));
        let bound = data.add(&format!("FACE_OUTER_BOUND('',#{edge_loop},.T.)"));
        faces.push(data.add(&format!("ADVANCED_FACE('{}',(#{bound}),#{surface},.T.)", face.name)));
    }
    let shell = data.add(&format!("CLOSED_SHELL('',{})", references(&faces)));
    let body = data.add(&format!("MANIFOLD_SOLID_BREP('{name}',#{shell})"));
    let representation = data.add(&format!("ADVANCED_BREP_SHAPE_REPRESENTATION('{name}',(#{axes},#{body}),#{space})"));
    data.add(&format!("SHAPE_DEFINITION_REPRESENTATION(#{shape},#{representation})"));
    let mut styled = Vec::new();
    for (face, instance) in solid.faces.iter().zip(&faces) {
        let [red, green, blue] = colour(face.region).map(real);
        let rgb = data.add(&format!("COLOUR_RGB('',{red},{green},{blue})"));
        let fill = data.add(&format!("FILL_AREA_STYLE_COLOUR('',#{rgb})"));
        let area = data.add(&format!("FILL_AREA_STYLE('',(#{fill}))"));
        let style = data.add(&format!("SURFACE_STYLE_FILL_AREA(#{area})"));
        let side = data.add(&format!("SURFACE_SIDE_STYLE('',(#{style}))"));
        let usage = data.add(&format!("SURFACE_STYLE_USAGE(.BOTH.,#{side})"));
        let assignment = data.add(&format!("PRESENTATION_STYLE_ASSIGNMENT((#{usage}))"));
        styled.push(data.add(&format!("STYLED_ITEM('',(#{assignment}),#{instance})")));
    }
    data.add(&format!("MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',{},#{space})", references(&styled)));
    format!(
        "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('hull as a closed solid, x forward, y to port, z up'),'2;1');\n\
         FILE_NAME('{name}','1970-01-01T00:00:00',(''),(''),'loftsman {}','loftsman','');\n\
         FILE_SCHEMA(('AUTOMOTIVE_DESIGN {{ 1 0 10303 214 1 1 1 1 }}'));\nENDSEC;\nDATA;\n{}ENDSEC;\nEND-ISO-10303-21;\n",
        env!("CARGO_PKG_VERSION"),
        data.text
    )
}
