#include <arcslip/continuation/tracing/state.hpp>

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <type_traits>

namespace arcslip::continuation {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* format = "arcslip-state-1";

// Each struct has one list of fields for both writing and reading: `fields` calls visit(name, field)
// for each.
template <class Visit>
void fields(Visit&& visit, auto& x);

class Writer {
 public:
  explicit Writer(Json& to) : to_(to) {}
  static bool holds(const char*) { return true; }
  template <class T>
  void operator()(const char* name, const T& x) {
    to_[name] = json(x);
  }

  template <class T>
  static Json json(const T& x) {
    if constexpr (std::is_same_v<T, Vector>) {
      Json all = Json::array();
      for (const double each : x) all.push_back(json(each));
      return all;
    } else if constexpr (requires { x.has_value(); }) {
      return x ? json(*x) : Json();
    } else if constexpr (std::is_same_v<T, EventData>) {
      Json data = std::visit([](const auto& held) { return json(held); }, x);
      return Json{{"kind", x.index()}, {"data", std::move(data)}};
    } else if constexpr (std::is_same_v<T, std::monostate>) {
      return Json();
    } else if constexpr (std::is_same_v<T, std::complex<double>>) {
      return Json::array({json(x.real()), json(x.imag())});
    } else if constexpr (std::is_enum_v<T>) {
      return static_cast<int>(x);
    } else if constexpr (std::is_same_v<T, double>) {
      // JSON has no infinities or NaN, but monitors do: the logarithm of a zero amplitude.
      if (std::isnan(x)) return "nan";
      if (std::isinf(x)) return x > 0 ? "inf" : "-inf";
      return x;
    } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
      return x;
    } else if constexpr (requires { x.size(); }) {
      Json all = Json::array();
      for (const auto& each : x) all.push_back(json(each));
      return all;
    } else {
      Json object = Json::object();
      fields(Writer(object), x);
      return object;
    }
  }

 private:
  Json& to_;
};

class Reader {
 public:
  explicit Reader(const Json& from) : from_(from) {}
  bool holds(const char* name) const { return from_.contains(name); }
  template <class T>
  void operator()(const char* name, T& x) {
    read(from_.at(name), x);
  }

  template <class T>
  static void read(const Json& from, T& x) {
    if constexpr (std::is_same_v<T, Vector>) {
      std::vector<double> values;
      read(from, values);
      x = Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size()));
    } else if constexpr (requires { x.has_value(); }) {
      x.reset();
      if (!from.is_null()) read(from, x.emplace());
    } else if constexpr (std::is_same_v<T, EventData>) {
      read_data<0>(from, x);
    } else if constexpr (std::is_same_v<T, std::monostate>) {
    } else if constexpr (std::is_same_v<T, std::complex<double>>) {
      double real = 0, imaginary = 0;
      read(from.at(0), real);
      read(from.at(1), imaginary);
      x = {real, imaginary};
    } else if constexpr (std::is_enum_v<T>) {
      x = static_cast<T>(from.get<int>());
    } else if constexpr (std::is_same_v<T, double>) {
      constexpr double inf = std::numeric_limits<double>::infinity();
      if (from == "nan")
        x = std::numeric_limits<double>::quiet_NaN();
      else if (from == "inf" || from == "-inf")
        x = from == "inf" ? inf : -inf;
      else
        x = from.get<double>();
    } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
      x = from.get<T>();
    } else if constexpr (requires { x.size(); }) {
      x.clear();
      for (const Json& each : from) read(each, x.emplace_back());
    } else {
      fields(Reader(from), x);
    }
  }

 private:
  template <std::size_t kind>
  static void read_data(const Json& from, EventData& x) {
    if constexpr (kind < std::variant_size_v<EventData>) {
      if (from.at("kind").get<std::size_t>() != kind) return read_data<kind + 1>(from, x);
      read(from.at("data"), x.emplace<kind>());
    } else {
      throw std::invalid_argument("an event of an unknown kind");
    }
  }

  const Json& from_;
};

template <class T, class U>
constexpr bool is = std::is_same_v<std::remove_const_t<T>, U>;

// One that is absent in states of earlier versions.
void newer_field(auto& visit, const char* name, auto& x) {
  if (visit.holds(name)) visit(name, x);
}

