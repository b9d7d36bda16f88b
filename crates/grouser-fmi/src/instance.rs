//! An instance: its phase, the values that an importer set, and the rover on its way.

use std::ffi::CString;
use std::sync::Arc;

use grouser::simulation::LEAST_STEP;
use grouser::simulation::scenario::LONGEST_DURATION;

use crate::model::FmuModel;
use crate::motion::RoverMotion;
use crate::variables::{Role, Variable};

/// What FMI lets an importer do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Phase {
    Instantiated,
    Initialization,
    Step,
    Terminated,
}

const PHASES: [Phase; 4] =
    [Phase::Instantiated, Phase::Initialization, Phase::Step, Phase::Terminated];

/// All that changes in an instance.
#[derive(Clone)]
pub(crate) struct InstanceState {
    phase: Phase,
    parameters: Vec<f64>,
    /// Speeds that are commanded of the wheels [rad/s].
    inputs: Vec<f64>,
    /// When the importer's time began, and where it is [s].
    start: f64,
    time: f64,
    /// None until someone asks for it, and again where a parameter changed.
    motion: Option<RoverMotion>,
}

/// A state, and the model that it belongs to.
pub(crate) struct SavedInstance {
    token: String,
    pub(crate) state: InstanceState,
}

/// An instance.
pub(crate) struct Instance {
    model: Arc<FmuModel>,
    token: String,
    state: InstanceState,
    /// The text that was last given out.
    text: CString,
}

impl Instance {
    pub(crate) fn new(model: FmuModel, token: &str) -> Self {
        let state = InstanceState {
            phase: Phase::Instantiated,
            parameters: model.usual(),
            inputs: model.starts.clone(),
            start: 0.0,
            time: 0.0,
            motion: None,
        };
        Self { model: Arc::new(model), token: token.to_owned(), state, text: CString::default() }
    }

    /// Checks that a call is made in one of the phases in which FMI allows it.
    pub(crate) fn check_phase(&self, allowed: &[Phase]) -> Result<(), String> {
        if allowed.contains(&self.state.phase) {
            return Ok(());
        }
        Err(match self.state.phase {
            Phase::Instantiated => "this is not allowed before the initialization",
            Phase::Initialization => "this is not allowed during the initialization",
            Phase::Step => "this is not allowed after the initialization",
            Phase::Terminated => "this is not allowed after the end of the simulation",
        }
        .to_owned())
    }

    pub(crate) fn enter_initialization(&mut self, start: f64) -> Result<(), String> {
        self.check_phase(&[Phase::Instantiated])?;
        if !start.is_finite() {
            return Err(format!("the start time is {start}, it must be finite"));
        }
        (self.state.start, self.state.time) = (start, start);
        self.state.phase = Phase::Initialization;
        Ok(())
    }

    pub(crate) fn exit_initialization(&mut self) -> Result<(), String> {
        self.check_phase(&[Phase::Initialization])?;
        self.motion()?;
        self.state.phase = Phase::Step;
        Ok(())
    }

    pub(crate) fn terminate(&mut self) -> Result<(), String> {
        self.check_phase(&[Phase::Step])?;
        self.state.phase = Phase::Terminated;
        Ok(())
    }

    pub(crate) fn reset(&mut self) {
        let fresh = &self.model;
        self.state = InstanceState {
            phase: Phase::Instantiated,
            parameters: fresh.usual(),
            inputs: fresh.starts.clone(),
            start: 0.0,
            time: 0.0,
            motion: None,
        };
    }

    /// A number that an importer asks for.
    pub(crate) fn number(&mut self, reference: u32) -> Result<f64, String> {
        let model = Arc::clone(&self.model);
        let variable = variable(&model, reference)?;
        match variable.role {
            Role::Time => Ok(self.state.time),
            Role::Input { wheel } => Ok(self.state.inputs[wheel]),
            Role::Parameter { place } => Ok(self.state.parameters[place]),
            Role::ResultOf(output) => {
                self.check_computed(variable)?;
                let record = self.motion()?.record();
                record.map(|record| output.number(record)).ok_or_else(|| {
                    format!("there is no record from which {} could be read", variable.name)
                })
            }
            Role::Outcome | Role::Leg => Err(wrong_type(variable, "Int64")),
            Role::Reason => Err(wrong_type(variable, "String")),
        }
    }

