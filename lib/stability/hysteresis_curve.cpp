#include <arcslip/stability/hysteresis_curve.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::time {
namespace {

constexpr double first_length = 0.25;
constexpr double shortest_cell = 1e-12;  // cell, in g, at x = 0
constexpr double cell_growth = 1.6;      // of a cell by the one before
constexpr double resolved_cell = 4e-15;  // last coefficients of dx over a cell
constexpr double settled_curve = 4e-16;  // x
constexpr int most_curve_iterations = 40;
constexpr std::size_t most_cells = 10000;

}  // namespace

double HysteresisCurve::Cell::x_at(double s) const {
  double sum = 0;
  for (std::size_t j = by_s.size(); j-- > 0;) sum = (sum + by_s[j] / static_cast<double>(j + 1)) * s;
  return x + length * sum;
}

double HysteresisCurve::Cell::rate_at(double s) const {
  double sum = 0;
  for (std::size_t j = by_s.size(); j-- > 0;) sum = sum * s + by_s[j];
  return sum;
}

HysteresisCurve::HysteresisCurve(const elements::Hysteresis& law, std::span<const double> fields)
    : law_(&law), fields_(fields.begin(), fields.end()), up_(tabulate(1)), down_(tabulate(-1)) {}

// By Picard's iteration, which contracts in cells as short as a polynomial takes.
bool HysteresisCurve::solve(const LegendreFit& fit, double sign, Cell& cell) const {
  Vector x = Vector::Constant(nodes, cell.x), r(nodes), next;
  for (int i = 0;; ++i) {
    for (int k = 0; k < nodes; ++k) r[k] = rate(sign * std::min(x[k], 1.0));
    next = cell.length * (fit.integral * r);
    next.array() += cell.x;
    const double change = (next - x).cwiseAbs().maxCoeff();
    x = next;
    if (change <= settled_curve * x[nodes - 1]) break;
    if (i == most_curve_iterations) return false;
  }
  const Vector b = fit.by_values * r;
  const Vector by_s = fit.powers.transpose() * b;
  for (int j = 0; j < nodes; ++j) cell.by_s[static_cast<std::size_t>(j)] = by_s[j];
  return cell.length * b.tail(2).cwiseAbs().sum() <= resolved_cell;
}

HysteresisCurve::Side HysteresisCurve::tabulate(double sign) const {
  const LegendreFit fit(nodes);
  Side side;
  double x = 0, length = first_length;
  while (x < 1 && rate(sign * x) >= at_bound && side.cells.size() < most_cells) {
    Cell cell{side.end, length, x, {}};
    const bool solved = solve(fit, sign, cell);
    if (!solved && length > shortest_cell) {
      length *= 0.5;
      continue;
    }
    const double end = cell.x_at(1);
    if (sign < 0 && end > 1 + settled_curve) {
      // x comes to -1, and faster on the way: the chord ends before.
      length *= (1 - x) / (end - x);
      continue;
    }
    side.cells.push_back(cell);
    side.end += length;
    x = end;
    if (1 - x <= settled_curve) break;
    length *= cell_growth;
  }
  return side;
}

const HysteresisCurve::Cell* HysteresisCurve::cell_at(const Side& side, double size) {
  if (size >= side.end) return nullptr;
  return &*std::prev(std::upper_bound(side.cells.begin(), side.cells.end(), size,
                                      [](double value, const Cell& of) { return value < of.g; }));
}

double HysteresisCurve::x(double g) const {
  const double sign = g < 0 ? -1 : 1, size = std::abs(g);
  const Cell* const cell = cell_at(g < 0 ? down_ : up_, size);
  return cell ? sign * std::min(cell->x_at((size - cell->g) / cell->length), 1.0) : sign;
}

// Of x: next to a corner of the law the polynomials of r are less exact than their integrals.
double HysteresisCurve::rate_at(double g) const {
  return g >= end() ? 0 : std::max(rate(x(g)), 0.0);
}

double HysteresisCurve::g(double x) const {
  const Side& side = x < 0 ? down_ : up_;
  const double sign = x < 0 ? -1 : 1, size = std::abs(x);
  if (side.cells.empty()) return 0;
  const auto after = std::upper_bound(side.cells.begin(), side.cells.end(), size,
                                      [](double value, const Cell& of) { return value < of.x; });
  const Cell& cell = *std::prev(after);
  double low = 0, high = 1, s = (size - cell.x) / (cell.x_at(1) - cell.x);
  for (int i = 0; i < most_curve_iterations && s > 0 && s < 1; ++i) {
    const double excess = cell.x_at(s) - size;
    (excess > 0 ? high : low) = s;
    double next = s - excess / (cell.length * cell.rate_at(s));
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    const double change = std::abs(next - s);
    s = next;
    if (change <= settled_curve * s) break;
  }
  return sign * (cell.g + cell.length * std::clamp(s, 0.0, 1.0));
}

}  // namespace arcslip::time
