#include <arcslip/laws/memoryless/formula_law.hpp>

#include <arcslip/laws/memoryless/kink_finder.hpp>
#include <arcslip/laws/memoryless/kinked_element.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace arcslip::elements {
namespace {

// What a law's formulas are evaluated with.
struct FormulaScratch final : Scratch {
  explicit FormulaScratch(const formula::Formula& formula) : evaluator(formula) {}

  formula::Evaluator evaluator;
  std::vector<formula::InputValues> inputs;
  std::vector<double*> values;
  std::vector<formula::Derivative> tangent, by_fields;
};

constexpr double zero = 0;

// The highest of all; none where one is not known.
void extend(std::optional<formula::Degree>& all, const std::optional<formula::Degree>& own) {
  if (all && own)
    all = formula::Degree{std::max(all->motion, own->motion), std::max(all->orders, own->orders)};
  else
    all.reset();
}

}  // namespace

std::vector<std::string> motion_names(int directions) {
  std::vector<std::string> names;
  for (const char* letter : {"q", "v"})
    for (int i = 1; i <= directions; ++i)
      names.push_back(directions == 1 ? letter : letter + std::to_string(i));
  names.emplace_back("phase");
  return names;
}

formula::InputOf FormulaInputs::names(std::span<const scene::Field> own) const {
  std::vector<std::string> all = motion_names(directions);
  for (const scene::Field& field : own) all.emplace_back(field.name);
  return formula::names_of(std::vector<std::string_view>(all.begin(), all.end()));
}

FormulaLaw::FormulaLaw(std::string_view name, std::string_view help, const std::vector<std::string>& forces,
                       std::span<const scene::Field> fields)
    : name_(name),
      help_(help),
      fields_(fields),
      inputs_{static_cast<int>(forces.size()), static_cast<int>(fields.size())},
      formula_(forces, inputs_.names(fields)),
      degree_(formula::Degree()),
      degree_of_pieces_(formula::Degree()) {
  const int d = inputs_.directions;
  if (d > 1) {
    slot_names_ = motion_names(d);
    slot_names_.resize(forces.size());
    slots_.assign(slot_names_.begin(), slot_names_.end());
  }
  std::vector<formula::Role> roles(static_cast<std::size_t>(inputs_.count()), formula::Role::constant);
  for (int i = 0; i < d; ++i) {
    for (const int input : {inputs_.displacement(i), inputs_.velocity(i)})
      roles[static_cast<std::size_t>(input)] = formula::Role::motion;
    rate_dependent_ = rate_dependent_ || formula_.uses(inputs_.velocity(i));
  }
  roles[static_cast<std::size_t>(inputs_.phase())] = formula::Role::phase;
  phase_dependent_ = formula_.uses(inputs_.phase());
  potential_ = d == 1 && !rate_dependent_ && !phase_dependent_;
  antisymmetric_ = !phase_dependent_;
  switches_ = formula::switches(formula_, roles);
  may_jump_ = formula::may_jump(formula_, roles);
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const formula::Parity parity = formula::parity(formula_, i, roles);
    antisymmetric_ = antisymmetric_ && (parity == formula::Parity::odd || parity == formula::Parity::zero);
    extend(degree_, formula::degree(formula_, i, roles));
    extend(degree_of_pieces_, formula::degree(formula_, i, roles, formula::Pieces::several));
  }
}

int FormulaLaw::samples(const Harmonics& h) const {
  if (!degree_) return 32 * h.order + 64;
  return (degree_->motion + 1) * h.order + degree_->orders * h.period + 2;
}

std::unique_ptr<Element> FormulaLaw::element(const Harmonics& harmonics, const Sampling& sampling) const {
  return has_kinks() ? kinked_element(*this, harmonics) : SampledLaw::element(harmonics, sampling);
}

void FormulaLaw::add_kinks(const Harmonics& harmonics, In u, double base_frequency, Fields fields,
                           std::vector<double>& angles) const {
  if (!has_kinks()) return;
  KinkFinder finder(*this, harmonics);
  for (const Kink& kink : finder.find(u, base_frequency, fields)) angles.push_back(kink.theta);
}

void FormulaLaw::sample(Fields fields, const Eigen::MatrixXd& q, SampledForce& at) const {
  const Eigen::MatrixXd v = Eigen::MatrixXd::Zero(q.rows(), q.cols());
  sample_motion(fields, {q, v, Eigen::VectorXd::Zero(q.rows())}, Wanted::tangent, at);
}

