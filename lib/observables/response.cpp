#include <arcslip/observables/response.hpp>

namespace arcslip::observables {

const char* name(Status status) {
  switch (status) {
    case Status::complete:
      return "complete";
    case Status::stopped:
      return "stopped";
    case Status::failed:
      break;
  }
  return "failed";
}

}  // namespace arcslip::observables
