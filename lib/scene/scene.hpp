#pragma once
// A scene, validated and resolved, as plain data in the user's units.

#include <arcslip/control/error.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/sampling/sampler.hpp>
#include <arcslip/scene/field.hpp>
#include <arcslip/scene/matrices.hpp>
#include <arcslip/scene/named_file.hpp>
#include <arcslip/scene/number_text.hpp>
#include <arcslip/scene/settings.hpp>

#include <cstddef>
#include <iosfwd>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace arcslip::scene {

class PartType;   // part_type.hpp
class StudyType;  // study_type.hpp
struct Catalogue;

enum class FrequencyUnit { hertz, radian_per_second };
enum class Friction { exact, sampled };
/// Changes of contact states along a branch: each is located, or they are passed where the curve allows it;
/// automatic: passed with many contacts.
enum class Kinks { automatic, located, passed };
enum class Frame { relative, absolute };  // of a response: relative to the ground or not
/// The direction in which a part acts on the degrees of freedom: sum of weight * x_dof. Ground has no term.
struct Term {
  int dof;
  double weight;
  bool next = false;  // of the next sector (Cyclic)
  friend bool operator==(const Term&, const Term&) = default;
};
using Direction = std::vector<Term>;

/// A mass, spring, damper, element or force: a type, its directions, and one value for each of its fields.
struct Part {
  std::string name;
  const PartType* type = nullptr;
  std::vector<Direction> directions;  // of the type's slots; one if it has none
  std::vector<double> values;
  int harmonic = 1;                 // excitation only: its harmonic; 0: constant
  Settings options{};               // of the type; empty: its defaults
  double wear_coefficient = 0;      // of elements that dissipate: volume worn for the energy, m^3/J
  bool detailed = true;             // false: an element of a patch of which results have the totals alone
  std::vector<NumberText> texts{};  // of the values, as many as them, or none: all are plain numbers

  std::span<const Field> fields() const;
  /// The formula of a value; null: it is a parameter.
  const NumberText* formula(std::size_t field) const {
    return field < texts.size() && texts[field].follows() ? &texts[field] : nullptr;
  }
  friend bool operator==(const Part&, const Part&) = default;
};

/// Made in code: a fixed order of 7. A file without "harmonics" has an accuracy of 1e-4, with an order of up
/// to 55, which functions that run no study take; set both where a scene comes from a file.
struct Harmonics {
  int order = 7;   // highest harmonic N of the base frequency, 1 to 2000
  int period = 1;  // of the motion, in periods of the excitation; base frequency = its frequency/period
  Friction friction = Friction::exact;
  int samples = 512;  // samples per period where friction is sampled
  /// If not 0, studies choose the order by it, up to `order`: of amplitudes, relative to the largest one
  /// (studies/order_selection.hpp). Functions that run no study use `order`.
  double accuracy = 0;
  Kinks kinks = Kinks::automatic;
  bool chosen = false;  // the order is one that a study tries by its accuracy: all points are estimated
  friend bool operator==(const Harmonics&, const Harmonics&) = default;
};

/// Lists of values by parameter name; several lists form their product.
using ValueLists = std::vector<std::pair<std::string, std::vector<double>>>;

/// A study as data: its kind, its settings, and values of parameters for which it is repeated.
struct Study {
  std::string name;
  const StudyType* type = nullptr;
  Settings settings{};
  ValueLists for_each{};
  bool in_rows = false;      // for_each: the k-th values of all lists together, instead of every combination
  NamedFile rows_file{};     // the CSV file that for_each names, whose rows these are
  sampling::Plan samples{};  // for_each by distributions, in place of lists
  /// Numbers of the settings that are formulas, by their JSON pointers in the study.
  std::vector<std::pair<std::string, NumberText>> texts{};
  friend bool operator==(const Study&, const Study&) = default;
};

