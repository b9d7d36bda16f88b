//! `card`: the operator's card as PDF, which the program draws that serves the console.

use grouser::document::json;
use grouser_draw::base64;
use http::StatusCode;
use serde_json::json;

use super::fields::AskedFields;
use super::parts::ScenarioParts;
use super::rule;
use crate::asked::Question;
use crate::cards::CardOrder;
use crate::console::Console;
use crate::progress::Progress;
use crate::refusal::Refusal;

pub(super) fn read(console: &Console, body: &[u8]) -> Result<Question, Refusal> {
    let fields = AskedFields::of(body)?;
    let parts = ScenarioParts::of(&fields)?;
    let rule = rule::of(&fields)?;
    fields.finish()?;
    let Some(make) = console.card else {
        let message = "this server draws no cards";
        return Err(Refusal::new(StatusCode::NOT_IMPLEMENTED, message)
            .with_hint("`grouser card` does, and so does a console of `grouser serve`"));
    };
    if parts.common().has_every_model() {
        let message = "a card is of one model, or of what is believed of all: name one, or leave it \
                       out";
        return Err(Refusal::of_key("model", message));
    }
    let scenario = parts.scenarios(&console.folder, true)?.into_iter().next();
    let order = scenario.map(|scenario| CardOrder { scenario, rule });
    let unknown = || Refusal::new(StatusCode::INTERNAL_SERVER_ERROR, "there is no model");
    let order = order.ok_or_else(unknown)?;
    Ok(Question::new(move |go_on, send| {
        let go_on = go_on.of_study();
        let turn = go_on.turn().ok_or_else(Refusal::stopped)?;
        let progress = Progress::new(send, "samples", 0, None);
        let made = make(order, &|| {
            progress.count();
            go_on.is_on()
        });
        drop(turn);
        let failed = |why| Refusal::new(StatusCode::UNPROCESSABLE_ENTITY, why);
        let card = made.map_err(failed)?.ok_or_else(Refusal::stopped)?;
        send(json::line(&json!({
            "schema": "grouser.card-file.v1",
            "name": "card.pdf",
            "pdf": base64(&card),
        })));
        Ok(())
    }))
}
