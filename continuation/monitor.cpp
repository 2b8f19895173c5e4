#include <arcslip/continuation/monitor.hpp>

#include <arcslip/continuation/monitor_calls.hpp>
#include <arcslip/continuation/text.hpp>

#include <stdexcept>
#include <string>
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

MonitorFailure::MonitorFailure(const std::string& monitor, double at, const std::string& what)
    : std::runtime_error("the monitor \"" + monitor + "\" threw at " + text(at) + because(what)),
      parameter(at) {}

Monitor bound_monitor(std::string name, int index, double value) {
  Monitor monitor;
  monitor.name = std::move(name);
  monitor.value = [=](const Accepted& now) {
    if (index < 0 || index >= now.u.size())
      throw std::out_of_range("there is no unknown " + std::to_string(index) + " among " +
                              std::to_string(now.u.size()));
    return now.u[index] - value;
  };
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