    /// A whole number that an importer asks for.
    pub(crate) fn whole(&mut self, reference: u32) -> Result<i64, String> {
        let model = Arc::clone(&self.model);
        let variable = variable(&model, reference)?;
        match variable.role {
            Role::Outcome => {
                self.check_computed(variable)?;
                Ok(self.motion()?.outcome().0)
            }
            Role::Leg => {
                self.check_computed(variable)?;
                Ok(self.motion()?.leg())
            }
            Role::Reason => Err(wrong_type(variable, "String")),
            _ => Err(wrong_type(variable, "Float64")),
        }
    }

    /// A text that an importer asks for; it is valid until the next one is.
    pub(crate) fn text(&mut self, reference: u32) -> Result<&CString, String> {
        let model = Arc::clone(&self.model);
        let variable = variable(&model, reference)?;
        if !matches!(variable.role, Role::Reason) {
            let whole = matches!(variable.role, Role::Outcome | Role::Leg);
            return Err(wrong_type(variable, if whole { "Int64" } else { "Float64" }));
        }
        self.check_computed(variable)?;
        let (_, reason) = self.motion()?.outcome();
        self.text = CString::new(reason.replace('\0', "")).unwrap_or_default();
        Ok(&self.text)
    }

    /// Sets numbers; nothing changes if one of them cannot be set.
    pub(crate) fn set(&mut self, references: &[u32], values: &[f64]) -> Result<(), String> {
        for (reference, value) in references.iter().zip(values) {
            self.check_set(*reference, *value)?;
        }
        for (reference, value) in references.iter().zip(values) {
            match variable(&self.model, *reference)?.role {
                Role::Input { wheel } => self.state.inputs[wheel] = *value,
                Role::Parameter { place } => {
                    self.state.parameters[place] = *value;
                    self.state.motion = None;
                }
                _ => {}
            }
        }
        Ok(())
    }

    fn check_set(&self, reference: u32, value: f64) -> Result<(), String> {
        let variable = variable(&self.model, reference)?;
        let name = &variable.name;
        match variable.role {
            Role::Input { .. } => {
                self.check_phase(&[Phase::Instantiated, Phase::Initialization, Phase::Step])?;
                if !value.is_finite() {
                    return Err(format!("{name} is {value}, it must be finite"));
                }
            }
            Role::Parameter { place } => {
                let phases = [Phase::Instantiated, Phase::Initialization];
                self.check_phase(&phases).map_err(|error| format!("{name} is set: {error}"))?;
                let range = &self.model.parameters[place].range;
                if !range.contains(&value) {
                    let (least, most) = (range.start(), range.end());
                    return Err(format!("{name} is {value}, it must be from {least} to {most}"));
                }
            }
            _ => return Err(format!("{name} is no input and no parameter: it cannot be set")),
        }
        Ok(())
    }

    /// Goes on for a step.
    ///
    /// * `from`: where the importer's time is [s]
    pub(crate) fn step(&mut self, from: f64, span: f64) -> Result<(), String> {
        self.check_phase(&[Phase::Step])?;
        /// Times of importers that differ by less are one, over the time [-]: their rounding.
        const ROUNDING: f64 = 1e-9;
        let time = self.state.time;
        let is_here = (from - time).abs() <= ROUNDING * time.abs().max(1.0);
        if !is_here {
            return Err(format!("the step begins at {from} s, and the rover is at {time} s"));
        }
        if !(LEAST_STEP..=LONGEST_DURATION).contains(&span) {
            return Err(format!("the step is {span} s long, it must be from 1e-6 to 86400"));
        }
        let InstanceState { start, inputs, .. } = &self.state;
        let (since, inputs) = ([time - start, span], inputs.clone());
        let model = Arc::clone(&self.model);
        self.motion()?.step(&model, &inputs, since)?;
        self.state.time = time + span;
        Ok(())
    }

    /// Where the importer's time is [s].
    pub(crate) fn time(&self) -> f64 {
        self.state.time
    }

    /// A copy of all that changes.
    pub(crate) fn saved(&self) -> SavedInstance {
        SavedInstance { token: self.token.clone(), state: self.state.clone() }
    }

    /// Sets all that changes.
    pub(crate) fn restore(&mut self, saved: &SavedInstance) -> Result<(), String> {
        self.check_own(&saved.token)?;
        self.state = saved.state.clone();
        Ok(())
    }

