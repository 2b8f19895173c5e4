#pragma once
// Threads among which the elements of an evaluation are shared.

#include <cstddef>
#include <functional>
#include <memory>

namespace arcslip::control {

class Workers {
 public:
  /// The caller's thread among them. The others start with the first run().
  explicit Workers(int threads);
  ~Workers();

  /// work(k) for k = 0 ... count - 1, each once and in any order; by the calling thread alone while another
  /// one is in run(). An exception is passed on when all threads have ended; what was not begun then is left
  /// out.
  void run(std::size_t count, const std::function<void(std::size_t)>& work);

 private:
  struct Shared;
  std::unique_ptr<Shared> shared_;
};

}  // namespace arcslip::control
