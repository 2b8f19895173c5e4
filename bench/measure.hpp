#pragma once
// What a benchmark costs in numbers that a busy machine changes little: the least processor time of the
// thread in which it runs, and, under callgrind, the number of instructions.
//
// valgrind --tool=callgrind --instr-atstart=no writes a profile for each count, in the order of their
// numbers.

#include <benchmark/benchmark.h>

#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#endif

#include <algorithm>
#include <ctime>
#include <limits>

namespace arcslip::bench {

/// Of this thread.
inline double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Seconds of one of so many calls.
template <class Work>
double seconds(int calls, const Work& work) {
  const double begin = processor_seconds();
  for (int k = 0; k < calls; ++k) work();
  return (processor_seconds() - begin) / calls;
}

/// How many calls take long enough for the clock.
template <class Work>
int calls_to_time(const Work& work) {
  constexpr double long_enough = 1e-4, shortest = 1e-7;  // s
  double once = seconds(1, work);
  if (once < long_enough) once = std::min(once, seconds(1, work));
  return std::max(static_cast<int>(long_enough / std::max(once, shortest)), 1);
}

inline int profiles = 0;  // written so far

/// The number of the profile with the instructions of one call; 0: not under callgrind.
template <class Work>
int profile(const Work& work) {
#ifdef CALLGRIND_DUMP_STATS
  if (RUNNING_ON_VALGRIND == 0) return 0;
  CALLGRIND_START_INSTRUMENTATION;
  CALLGRIND_ZERO_STATS;
  work();
  CALLGRIND_DUMP_STATS;
  CALLGRIND_STOP_INSTRUMENTATION;
  return ++profiles;
#else
  return 0;
#endif
}

/// The iterations of a benchmark, of so many calls. Counters: `seconds`, the least of a call, and `profile`.
template <class Work>
void measure(benchmark::State& state, const Work& work, int calls = 1) {
  double least = std::numeric_limits<double>::infinity();
  for (auto _ : state) least = std::min(least, seconds(calls, work));
  state.counters["seconds"] = {least, benchmark::Counter::kAvgThreads};
  if (const int number = profile(work)) state.counters["profile"] = number;
}

/// The least seconds of something that is done as well.
template <class Work>
double least_seconds(const Work& work) {
  constexpr int batches = 20;
  constexpr double long_enough = 0.02;  // s
  const int calls = calls_to_time(work);
  double least = std::numeric_limits<double>::infinity(), all = 0;
  for (int batch = 0; batch < batches && all < long_enough; ++batch) {
    const double once = seconds(calls, work);
    least = std::min(least, once);
    all += calls * once;
  }
  return least;
}

}  // namespace arcslip::bench