// Coefficients of normal forms are absent in states of earlier versions.
void fields_of_fold(auto& visit, auto& x) {
  visit("right_null", x.right_null), visit("left_null", x.left_null), visit("curvature", x.curvature);
  if (visit.holds("quadratic")) visit("quadratic", x.quadratic), visit("unfolding", x.unfolding);
}

void fields_of_branch_point(auto& visit, auto& x) {
  visit("type", x.type), visit("tangents", x.tangents), visit("left_null", x.left_null);
  if (!visit.holds("crossing")) return;
  visit("crossing", x.crossing), visit("quadratic", x.quadratic), visit("cubic", x.cubic);
  visit("criticality", x.criticality);
}

void fields_of_hopf(auto& visit, auto& x) {
  visit("frequency", x.frequency), visit("real", x.real), visit("imaginary", x.imaginary);
  if (!visit.holds("lyapunov")) return;
  visit("lyapunov", x.lyapunov), visit("detuning", x.detuning), visit("growth", x.growth);
  visit("drift", x.drift), visit("criticality", x.criticality), visit("mean", x.mean);
  visit("second_real", x.second_real), visit("second_imaginary", x.second_imaginary);
  visit("parameter_shift", x.parameter_shift), visit("frequency_shift", x.frequency_shift);
}

template <class T, class... All>
constexpr bool is_one_of(const std::variant<All...>*) {
  return (is<T, All> || ...);
}
template <class T>
constexpr bool is_event_data = is_one_of<T>(static_cast<const EventData*>(nullptr));

void fields_of_point_of_curve(auto& visit, auto& x) {
  using T = std::remove_reference_t<decltype(x)>;
  if constexpr (is<T, Cusp>) {
    visit("cubic", x.cubic);
  } else if constexpr (is<T, BogdanovTakens>) {
    visit("a", x.a), visit("b", x.b), visit("criticality", x.criticality);
  } else if constexpr (is<T, GeneralizedHopf>) {
    visit("frequency", x.frequency), visit("lyapunov", x.lyapunov), visit("detuning", x.detuning);
    newer_field(visit, "second_lyapunov", x.second_lyapunov);
  } else if constexpr (is<T, ZeroHopf>) {
    visit("frequency", x.frequency), visit("g200", x.g200), visit("g011", x.g011), visit("g300", x.g300);
    visit("g111", x.g111), visit("g110_real", x.g110_real), visit("g110_imaginary", x.g110_imaginary);
    visit("g210_real", x.g210_real), visit("g210_imaginary", x.g210_imaginary);
    visit("g021_real", x.g021_real), visit("g021_imaginary", x.g021_imaginary);
  } else {
    visit("frequency", x.frequency), visit("other_frequency", x.other_frequency);
    visit("g2100", x.g2100), visit("g1011", x.g1011), visit("g1110", x.g1110), visit("g0021", x.g0021);
  }
}

void fields_of_event_data(auto& visit, auto& x) {
  using T = std::remove_reference_t<decltype(x)>;
  if constexpr (is<T, Fold>)
    fields_of_fold(visit, x);
  else if constexpr (is<T, BranchPoint>)
    fields_of_branch_point(visit, x);
  else if constexpr (is<T, Hopf>)
    fields_of_hopf(visit, x);
  else if constexpr (is<T, Kink>)
    visit("before", x.before), visit("after", x.after);
  else
    fields_of_point_of_curve(visit, x);
}

void fields_of_state(auto& visit, auto& x) {
  visit("branch", x.branch), visit("free", x.free), visit("direction", x.direction), visit("p", x.p);
  visit("start", x.start), visit("here", x.here), visit("before", x.before);
  visit("has_before", x.has_before), visit("begun", x.begun), visit("ended", x.ended);
  visit("step", x.step), visit("last_step", x.last_step), visit("rejections", x.rejections);
  visit("trouble_end", x.trouble_end), visit("unresolved_end", x.unresolved_end);
  visit("unresolved_step", x.unresolved_step), visit("turn", x.turn), visit("courses", x.courses);
  if (visit.holds("factors")) {  // absent in states of earlier versions, as what follows
    visit("longest", x.longest), visit("slow", x.slow), visit("jacobian_doubt", x.jacobian_doubt);
    visit("jacobian_error", x.jacobian_error), visit("factors_fit", x.factors_fit);
    visit("factors", x.factors);
  }
  newer_field(visit, "curve_error", x.curve_error), newer_field(visit, "expected", x.expected);
  newer_field(visit, "transverse", x.transverse), newer_field(visit, "accepted", x.accepted);
  newer_field(visit, "left_at_start", x.left_at_start);
  newer_field(visit, "largest_accepted", x.largest_accepted);
}

