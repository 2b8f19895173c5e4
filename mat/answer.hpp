#pragma once
// What is written on standard output: lib/scene/files/mat_protocol.hpp.

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace arcslip::mat {

/// What was found instead of a matrix: what() is the cause. variable: its name, "" before there is one.
class Fault : public std::runtime_error {
 public:
  explicit Fault(const std::string& cause, std::string variable = "");
  const std::string& variable() const { return variable_; }

 private:
  std::string variable_;
};

void write_fault(const Fault& fault);
void write_variables(const std::vector<std::string>& names);

struct MatrixSizes {
  std::size_t rows, columns, entries;
};
/// Begins a matrix: its starts, rows and values follow.
void write_matrix(const std::string& variable, const MatrixSizes& sizes);
void write(std::span<const std::uint32_t> numbers);
void write(std::span<const double> numbers);

/// Writes what is left, and ends the program: what libraries have to do at its end is not done, as it may
/// fail where a file is damaged.
[[noreturn]] void finish();

}  // namespace arcslip::mat
