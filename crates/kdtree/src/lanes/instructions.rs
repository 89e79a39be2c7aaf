//! Which instructions a tree's queries use.
#![allow(unsafe_code)] // Calls code compiled for instructions that were asked for first.

use super::{Lanes, portable::Portable};

/// A set of vector instructions. Answers are the same bits with each; speed is not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Instructions {
    /// Those that every processor of the target has.
    Portable,
    /// AVX2 with bit manipulation, on x86-64.
    Avx2,
    /// AVX-512 (F, BW, DQ, VL) with bit manipulation, on x86-64.
    Avx512,
}

impl Instructions {
    /// The widest set that this processor has.
    pub fn widest() -> Self {
        [Self::Avx512, Self::Avx2].into_iter().find(|set| set.is_available()).unwrap_or(Self::Portable)
    }

    /// Whether this processor has the set.
    pub fn is_available(self) -> bool {
        match self {
            Self::Portable => true,
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => {
                is_x86_feature_detected!("avx2")
                    && is_x86_feature_detected!("bmi1")
                    && is_x86_feature_detected!("bmi2")
                    && is_x86_feature_detected!("popcnt")
                    && is_x86_feature_detected!("lzcnt")
            }
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => {
                Self::Avx2.is_available()
                    && is_x86_feature_detected!("avx512f")
                    && is_x86_feature_detected!("avx512bw")
                    && is_x86_feature_detected!("avx512dq")
                    && is_x86_feature_detected!("avx512vl")
            }
            #[cfg(not(target_arch = "x86_64"))]
            _ => false,
        }
    }
}

/// Work written once for all lanes. `run` is to be `#[inline(always)]`, so that it is compiled for each set.
pub(crate) trait Task {
    type Output;
    fn run<L: Lanes>(self) -> Self::Output;
}

/// Runs a task with the instructions of a tree, which holds only sets that are available.
#[inline]
pub(crate) fn dispatch<T: Task>(instructions: Instructions, task: T) -> T::Output {
    debug_assert!(instructions.is_available());
    match instructions {
        // SAFETY: a tree is given a set only after `is_available` said yes to every feature named below.
        #[cfg(target_arch = "x86_64")]
        Instructions::Avx512 => unsafe { run_avx512(task) },
        #[cfg(target_arch = "x86_64")]
        Instructions::Avx2 => unsafe { run_avx2(task) },
        _ => task.run::<Portable>(),
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512bw,avx512dq,avx512vl,avx2,bmi1,bmi2,popcnt,lzcnt")]
fn run_avx512<T: Task>(task: T) -> T::Output {
    task.run::<super::avx512::Avx512>()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,bmi1,bmi2,popcnt,lzcnt")]
fn run_avx2<T: Task>(task: T) -> T::Output {
    task.run::<super::avx2::Avx2>()
}
