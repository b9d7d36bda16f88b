//! The claims of the library, tested from outside.

mod attitude_map;
mod calibration;
mod campaign;
mod campaign_documents;
mod card;
mod documents;
mod extended;
mod files;
mod floors;
mod given;
mod kernel;
mod laws;
mod measured;
mod measurements;
mod million;
mod paper;
mod reference;
mod rft;
mod rover;
mod runs;
mod simulated;
mod stepping;
mod time_step;
mod uncertain_documents;
mod uncertainty;
mod units;
