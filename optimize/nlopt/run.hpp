#pragma once
// A run of NLopt. Not installed.

#include <arcslip/optimize/nlopt/minimize.hpp>

#include <nlopt.h>

#include <chrono>
#include <exception>

namespace arcslip::optimize {

/// Wraps the user's functions for NLopt: calls them, keeps the best point, enforces the limits and records
/// why the run ended. objective() and constraint() are called from C and let no exception escape.
class Run {
 public:
  Run(const NonlinearProgram& problem, const MinimizeOptions& options, nlopt_opt handle);

  double objective(std::span<const double> x, std::span<double> gradient) noexcept;
  double constraint(std::size_t k, std::span<const double> x, std::span<double> gradient) noexcept;

  /// The result of a run that NLopt ended with this code and this message (may be null).
  MinimizeResult result(int nlopt_result, const char* nlopt_message) const;

 private:
  // The functions by number: 0 the objective, then the constraints, then the progress callback.
  double call(std::size_t k, const Function& function, std::span<const double> x,
              std::span<double> gradient) noexcept;
  void take(std::size_t k, std::span<const double> x, std::span<const double> gradient, double value);
  void keep_if_best();
  void report(std::span<const double> x, double value);
  double barrier() const noexcept;
  void interrupt(MinimizeReason reason, std::size_t blamed = 0) noexcept;
  double seconds() const noexcept;
  std::string blamed_name() const;
  std::string cause(const MinimizeResult& r, const char* nlopt_message) const;
  std::string message(const MinimizeResult& r) const;

  const NonlinearProgram& problem_;
  const MinimizeOptions& options_;
  nlopt_opt handle_;
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  long evaluations_ = 0;

  std::vector<double> x_;       // of the last call
  std::vector<double> values_;  // of the objective and each constraint at x_; NaN: not called yet
  std::vector<double> best_x_;
  double best_value_ = std::numeric_limits<double>::infinity();
  double best_excess_ = std::numeric_limits<double>::infinity();
  double worst_ = -std::numeric_limits<double>::infinity();  // largest finite value of the objective

  std::optional<MinimizeReason> interrupted_;
  std::size_t blamed_ = 0;  // number of the function that failed
  std::exception_ptr thrown_;
  double odd_ = 0;                        // the non-finite value,
  std::optional<std::size_t> odd_entry_;  // and its index, if in a gradient
};

}  // namespace arcslip::optimize
