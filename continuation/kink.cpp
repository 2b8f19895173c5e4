#include <arcslip/continuation/monitor.hpp>

namespace arcslip::continuation {

Monitor kink_monitor() {
  Monitor monitor;
  monitor.name = "kink";
  monitor.value = [](const Accepted&) { return 1.0; };
  monitor.kind = MonitorKind::kink;
  return monitor;
}

}  // namespace arcslip::continuation
