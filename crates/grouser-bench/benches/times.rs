//! Times of the units of work, for people: `cargo bench`.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use grouser_bench::{Fixtures, Unit};

fn times(criterion: &mut Criterion) {
    let fixtures = Fixtures::new().expect("the presets can be read");
    let mut group = criterion.benchmark_group("grouser");
    group.sample_size(20);
    for unit in Unit::ALL {
        group.throughput(Throughput::Elements(fixtures.work(unit).count as u64));
        group.bench_function(unit.key(), |bencher| {
            bencher.iter(|| black_box(fixtures.work(unit).checksum));
        });
    }
    group.finish();
}

criterion_group!(benches, times);
criterion_main!(benches);
