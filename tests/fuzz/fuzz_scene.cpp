// libFuzzer's entries: see README.md.

#include "fuzz/examine.hpp"
#include "fuzz/mutation.hpp"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::Findings findings = fuzz::examine(std::string(reinterpret_cast<const char*>(data), size));
  for (const std::string& fault : findings.faults) std::fprintf(stderr, "FAULT: %s\n", fault.c_str());
  if (!findings.faults.empty()) std::abort();
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned int seed) {
  if (seed % 20 == 0) return LLVMFuzzerMutate(data, size, most);  // bytes, as libFuzzer likes it
  const std::string mutant = fuzz::mutate(std::string(reinterpret_cast<const char*>(data), size), seed, most);
  std::memcpy(data, mutant.data(), mutant.size());
  return mutant.size();
}
