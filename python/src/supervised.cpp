#include "supervised.hpp"

#include <arcslip/control/interruptible.hpp>

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

namespace nb = nanobind;

namespace arcslip::python {
namespace {

constexpr std::chrono::milliseconds between_polls{50};

nb::dict as_dict(const control::Progress& now) {
  nb::dict all;
  all["branch"] = now.branch;
  all["branches"] = now.branches;
  all["points"] = now.points;
  all["frequency"] = now.frequency;
  all["step"] = now.step;
  all["share_done"] = now.share_done;
  all["item"] = now.item;
  all["counted"] = now.counted;
  all["phase"] = now.phase;
  all["order"] = now.order;
  all["best"] = now.best;
  return all;
}

/// What the thread that computes and the one that waits share.
struct Shared {
  std::mutex mutex;
  std::condition_variable changed;
  bool finished = false;
  std::optional<control::Progress> latest;  // that has not been reported
  std::exception_ptr failure;
};

/// Lets Python handle its signals, and reports. Called with the interpreter's lock.
void poll(const control::Control& control, const nb::object& report,
          const std::optional<control::Progress>& latest) {
  if (PyErr_CheckSignals() != 0) throw nb::python_error();
  if (!latest || report.is_none()) return;
  if (report(as_dict(*latest)).is(nb::bool_(false))) control.stop();
}

}  // namespace

std::optional<nb::python_error> supervised(const nb::object& report,
                                           const std::function<void(const control::Control&)>& work) {
  Shared shared;
  static control::AbandonedThreads abandoned;  // joined when the interpreter has ended
  const auto keep = [&](const control::Progress& now) {
    const std::lock_guard lock(shared.mutex);
    shared.latest = now;
  };
  const control::Control control{{.report = keep, .abandoned = &abandoned}};
  std::optional<nb::python_error> ended_by;
  {
    const nb::gil_scoped_release released;
    const std::jthread thread([&] {
      try {
        work(control);
      } catch (...) {
        shared.failure = std::current_exception();
      }
      const std::lock_guard lock(shared.mutex);
      shared.finished = true;
      shared.changed.notify_all();
    });
    std::unique_lock lock(shared.mutex);
    while (!shared.changed.wait_for(lock, between_polls, [&] { return shared.finished; })) {
      const auto latest = std::exchange(shared.latest, std::nullopt);
      lock.unlock();
      if (!ended_by) {
        const nb::gil_scoped_acquire held;
        try {
          poll(control, report, latest);
        } catch (nb::python_error& error) {
          ended_by.emplace(std::move(error));
          control.stop();
        } catch (...) {
          control.stop();  // the thread is joined on the way out
          throw;
        }
      }
      lock.lock();
    }
  }
  if (shared.failure && !ended_by) std::rethrow_exception(shared.failure);
  return ended_by;
}

}  // namespace arcslip::python
