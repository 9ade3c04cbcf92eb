//! Vector code chosen at run time.

/// A loop over lanes that is worth compiling twice: for the baseline CPU, and for AVX2.
///
/// Both give the same bits: lanes do the same IEEE operations in the same order, and the compiler
/// never fuses a multiplication with an addition on its own.
pub trait Kernel {
    /// The loop. Mark implementations `#[inline(always)]`, so that it is compiled within
    /// [`vectorised`]'s two callers.
    fn run(self);
}

/// Runs a kernel with AVX2 where the CPU has it.
#[inline]
pub fn vectorised(kernel: impl Kernel) {
    #[cfg(target_arch = "x86_64")]
    {
        #[target_feature(enable = "avx2")]
        fn with_avx2(kernel: impl Kernel) {
            kernel.run();
        }
        if std::arch::is_x86_feature_detected!("avx2") {
            // SAFETY: the CPU has AVX2, as was just asked.
            #[expect(unsafe_code, reason = "a CPU feature was asked for before its use")]
            return unsafe { with_avx2(kernel) };
        }
    }
    kernel.run();
}
