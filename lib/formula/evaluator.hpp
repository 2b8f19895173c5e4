#pragma once
// Values and derivatives of a formula at many samples.
//
// Values are computed operation by operation, each at up to 64 samples at once. Derivatives by all inputs
// come from one sweep back over the tape for each expression (reverse differentiation), which takes about as
// long as two to three of its values, however many inputs there are; they are exact but for rounding. At a
// kink they are those of one side, of abs and sign 0; what the choice of if() does not take has no effect on
// them.

#include <arcslip/formula/formula.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace arcslip::formula {

/// Where the values of an input stand: one for each sample, or one for all.
struct InputValues {
  const double* at;
  bool varies;
};

/// The derivative of an expression by an input, and where it goes, one for each sample.
struct Derivative {
  std::size_t expression;
  int input;
  double* to;
};

/// Owns its buffers; for one thread. The formula must outlive it.
class Evaluator {
 public:
  explicit Evaluator(const Formula& formula);

  /// values: where those of each expression go; null: they are not wanted. Allocates nothing but in the first
  /// call.
  void compute(std::span<const InputValues> inputs, std::size_t samples, std::span<double* const> values,
               std::span<const Derivative> derivatives = {});

 private:
  bool has_marks(std::span<const InputValues> inputs, std::span<const Derivative> derivatives) const;
  void set_marks(std::span<const InputValues> inputs, std::span<const Derivative> derivatives);
  void compute_values(std::span<const InputValues> inputs, std::size_t from, std::size_t count);
  static void set_values(const Node& node, std::size_t count, double* __restrict f, const double* a,
                         const double* b, const double* c);
  void go_back(std::size_t expression, std::size_t count);
  void pass_on(const Node& node, int n, std::size_t count);
  const double* values_of(int node) const { return at_[static_cast<std::size_t>(node)]; }
  double* adjoints_of(int node) { return adjoints_.data() + static_cast<std::size_t>(node) * stride_; }

  const Formula& formula_;
  std::size_t stride_ = 0;             // between the values of two nodes
  std::vector<char> varies_, active_;  // nodes: whether samples differ; whether a derivative goes through it
  std::vector<char> marked_inputs_;    // for these marks: which inputs vary
  std::vector<int> marked_derivatives_;  // by which inputs derivatives are taken
  std::vector<double> values_, adjoints_;
  std::vector<const double*> at_;  // the values of each node: those of an input where they are given
  std::vector<char> reached_;      // nodes whose adjoints are known so far
};

}  // namespace arcslip::formula
