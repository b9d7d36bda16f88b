//! `modelDescription.xml`: what an importer reads before it loads the library.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use grouser::document::Kind;
use grouser::document::unit::ONE;
use grouser::simulation::OutcomeKind;

use crate::drive::Drive;
use crate::functions::CATEGORY;
use crate::model::FmuModel;
use crate::units::{BASE, in_base};
use crate::variables::{Role, UNDER_WAY, Variable, number_of};

/// The name of the library in an FMU, without what its system puts at the end.
pub const IDENTIFIER: &str = "grouser";

/// The type of the outcome.
const OUTCOME: &str = "Outcome";

/// The description of a model.
///
/// * `token`: which belongs to its document
pub(crate) fn description(model: &FmuModel, token: &str) -> String {
    let scenario = model.nominal();
    let name = escaped(model.document().name());
    let source = match escaped(model.document().source()) {
        source if source.is_empty() => source,
        source => format!(" description=\"{source}\""),
    };
    let version = env!("CARGO_PKG_VERSION");
    let is_mission = model.kind() == Kind::Mission;
    let numerics = &scenario.numerics;
    // A mission is seen at its records.
    let fixed = if is_mission {
        format!(" fixedInternalStepSize=\"{:?}\"", numerics.sample_interval)
    } else {
        String::new()
    };
    let stop =
        if is_mission { String::new() } else { format!(" stopTime=\"{:?}\"", scenario.duration) };
    let mut xml = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <fmiModelDescription fmiVersion=\"3.0\" modelName=\"{name}\" instantiationToken=\"{token}\"\
         {source} license=\"MIT OR Apache-2.0\" generationTool=\"Grouser {version}\" \
         variableNamingConvention=\"flat\">\n  \
         <CoSimulation modelIdentifier=\"{IDENTIFIER}\" canGetAndSetFMUState=\"true\" \
         canSerializeFMUState=\"true\" canHandleVariableCommunicationStepSize=\"true\"{fixed}/>\n"
    );
    write_units(&mut xml, &model.variables);
    write_outcomes(&mut xml);
    let category = CATEGORY.to_string_lossy();
    // Writing to a string does not fail.
    let _ = write!(
        xml,
        "  <LogCategories>\n    <Category name=\"{category}\" \
         description=\"Why a call did not do what it says\"/>\n  </LogCategories>\n  \
         <DefaultExperiment startTime=\"0\"{stop} stepSize=\"{:?}\"/>\n  <ModelVariables>\n",
        numerics.sample_interval
    );
    for (reference, variable) in model.variables.iter().enumerate() {
        write_variable(&mut xml, model, reference, variable);
    }
    xml += "  </ModelVariables>\n  <ModelStructure>\n";
    for element in ["Output", "InitialUnknown"] {
        for (reference, _) in
            model.variables.iter().enumerate().filter(|(_, variable)| is_output(variable))
        {
            let _ = writeln!(xml, "    <{element} valueReference=\"{reference}\"/>");
        }
    }
    xml += "  </ModelStructure>\n</fmiModelDescription>\n";
    xml
}

fn is_output(variable: &Variable) -> bool {
    variable.causality() == "output"
}

fn write_units(xml: &mut String, variables: &[Variable]) {
    let units: BTreeMap<&str, _> = variables.iter().map(|it| (it.unit.symbol, it.unit)).collect();
    *xml += "  <UnitDefinitions>\n";
    for (symbol, unit) in units.into_iter().filter(|(symbol, _)| *symbol != ONE.symbol) {
        let Some(base) = in_base(unit) else { continue };
        let exponents = BASE.iter().zip(base.exponents).filter(|(_, exponent)| *exponent != 0);
        let exponents: String =
            exponents.map(|(name, exponent)| format!(" {name}=\"{exponent}\"")).collect();
        let scale = |name: &str, value: f64, usual: f64| {
            if value == usual { String::new() } else { format!(" {name}=\"{value:?}\"") }
        };
        let (factor, offset) =
            (scale("factor", base.factor, 1.0), scale("offset", base.offset, 0.0));
        let _ = writeln!(
            xml,
            "    <Unit name=\"{symbol}\"><BaseUnit{exponents}{factor}{offset}/></Unit>"
        );
    }
    *xml += "  </UnitDefinitions>\n";
}