/// An observed motion.
struct Response {
  std::string name{};  // empty for a single unnamed response
  Direction direction{};
  std::vector<Direction> others{};  // of "max_of": amplitudes are the largest of `direction` and of these
  Frame frame = Frame::relative;
  friend bool operator==(const Response&, const Response&) = default;
};

/// The structure is one sector of a ring of equal ones, which moves in the wave of its engine order: the
/// excitation and the motion of each sector are those of the one before, later by engine_order/sectors of a
/// period of the excitation.
struct Cyclic {
  int sectors;
  int engine_order;
  friend bool operator==(const Cyclic&, const Cyclic&) = default;
};

/// For the elements of one response, whose results do not depend on them. Not of the file, and not compared.
struct Threads {
  int count = 1;
  friend bool operator==(const Threads&, const Threads&) { return true; }
};

/// The types of the parts and studies, whose ownership scenes share. Not of the file, and not compared. None
/// in scenes made in code: their types have to outlive them.
struct SharedCatalogue {
  std::shared_ptr<const Catalogue> all{};
  friend bool operator==(const SharedCatalogue&, const SharedCatalogue&) { return true; }
};

struct Scene {
  std::string title;
  std::vector<std::pair<std::string, std::string>> labels{};  // of axes in figures, by parameter or quantity
  FrequencyUnit frequency_unit = FrequencyUnit::hertz;
  std::vector<std::string> dofs;  // first those of the rows of the matrices that have names
  std::optional<Matrices> matrices{};
  std::optional<Cyclic> cyclic{};
  std::vector<Part> damping{};   // in proportion to masses and stiffnesses
  std::vector<Part> rotation{};  // at most one
  std::vector<Part> masses, springs, dampers, elements;
  std::vector<Part> patches;  // of contacts (patch.hpp), which all_elements() has after the elements
  std::vector<Part> excitation;
  std::vector<Constant> constants{};
  Harmonics harmonics;
  std::vector<Response> responses{1};  // at least one: the first defines the amplitude
  std::vector<Study> studies;
  Folder folder{};    // of its file
  Threads threads{};  // that may be used
  SharedCatalogue catalogue{};

  const Direction& response() const { return responses.front().direction; }
  Direction& response() { return responses.front().direction; }
  friend bool operator==(const Scene&, const Scene&) = default;
};

/// The elements, then those of the patches.
std::vector<Part> all_elements(const Scene& scene);

/// The types of the other sections. Fields: value; value; value; cosine, sine of each excitation.
const PartType& mass_type();
const PartType& spring_type();
const PartType& damper_type();
const PartType& force_type();
/// Damping of the whole structure, but not of elements: C = alpha M + beta K; a complex stiffness
/// K (1 + i loss_factor); or the same damping ratio for every mode of the structure. One part of each.
const PartType& rayleigh_type();
const PartType& loss_factor_type();
const PartType& modal_damping_type();
std::span<const PartType* const> damping_types();
/// The speed (rad/s) of a rotating structure, by which its stiffness is K + speed^2 K2.
const PartType& rotation_type();
/// Motions of the ground along the part's direction r: the ground under degree of freedom i moves by r_i
/// times the displacement (m) or acceleration (m/s^2). Displacements are relative to the ground. With
/// matrices from files r is a vector over all their rows (shape.hpp), as the force of a pressure field is.
const PartType& base_displacement_type();
const PartType& base_acceleration_type();
std::span<const PartType* const> excitation_types();
/// Whether it is one of the motions of the ground.
bool is_base_motion(const PartType& type);

/// One fault of a scene file.
struct Fault {
  std::string pointer;  // JSON pointer (RFC 6901), "" for the file as a whole
  std::string message;  // what was found, what is allowed, and the nearest known key, if any
};

/// All faults of a scene. what() lists them, one per line.
class SceneError : public Error {
 public:
  explicit SceneError(std::vector<Fault> faults);
  const std::vector<Fault>& faults() const { return faults_; }

 private:
  std::vector<Fault> faults_;
};

/// A file that cannot be opened or read.
class FileError : public Error {
  using Error::Error;
};

