//! Whatever is typed, the program ends with one of its exit codes: never a panic, never a signal.

use crate::program::Place;

/// Command lines to begin with: quick ones, of every command.
const LINES: [&str; 12] = [
    "wheel-test --soil toyoura --wheel hakuto --load-n 17 --slip-ratio 0:0.9:0.3 --format json",
    "wheel-test --slip-ratio -1:1:0.5 --slip-angle-deg -90,15 --gravity-m-s2 moon --model bekker",
    "wheel-test --soil sand.toml --set soil.cohesion_kpa=0.5 --set wheel.radius_m=0.1",
    "attitude --slope-deg 5,25 --rover hakuto --load-transfer quasi-static-torque --format csv",
    "attitude moon-10-deg --slope-deg 10 --wheel-moments included --set rover.body.mass_kg=6",
    "traverse --slope-deg 10 --yaw-deg -5.5 --duration-s 0.5 --format json",
    "traverse spot-turn --duration-s 0.5 --rim-speed-m-s -0.06,-0.06,0.06,0.06 --start rest",
    "traverse --drive eq18 --reference-slip-ratio 0.2 --duration-s 0.5 --out results --force",
    "presets toyoura --kind soil",
    "presets --format csv",
    "schema rover",
    "check sand.toml",
];

/// Words that are likely to be wrong where they come.
const WORDS: [&str; 44] = [
    "",
    "-",
    "--",
    "-1",
    "0",
    "1e400",
    "-1e-400",
    "nan",
    "-inf",
    "1e308",
    "9223372036854775808",
    "0.1.2",
    "0:1:0.1",
    "1:0:0.1",
    "::",
    ",",
    "5,5,5",
    "[",
    "{",
    "\"",
    "'",
    "a=b",
    "soil.",
    ".soil=1",
    "soil.n=1=2",
    "soil.pressure_sinkage={}",
    "rover.mount=[]",
    "wheel.grousers=0",
    "scenario.drive={law=\"eq18\"}",
    "soil.shear.law=isotropic",
    "--set",
    "--format",
    "--force",
    "--help",
    "--out",
    "./",
    "sand.toml",
    "toyoura",
    "hakuto",
    "traverse",
    "\u{1f6de}",
    "\u{202e}x",
    "a b",
    "x\ny",
];

/// A generator of numbers: Knuth's linear congruence, its high bits.
struct Dice(u64);

impl Dice {
    fn below(&mut self, count: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(self.0 >> 33).expect("31 bits") % count
    }
}

/// One change at one place: a word left out, put in, doubled, swapped, or changed within.
fn scramble(words: &mut Vec<String>, dice: &mut Dice) {
    // What comes after the command is where there is more to go wrong.
    let at = dice.below(words.len()).max(dice.below(words.len()));
    let word = WORDS[dice.below(WORDS.len())].to_owned();
    match dice.below(14) {
        0 if words.len() > 1 => drop(words.remove(at)),
        1 => words.insert(at, word),
        2 => words.insert(at, words[at].clone()),
        3 => {
            let other = dice.below(words.len());
            words.swap(at, other);
        }
        4 | 5 => words[at] = word,
        kind => {
            let mut letters: Vec<char> = words[at].chars().collect();
            if letters.is_empty() || (words[at].starts_with("--") && kind > 7) {
                return;
            }
            let place = dice.below(letters.len());
            if kind < 9 {
                letters.remove(place);
            } else {
                letters[place] = ['-', '.', '9', '0', '1', '5', ',', 'e', 'µ'][dice.below(9)];
            }
            words[at] = letters.into_iter().collect();
        }
    }
}

#[test]
fn scrambled_command_lines_end_with_an_exit_code_of_ours() {
    let place = Place::new();
    place.write("sand.toml", place.results("presets toyoura"));
    let mut dice = Dice(2026);
    let mut codes = [0; 3];
    for round in 0..400 {
        let mut words: Vec<String> =
            LINES[round % LINES.len()].split(' ').map(str::to_owned).collect();
        for _ in 0..=dice.below(3) / 2 {
            scramble(&mut words, &mut dice);
        }
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        let answer = place.run(&words);
        match usize::try_from(answer.code()) {
            Ok(code @ 0..=2) => codes[code] += 1,
            _ => panic!("{words:?} ended with {}: {}", answer.status, answer.stderr),
        }
        assert_eq!(answer.code() == 2, answer.stderr.contains("error: "), "{words:?}");
    }
    // Some must be understood and some not, or the lines are scrambled too little or too much.
    assert!(codes[0] > 40 && codes[2] > 100, "{codes:?}");
}
