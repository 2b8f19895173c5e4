#include <arcslip/time/event_driven/event_driven.hpp>

#include <arcslip/time/event_driven/march.hpp>
#include <arcslip/time/event_driven/piece_extremes.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace arcslip::time {
namespace {

double elastic_and_kinetic(const EquationOfMotion& equation, const MotionState& state) {
  double energy = 0.5 * state.v.dot(equation.M * state.v) + 0.5 * state.x.dot(equation.K * state.x);
  for (const TimeElement& element : equation.elements)
    energy += element.law->in_time(element.fields)
                  ->stored(element.directions.transpose() * state.x,
                           state.z.segment(element.memory, element.law->memory()));
  return energy;
}

class Recorder {
 public:
  Recorder(const EquationOfMotion& equation, const March& march, std::span<const double> instants)
      : equation_(equation), march_(march), instants_(instants) {
    for (const TimeElement& element : equation.elements) {
      const double x_n = element.directions.rightCols(1).col(0).dot(march.state().x);
      records_.push_back({element.law->has_contact() ? static_cast<int>(motion_.friction.size()) : -1, 0,
                          element.law->has_normal_load(), x_n, x_n});
      if (element.law->has_contact()) motion_.friction.push_back({element.name});
      motion_.history.elements.push_back({element.name, {}, {}, {}, {}});
    }
    for (const Contact& contact : march.contacts())
      records_[static_cast<std::size_t>(contact.element)].sliders +=
          contact.slider >= 0 ? contact.automaton.weight : 0;
    motion_.amplitude = -1;
    start_energy_ = elastic_and_kinetic(equation, march.state());
  }

  void piece() {
    const double s = march_.s(), h = march_.h();
    const LinearMotion& piece = march_.piece();
    while (next_ < instants_.size() && instants_[next_] <= march_.piece_end()) {
      at(std::clamp((instants_[next_] - march_.time()) / h, 0.0, s), instants_[next_]);
      ++next_;
    }
    if (const ContactEvent* event = march_.event()) motion_.events.push_back(*event);
    if (s == 0) return;
    const auto work = piece.work(s);
    motion_.energy.input += work.input;
    motion_.energy.viscous += work.viscous;
    for (const Contact& contact : march_.contacts()) {
      if (Record& of = records_[static_cast<std::size_t>(contact.element)]; of.has_load)
        extremes_.visit(piece, contact.along.back(), s, of.lowest, of.highest, [&](double, double x_n) {
          of.lowest = std::min(of.lowest, x_n);
          of.highest = std::max(of.highest, x_n);
        });
      if (contact.slider < 0) continue;
      const double energy = contact.follows() ? dissipated(contact, s) : 0;
      motion_.energy.friction += energy;
      const Record& record = records_[static_cast<std::size_t>(contact.element)];
      if (record.friction < 0) continue;
      FrictionRecord& friction = motion_.friction[static_cast<std::size_t>(record.friction)];
      friction.energy += energy;
      if (!contact.follows()) friction.stick_time += s * h * contact.automaton.weight / record.sliders;
      if (contact.mode().open) friction.open_time += s * h * contact.automaton.weight / record.sliders;
    }
    const double A = motion_.amplitude;
    extremes_.visit_observed(piece, s, -A, A, [&](double at, double x) {
      if (std::abs(x) <= motion_.amplitude) return;
      motion_.amplitude = std::abs(x);
      motion_.amplitude_time = march_.time() + at * h;
    });
  }

  EventDrivenMotion finish() {
    motion_.reason = march_.reason();
    motion_.message = march_.message();
    motion_.time = march_.time();
    motion_.end = march_.state();
    motion_.energy.stored = elastic_and_kinetic(equation_, motion_.end) - start_energy_;
    for (std::size_t e = 0; e < records_.size(); ++e) {
      const Record& of = records_[e];
      if (!of.has_load || of.friction < 0) continue;
      const TimeElement& element = equation_.elements[e];
      FrictionRecord& friction = motion_.friction[static_cast<std::size_t>(of.friction)];
      std::tie(friction.load_min, friction.load_max) =
          std::minmax({element.law->normal_load_at(element.fields, of.lowest),
                       element.law->normal_load_at(element.fields, of.highest)});
    }
    if (motion_.amplitude < 0)
      motion_.amplitude = std::abs(equation_.observed(motion_.time, motion_.end.x, motion_.end.v).x);
    return std::move(motion_);
  }

