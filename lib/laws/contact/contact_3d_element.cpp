#include <arcslip/laws/contact/contact_3d.hpp>

#include <arcslip/laws/contact/normal_contact.hpp>
#include <arcslip/laws/contact/slider_deflection.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace arcslip::elements {
namespace {

constexpr double least_slip = 1e-8;    // of the radius: less beyond full stick leaves derivatives few digits
constexpr double frictionless = 1e-7;  // radius of the disc, of the motion, that stands for the limit 0

constexpr double smallest = 1e-13;  // radius, of the motion: with a smaller one the contact slips alike

// The tangential stiffness, or that with which the disc has the smallest radius, if it is less: the limit of
// the force, mu N, is the same. size: a bound of the motion. 0: there is no friction.
double stiffness_in_use(double k_t, double mu, const Eigen::VectorXd& load, double size) {
  if (!(mu > 0)) return 0;
  const double most = mu * load.cwiseAbs().sum();
  const double k = most > 0 && size > 0 ? std::min(k_t, most / (smallest * size)) : k_t;
  return k >= std::numeric_limits<double>::min() / smallest ? k : 0;
}

class Contact3dElement final : public Element {
 public:
  explicit Contact3dElement(const Harmonics& h)
      : h_(h),
        c_(h.size()),
        normal_(h),
        disc_(h),
        stretch_(h),
        disc_nearby_(h),
        nearby_(h),
        shorter_(c_),
        derivative_(2 * c_, 3 * c_),
        u_(Eigen::VectorXd::Constant(3 * c_, std::numeric_limits<double>::quiet_NaN())),
        u_n_(c_),
        radius_(c_),
        F_(3 * c_),
        J_(3 * c_, 3 * c_) {}

  void move_to(In u, Fields fields, bool jacobian) override {
    if (u != u_ || !std::equal(fields.begin(), fields.end(), fields_)) find(u, fields);
    if (jacobian) set_jacobian();
  }

  const Eigen::VectorXd& force() const override { return F_; }
  const Eigen::MatrixXd& jacobian() const override { return J_; }

  void field_derivative(int field, Out dF) const override {
    dF.setZero();
    const double mu = fields_[contact_field::friction_coefficient];
    if (field == contact_field::normal_stiffness) dF.tail(c_) = normal_.by_stiffness();
    if (field == contact_field::normal_load) dF.tail(c_) = normal_.by_load();
    if (rigid_ || (!(k_ > 0) && field != contact_field::friction_coefficient)) return;
    differentiate();
    const auto by_radius = derivative_.rightCols(c_);
    auto T = dF.head(2 * c_);
    if (field == contact_field::tangential_stiffness)  // h is mu N/k_t
      T = stretch_.coefficients() - by_radius * radius_;
    else if (field == contact_field::normal_stiffness)
      T = mu * (by_radius * u_n_);
    else if (field == contact_field::friction_coefficient)
      T = by_radius * normal_.load();
    else
      T = mu * by_radius.col(0);
  }

  std::uint64_t piece() const override {
    const std::uint64_t side = fields_[contact_field::normal_load] <= 0 ? ~std::uint64_t{0} : 0;
    if (!(k_ > 0) || rigid_) return ((normal_.opens() ? 1 : 0) + 2 * normal_.closed().size()) ^ side;
    return stretch_.phases().sequence() ^ side;
  }

  bool friction(FrictionState& state) const override {
    if (rigid_ || !(k_ > 0)) {
      state.slip_onsets.clear();
      state.slip_ends.clear();
      state.stick_share = 0;
      double closed = 0;
      for (const auto& [begin, end] : normal_.closed()) closed += end - begin;
      state.open_share = std::max(0.0, 1 - closed / (2 * std::numbers::pi));
    } else {
      stretch_.phases().tell(state);
    }
    normal_.tell(state);
    return true;
  }

  void contact(std::vector<ContactInterval>& intervals) const override {
    if (!rigid_ && k_ > 0) return stretch_.phases().tell(intervals);
    intervals.clear();
    double before = 0;
    for (const auto& [begin, end] : normal_.closed()) {
      if (!intervals.empty()) intervals.push_back({"open", before, begin});
      intervals.push_back({"slip", begin, end});
      before = end;
    }
    constexpr double turn = 2 * std::numbers::pi;
    if (intervals.empty())
      intervals.push_back({"open", 0, turn});
    else
      intervals.push_back({"open", before, intervals.front().begin + turn});
  }

