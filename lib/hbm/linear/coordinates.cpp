#include <arcslip/hbm/linear/coordinates.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::hbm {
namespace {

constexpr double independent = 1e-10;  // of unit directions, after taking out those before
constexpr double much_stiffer = 1e4;   // than the softest part: five digits are lost beyond

using Directions = std::vector<Eigen::VectorXd>;

// Of directions that are added, those far from depending on others come first, as neighbours along a joint
// move nearly alike: what they have outside of the span of those before.
constexpr double shares_outside[] = {1e-1, 1e-2, 1e-3, 1e-4, 1e-6, independent};

// A largest independent set, in the order in which directions are added, with an orthonormal basis of its
// span.
class Independent {
 public:
  explicit Independent(int dofs) : chosen_(dofs, 0), orthonormal_(dofs, 0) {}

  bool add(const Eigen::VectorXd& d, double least = independent) {
    if (chosen_.cols() == chosen_.rows()) return false;
    const Eigen::VectorXd rest = outside(d);
    if (rest.norm() < least) return false;
    const Eigen::Index r = chosen_.cols();
    chosen_.conservativeResize(Eigen::NoChange, r + 1);
    orthonormal_.conservativeResize(Eigen::NoChange, r + 1);
    chosen_.col(r) = d;
    orthonormal_.col(r) = rest.normalized();
    return true;
  }
  void add_far_first(const Directions& directions) {
    std::vector<const Eigen::VectorXd*> left;
    for (const Eigen::VectorXd& d : directions) left.push_back(&d);
    for (const double least : shares_outside)
      std::erase_if(left, [&](const auto* d) { return add(*d, least); });
  }
  bool spans(const Eigen::VectorXd& d) const { return outside(d).norm() < independent; }
  const Eigen::MatrixXd& chosen() const { return chosen_; }
  const Eigen::MatrixXd& orthonormal() const { return orthonormal_; }

 private:
  Eigen::VectorXd outside(const Eigen::VectorXd& d) const {
    const double size = d.norm();  // of tiny and of huge directions 0 and infinity
    Eigen::VectorXd rest = size > 0 && std::isfinite(size) ? d.normalized() : d.stableNormalized();
    for (int pass = 0; pass < 2; ++pass) rest -= orthonormal_ * (orthonormal_.transpose() * rest);
    return rest;
  }

  Eigen::MatrixXd chosen_, orthonormal_;
};

// Directions of the parts that are much stiffer than the softest, stiffest first. What reaches into the next
// sector of a ring has no elongation that is a coordinate of one.
Directions stiff_directions(const model::Model& model) {
  std::vector<std::pair<double, const model::Direction*>> all;
  const auto add = [&](double stiffness, const model::Direction& d) {
    const double k = std::abs(stiffness) * d.squaredNorm();
    if (k > 0 && std::isfinite(stiffness)) all.emplace_back(k, &d);
  };
  const continuation::Vector p = model::defaults(model);
  for (const auto& spring : model.springs)
    if (spring.next.size() == 0) add(spring.number.value(p), spring.direction);
  for (const auto& element : model.elements)
    for (std::size_t i = 0; i < element.directions.size(); ++i)
      if (element.next.empty() || element.next[i].size() == 0)
        add(element.law->traits(element.fields(p), static_cast<int>(i)).stiffness, element.directions[i]);
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  Directions stiff;
  for (const auto& [k, d] : all)
    if (k > much_stiffer * all.back().first) stiff.emplace_back(*d);
  return stiff;
}

// The elongations of stiff parts that are determined by the elements' displacements: single ones, then sums
// of several.
Directions stiff_between_elements(const Directions& stiff, const Independent& elements, int dofs) {
  Directions found;
  if (stiff.empty()) return found;
  Independent all(dofs);
  for (const auto& d : stiff) {
    all.add(d);
    if (elements.spans(d)) found.push_back(d);
  }
  const Eigen::MatrixXd cosines = all.orthonormal().transpose() * elements.orthonormal();
  if (cosines.size() == 0 || !cosines.allFinite()) return found;  // of directions that overflow
  const auto angles = continuation::singular_values(cosines);
  for (Eigen::Index i = 0; i < angles.values.size(); ++i)
    if (angles.values[i] > 1 - independent) found.push_back(elements.orthonormal() * angles.V.col(i));
  return found;
}

}  // namespace

Coordinates coordinates(const model::Model& model, double frequency) {
  Directions directions;
  for (const auto& element : model.elements) {
    directions.insert(directions.end(), element.directions.begin(), element.directions.end());
    for (const model::Direction& next : element.next)
      if (next.size() > 0) directions.emplace_back(next);
  }
  if (directions.empty()) directions.push_back(model.response);
  Independent elements(model.dofs);
  elements.add_far_first(directions);

  Coordinates c;
  c.unknowns = static_cast<int>(elements.chosen().cols());
  c.P.resize(model.dofs, model.dofs);
  const Directions stiff = stiff_directions(model);
  Independent chosen(model.dofs);
  for (const auto& d : stiff_between_elements(stiff, elements, model.dofs)) chosen.add(d);
  chosen.add_far_first(directions);
  for (const auto& d : stiff) chosen.add(d);
  const Eigen::MatrixXd& B = chosen.chosen();
  // B^T x = (unknowns, elongations): x = B (B^T B)^-1 (unknowns, elongations) + (null space of B^T) * the
  // rest.
  c.P.leftCols(B.cols()) =
      B * continuation::solve(B.transpose() * B, Eigen::MatrixXd::Identity(B.cols(), B.cols()));
  if (B.cols() < model.dofs) c.P.rightCols(model.dofs - B.cols()) = continuation::orthogonal_complement(B);
  if (frequency > 0 && stiff.empty() && !model.linked && model::is_symmetric(model))
    c.modes = fixed_interface_modes(model, c.P, c.unknowns, frequency);
  if (c.modes) c.P.rightCols(c.linear()) *= c.modes->of_linear;
  return c;
}

}  // namespace arcslip::hbm
