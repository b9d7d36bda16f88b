//! The header says what the library has.

use std::path::Path;

/// `GROUSER_WRITE_HEADER=1 cargo test -p grouser-c --test it header` writes it.
#[test]
fn the_header_is_made_of_the_functions() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let config = cbindgen::Config::from_file(folder.join("cbindgen.toml")).expect("its settings");
    let bindings = cbindgen::Builder::new().with_crate(folder).with_config(config).generate();
    let mut made = Vec::new();
    bindings.expect("the sources are Rust").write(&mut made);
    let path = folder.join("include/grouser.h");
    if std::env::var_os("GROUSER_WRITE_HEADER").is_some() {
        std::fs::write(&path, &made).expect("the header can be written");
    }
    let kept = std::fs::read(&path).unwrap_or_default();
    let hint = "write it with GROUSER_WRITE_HEADER=1 cargo test -p grouser-c --test it header";
    assert!(made == kept, "include/grouser.h is not what the sources have; {hint}");
}
