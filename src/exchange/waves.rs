//! What the wave resistance came to, as `derive.json` and `fairing.json` have it.

use serde_json::{Value, json};

use super::number::json_number;
use crate::resistance::{WaveResult, WaveTrade};

pub(super) fn waves_json(waves: &WaveResult) -> Value {
    let number = |value: f64| json_number(Some(value));
    let speed = |(k, froude): (usize, &f64)| {
        let of = |list: &[f64]| json_number(list.get(k).copied());
        json!({ "froude_number": number(*froude), "RW_before": of(&waves.before), "RW_after": of(&waves.after) })
    };
    let trade = |trade: &WaveTrade| {
        json!({
            "weight": number(trade.weight),
            "RW_ratio": number(trade.ratio),
            "energy": number(trade.energy),
            "moves_rms": number(trade.moves),
            "inflections": trade.inflections,
            "keeps_signs": trade.keeps_signs,
        })
    };
    json!({
        "speeds": waves.froude_numbers.iter().enumerate().map(speed).collect::<Vec<_>>(),
        "weights": waves.trades.iter().map(trade).collect::<Vec<_>>(),
        "taken": waves.taken,
    })
}
