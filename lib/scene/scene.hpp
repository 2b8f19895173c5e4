#pragma once
// A scene: what a user wrote, checked and resolved, as plain data in the user's own units.

#include <cstddef>
#include <iosfwd>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace arcslip::scene {

enum class FrequencyUnit { hertz, radian_per_second };
enum class Friction { exact, sampled };
enum class StudyKind { frf, trace, peaks, folds, time, optimum };

/// How a motion in time is found: by shooting on the period, between exact events where the scene is
/// piecewise linear (no cubic spring, no massless degree of freedom) and in Newmark's steps elsewhere, or
/// always in Newmark's steps; or period by period from rest, in Newmark's steps or between exact events.
enum class TimeMethod { shooting, newmark_shooting, newmark, event_driven };

/// One scalar of a part. It is a parameter of the scene under the name "part.field".
struct Field {
  std::string_view name;
  std::string_view unit;                  // SI, "-" for a pure number
  double lower, upper;                    // closed bounds
  bool lower_open = false;                // true: the lower bound itself is not allowed
  std::optional<double> default_value{};  // none: the field is required
  std::string_view help{};
};

/// What a section of the scene may hold: a type's name and its scalar fields, in the order of Part::values.
struct PartType {
  std::string_view name;
  std::span<const Field> fields;
};

/// The direction in which a part acts on the degrees of freedom: sum of weight * x_dof. Ground has no term.
struct Term {
  int dof;
  double weight;
  friend bool operator==(const Term&, const Term&) = default;
};
using Direction = std::vector<Term>;

/// A mass, spring, damper, element or force: a type, a direction, and one value for each field of the type.
struct Part {
  std::string name;
  const PartType* type = nullptr;
  Direction direction;
  std::vector<double> values;
  int harmonic = 1;  // excitation only: order of the harmonic of the force
  friend bool operator==(const Part&, const Part&) = default;
};

/// One parameter, `name`, that sets several fields "part.field" at once; its default is their common value.
struct Tie {
  std::string name;
  std::vector<std::string> members;
  friend bool operator==(const Tie&, const Tie&) = default;
};

struct Harmonics {
  int order = 7;  // highest harmonic N, 1 to 2000
  Friction friction = Friction::exact;
  int samples = 512;  // samples per period where friction is sampled
  friend bool operator==(const Harmonics&, const Harmonics&) = default;
};

/// Of a study of kind time.
struct TimeSettings {
  TimeMethod method = TimeMethod::shooting;
  int steps = 1000;         // per period: Newmark's, and those of the history
  int periods = 10'000;     // a transient has at most, those recorded included
  int recorded = 1;         // periods with history, at the end
  double tolerance = 1e-9;  // of the state: change over a period that is steady, last correction of shooting
  friend bool operator==(const TimeSettings&, const TimeSettings&) = default;
};

/// Of the search of a study of kind optimum. Algorithms are called by NLopt's own names.
struct SearchSettings {
  std::string algorithm{};  // empty: the default, LD_SLSQP
  std::string local{};      // what AUGLAG and MLSL search with; empty: none
  int evaluations = 1000;   // designs that are looked at, at most
  double seconds = 0;       // 0: no limit
  int population = 0;       // of the stochastic algorithms; 0: their own choice
  int seed = 1;             // of the stochastic algorithms: the same seed gives the same run
  friend bool operator==(const SearchSettings&, const SearchSettings&) = default;
};

/// A parameter of a design, and the values it may take.
struct DesignVariable {
  std::string name;
  double lower = 0, upper = 0;
  friend bool operator==(const DesignVariable&, const DesignVariable&) = default;
};

/// at_least <= observable <= at_most, at each resonance peak that is watched, those of at least three
/// quarters of the highest. Observables: the numbers of observables/quantities.hpp that each response has, as
/// "frequency" (in the scene's unit) and "energy_friction" (J per period); for an element NAME
/// "NAME.equivalent_stiffness" and "NAME.equivalent_damping", with friction "NAME.stick_percent",
/// "NAME.energy".
struct ObservableLimit {
  std::string observable;
  double at_least = -std::numeric_limits<double>::infinity();
  double at_most = std::numeric_limits<double>::infinity();
  friend bool operator==(const ObservableLimit&, const ObservableLimit&) = default;
};

/// at_least <= sum of weight * parameter <= at_most; the parameters are those of a design.
struct LinearLimit {
  std::vector<std::pair<std::string, double>> weights;
  double at_least = -std::numeric_limits<double>::infinity();
  double at_most = std::numeric_limits<double>::infinity();
  friend bool operator==(const LinearLimit&, const LinearLimit&) = default;
};

/// One of several circumstances that a design is to serve: a level of the excitation, a sample of what
/// scatters, a place where the amplitude is read.
struct DesignCase {
  std::vector<std::pair<std::string, double>> set;  // parameters and their values
  double weight = 1;                                // of its amplitude, > 0
  std::optional<Direction> response{};              // none: the scene's
  friend bool operator==(const DesignCase&, const DesignCase&) = default;
};

/// What is to be least: the largest weighted amplitude of all cases, or their weighted mean.
enum class Criterion { worst, mean };

