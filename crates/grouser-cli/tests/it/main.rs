//! The program as its users meet it: what they type, what it answers, what it leaves behind.

mod animation;
mod bad_input;
mod calibrate;
mod campaign;
mod campaign_damage;
mod card;
mod contract;
mod conversations;
mod forecast;
mod former_names;
mod hostile;
mod import;
mod logs;
mod mission;
mod models;
mod motors;
mod new;
mod program;
mod reports;
mod scrambled;
mod simulated;
mod slip_from_current;
mod terminal;
mod validate;
mod validity;
mod yaws;
