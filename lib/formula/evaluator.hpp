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
#include <utility>
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

  /// values: where those of each expression go, apart from the inputs; null: they are not wanted. Allocates
  /// nothing but in the first call.
  void compute(std::span<const InputValues> inputs, std::size_t samples, std::span<double* const> values,
               std::span<const Derivative> derivatives = {}) {
    compute(prepare(inputs, derivatives), inputs, samples, values, derivatives);
  }

  /// The number of what is to be done with such inputs and derivatives, for the other compute().
  std::size_t prepare(std::span<const InputValues> inputs, std::span<const Derivative> derivatives);
  void compute(std::size_t program, std::span<const InputValues> inputs, std::size_t samples,
               std::span<double* const> values, std::span<const Derivative> derivatives);

 private:
  // What is to be done where certain inputs vary and certain derivatives are wanted.
  struct Program {
    std::vector<char> varying_inputs;
    std::vector<std::pair<std::size_t, int>> derivatives;  // expressions and inputs
    std::vector<int> constants;                            // nodes that are the same for all samples
    std::vector<std::pair<int, int>> given;            // nodes that are inputs which vary, and these inputs
    std::vector<int> steps;                            // the other nodes
    std::vector<std::pair<int, std::size_t>> results;  // of them, and the expression that each is
    std::vector<std::pair<int, std::size_t>> copies;   // other nodes that are expressions
    // The sweep back over an expression: from the adjoint of a node to those of its arguments, where a
    // derivative goes through these: set first, then added to.
    enum class Pass : char { none, set, add };
    struct Back {
      int node;
      Pass a, b, c;
    };
    struct Sweep {
      std::size_t expression;
      std::vector<Back> steps;
      std::vector<std::pair<int, std::size_t>> ends;  // nodes and the derivatives that they are
      std::vector<std::size_t> zeros;                 // derivatives by what the expression does not have
    };
    std::vector<Sweep> sweeps;
  };

  Program make_program(std::span<const InputValues> inputs, std::span<const Derivative> derivatives) const;
  std::vector<char> active_nodes(std::size_t expression, std::span<const Derivative> derivatives) const;
  Program::Sweep make_sweep(std::size_t expression, std::span<const Derivative> derivatives) const;
  void reserve(std::size_t samples);
  void set_constants(std::size_t program, std::span<const InputValues> inputs);
  void set_values(int n, std::size_t count);
  void go_back(const Program::Sweep& sweep, std::size_t count);
  void pass_on(const Program::Back& step, bool is_last, std::size_t count);
  double* own_values(int node) { return values_.data() + static_cast<std::size_t>(node) * stride_; }
  double* own_adjoints(int node) { return adjoints_.data() + static_cast<std::size_t>(node) * stride_; }
  const double* values_of(int node) const { return at_[static_cast<std::size_t>(node)]; }
  double* adjoints_of(int node) const { return adjoints_at_[static_cast<std::size_t>(node)]; }

  const Formula& formula_;
  std::vector<Program> programs_;
  std::size_t constants_of_;  // the program whose constants are set
  std::size_t stride_ = 0;    // between the values of two nodes
  std::vector<double> values_, adjoints_;
  // The values of each node: those of an input where they are given. Those of an expression are computed
  // where they go, as are its derivatives.
  std::vector<const double*> at_;
  std::vector<double*> results_at_, adjoints_at_;
};

}  // namespace arcslip::formula
