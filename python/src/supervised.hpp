#pragma once
// Computations that Python waits for. They run without the interpreter's lock and in a thread of their own,
// while the thread that waits lets Python handle its signals and hands on progress. The only place that knows
// how a computation is stopped.

#include <arcslip/control/run_control.hpp>

#include <nanobind/nanobind.h>

#include <functional>
#include <optional>

namespace arcslip::python {

/// Calls work(control) and waits for it. report: called about ten times a second in this thread with the
/// latest progress, as a dict; it ends the work by returning False or by an exception; None: nothing is
/// reported. Returns the exception of a signal, as KeyboardInterrupt, or of `report` that ended the work,
/// which then may have a part of its results. Passes on what work throws by itself.
std::optional<nanobind::python_error> supervised(const nanobind::object& report,
                                                 const std::function<void(const control::Control&)>& work);

}  // namespace arcslip::python
