//! The operator's card: an order goes to what draws it, and the file comes back whole.

use grouser_draw::from_base64;
use grouser_serve::{CardOrder, Settings};
use serde_json::json;

use crate::served::Served;

/// What a card would be of, in the place of one.
fn words(
    CardOrder { scenario, rule }: CardOrder,
    go_on: &(dyn Fn() -> bool + Sync),
) -> Result<Option<Vec<u8>>, String> {
    let gravity = scenario.value.gravity;
    if gravity > 3.0 {
        return Err("no card of so much gravity".to_owned());
    }
    let words = format!("{gravity} {} {}", rule.go_slip_ratio, go_on());
    Ok(Some([words.as_bytes(), b"\0\xff"].concat()))
}

#[test]
fn a_card_is_drawn_of_what_is_asked_for() {
    let server = Served::start(&Settings { card: Some(words), ..Settings::default() });
    let asked = json!({
        "soil": "toyoura", "set": {"scenario.gravity_m_s2": 1.62}, "go_slip_ratio": 0.2,
    });
    let reply = server.post("card", &asked);
    assert_eq!(reply.status, 200, "{reply:?}");
    // Lines of progress come before the card.
    let lines = reply.lines();
    assert_eq!((lines.len(), &lines[0]["schema"]), (2, &json!("grouser.progress.v1")));
    let line = &lines[1];
    assert_eq!(
        (&line["schema"], &line["name"]),
        (&json!("grouser.card-file.v1"), &json!("card.pdf"))
    );
    let bytes = from_base64(line["pdf"].as_str().unwrap()).unwrap();
    assert_eq!(bytes, b"1.62 0.2 true\0\xff");
    // What is wrong is said in its words, and by its key.
    let reply = server.post("card", &json!({}));
    assert!(reply.status == 422 && reply.body.contains("so much gravity"), "{reply:?}");
    let reply = server.post("card", &json!({"model": "all"}));
    assert_eq!((reply.status, &reply.lines()[0]["key"]), (422, &json!("model")));
}

/// The page offers no button for what is not among the questions.
#[test]
fn a_server_without_cards_says_so() {
    let (with, without) = (Settings { card: Some(words), ..Settings::default() }, Served::usual());
    for (server, draws) in [(&Served::start(&with), true), (&without, false)] {
        let list = server.ask("GET", "/api/questions", "", "").lines().remove(0);
        let names: Vec<_> = list["rows"].as_array().unwrap().iter().map(|it| &it["name"]).collect();
        assert_eq!(names.contains(&&json!("card")), draws, "{list}");
        assert!(names.contains(&&json!("heading")) && names.contains(&&json!("fit")), "{list}");
    }
    let reply = without.post("card", &json!({}));
    assert_eq!(reply.status, 501, "{reply:?}");
    assert!(reply.body.contains("grouser card"), "{reply:?}");
}