/// What is to be computed, as data. A for_each list holds a parameter's name and the values it takes;
/// several lists make their product.
struct Study {
  std::string name;
  StudyKind kind = StudyKind::frf;
  double from = 0, to = 0;  // of the frequency in the scene's unit (frf), or of `over`, in its own
  std::vector<std::pair<std::string, std::vector<double>>> for_each;
  std::string over{};                           // the parameter of trace, peaks and folds; empty for others
  double frequency_from = 0, frequency_to = 0;  // trace, time: both the fixed frequency; else the window
  TimeSettings time{};
  std::vector<DesignVariable> design{};  // optimum: what it is over, with bounds
  SearchSettings search{};
  std::vector<ObservableLimit> constraints{};     // optimum
  std::vector<LinearLimit> linear_constraints{};  // optimum
  std::vector<DesignCase> cases{};                // optimum: none is one, the scene as it is
  Criterion criterion = Criterion::worst;         // optimum, over the cases
  std::vector<DesignVariable> scatter{};          // optimum, worst: the highest between these bounds counts
  std::optional<DesignVariable> along{};          // optimum: followed over this one, from lower to upper
  friend bool operator==(const Study&, const Study&) = default;
};

struct Scene {
  std::string title;
  FrequencyUnit frequency_unit = FrequencyUnit::hertz;
  std::vector<std::string> dofs;
  std::vector<Part> masses, springs, dampers, elements, excitation;
  std::vector<Tie> ties;
  Harmonics harmonics;
  Direction response;
  std::vector<Study> studies;
  friend bool operator==(const Scene&, const Scene&) = default;
};

extern const PartType mass_type, spring_type, damper_type,
    force_type;                           // fields: value; value; value; cosine, sine
extern const PartType jenkins_type;       // stiffness, friction_coefficient, normal_load
extern const PartType cubic_spring_type;  // stiffness (N/m^3)

/// Every type that the section "elements" knows.
std::span<const PartType* const> element_types();

/// One fault of a scene file.
struct Fault {
  std::string pointer;  // JSON pointer (RFC 6901) to the place, "" for the file as a whole
  std::string message;  // what was found, what is allowed, and the nearest known key where there is one
};

/// All faults of a scene, found in one reading. what() lists them, one a line.
class SceneError : public std::runtime_error {
 public:
  explicit SceneError(std::vector<Fault> faults);
  const std::vector<Fault>& faults() const { return faults_; }

 private:
  std::vector<Fault> faults_;
};

/// A file that cannot be opened or read.
class FileError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A parameter that is not there, or a value that it may not take.
class ParameterError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline constexpr int largest_depth = 64;                // of nested JSON
inline constexpr std::size_t largest_size = 64u << 20;  // bytes
inline constexpr int largest_order = 2000;              // of the harmonics
inline constexpr int largest_samples = 1'000'000;       // per period
inline constexpr int largest_steps = 10'000'000;        // per period, and with history in all
inline constexpr int largest_periods = 100'000'000;     // of a transient
inline constexpr int largest_search = 100'000'000;      // evaluations, and other whole numbers of a search
inline constexpr int largest_cases = 1000;              // of a design
inline constexpr std::size_t largest_count =
    5'000'000;  // JSON values in one file, so that memory stays bounded

/// Reads format "arcslip-scene-1". Throws SceneError with every fault found.
Scene read(std::istream& in);
/// The same from a file. Throws FileError where the file cannot be read.
Scene read_file(const std::string& path);

/// The resolved scene with every default, in the same format: read(write(s)) gives s again.
std::string write(const Scene& scene);
/// Checks a scene that was built or changed in code. Throws SceneError with the faults that reading
/// write(scene) finds.
void check(const Scene& scene);
/// Hash of the resolved scene (FNV-1a, 64 bits, 16 hexadecimal digits), kept in results.
std::string hash(const Scene& scene);

/// Names of all parameters: ties, then every "part.field" (a tied field still answers to its own name).
std::vector<std::string> parameter_names(const Scene& scene);
/// The fields behind a parameter, one for a "part.field" and one for each member of a tie. Throws
/// ParameterError.
std::vector<const Field*> parameter_fields(const Scene& scene, std::string_view parameter);
/// Value of a parameter. Throws ParameterError, with the nearest known name, where there is none.
double value(const Scene& scene, std::string_view parameter);
/// Gives a parameter a value and drops it from the lists of every study, as drop() does. Throws
/// ParameterError where there is no such parameter, where the value is out of its bounds, and where the field
/// is tied: its tie is to be set then.
void set(Scene& scene, std::string_view parameter, double value);
/// Takes a parameter from for_each, cases and scatter. Cases that are the same then become one, with the
/// largest of their weights (worst) or the sum of them (mean).
void drop(Study& study, std::string_view parameter);

/// Factor from the scene's frequency unit to rad/s.
double to_rad_per_s(FrequencyUnit unit);
/// "Hz" or "rad/s".
std::string_view unit_name(FrequencyUnit unit);
/// "frf", as a scene file writes it.
std::string_view kind_name(StudyKind kind);
/// "newmark-shooting", as a scene file writes it.
std::string_view method_name(TimeMethod method);
/// The method of that name, or none.
std::optional<TimeMethod> method_of(std::string_view name);
/// "worst", as a scene file writes it.
std::string_view criterion_name(Criterion criterion);
/// The criterion of that name, or none.
std::optional<Criterion> criterion_of(std::string_view name);

/// The known word nearest to `word` (edit distance at most a third of its length, at least 2), or "".
std::string nearest(std::string_view word, std::span<const std::string> known);

}  // namespace arcslip::scene
