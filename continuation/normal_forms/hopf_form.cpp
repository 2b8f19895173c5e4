#include <arcslip/continuation/normal_forms/hopf_form.hpp>

#include <arcslip/continuation/linear/shifted_solver.hpp>
#include <arcslip/continuation/normal_forms/propagated_error.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <optional>
#include <vector>

namespace arcslip::continuation {
namespace {

class HopfForm {
 public:
  HopfForm(Evaluator& at, const PlaceOfForms& place) : forms_(at, place), n_(place.u.size()) {}

  // known: J with its errors, or null.
  bool compute(Hopf& hopf, const KnownJacobian* known = nullptr) {
    const auto J = known ? std::nullopt : forms_.jacobian();
    if (!known && !J) return false;
    ShiftedSolver solver(known ? known->J : *J, known ? known->errors : forms_.errors_of_jacobian());
    const ComplexVector z = hopf.real.cast<Complex>() + Complex(0, 1) * hopf.imaginary.cast<Complex>();
    const auto pair = refined_eigenpair(solver, Complex(0, hopf.frequency), z);
    if (!pair) return false;
    omega_ = pair->value.imag();
    q_ = pair->right;
    w_ = pair->left;
    q_ *= std::polar(1.0, std::arg(q_.dot(z)));
    w_ *= std::polar(1.0, std::arg(w_.dot(q_)));
    if (!manifold(solver)) return false;
    cubic(hopf);
    speed(hopf);
    return true;
  }

 private:
  ComplexVector extended(const ComplexVector& v) const {
    ComplexVector d(n_ + 1);
    d << v, Complex(0);
    return d;
  }

  // h11, h20 and u_p.
  bool manifold(ShiftedSolver& solver) {
    const ComplexForm qq = forms_.second(extended(q_), extended(q_)),
                      qc = forms_.second(extended(q_), extended(q_.conjugate()));
    const RealForm F_p = forms_.parameter_derivative();
    if (!solver.factorize(Complex(0))) return false;
    h11_ = solved(solver, {-qc.value, qc.error});
    u_p_ = solved(solver, {(-F_p.value).cast<Complex>(), F_p.error});
    if (!solver.factorize(Complex(0, 2 * omega_))) return false;
    h20_ = solved(solver, {-qq.value, qq.error});
    return h11_.value.allFinite() && h20_.value.allFinite();
  }

  void cubic(Hopf& hopf) {
    const ComplexVector q = extended(q_), qc = extended(q_.conjugate());
    PropagatedError sum(w_);
    sum.add(0.5, forms_.third(q, q, qc));
    sum.add(1, forms_.second(q, extended(h11_.value)), relative_error(h11_));
    sum.add(0.5, forms_.second(qc, extended(h20_.value)), relative_error(h20_));
    hopf.lyapunov = {sum.value().real() / omega_, sum.error() / omega_};
    hopf.detuning = {sum.value().imag(), sum.error()};
    if (hopf.lyapunov.signed_by_value())
      hopf.criticality = hopf.lyapunov.value < 0 ? Criticality::supercritical : Criticality::subcritical;
    hopf.mean = h11_.value.real();
    hopf.second_real = h20_.value.real();
    hopf.second_imaginary = h20_.value.imag();
  }

  void speed(Hopf& hopf) {
    if (!u_p_.value.allFinite()) return;
    ComplexVector along(n_ + 1);
    along << u_p_.value, Complex(1);
    PropagatedError sum(w_);
    sum.add(1, forms_.second(extended(q_), along), relative_error(u_p_));
    hopf.growth = {sum.value().real(), sum.error()};
    hopf.drift = {sum.value().imag(), sum.error()};
    if (!hopf.growth.signed_by_value() || !hopf.lyapunov.known()) return;
    hopf.parameter_shift = -hopf.lyapunov.value * omega_ / hopf.growth.value;
    hopf.frequency_shift = hopf.detuning.value + hopf.drift.value * hopf.parameter_shift;
    hopf.mean += hopf.parameter_shift * u_p_.value.real();
  }

  DirectionalDerivatives forms_;
  Eigen::Index n_;
  double omega_ = 0;
  ComplexVector q_, w_;
  ComplexForm h11_, h20_, u_p_;
};

constexpr double nudge = 1e-13;  // of the scales and |u|: other rounding errors, the same form
constexpr double widening = 10;  // of the distance between the middle one of five and the next but one

// Where J itself consists of differences, its rounding errors are in no estimate of the form: they show as
// its spread over places next to this one. Of five forms the one in the middle is taken.
void choose_middle(Evaluator& at, const PlaceOfForms& place, const Hopf& given, Hopf& hopf) {
  const Vector sizes = place.u.cwiseAbs().cwiseMax(place.scales.head(place.u.size()));
  if (!hopf.lyapunov.known()) return;
  std::vector<Hopf> forms{hopf};
  for (const double way : {-2.0, -1.0, 1.0, 2.0}) {
    PlaceOfForms nearby = place;
    nearby.u += way * nudge * sizes;
    forms.push_back(given);
    if (!HopfForm(at, nearby).compute(forms.back()) || !forms.back().lyapunov.known()) return;
  }
  std::sort(forms.begin(), forms.end(),
            [](const Hopf& a, const Hopf& b) { return a.lyapunov.value < b.lyapunov.value; });
  hopf = forms[2];
  for (const auto coefficient : {&Hopf::lyapunov, &Hopf::detuning, &Hopf::growth, &Hopf::drift}) {
    std::array<double, 5> distances{};
    for (std::size_t i = 0; i < forms.size(); ++i)
      distances[i] = std::abs((forms[i].*coefficient).value - (hopf.*coefficient).value);
    std::sort(distances.begin(), distances.end());
    (hopf.*coefficient).error += widening * distances[2];
  }
  if (!hopf.lyapunov.signed_by_value()) hopf.criticality = given.criticality;
}

}  // namespace

void add_normal_form(Evaluator& at, const PlaceOfForms& place, Hopf& hopf, const KnownJacobian* J) try {
  const Hopf given = hopf;
  if (HopfForm(at, place).compute(hopf, J) && at.by_differences().jacobian)
    choose_middle(at, place, given, hopf);
} catch (const std::exception&) {  // no derivatives, as it says
}

}  // namespace arcslip::continuation
