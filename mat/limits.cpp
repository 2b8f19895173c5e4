#include "limits.hpp"

#include <arcslip/scene/files/mat_protocol.hpp>

#include <algorithm>
#include <csignal>

#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

namespace arcslip::mat {
namespace {

constexpr rlim_t least_memory = rlim_t{128} << 20;  // bytes of addresses: four times what the libraries take
// Copies of the data: as they are unpacked a chunk at a time, and as they are kept.
constexpr rlim_t copies = 4;
constexpr rlim_t least_time = 10;          // s of the processor
constexpr rlim_t bytes_in_time = 100'000;  // of the file in a second, far less than it takes

void limit(decltype(RLIMIT_AS) resource, rlim_t value) {
  rlimit now{};
  if (::getrlimit(resource, &now) != 0) return;
  now.rlim_cur = now.rlim_max = std::min(value, now.rlim_max);
  ::setrlimit(resource, &now);
}

}  // namespace

void limit_resources(std::size_t file) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // nobody reads the answer
  ::closefrom(STDERR_FILENO + 1);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, 0);
  limit(RLIMIT_NOFILE, STDERR_FILENO + 2);
  limit(RLIMIT_CPU, least_time + file / bytes_in_time);
  limit(RLIMIT_AS, least_memory + copies * scene::mat_protocol::most_compressed * file);
}

}  // namespace arcslip::mat
