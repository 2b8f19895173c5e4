#include <arcslip/results/version.hpp>

namespace arcslip::results {

std::string_view version() {
  return ARCSLIP_VERSION;
}

}  // namespace arcslip::results
