//! What mends a verdict that cannot tell.

use std::collections::BTreeSet;

use grouser::answers::{Answer, Member};
use grouser::document::columns::verdict::REASON;
use grouser::document::table::Table;
use grouser::studies::verdict::Reason;

/// What to do about a reason; nothing about those that are findings.
fn remedy(reason: Reason) -> Option<&'static str> {
    match reason {
        Reason::NoStatedUncertainty => Some(
            "a soil that states how well its numbers are known gives verdicts: `grouser new soil \
             --set like=PRESET --set known=copied` makes one, and `calibrate` and `learn` write \
             one that was measured",
        ),
        Reason::OutsideDomain => Some(
            "the flags say what is outside: a soil that was measured with such wheels and loads \
             gives verdicts, and `grouser forecast` says what another one supports",
        ),
        Reason::SearchGaveUp => Some("other samples may decide: --samples 400, or another --seed"),
        _ => None,
    }
}

/// A line for each reason that something can be done about.
pub(crate) fn of_reasons(reasons: impl Iterator<Item = Reason>) -> Vec<String> {
    let lines: BTreeSet<&str> = reasons.filter_map(remedy).collect();
    lines.into_iter().map(|line| format!("hint: {line}")).collect()
}

/// A line for each reason of an answer's verdicts that something can be done about.
pub(super) fn of_answer(answer: &Answer) -> Vec<String> {
    let tables = answer.results.iter().flat_map(|member| match member {
        Member::Rows(_, table) => vec![&**table],
        Member::With(_, table, _, objects) => vec![&**table, objects],
        Member::Row(_, table) => vec![table],
        Member::Value(..) | Member::Entries(_) => Vec::new(),
    });
    of_reasons(tables.flat_map(reasons))
}

fn reasons(table: &Table) -> impl Iterator<Item = Reason> {
    let names = table.texts(REASON).iter().flatten();
    names.filter_map(|name| Reason::ALL.into_iter().find(|reason| reason.name() == name))
}