void FormulaLaw::sample_motion(Fields fields, const SampledMotion& motion, Wanted wanted,
                               SampledForce& at) const {
  const int d = inputs_.directions;
  auto* scratch = static_cast<FormulaScratch*>(at.scratch.get());
  if (scratch == nullptr) {
    auto made = std::make_unique<FormulaScratch>(formula_);
    scratch = made.get();
    at.scratch = std::move(made);
    scratch->inputs.resize(static_cast<std::size_t>(inputs_.count()));
    for (int i = 0; i < d; ++i) {
      scratch->values.push_back(at.f.col(i).data());
      for (int j = 0; j < d; ++j) {
        const auto expression = static_cast<std::size_t>(i);
        scratch->tangent.push_back({expression, inputs_.displacement(j), at.f_q.col(j * d + i).data()});
        if (rate_dependent_)
          scratch->tangent.push_back({expression, inputs_.velocity(j), at.f_v.col(j * d + i).data()});
      }
      for (int k = 0; k < inputs_.fields; ++k)
        scratch->by_fields.push_back(
            {static_cast<std::size_t>(i), inputs_.field(k), at.f_field.col(k * d + i).data()});
    }
  }
  auto& inputs = scratch->inputs;
  const auto set = [&](int input, const double* values, bool varies) {
    inputs[static_cast<std::size_t>(input)] = {values, varies};
  };
  for (int i = 0; i < d; ++i) {
    set(inputs_.displacement(i), motion.q.col(i).data(), true);
    set(inputs_.velocity(i), rate_dependent_ ? motion.v.col(i).data() : &zero, rate_dependent_);
  }
  set(inputs_.phase(), phase_dependent_ ? motion.phase.data() : &zero, phase_dependent_);
  for (int k = 0; k < inputs_.fields; ++k) set(inputs_.field(k), &fields[static_cast<std::size_t>(k)], false);
  std::span<const formula::Derivative> derivatives;
  if (wanted == Wanted::tangent) derivatives = scratch->tangent;
  if (wanted == Wanted::by_fields) derivatives = scratch->by_fields;
  scratch->evaluator.compute(inputs, static_cast<std::size_t>(motion.q.rows()), scratch->values, derivatives);
}

void FormulaLaw::step(Fields fields, const StepStart& start, In dq, StepEnd& end) const {
  SampledLaw::step(fields, start, dq, end);
  end.dissipated = 0;
  if (potential_) return;
  // The trapezoidal rule, without what is stored.
  end.dissipated = 0.5 * (start.f + end.f).dot(dq);
  if (inputs_.directions > 1 || phase_dependent_ || !formula_.uses(inputs_.displacement(0))) return;
  auto& scratch = static_cast<FormulaScratch&>(*end.sample.scratch);
  const std::array<double, 2> q = {start.q[0], start.q[0] + dq[0]};
  std::array<double, 2> f{};
  const auto input = [&](int k) -> formula::InputValues& {
    return scratch.inputs[static_cast<std::size_t>(k)];
  };
  input(inputs_.displacement(0)) = {q.data(), true};
  input(inputs_.velocity(0)) = {&zero, false};
  for (int k = 0; k < inputs_.fields; ++k)
    input(inputs_.field(k)) = {&fields[static_cast<std::size_t>(k)], false};
  scratch.evaluator.compute(scratch.inputs, 2, std::array{f.data()});
  end.dissipated -= 0.5 * dq[0] * (f[0] + f[1]);
}

double FormulaLaw::force(Fields fields, int direction, std::span<const double> motion) const {
  std::vector<formula::InputValues> inputs;
  for (const double& each : motion) inputs.push_back({&each, false});
  for (const double& each : fields) inputs.push_back({&each, false});
  std::vector<double*> values(static_cast<std::size_t>(inputs_.directions));
  double f = 0;
  values[static_cast<std::size_t>(direction)] = &f;
  formula::Evaluator(formula_).compute(inputs, 1, values);
  return f;
}

double FormulaLaw::derivative(Fields fields, int direction, std::span<const double> motion, int input) const {
  std::vector<formula::InputValues> inputs;
  for (const double& each : motion) inputs.push_back({&each, false});
  for (const double& each : fields) inputs.push_back({&each, false});
  double slope = 0;
  formula::Evaluator(formula_).compute(
      inputs, 1, {}, std::array{formula::Derivative{static_cast<std::size_t>(direction), input, &slope}});
  return slope;
}

}  // namespace arcslip::elements
