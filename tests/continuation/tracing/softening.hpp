#pragma once
// A bar in series with one element that softens: the closed form of its response, and the bar as a problem
// with a state, pulled by a force or by its end.

#include "continuation/problems.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace softening {

using namespace problems;

/// Of length 1 and stiffness 1. The weak element carries s(k) at its largest strain k so far, from s(1) = 1
/// on.
struct Bar {
  int elements = 10;
  std::function<double(double)> strength, slope;
  bool by_force = true;  // the parameter: the force, or the place of the end

  int weak() const { return elements / 2; }
  double h() const { return 1.0 / elements; }
  int size() const { return elements - (by_force ? 0 : 1); }
  double strain(In u, double end, int e) const {
    const auto place = [&](int node) { return node < 0 ? 0 : node < size() ? u[node] : end; };
    return (place(e) - place(e - 1)) / h();
  }
  double force(double w) const { return w > 1 ? strength(w) : w; }
  double end(double w) const { return w * h() + (1 - h()) * force(w); }
};

/// Linear from 1 to 0 over `brittleness`, and exponential with this length.
inline Bar linear(int elements, double length) {
  return {elements, [=](double k) { return 1 - (k - 1) / length; }, [=](double) { return -1 / length; }};
}
inline Bar exponential(int elements, double length) {
  return {elements, [=](double k) { return std::exp((1 - k) / length); },
          [=](double k) { return -std::exp((1 - k) / length) / length; }};
}

/// F without a Jacobian for less than 6 elements; otherwise with a sparse one.
inline StateFunctions functions(const Bar& bar) {
  StateFunctions all;
  all.initial = Vector::Ones(1);
  all.functions = [bar](AcceptedState largest) {
    const int n = bar.size();
    const auto weak_stress = [=](double strain, Choices& choose) {
      const double k = choose.max(strain, largest[0]);
      return bar.strength(k) / k * strain;
    };
    Functions f;
    f.size = n;
    f.parameters = {parameter(bar.by_force ? "force" : "end", 0)};
    f.choosing.residual = [=](In u, In p, Choices& choose, Out F) {
      for (int node = 0; node < n; ++node) F[node] = 0;
      for (int e = 0; e < bar.elements; ++e) {
        const double strain = bar.strain(u, p[0], e);
        const double stress = e == bar.weak() ? weak_stress(strain, choose) : strain;
        if (e > 0) F[e - 1] -= stress;
        if (e < n) F[e] += stress;
      }
      if (bar.by_force) F[n - 1] -= p[0];
    };
    if (bar.elements < 6) return f;
    f.choosing.sparse_jacobian = [=](In u, In p, Choices& made, SparseMatrix& J) {
      std::vector<Eigen::Triplet<double>> entries;
      for (int e = 0; e < bar.elements; ++e) {
        double slope = 1;
        if (e == bar.weak()) {
          const double strain = bar.strain(u, p[0], e), k = made.max(strain, largest[0]);
          slope = made[0] == 0 ? bar.slope(k) : bar.strength(k) / k;
        }
        slope /= bar.h();
        if (e < n) entries.emplace_back(e, e, slope);
        if (e > 0) entries.emplace_back(e - 1, e - 1, slope);
        if (e > 0 && e < n) entries.emplace_back(e, e - 1, -slope), entries.emplace_back(e - 1, e, -slope);
      }
      J.setFromTriplets(entries.begin(), entries.end());
    };
    return f;
  };
  all.next = [bar](In u, In p, In largest, Out next) {
    next[0] = std::max(bar.strain(u, p[0], bar.weak()), largest[0]);
  };
  return all;
}

/// The largest error of strains, force and end over the points of a branch.
inline double error(const Bar& bar, const Branch& branch) {
  double worst = 0;
  for (const Point& point : branch.points) {
    const double p = point.parameter, w = bar.strain(point.u, p, bar.weak());
    const double force = bar.force(w), end = bar.by_force ? point.u[bar.size() - 1] : p;
    worst = std::max({worst, std::abs(end - bar.end(w)), bar.by_force ? std::abs(p - force) : 0});
    for (int e = 0; e < bar.elements; ++e)
      if (e != bar.weak()) worst = std::max(worst, std::abs(bar.strain(point.u, p, e) - force));
  }
  return worst;
}

inline Start at_rest(const Bar& bar) {
  return {.u = Vector::Zero(bar.size()), .p = Vector{{0.0}}};
}

}  // namespace softening
