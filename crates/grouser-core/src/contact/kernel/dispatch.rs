//! Which vector instructions the kernel runs on.

#![allow(unsafe_code, reason = "the one place: to call what the processor was asked for before")]

/// A set of vector instructions. All of them give the same bits; they differ in time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InstructionSet {
    /// What every processor of the target has (SSE2 on x86-64).
    Baseline,
    /// Four doubles at once.
    Avx2,
    /// Eight doubles at once.
    Avx512,
}

/// Work that is compiled once for each instruction set.
///
/// `run` and all that it calls have to be `#[inline(always)]`: what is not inlined is compiled for
/// [`InstructionSet::Baseline`].
pub(in crate::contact) trait Work {
    type Output;
    fn run(self) -> Self::Output;
}

impl InstructionSet {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Baseline, Self::Avx2, Self::Avx512];

    /// Its name in reports.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Baseline => "baseline",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
        }
    }

    /// Whether this processor has it.
    #[must_use]
    pub fn is_available(self) -> bool {
        match self {
            Self::Baseline => true,
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => std::arch::is_x86_feature_detected!("avx2"),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => {
                std::arch::is_x86_feature_detected!("avx512f")
                    && std::arch::is_x86_feature_detected!("avx512dq")
                    && std::arch::is_x86_feature_detected!("avx512vl")
            }
            #[cfg(not(target_arch = "x86_64"))]
            Self::Avx2 | Self::Avx512 => false,
        }
    }

    /// The fastest for many wheels that this processor has. The standard library remembers what it
    /// detected.
    #[must_use]
    pub fn best() -> Self {
        if Self::Avx512.is_available() {
            Self::Avx512
        } else if Self::Avx2.is_available() {
            Self::Avx2
        } else {
            Self::Baseline
        }
    }

    /// The fastest for the nodes of a single wheel: four doubles at once also where eight can be,
    /// since all nodes of eight at once wait for each other. Source: measured on a processor with two
    /// units of eight, where the wheels of a rover take a tenth less so.
    pub(in crate::contact) fn best_of_one_wheel() -> Self {
        let best = Self::best();
        if best == Self::Avx512 { Self::Avx2 } else { best }
    }

    /// Does multiplications and additions of doubles, none of which waits for another: what a
    /// processor does at most on this set. Returns a sum of the results, so that none is left out.
    ///
    /// * `rounds`: of [`operations_a_round`](Self::operations_a_round) each
    #[must_use]
    pub fn multiply_and_add(self, rounds: usize) -> f64 {
        if self == Self::Avx512 {
            self.run(Operations::<{ 2 * SIDE_BY_SIDE }> { rounds })
        } else {
            self.run(Operations::<SIDE_BY_SIDE> { rounds })
        }
    }

    /// Multiplications and additions in a round of [`multiply_and_add`](Self::multiply_and_add).
    #[must_use]
    pub fn operations_a_round(self) -> usize {
        if self == Self::Avx512 { 4 * SIDE_BY_SIDE } else { 2 * SIDE_BY_SIDE }
    }

    /// Does the work on this set, or on the baseline where the processor lacks it.
    #[inline]
    pub(in crate::contact) fn run<W: Work>(self, work: W) -> W::Output {
        #[cfg(target_arch = "x86_64")]
        {
            if self == Self::Avx512 && self.is_available() {
                // SAFETY: the processor has just been asked for these instructions.
                return unsafe { on_avx512(work) };
            }
            if self == Self::Avx2 && self.is_available() {
                // SAFETY: as above.
                return unsafe { on_avx2(work) };
            }
        }
        work.run()
    }
}

/// Number of doubles that keep a processor busy through the latency of its operations and stay in
/// its registers, with vectors of four; with vectors of eight, twice as many. (Of 48 the compiler
/// makes no vectors.)
const SIDE_BY_SIDE: usize = 56;

struct Operations<const SIDE_BY_SIDE: usize> {
    rounds: usize,
}

impl<const SIDE_BY_SIDE: usize> Work for Operations<SIDE_BY_SIDE> {
    type Output = f64;

    #[expect(clippy::inline_always, reason = "it is compiled once for each instruction set")]
    #[inline(always)]
    fn run(self) -> f64 {
        // Each starts elsewhere: of equal ones a compiler computes one.
        let mut numbers: [f64; SIDE_BY_SIDE] = std::array::from_fn(|place| place as f64);
        for _ in 0..self.rounds {
            for number in &mut numbers {
                // It stays near 2.
                *number = *number * 0.5 + 1.0;
            }
        }
        numbers.iter().sum()
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl")]
fn on_avx512<W: Work>(work: W) -> W::Output {
    work.run()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn on_avx2<W: Work>(work: W) -> W::Output {
    work.run()
}