/// An unknown parameter, or a value outside its bounds.
class ParameterError : public Error {
  using Error::Error;
};

inline constexpr int largest_depth = 64;                                   // of nested JSON
inline constexpr std::size_t largest_size = 64u << 20;                     // bytes
inline constexpr int largest_order = 2000;                                 // of the harmonics
inline constexpr double finest_accuracy = 1e-10, coarsest_accuracy = 0.1;  // of the harmonics
// Of a scene file that gives neither an accuracy nor an order.
inline constexpr double default_accuracy = 1e-4;
inline constexpr int largest_chosen_order = 499;   // by an accuracy, unless the scene gives another one
inline constexpr int largest_period = 100;         // of a motion, in periods of the excitation
inline constexpr int largest_samples = 1'000'000;  // per period
inline constexpr std::size_t largest_count =
    5'000'000;  // JSON values in one file, so that memory stays bounded

/// Reads format "arcslip-scene-2", and "arcslip-scene-1". catalogue: the laws of force and the kinds of studies that it may hold, as
/// studies::catalogue(). folder: base of its relative paths. Throws SceneError with every fault found.
Scene read(std::istream& in, const Catalogue& catalogue, const std::string& folder = {});
/// The same from a file, with its folder. Throws FileError if the file cannot be read, and SceneError for a
/// file whose writing was interrupted, according to the manifest next to it (scene/files/manifest.hpp).
Scene read_file(const std::string& path, const Catalogue& catalogue);

/// The resolved scene with every default, in the same format: read(write(s)) gives s again.
std::string write(const Scene& scene);
/// Validates a scene built or changed in code. Throws SceneError with the faults that reading write(scene)
/// would find.
void check(const Scene& scene);
/// All files named by the scene.
std::vector<NamedFile*> files(Scene& scene);
/// The same scene relative to another folder: paths are adjusted to refer to the same files.
Scene from_folder(Scene scene, const std::string& folder);

/// Hash of the resolved scene and of the content of its named files (FNV-1a, 64 bits, 16 hexadecimal digits),
/// stored in results.
std::string hash(const Scene& scene);

/// Names of all parameters: constants, then every "part.field", also those given by formulas.
std::vector<std::string> parameter_names(const Scene& scene);
/// Name, unit, bounds and help of a parameter, valid as long as the scene. The bounds of a constant are also
/// those of the numbers that are this constant alone. Throws ParameterError.
Field parameter_field(const Scene& scene, std::string_view parameter);
/// The formula that gives a parameter; null: it is given by its value. Throws ParameterError.
const NumberText* parameter_formula(const Scene& scene, std::string_view parameter);
/// Value of a parameter: a constant, "part.field", or "part" for "part.value". Throws ParameterError, with
/// the nearest known name, if it is unknown.
double value(const Scene& scene, std::string_view parameter);
/// Sets a parameter, with all numbers whose formulas have it, and drops it from the lists of every study, as
/// drop() does. Throws ParameterError for an unknown parameter, one that is given by a formula, and a value
/// by which a number would be out of its bounds; the scene is then as before.
void set(Scene& scene, std::string_view parameter, double value);
/// Gives a parameter by a text: a formula of others, "0.12*k", or a number with a unit, "0.2 mm". Throws
/// ParameterError where set() does, and for a formula that is wrong or follows the parameter itself.
void set_text(Scene& scene, std::string_view parameter, const std::string& text);
/// Removes a parameter from for_each and from the lists in the study's settings.
void drop(Study& study, std::string_view parameter);

/// Factor from the scene's frequency unit to rad/s.
double to_rad_per_s(FrequencyUnit unit);
/// "Hz" or "rad/s".
std::string_view unit_name(FrequencyUnit unit);
/// The known word nearest to `word` (edit distance at most a third of its length, at least 2), or "".
std::string nearest(std::string_view word, std::span<const std::string> known);

}  // namespace arcslip::scene
