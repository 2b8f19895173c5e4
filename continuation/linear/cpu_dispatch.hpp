#pragma once
// Loops over contiguous numbers, compiled for the widest instructions of the processor at hand. The same
// operations in the same order: no digit of a result depends on the processor.

namespace arcslip::continuation {

#if defined(__x86_64__)
template <class Loops>
[[gnu::target("avx2")]] auto with_avx2(const Loops& loops) {
  return loops();
}
#endif

/// loops(), which is declared __attribute__((always_inline)), as all that it calls and that is to gain.
template <class Loops>
auto widest(const Loops& loops) {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return with_avx2(loops);
#endif
  return loops();
}

}  // namespace arcslip::continuation
