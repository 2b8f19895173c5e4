#pragma once
// The Jenkins element under another name, with other names for its fields in another order: what knows a law
// by its name, or a field by its place, treats it differently.

#include <arcslip/laws/hysteresis/jenkins.hpp>

#include <array>
#include <utility>

namespace own_laws {

using namespace arcslip;
using elements::Fields, elements::In, elements::Out;

/// Of the law's fields, in the order (grip, preload, tangent): which of Jenkins's they are.
inline constexpr std::array<int, 3> place{1, 2, 0};

inline std::array<double, 3> in_order(Fields own) {
  std::array<double, 3> fields{};
  for (std::size_t k = 0; k < 3; ++k) fields[static_cast<std::size_t>(place[k])] = own[k];
  return fields;
}

class RenamedElement final : public elements::Element {
 public:
  explicit RenamedElement(std::unique_ptr<Element> inner) : inner_(std::move(inner)) {}
  void move_to(In u, Fields fields, bool jacobian) override {
    inner_->move_to(u, in_order(fields), jacobian);
  }
  const Eigen::VectorXd& force() const override { return inner_->force(); }
  const Eigen::MatrixXd& jacobian() const override { return inner_->jacobian(); }
  void field_derivative(int field, Out dF) const override {
    inner_->field_derivative(place[static_cast<std::size_t>(field)], dF);
  }
  std::uint64_t piece() const override { return inner_->piece(); }
  bool friction(elements::FrictionState& state) const override { return inner_->friction(state); }
  bool place_slider(double share) override { return inner_->place_slider(share); }
  void contact(std::vector<elements::ContactInterval>& intervals) const override {
    inner_->contact(intervals);
  }

 private:
  std::unique_ptr<Element> inner_;
};

class RenamedCorners final : public elements::Corners {
 public:
  explicit RenamedCorners(std::unique_ptr<Corners> inner) : inner_(std::move(inner)) {}
  void equations(const elements::Corner& corner, In w, Fields fields, Equations& at) override {
    inner_->equations(corner, w, in_order(fields), at);
    at.by_field = at.by_field(Eigen::all, place).eval();
  }
  double size(const elements::Corner& corner, In w, Fields fields) override {
    return inner_->size(corner, w, in_order(fields));
  }
  bool polish(elements::Corner& corner, In w, Fields fields) override {
    return inner_->polish(corner, w, in_order(fields));
  }
  std::vector<elements::Corner> near(In w, Fields fields, double tolerance) override {
    return inner_->near(w, in_order(fields), tolerance);
  }

 private:
  std::unique_ptr<Corners> inner_;
};

class RenamedJenkins final : public elements::PlainLaw {
 public:
  std::string_view name() const override { return "series_slider"; }
  std::string_view help() const override { return "the Jenkins element under another name"; }
  std::span<const scene::Field> fields(const scene::Settings&) const override { return fields_; }

  elements::Facts facts() const override { return law().facts(); }
  elements::Traits traits(Fields fields, int direction) const override {
    elements::Traits traits = law().traits(in_order(fields), direction);
    traits.stiffness_field = 2;
    return traits;
  }
  double stiffness(Fields fields, int direction, double reach) const override {
    return law().stiffness(in_order(fields), direction, reach);
  }
  bool limited_by(int field) const override {
    return law().limited_by(place[static_cast<std::size_t>(field)]);
  }
  std::unique_ptr<elements::Element> element(const elements::Harmonics& harmonics,
                                             const elements::Sampling& sampling) const override {
    return std::make_unique<RenamedElement>(law().element(harmonics, sampling));
  }
  std::unique_ptr<elements::Corners> corners(const elements::Harmonics& harmonics) const override {
    return std::make_unique<RenamedCorners>(law().corners(harmonics));
  }
  Eigen::MatrixXd force_at(const elements::Harmonics& harmonics, In u, Fields fields,
                           elements::Angles angles) const override {
    return law().force_at(harmonics, u, in_order(fields), angles);
  }
  std::optional<std::vector<elements::Automaton>> automata(Fields fields) const override {
    return law().automata(in_order(fields));
  }

 private:
  static const elements::PlainLaw& law() { return elements::jenkins(); }

  std::array<scene::Field, 3> fields_ = [] {
    std::array<scene::Field, 3> own{};
    for (std::size_t k = 0; k < 3; ++k)
      own[k] = elements::jenkins().fields({})[static_cast<std::size_t>(place[k])];
    own[0].name = "grip";
    own[1].name = "preload";
    own[2].name = "tangent";
    return own;
  }();
};

}  // namespace own_laws