fn write_outcomes(xml: &mut String) {
    let _ = write!(
        xml,
        "  <TypeDefinitions>\n    <EnumerationType name=\"{OUTCOME}\">\n      \
         <Item name=\"under_way\" value=\"{UNDER_WAY}\" description=\"The rover is under way\"/>\n"
    );
    for kind in OutcomeKind::ALL {
        let (name, value) = (kind.name(), number_of(kind));
        let meaning = escaped(kind.row().meaning);
        let _ = writeln!(
            xml,
            "      <Item name=\"{name}\" value=\"{value}\" description=\"{meaning}\"/>"
        );
    }
    *xml += "    </EnumerationType>\n  </TypeDefinitions>\n";
}

fn write_variable(xml: &mut String, model: &FmuModel, reference: usize, variable: &Variable) {
    let (name, sentence) = (escaped(&variable.name), escaped(&variable.sentence));
    let start = model.start_of(variable).map_or(String::new(), |it| format!(" start=\"{it:?}\""));
    let unit = match variable.unit.symbol {
        symbol if symbol == ONE.symbol => String::new(),
        symbol => format!(" unit=\"{symbol}\""),
    };
    let causality = variable.causality();
    let (element, variability) = match variable.role {
        Role::Time | Role::Input { .. } | Role::ResultOf(_) => ("Float64", "continuous"),
        Role::Parameter { .. } => ("Float64", "fixed"),
        Role::Outcome => ("Enumeration", "discrete"),
        Role::Reason => ("String", "discrete"),
        Role::Leg => ("Int64", "discrete"),
    };
    let range = match variable.role {
        Role::Parameter { place } => {
            let range = &model.parameters[place].range;
            let end = |name: &str, end: f64| {
                if end.is_finite() { format!(" {name}=\"{end:?}\"") } else { String::new() }
            };
            end("min", *range.start()) + &end("max", *range.end())
        }
        _ => String::new(),
    };
    let type_ = match variable.role {
        Role::Outcome => format!(" declaredType=\"{OUTCOME}\""),
        _ => String::new(),
    };
    let _ = writeln!(
        xml,
        "    <{element} name=\"{name}\" valueReference=\"{reference}\" causality=\"{causality}\" \
         variability=\"{variability}\"{type_}{unit}{range}{start} description=\"{sentence}\"/>"
    );
}

/// A page about the model, for readers.
pub(crate) fn page(model: &FmuModel) -> String {
    let name = escaped(model.document().name());
    let turned = match model.drive {
        Drive::Inputs => {
            "The inputs are the speeds that are commanded of the wheels. They begin at the \
             document's; each holds over a step."
        }
        Drive::Document => "The document turns the wheels: there are no inputs.",
    };
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\"><title>{name}</title>\
         </head>\n<body>\n<h1>{name}</h1>\n<p>A rover on loose soil, by Grouser {}. {turned} \
         Parameters are numbers of the document in <code>resources</code>, and are set before the \
         initialization ends. Where a rover has just tipped over or sunk, results of its wheels are \
         NaN.</p>\n<table>\n<tr><th>variable</th><th>unit</th><th>is</th><th></th></tr>\n",
        env!("CARGO_PKG_VERSION")
    );
    for variable in &model.variables {
        let role = variable.causality();
        let _ = writeln!(
            page,
            "<tr><td>{}</td><td>{}</td><td>{role}</td><td>{}</td></tr>",
            escaped(&variable.name),
            escaped(variable.unit.symbol),
            escaped(&variable.sentence)
        );
    }
    page + "</table>\n</body>\n</html>\n"
}

/// A text within an attribute or an element, without line breaks.
fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for letter in text.chars() {
        match letter {
            '&' => escaped += "&amp;",
            '<' => escaped += "&lt;",
            '>' => escaped += "&gt;",
            '"' => escaped += "&quot;",
            letter if letter.is_control() => escaped.push(' '),
            letter => escaped.push(letter),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_of_documents_cannot_leave_their_attribute() {
        assert_eq!(escaped("a \"b\" <c> & d\ne"), "a &quot;b&quot; &lt;c&gt; &amp; d e");
    }
}
