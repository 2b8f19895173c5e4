#include <arcslip/laws/memoryless/formula_law.hpp>

#include <arcslip/formula/facts.hpp>
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

  struct Program {
    std::optional<std::size_t> number;
    std::vector<formula::Derivative> derivatives;
  };
  Program& of(Wanted wanted) { return programs[static_cast<std::size_t>(wanted)]; }
  std::array<Program, 3> programs;
};

constexpr double zero = 0;

// The highest of all; none where one is not known.
void extend(std::optional<formula::Degree>& all, const std::optional<formula::Degree>& own) {
  if (all && own)
    all = formula::Degree{std::max(all->motion, own->motion), std::max(all->orders, own->orders)};
  else
    all.reset();
}

std::vector<std::string> names_of(std::span<const scene::Field> fields) {
  std::vector<std::string> names;
  for (const scene::Field& field : fields) names.emplace_back(field.name);
  return names;
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

formula::InputOf FormulaInputs::names(std::vector<std::string> own) const {
  std::vector<std::string> all = motion_names(directions);
  all.insert(all.end(), own.begin(), own.end());
  return formula::names_of(std::vector<std::string_view>(all.begin(), all.end()));
}

FormulaLaw::FormulaLaw(std::string_view name, std::string_view help, const std::vector<std::string>& forces,
                       std::span<const scene::Field> fields, Work work, const std::vector<std::string>& names)
    : name_(name),
      help_(help),
      fields_(fields),
      inputs_{static_cast<int>(forces.size()), static_cast<int>(fields.size())},
      formula_(forces, inputs_.names(names.empty() ? names_of(fields) : names),
               names.empty() ? formula::Formula::Author::user : formula::Formula::Author::program),
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
  potential_ = (d == 1 || work == Work::stored) && !rate_dependent_ && !phase_dependent_;
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
        auto& tangent = scratch->of(Wanted::tangent).derivatives;
        tangent.push_back({expression, inputs_.displacement(j), at.f_q.col(j * d + i).data()});
        if (rate_dependent_)
          tangent.push_back({expression, inputs_.velocity(j), at.f_v.col(j * d + i).data()});
      }
      for (int k = 0; k < inputs_.fields; ++k)
        scratch->of(Wanted::by_fields)
            .derivatives.push_back(
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
  FormulaScratch::Program& program = scratch->of(wanted);
  if (!program.number) program.number = scratch->evaluator.prepare(inputs, program.derivatives);
  scratch->evaluator.compute(*program.number, inputs, static_cast<std::size_t>(motion.q.rows()),
                             scratch->values, program.derivatives);
}

std::optional<std::vector<double>> FormulaLaw::polynomial(Fields fields) const {
  if (inputs_.directions > 1 || phase_dependent_) return {};
  std::vector<double> values(static_cast<std::size_t>(inputs_.count()));
  for (int k = 0; k < inputs_.fields; ++k)
    values[static_cast<std::size_t>(inputs_.field(k))] = fields[static_cast<std::size_t>(k)];
  auto coefficients = formula::polynomial(formula_, 0, inputs_.displacement(0), values);
  while (coefficients && coefficients->size() > 1 && coefficients->back() == 0) coefficients->pop_back();
  return coefficients;
}

SampledLaw::Shape FormulaLaw::shape(Fields fields, int direction) const {
  auto coefficients = polynomial(fields);
  const bool linear = coefficients ? coefficients->size() <= 2 : degree_ && degree_->motion < 2;
  return {formula_.uses(inputs_.displacement(direction)), linear, degree_.has_value(),
          std::move(coefficients)};
}

// Of a force that is a field times the displacement.
int FormulaLaw::stiffness_field(Fields fields) const {
  const auto nodes = formula_.nodes();
  if (inputs_.directions > 1 || nodes.size() != 3 || nodes[2].operation != formula::Operation::multiply)
    return -1;
  for (int k = 0; k < inputs_.fields; ++k)
    if (formula_.uses(inputs_.field(k)) && formula_.uses(inputs_.displacement(0)) &&
        fields[static_cast<std::size_t>(k)] > 0)
      return k;
  return -1;
}

Traits FormulaLaw::traits(Fields fields, int direction) const {
  Traits all = SampledLaw::traits(fields, direction);
  all.stiffness_field = stiffness_field(fields);
  return all;
}

std::optional<std::vector<Automaton>> FormulaLaw::automata(Fields fields) const {
  const auto coefficients = potential_ ? polynomial(fields) : std::nullopt;
  if (!coefficients || coefficients->size() > 2) return {};
  Automaton spring(-1);
  spring.add("linear", coefficients->size() > 1 ? (*coefficients)[1] : 0, 0, coefficients->front());
  return std::vector{spring};
}

}  // namespace arcslip::elements
