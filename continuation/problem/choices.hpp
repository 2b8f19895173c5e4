#pragma once
// The choices of a piecewise smooth F, made in one place:
//
//   Functions contact;
//   contact.choosing.residual = [=](In u, In p, Choices& choose, Out F) {
//     F[0] = k * u[0] + stop * choose.positive(u[0] - gap) - p[0];
//   };
//
// Which way each went is noted, in the order of the calls, and all of them together are the smooth piece of
// F. Kept, they continue that piece beyond its ends: F, its derivatives and its piece always belong together,
// and differences next to a kink are central ones of a smooth function.
//
// F has to be continuous where a choice changes. Calls that depend on others, as of a contact that only one
// of two sides has, may depend on choices alone.

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

namespace arcslip::continuation {

class Choices {
 public:
  double max(double a, double b);                      // a where they are equal
  double min(double a, double b);                      // a where they are equal
  double abs(double x);                                // x at 0
  double positive(double x);                           // max(x, 0): of the overlap of a contact
  double clamp(double x, double lower, double upper);  // saturation: x between two limits, lower <= upper

  /// A switch: x >= corner.
  bool above(double x, double corner = 0);

  /// The part of a line with these corners, in ascending order, on which x lies: how many corners are <= x.
  std::size_t part(double x, std::span<const double> corners);
  std::size_t part(double x, std::initializer_list<double> corners);

  /// The choice of each call in turn: 0 for the first argument, the sign +, inside the limits, and below the
  /// corner; 1 for the other one, and at the lower limit; 2 at the upper limit; or the part.
  std::size_t size() const { return made_.size(); }
  std::size_t operator[](std::size_t call) const { return made_[call]; }

  /// A number for all choices: others have another one, but for a chance of 2^-64.
  std::uint64_t piece() const;

  /// Before an evaluation, in an `Evaluator` of your own: `anew`, choices go by the numbers and are noted;
  /// `keep`, those of the last evaluation begun anew are made again, call by call.
  void anew();
  void keep();

 private:
  std::size_t choose(std::size_t by_numbers, std::size_t options);

  std::vector<std::size_t> made_;
  std::size_t calls_ = 0;
  bool kept_ = false;
};

}  // namespace arcslip::continuation
