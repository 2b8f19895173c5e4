// Coefficients of a piecewise linear force (piecewise_linear.hpp).
#include <arcslip/laws/memoryless/piecewise_linear_curve.hpp>

#include <arcslip/fourier/crossings.hpp>
#include <arcslip/fourier/moments.hpp>
#include <arcslip/fourier/reversals.hpp>

#include <algorithm>
#include <numbers>
#include <optional>

namespace arcslip::elements {
namespace {

constexpr std::uint64_t spread = 0x9e3779b97f4a7c15;  // powers of it number the corners

class PiecewiseLinearElement final : public Element {
 public:
  PiecewiseLinearElement(const std::vector<PiecewiseLinearShape>& shapes, const Harmonics& h)
      : shapes_(shapes),
        h_(h),
        reversals_(h),
        crossings_(h),
        factors_(static_cast<Eigen::Index>(shapes.front().terms.size())),
        moments_(shapes.front().terms.size(), Moments(h)),
        A_(h.size(), factors_.size()),
        l_(h.size(), factors_.size()),
        integral_(h.size()),
        F_(h.size()),
        J_(h.size(), h.size()),
        middle_(static_cast<std::size_t>(2 * h.order + 1)),
        half_(middle_.size()),
        numbers_(shapes.front().corners.size()) {
    path_.reserve(static_cast<std::size_t>(8 * h.order + 33));
    if (shapes.front().contact) intervals_.reserve(path_.capacity() * shapes.front().lines());
    std::uint64_t number = 1;
    for (std::uint64_t& each : numbers_) each = number *= spread;
  }

  void move_to(In u, Fields fields, bool jacobian) override {
    const PiecewiseLinearCurve curve(shapes_, fields);
    const double kappa = 1 / std::numbers::pi;
    A_.setZero();
    l_.setZero();
    for (Moments& moments : moments_) moments.clear();
    piece_ = 0;
    intervals_.clear();
    find(u, curve);
    F_.setZero();
    if (jacobian) J_.setZero();
    for (Eigen::Index a = 0; a < factors_.size(); ++a) {
      Moments& moments = moments_[static_cast<std::size_t>(a)];
      factors_[a] = fields[static_cast<std::size_t>(a)];
      moments.close();
      moments.times(u, kappa, A_.col(a));
      A_.col(a) += curve.length() * kappa * l_.col(a);
      l_.col(a) *= kappa;
      if (!h_.odd) A_(0, a) *= 0.5, l_(0, a) *= 0.5;
      F_ += factors_[a] * A_.col(a);
      if (jacobian) moments.add_to(J_, kappa * factors_[a]);
    }
    if (jacobian && !h_.odd) J_.row(0) *= 0.5;
    length_sign_ = curve.length_sign();
    if (length_sign_ < 0) piece_ = ~piece_;
  }

  const Eigen::VectorXd& force() const override { return F_; }
  const Eigen::MatrixXd& jacobian() const override { return J_; }
  void field_derivative(int field, Out dF) const override {
    if (field < factors_.size())
      dF = A_.col(field);
    else
      dF.noalias() = length_sign_ * (l_ * factors_);
  }
  std::uint64_t piece() const override { return piece_; }
  void contact(std::vector<ContactInterval>& intervals) const override { intervals = intervals_; }

 private:
  // The intervals of a period that lie on one of two lines.
  void find_about_corner(In u, const PiecewiseLinearCurve& curve) {
    const auto& crossings = crossings_.find(u, curve.corner(0), reversals_);
    if (crossings.empty()) {
      piece_ = crossings_.is_above() ? 1 : 0;
      add(curve, piece_, 0, whole_turn);
    }
    for (std::size_t i = 0; i < crossings.size(); ++i) {
      const auto& [begin, rises] = crossings[i];
      const double end = i + 1 < crossings.size() ? crossings[i + 1].theta : crossings[0].theta + whole_turn;
      if (rises) piece_ += numbers_[0];
      add(curve, rises ? 1 : 0, begin, end);
    }
  }