 private:
  void find(In u, Fields fields) {
    u_.setConstant(std::numeric_limits<double>::quiet_NaN());
    std::copy(fields.begin(), fields.end(), fields_);
    const double k_t = fields[contact_field::tangential_stiffness],
                 mu = fields[contact_field::friction_coefficient];
    u_n_ = u.tail(c_);
    normal_.move_to(u_n_, fields[contact_field::normal_stiffness], fields[contact_field::normal_load]);
    F_.tail(c_) = normal_.force();
    radius_ = mu / k_t * normal_.load();
    disc_.set(u.head(c_), u.segment(c_, c_), radius_);
    k_ = stiffness_in_use(k_t, mu, normal_.load(), disc_.motion_bound(0));
    if (k_ != k_t) {
      // Without friction the limit: derivatives by mu need the direction of slip.
      const double size = disc_.motion_bound(0), most = normal_.load().cwiseAbs().sum();
      const double ratio = k_ > 0 ? mu / k_ : most > 0 ? frictionless * size / most : 0;
      radius_ = ratio * normal_.load();
      disc_.set(u.head(c_), u.segment(c_, c_), radius_);
    }
    const bool finite = std::isfinite(disc_.motion_bound(3)) && std::isfinite(disc_.radius_bound(3)) &&
                        std::isfinite(disc_.largest());
    rigid_ = !finite || (!(k_ > 0) && !(disc_.motion_bound(0) > 0));
    differentiated_ = false;
    F_.head(2 * c_).setConstant(finite ? 0 : std::numeric_limits<double>::quiet_NaN());
    if (!rigid_) {
      stretch_.move_to(disc_, normal_.closed(), normal_.opens());
      if (k_ > 0) F_.head(2 * c_) = k_ * stretch_.coefficients();
    }
    u_ = u;
  }

  // Next to full stick the rest is hardly held across the slip: its derivative is the ratio of two small
  // numbers, of which rounding leaves little. There the derivatives are continued from shorter radii, with
  // the root of what these fall short of full stick.
  void differentiate() const {
    if (differentiated_) return;
    differentiated_ = true;
    const double missing = stretch_.phases().short_of_stick(), least = least_slip * disc_.largest();
    if (!(missing > 0) || missing >= least) {
      stretch_.differentiate();
      derivative_ = stretch_.derivative();
      return;
    }
    const double root = std::sqrt(missing / least);
    shorten(4 * least - missing);
    derivative_ = (root - 1) * nearby_.derivative();
    shorten(least - missing);
    derivative_ += (2 - root) * nearby_.derivative();
  }
  void shorten(double by) const {
    shorter_ = radius_;
    shorter_[0] -= by;
    disc_nearby_.set(disc_.coefficients(0), disc_.coefficients(1), shorter_);
    nearby_.move_to(disc_nearby_, normal_.closed(), false);
    nearby_.differentiate();
  }

  void set_jacobian() {
    const double mu = fields_[contact_field::friction_coefficient];
    J_.setZero();
    normal_.jacobian(J_.bottomRightCorner(c_, c_));
    if (rigid_ || !(k_ > 0)) return;
    differentiate();
    J_.topLeftCorner(2 * c_, 2 * c_) = k_ * derivative_.leftCols(2 * c_);
    J_.topRightCorner(2 * c_, c_) = mu * fields_[contact_field::normal_stiffness] * derivative_.rightCols(c_);
  }

  Harmonics h_;
  Eigen::Index c_;
  double fields_[contact_field::count] = {};
  double k_ = 0;  // stiffness_in_use()
  NormalContact normal_;
  Disc disc_;
  mutable DiscStretch stretch_;  // its derivatives are computed where they are asked for
  mutable bool differentiated_ = false;
  mutable Disc disc_nearby_;
  mutable DiscStretch nearby_;
  mutable Eigen::VectorXd shorter_;
  mutable Eigen::MatrixXd derivative_;  // of the stretch
  bool rigid_ = false;
  Eigen::VectorXd u_;  // at which the rest is known, with these fields
  Eigen::VectorXd u_n_, radius_, F_;
  Eigen::MatrixXd J_;
};

}  // namespace

std::unique_ptr<Element> make_contact_3d(const Harmonics& harmonics) {
  return std::make_unique<Contact3dElement>(harmonics);
}

Eigen::MatrixXd contact_3d_force(const Harmonics& h, In u, Fields fields, Angles angles) {
  const Eigen::Index c = h.size();
  const double k_t = fields[contact_field::tangential_stiffness],
               k_n = fields[contact_field::normal_stiffness],
               mu = fields[contact_field::friction_coefficient], N_0 = fields[contact_field::normal_load];
  NormalContact normal(h);
  normal.move_to(u.tail(c), k_n, N_0);
  Disc disc(h);
  const Eigen::VectorXd load = normal.load();
  disc.set(u.head(c), u.segment(c, c), mu / k_t * load);
  const double k = stiffness_in_use(k_t, mu, load, disc.motion_bound(0));
  if (k != k_t && k > 0) disc.set(u.head(c), u.segment(c, c), Eigen::VectorXd(mu / k * load));
  DiscPhases phases(h);
  if (k > 0) phases.find(disc, normal.closed(), normal.opens());
  Eigen::MatrixXd force = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(angles.size()), 3);
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const double N = std::max(N_0 + k_n * series_values(h, u.tail(c), angles[i]).x, 0.0);
    force(row, 2) = N - std::max(N_0, 0.0);
    if (k > 0) force.row(row).head<2>() = k * phases.stretch(disc, angles[i]).transpose();
  }
  return force;
}

}  // namespace arcslip::elements
