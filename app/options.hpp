#pragma once
// What the user wrote on the command line.

#include "exit_code.hpp"

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace arcslip::app {

enum class Verb { run, frf, check };

struct Options {
  Verb verb = Verb::check;
  std::string scene;                                // path
  std::vector<std::pair<std::string, double>> set;  // parameter and value
  std::optional<int> harmonics;
  std::optional<double> from, to;  // in the scene's frequency unit
  std::string out, json, csv;      // paths, "-" for standard output (json, csv), "" for none
  bool coefficients = false;
  bool quiet = false;
};

/// Arguments that make no sense. what() says which and what to do.
class UsageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Text that was asked for in place of work: help or the version.
struct Information {
  std::string text;
};

/// Throws UsageError.
std::variant<Options, Information> parse(int argc, const char* const* argv);

}  // namespace arcslip::app