  // The intervals of a period that lie on one line, between the reversals that enclose their ends. A motion
  // of odd harmonics alone has reversals in half of it, and the others mirrored.
  void find(In u, const PiecewiseLinearCurve& curve) {
    if (!h_.odd && curve.lines() == 2) return find_about_corner(u, curve);
    const auto& turns = reversals_.find(u);
    if (turns.empty()) {
      const std::size_t line = curve.line_at(h_.odd ? 0 : u[0]);
      add(curve, line, 0, whole_turn);
      piece_ = line;
      return;
    }
    path_.assign(turns.begin(), turns.end());
    if (h_.odd)
      for (const Reversal& at : turns) path_.push_back({at.theta + std::numbers::pi, -at.x});
    path_.push_back({path_.front().theta + whole_turn, path_.front().x});
    std::size_t line = curve.line_at(path_.front().x);
    double begin = path_.front().theta;
    std::optional<double> first_end;  // the first interval is joined to the last
    const std::size_t corners = curve.lines() - 1;
    for (std::size_t i = 0; i + 1 < path_.size(); ++i) {
      const Reversal &from = path_[i], &to = path_[i + 1];
      const auto leave = [&](std::size_t corner, std::size_t next) {
        const double at = reversals_.crossing(u, from, to, curve.corner(corner));
        if (first_end)
          add(curve, line, begin, at);
        else
          first_end = at;
        begin = at;
        line = next;
      };
      while (line < corners && to.x > curve.corner(line)) {
        piece_ += numbers_[line];
        leave(line, line + 1);
      }
      while (line > 0 && !(to.x > curve.corner(line - 1))) leave(line - 1, line - 1);
    }
    add(curve, line, begin, first_end ? *first_end + whole_turn : path_.back().theta);
    if (!first_end) piece_ = line;
  }

  void add(const PiecewiseLinearCurve& curve, std::size_t line, double begin, double end) {
    if (curve.shape().contact) intervals_.push_back({curve.shape().names[line], begin, end});
    const auto& terms = curve.shape().terms;
    const auto without_force = [&](const auto& lines) { return lines[line] == PiecewiseLinearShape::Line{}; };
    if (std::all_of(terms.begin(), terms.end(), without_force)) return;
    powers(0.5 * (begin + end), static_cast<int>(middle_.size()), middle_.data());
    powers(0.5 * (end - begin), static_cast<int>(half_.size()), half_.data());
    for (int i = 0; i < h_.cosines(); ++i) {
      const auto n = static_cast<std::size_t>(h_.cosine_order(i));
      integral_[i] = n == 0 ? end - begin : 2 * half_[n].imag() / static_cast<double>(n) * middle_[n].real();
    }
    for (int j = 0; j < h_.sines(); ++j) {
      const auto n = static_cast<std::size_t>(h_.sine_order(j));
      integral_[h_.cosines() + j] = 2 * half_[n].imag() / static_cast<double>(n) * middle_[n].imag();
    }
    for (std::size_t a = 0; a < terms.size(); ++a) {
      const auto [slope, offset] = terms[a][line];
      if (slope != 0) moments_[a].add_interval(end - begin, middle_.data(), half_.data(), slope);
      if (offset != 0) l_.col(static_cast<Eigen::Index>(a)) += offset * integral_;
    }
  }

  std::vector<PiecewiseLinearShape> shapes_;
  Harmonics h_;
  Reversals reversals_;
  Crossings crossings_;
  Eigen::VectorXd factors_;
  std::vector<Moments> moments_;
  std::vector<Reversal> path_;
  Eigen::MatrixXd A_, l_;
  Eigen::VectorXd integral_, F_;
  Eigen::MatrixXd J_;
  std::vector<std::complex<double>> middle_, half_;
  std::vector<std::uint64_t> numbers_;      // of the corners
  std::vector<ContactInterval> intervals_;  // of a contact
  double length_sign_ = 0;
  std::uint64_t piece_ = 0;  // how often each corner is passed, or the line that is never left; the shape
};

}  // namespace

std::unique_ptr<Element> make_piecewise_linear(const std::vector<PiecewiseLinearShape>& shapes,
                                               const Harmonics& harmonics) {
  return std::make_unique<PiecewiseLinearElement>(shapes, harmonics);
}

}  // namespace arcslip::elements