    fn check_own(&self, token: &str) -> Result<(), String> {
        if token == self.token {
            return Ok(());
        }
        Err("the state is of an instance of another FMU".to_owned())
    }

    /// The state that was made [bytes](SavedInstance::to_bytes).
    pub(crate) fn read(&self, bytes: &[u8]) -> Result<SavedInstance, String> {
        let damaged = || "the bytes are damaged, or no state of this FMU".to_owned();
        let mut reader = StateReader(bytes);
        let token = reader.bytes().and_then(|it| String::from_utf8(it).ok()).ok_or_else(damaged)?;
        self.check_own(&token)?;
        let read = (|| {
            let phase = *PHASES.get(usize::try_from(reader.number()?).ok()?)?;
            let (parameters, inputs) = (reader.numbers()?, reader.numbers()?);
            let (start, time) =
                (f64::from_bits(reader.number()?), f64::from_bits(reader.number()?));
            let motion = if reader.number()? == 1 { Some(reader.bytes()?) } else { None };
            reader.0.is_empty().then_some((phase, parameters, inputs, start, time, motion))
        })();
        let (phase, parameters, inputs, start, time, motion) = read.ok_or_else(damaged)?;
        if [parameters.len(), inputs.len()]
            != [self.model.parameters.len(), self.model.starts.len()]
        {
            return Err(damaged());
        }
        let motion = motion
            .map(|bytes| RoverMotion::restored(&self.model, &parameters, &bytes, time - start))
            .transpose()?;
        let state = InstanceState { phase, parameters, inputs, start, time, motion };
        Ok(SavedInstance { token, state })
    }

    fn motion(&mut self) -> Result<&mut RoverMotion, String> {
        let Self { model, state, .. } = self;
        let InstanceState { motion, parameters, .. } = state;
        if motion.is_none() {
            *motion = Some(RoverMotion::start(model, parameters)?);
        }
        motion.as_mut().ok_or_else(|| "there is no motion".to_owned())
    }

    fn check_computed(&self, variable: &Variable) -> Result<(), String> {
        let phases = [Phase::Initialization, Phase::Step, Phase::Terminated];
        let in_words = |error| format!("{} is computed: {error}", variable.name);
        self.check_phase(&phases).map_err(in_words)
    }
}

impl SavedInstance {
    /// The state as bytes, for files and other processes.
    pub(crate) fn to_bytes(&self) -> Vec<u8> {
        let InstanceState { phase, parameters, inputs, start, time, motion } = &self.state;
        let mut bytes = Vec::new();
        let number = |bytes: &mut Vec<u8>, number: u64| bytes.extend(number.to_le_bytes());
        let text = |bytes: &mut Vec<u8>, text: &[u8]| {
            number(bytes, text.len() as u64);
            bytes.extend(text);
        };
        text(&mut bytes, self.token.as_bytes());
        number(&mut bytes, *phase as u64);
        for numbers in [parameters, inputs] {
            number(&mut bytes, numbers.len() as u64);
            for value in numbers {
                number(&mut bytes, value.to_bits());
            }
        }
        number(&mut bytes, start.to_bits());
        number(&mut bytes, time.to_bits());
        number(&mut bytes, u64::from(motion.is_some()));
        if let Some(motion) = motion {
            text(&mut bytes, &motion.state());
        }
        bytes
    }
}

/// What is left of bytes.
struct StateReader<'b>(&'b [u8]);

impl StateReader<'_> {
    fn number(&mut self) -> Option<u64> {
        let (number, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(u64::from_le_bytes(*number))
    }

    fn numbers(&mut self) -> Option<Vec<f64>> {
        let count = self.number()?;
        (0..count).map(|_| self.number().map(f64::from_bits)).collect()
    }

    fn bytes(&mut self) -> Option<Vec<u8>> {
        let length = usize::try_from(self.number()?).ok()?;
        let (bytes, rest) = self.0.split_at_checked(length)?;
        self.0 = rest;
        Some(bytes.to_vec())
    }
}

fn variable(model: &FmuModel, reference: u32) -> Result<&Variable, String> {
    let place = usize::try_from(reference).ok();
    place.and_then(|place| model.variables.get(place)).ok_or_else(|| {
        let last = model.variables.len() - 1;
        format!("there is no variable with the reference {reference}: they go from 0 to {last}")
    })
}

fn wrong_type(variable: &Variable, type_: &str) -> String {
    format!("{} is of the type {type_}", variable.name)
}
