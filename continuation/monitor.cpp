#include <arcslip/continuation/monitor.hpp>

#include <utility>

namespace arcslip::continuation {
namespace {

Monitor monitor_of(MonitorKind kind, const char* name) {
  Monitor monitor;
  monitor.name = name;
  monitor.value = [](const Accepted&) { return 1.0; };
  monitor.kind = kind;
  return monitor;
}

}  // namespace

Monitor bound_monitor(std::string name, int index, double value) {
  Monitor monitor;
  monitor.name = std::move(name);
  monitor.value = [=](const Accepted& now) { return now.u[index] - value; };
  monitor.terminal = true;
  return monitor;
}

Monitor branch_point_monitor() {
  return monitor_of(MonitorKind::branch_point, "branch_point");
}

Monitor kink_monitor() {
  return monitor_of(MonitorKind::kink, "kink");
}

}  // namespace arcslip::continuation
