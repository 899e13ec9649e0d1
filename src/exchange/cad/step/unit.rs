//! The unit of length of a STEP file: that of the contexts of its shapes.

use std::collections::{BTreeMap, BTreeSet};

use super::super::super::fault::Faults;
use super::read::{Instance, Value};

/// Prefixes of the metre, and none.
const PREFIXES: [(&str, f64); 8] = [
    ("", 1.0),
    (".MICRO.", 1e-6),
    (".MILLI.", 1e-3),
    (".CENTI.", 1e-2),
    (".DECI.", 1e-1),
    (".DECA.", 1e1),
    (".HECTO.", 1e2),
    (".KILO.", 1e3),
];

/// Units that are made of others, one of the other.
const CHAIN: usize = 8;

type Instances = BTreeMap<u64, Instance>;

/// Metres in the length unit of the shapes of a file; none where it states none, or with a fault: one that is not known, or
/// shapes in several.
pub(super) fn of(instances: &Instances, faults: &mut Faults) -> Option<f64> {
    let used = of_shapes(instances);
    let numbers: Vec<u64> = if used.is_empty() { stated(instances) } else { used.into_iter().collect() };
    let mut found: Vec<f64> = Vec::new();
    for number in numbers {
        let instance = instances.get(&number)?;
        let Some(metres) = metres(instances, number, 0) else {
            faults.add(Some(instance.line), &format!("#{number}"), "not a unit of length that is known".to_owned());
            return None;
        };
        if !found.iter().any(|known| (known - metres).abs() <= 1e-9 * known) {
            found.push(metres);
        }
    }
    if found.len() > 1 {
        let list: Vec<String> = found.iter().map(|metres| format!("{metres} m")).collect();
        faults.add(None, &list.join(", "), "shapes in several units of length; expected one".to_owned());
        return None;
    }
    found.first().copied()
}

/// The units of length of the contexts of representations that hold more than placements.
fn of_shapes(instances: &Instances) -> BTreeSet<u64> {
    let is_placement = |number: &u64| {
        instances.get(number).is_none_or(|instance| {
            let kind = instance.kind();
            kind.starts_with("AXIS2_PLACEMENT") || kind == "MAPPED_ITEM"
        })
    };
    let contexts = instances.values().filter_map(|instance| {
        let (_, values) = instance.parts.iter().find(|(name, _)| name.ends_with("SHAPE_REPRESENTATION"))?;
        let [.., Value::List(items), Value::Reference(context)] = values.as_slice() else { return None };
        let holds = items.iter().any(|item| matches!(item, Value::Reference(number) if !is_placement(number)));
        holds.then_some(*context)
    });
    let units = contexts.filter_map(|context| instances.get(&context)?.part("GLOBAL_UNIT_ASSIGNED_CONTEXT"));
    let references = units.flatten().filter_map(|value| if let Value::List(list) = value { Some(list) } else { None });
    let is_length = |number: &u64| instances.get(number).is_some_and(|unit| unit.part("LENGTH_UNIT").is_some());
    references
        .flatten()
        .filter_map(|value| if let Value::Reference(number) = value { Some(*number) } else { None })
        .filter(is_length)
        .collect()
}

/// The unit of length of a file without contexts: one that is made of another is the one that is used.
fn stated(instances: &Instances) -> Vec<u64> {
    let lengths = || instances.iter().filter(|(_, i)| i.part("LENGTH_UNIT").is_some());
    let converted = lengths().find(|(_, i)| i.part("CONVERSION_BASED_UNIT").is_some());
    converted.or_else(|| lengths().next()).map(|(number, _)| *number).into_iter().collect()
}

/// Metres in a unit; one that is made of another has a measure that is typed, or a number alone.
fn metres(instances: &Instances, number: u64, depth: usize) -> Option<f64> {
    let instance = instances.get(&number).filter(|_| depth < CHAIN)?;
    let Some(part) = instance.part("CONVERSION_BASED_UNIT") else {
        let Some(Value::Word(prefix)) = instance.part("SI_UNIT")?.first() else { return None };
        return PREFIXES.iter().find(|(name, _)| name == prefix).map(|(_, metres)| *metres);
    };
    let [_, Value::Reference(measure)] = part else { return None };
    let [value, Value::Reference(of)] = instances.get(measure)?.part("LENGTH_MEASURE_WITH_UNIT")? else { return None };
    let number = match value {
        Value::Typed(list) => list.first()?,
        number => number,
    };
    let Value::Number(number) = number else { return None };
    Some(number * metres(instances, *of, depth + 1)?)
}