 private:
  void at(double s, double t) {
    const LinearMotion& piece = march_.piece();
    TimeHistory& history = motion_.history;
    history.time.push_back(t);
    LinearMotion::Series velocity{};
    piece.observed(series_, velocity);
    history.displacement.push_back(value(series_, s));
    history.velocity.push_back(value(velocity, s));
    for (const Contact& contact : march_.contacts()) {
      ElementTimeHistory& element = history.elements[static_cast<std::size_t>(contact.element)];
      const bool first = element.force.size() < history.time.size();
      if (first) {
        q_.resize(contact.directions.cols());
        for (std::size_t k = 0; k < contact.along.size(); ++k) {
          piece.displacement(contact.along[k], series_);
          q_[static_cast<Eigen::Index>(k)] = value(series_, s);
        }
        element.displacement.push_back(q_[0]);
        element.force.push_back(0);
        const TimeElement& of = equation_.elements[static_cast<std::size_t>(contact.element)];
        if (of.law->has_normal_load())
          element.normal_load.push_back(of.law->normal_load_at(of.fields, q_[q_.size() - 1]));
      }
      if (contact.slider == 0 && element.slider.size() < element.force.size())
        element.slider.push_back(march_.memory(contact, q_));
      element.force.back() += march_.force(contact, q_);
    }
  }

  // The work of a slider that follows, integral of f z' dt over the piece: f along the direction that it
  // follows. Its force is constant or linear in q.
  double dissipated(const Contact& contact, double s) {
    if (contact.slider < 0) return 0;
    const elements::Mode& mode = contact.mode();
    LinearMotion::Series way{}, force{};
    force[0] = mode.f_0[contact.slider];
    bool constant = true;
    for (Eigen::Index k = 0; k < contact.directions.cols(); ++k) {
      march_.piece().displacement(contact.along[static_cast<std::size_t>(k)], series_);
      const double rate = mode.f_q(contact.slider, k);
      constant = constant && rate == 0;
      for (std::size_t j = 0; j < series_.size(); ++j) {
        way[j] += mode.z_q[k] * series_[j];
        force[j] += rate * series_[j];
      }
    }
    way[0] = 0;
    if (constant) return force[0] * value(way, s);
    double sum = 0;
    for (std::size_t j = 1; j < way.size(); ++j)
      for (std::size_t i = 0; i < force.size(); ++i)
        sum += static_cast<double>(j) * way[j] * force[i] * std::pow(s, i + j) / static_cast<double>(i + j);
    return sum;
  }

  const EquationOfMotion& equation_;
  const March& march_;
  std::span<const double> instants_;
  std::size_t next_ = 0;
  double start_energy_;
  Extremes extremes_;
  LinearMotion::Series series_{};
  Vector q_;
  struct Record {
    int friction;            // index in motion_.friction; -1: none
    double sliders;          // which share the time, by their weights
    bool has_load;           // a normal load that varies
    double lowest, highest;  // displacement along its direction
  };
  std::vector<Record> records_;  // of each element
  EventDrivenMotion motion_;
};

}  // namespace

EventDriven::EventDriven(const EquationOfMotion& equation, const EventLimits& limits) : equation_(equation) {
  march_ = std::make_unique<March>(equation_, limits);
}

EventDriven::~EventDriven() = default;

EventDrivenMotion EventDriven::integrate(const MotionState& start, double from, double to,
                                         std::span<const double> instants) {
  march_->begin(start, from, Columns::motion);
  Recorder recorder(equation_, *march_, instants);
  while (march_->find(to)) {
    recorder.piece();
    march_->finish();
  }
  return recorder.finish();
}

}  // namespace arcslip::time
