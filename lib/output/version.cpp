#include <arcslip/output/version.hpp>

namespace arcslip::output {

std::string_view version() {
  return ARCSLIP_VERSION;
}

}  // namespace arcslip::output
