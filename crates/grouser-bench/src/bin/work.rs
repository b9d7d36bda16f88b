//! Does one unit of work and nothing else: what a counter of instructions is pointed at.
//!
//! `work set` tells the instruction set. `work KEY TIMES`; with TIMES 0 it prepares and does nothing, which is the count to subtract.

use std::hint::black_box;
use std::process::ExitCode;

use grouser::contact::InstructionSet;
use grouser_bench::{Fixtures, Unit};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if arguments == ["set"] {
        println!("{}", InstructionSet::best().name());
        return ExitCode::SUCCESS;
    }
    let unit = arguments.first().and_then(|key| Unit::ALL.into_iter().find(|it| it.key() == key));
    let times = arguments.get(1).and_then(|times| times.parse::<u32>().ok());
    let (Some(unit), Some(times)) = (unit, times) else {
        let keys: Vec<&str> = Unit::ALL.into_iter().map(Unit::key).collect();
        eprintln!("usage: work KEY TIMES\nkeys: {}", keys.join(", "));
        return ExitCode::from(2);
    };
    let Ok(fixtures) = Fixtures::new() else {
        eprintln!("the presets cannot be read");
        return ExitCode::FAILURE;
    };
    let mut count = 0;
    for _ in 0..times {
        let done = black_box(fixtures.work(unit));
        count += done.count;
    }
    println!("{count}");
    ExitCode::SUCCESS
}