template <class Visit>
void fields(Visit&& visit, auto& x) {
  using T = std::remove_reference_t<decltype(x)>;
  if constexpr (is<T, Point>) {
    visit("u", x.u), visit("parameter", x.parameter), visit("tangent", x.tangent);
    visit("arclength", x.arclength), visit("iterations", x.iterations), visit("correction", x.correction);
    newer_field(visit, "spectrum", x.spectrum), newer_field(visit, "state", x.state);
  } else if constexpr (is<T, Spectrum>) {
    visit("leading", x.leading), visit("unstable", x.unstable), visit("complete", x.complete);
    visit("found_near", x.found_near), newer_field(visit, "nearest", x.nearest);
  } else if constexpr (is<T, AxisRange>) {
    visit("lower", x.lower), visit("upper", x.upper);
  } else if constexpr (is<T, Coefficient>) {
    visit("value", x.value), visit("error", x.error);
  } else if constexpr (is<T, Event>) {
    visit("monitor", x.monitor), visit("point", x.point), visit("value", x.value);
    visit("nonsmooth", x.nonsmooth), visit("located", x.located), visit("after", x.after);
    visit("data", x.data);
  } else if constexpr (is<T, BranchStop>) {
    visit("reason", x.reason), visit("value", x.value), visit("limit", x.limit);
    visit("message", x.message);
  } else if constexpr (is<T, Counts>) {
    visit("points", x.points), visit("rejected_steps", x.rejected_steps), visit("residuals", x.residuals);
    visit("jacobians", x.jacobians), visit("factorizations", x.factorizations), visit("solves", x.solves);
  } else if constexpr (is<T, Branch>) {
    visit("points", x.points), visit("events", x.events), visit("stop", x.stop), visit("counts", x.counts);
    visit("linear_solver", x.linear_solver);
    newer_field(visit, "warnings", x.warnings), newer_field(visit, "state", x.state);
  } else if constexpr (is<T, CurvePoint>) {
    visit("v", x.v), visit("tangent", x.tangent), visit("arclength", x.arclength);
    visit("orientation", x.orientation), visit("piece", x.piece), visit("monitors", x.monitors);
    visit("quantities", x.quantities);
    newer_field(visit, "part", x.part);
  } else if constexpr (is<T, LocatedEvent>) {
    visit("event", x.event), visit("place", x.place), visit("quantity", x.quantity);
    visit("rounding", x.rounding), newer_field(visit, "accepted", x.accepted);
  } else if constexpr (is<T, Course>) {
    visit("last", x.last), visit("waiting", x.waiting), visit("side", x.side);
  } else if constexpr (is<T, Linearization>) {
    visit("v", x.v), visit("row", x.row), newer_field(visit, "state", x.state);
  } else if constexpr (is<T, FactorMemory>) {
    visit("factors", x.factors), visit("pivots", x.pivots), visit("pivots_kept", x.pivots_kept);
    visit("contraction", x.contraction);
  } else if constexpr (is_event_data<T>) {
    fields_of_event_data(visit, x);
  } else if constexpr (is<T, State::Turn>) {
    visit("angle", x.angle), visit("step", x.step), visit("end", x.end);
  } else if constexpr (is<T, State::Transverse>) {
    visit("b", x.b), visit("basis", x.basis);
  } else {
    static_assert(is<T, State>);
    fields_of_state(visit, x);
  }
}

}  // namespace

std::string to_json(const State& state) {
  Json json{{"format", format}};
  fields(Writer(json), state);
  // A message may quote the problem in any encoding.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

State state_from_json(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    const auto found = json.at("format").get<std::string>();
    if (found != format)
      throw std::invalid_argument("the format is \"" + found + "\", not \"" + format + "\"");
    State state;
    fields(Reader(json), state);
    return state;
  } catch (const nlohmann::json::exception& fault) {
    throw std::invalid_argument(std::string("not the state of a trace: ") + fault.what());
  }
}

}  // namespace arcslip::continuation
