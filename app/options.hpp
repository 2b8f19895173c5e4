#pragma once
// What the user wrote on the command line.

#include "exit_code.hpp"

#include <arcslip/scene/scene.hpp>

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace arcslip::app {

enum class Verb { run, frf, trace, peaks, folds, time, optimize, check };

/// A parameter of a design on the command line: name.field, or name.field=lower:upper.
struct DesignRange {
  std::string parameter;
  std::optional<std::pair<double, double>> bounds;
};

struct Options {
  Verb verb = Verb::check;
  std::string scene;                                // path
  std::vector<std::pair<std::string, double>> set;  // parameter and value
  std::optional<int> harmonics;
  std::string over;                  // the parameter of trace, peaks and folds, "" where it is not given
  std::optional<double> from, to;    // run, frf: in the scene's frequency unit; else of `over`
  std::vector<double> frequency;     // in the scene's unit: none, one (trace, time), or the window (others)
  std::vector<DesignRange> design;   // optimize: what it is over
  std::optional<DesignRange> along;  // optimize: what the optimum is followed over
  std::optional<scene::Criterion> criterion;    // optimize
  std::string algorithm, local;                 // optimize: by NLopt's own names
  std::optional<int> evaluations;               // optimize
  std::optional<double> seconds;                // optimize
  std::optional<int> steps, periods, recorded;  // time
  std::optional<double> tolerance;              // time
  std::optional<scene::TimeMethod> method;      // time
  std::string out, json, csv;                   // paths, "-" for standard output (json, csv), "" for none
  std::optional<int> combinations;              // of for_each, at most
  bool coefficients = false;
  bool quiet = false;
};

/// "frf", as the user writes it. Verbs that compute studies of one kind have the name of that kind, but
/// optimize.
std::string name(Verb verb);

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
