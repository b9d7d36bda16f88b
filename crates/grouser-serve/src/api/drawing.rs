//! `wheel-drawing`: a wheel in its soil, cut open, as `grouser draw` draws it.

use grouser::contact::{Contact, Ishigami, Slip, settle};
use grouser::document::columns::SLIP_ANGLE;
use grouser::document::json;
use grouser::document::study::{LOAD_N, SLIP_ANGLE_DEG};
use grouser_draw::drawings::{self, WheelInSoil};
use http::StatusCode;
use serde_json::json;

use super::fields::AskedFields;
use super::parts::StandParts;
use crate::asked::Question;
use crate::console::Console;
use crate::refusal::Refusal;

/// Lighter wheels leave no trace to draw [N]; at more skid the soil is sheared without bound.
const LOADS: std::ops::RangeInclusive<f64> = 1e-3..=*LOAD_N.end();
const SLIPS: std::ops::RangeInclusive<f64> = -0.9..=1.0;

pub(super) fn read(console: &Console, body: &[u8]) -> Result<Question, Refusal> {
    let fields = AskedFields::of(body)?;
    let load = fields.number("load_n", &LOADS)?.unwrap_or(17.0);
    let slip_ratio = fields.number("slip_ratio", &SLIPS)?.unwrap_or(0.2);
    let slip_angle = fields.number("slip_angle_deg", &SLIP_ANGLE_DEG)?.unwrap_or(0.0);
    let parts = StandParts::of(&fields, &console.folder)?;
    fields.finish()?;
    let stand = parts.stands(&console.folder, false)?.into_iter().next();
    let Some(stand) = stand else {
        return Err(Refusal::new(StatusCode::INTERNAL_SERVER_ERROR, "there is no model"));
    };
    Ok(Question::new(move |_, send| {
        let contact = Contact {
            wheel: stand.wheel.value,
            soil: stand.soil.value,
            slip: Slip::on_test_stand(slip_ratio, SLIP_ANGLE.unit.to_si(slip_angle)),
            gravity: stand.gravity,
        };
        // The stresses that are drawn are those of this model.
        let settled = settle(&Ishigami::DEFAULT, &contact, load).map_err(|problem| {
            let message = format!("the drawn wheel does not settle: {problem}");
            Refusal::of_key("load_n", message)
        })?;
        let wheel = WheelInSoil { contact: &contact, settled: &settled, load };
        let each = |drawing: &drawings::Drawing| json!({ "name": drawing.name, "caption": drawing.caption, "svg": drawing.to_svg() });
        let all: Vec<_> = drawings::of_a_wheel(&wheel).iter().map(each).collect();
        send(json::line(&json!({
            "schema": "grouser.wheel-drawing.v1",
            "model": "ishigami",
            "drawings": all,
        })));
        Ok(())
    }))
}
