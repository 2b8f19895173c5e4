#include "new_scene.hpp"

#include <arcslip/results/text.hpp>
#include <arcslip/scene/format/scene_file.hpp>
#include <arcslip/scene/keys/write_values.hpp>
#include <arcslip/studies/windows.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>
#include <utility>

namespace arcslip::app {
namespace {

using scene::file::Member;
using scene::file::Node;
using Object = Node::Object;

constexpr int digits_kept = 4;                       // of numbers that follow from others
constexpr double least_load = 0.05, most_load = 20;  // bounds of a normal load, over that of balance
constexpr double levels[] = {0.1, 0.3, 1, 3, 10};    // of a study for each of them
constexpr double smallest_motion = 1e-2, largest_motion = 10;  // of modes, over that where friction begins
constexpr double first_root_of_cantilever = 1.8751040687;      // of cos x cosh x = -1
constexpr double highest_over_first = 40;  // of a beam: its reduction, over the first mode
constexpr double circle = 2 * std::numbers::pi;

/// A number that follows from others, and how: for people, or as a scene has it.
struct Derived {
  double value;
  std::string formula;
  bool is_kept = false;  // the scene has the formula, which the number follows from then on
};

double rounded(double value) {
  return std::stod(results::to_digits(value, digits_kept));
}

Derived derived(double value, std::string formula) {
  return {rounded(value), std::move(formula)};
}

/// A number that is no parameter of its own: studies vary what it follows.
Derived kept(double value, std::string formula) {
  return {value, std::move(formula), true};
}

Node node(const char* text) {
  return {std::string(text)};
}
Node node(const std::string& text) {
  return {text};
}
Node node(double value) {
  return {value};
}
/// What is not kept as a formula has it in a comment.
Node node(const Derived& number) {
  return number.is_kept ? node(number.formula) : node(number.value);
}
Node node(const std::vector<double>& values) {
  return scene::file::node(values);
}
Node list(std::vector<Object> objects) {
  Node::List all;
  for (Object& each : objects) all.push_back({std::move(each)});
  return {std::move(all)};
}
Node to_ground(const std::string& place) {
  return {Node::List{node(place), node("ground")}};
}

/// "normal_load = 1.5 force/friction; ..." as the comment of a part.
std::string formulas(const std::vector<std::pair<std::string, Derived>>& numbers) {
  std::string text;
  for (const auto& [field, number] : numbers)
    if (!number.is_kept) text += (text.empty() ? "" : "; ") + field + " = " + number.formula;
  return text;
}

/// The values of the options.
class Given {
 public:
  Given(const NewKind& kind, const CommandOptions& options) : kind_(kind), options_(options) {}

  double operator()(const std::string& name) const {
    const auto given = options_.new_numbers.find(name);
    if (given != options_.new_numbers.end()) return given->second;
    const auto is = [&](const NewNumber& number) { return number.name == name; };
    return std::find_if(kind_.numbers.begin(), kind_.numbers.end(), is)->otherwise;
  }
  bool has(const std::string& name) const { return std::isfinite((*this)(name)); }
  std::string text(const std::string& name) const {
    const auto given = options_.new_texts.find(name);
    return given != options_.new_texts.end() ? given->second : "";
  }
  const CommandOptions& options() const { return options_; }

 private:
  const NewKind& kind_;
  const CommandOptions& options_;
};

/// Multiples of a number, for a study for each of them.
std::vector<double> multiples(double of) {
  std::vector<double> values;
  for (const double level : levels) values.push_back(rounded(level * of));
  return values;
}

Object head(const std::string& title, const std::string& comment) {
  return {{"format", node("arcslip-scene-2")},
          {"title", node(title)},
          {"comment", node(comment)},
          {"frequency_unit", node("Hz")}};
}

/// The constant "ratio", for formulas.
Member constant_ratio(double value, const std::string& help) {
  return {"constants", {Object{{"ratio", {Object{{"value", node(value)}, {"help", node(help)}}}}}}};
}

/// One mass on a spring and a damper, which the frequency and the damping ratio give.
Object one_mass(const std::string& dof, double mass, double frequency, double ratio) {
  return {{"dofs", {Node::List{node(dof)}}},
          {"masses", list({{{"name", node("m")}, {"at", node(dof)}, {"value", node(mass)}}})},
          {"springs",
           list({{{"name", node("k")},
                  {"at", node(dof)},
                  {"frequency", node(frequency)},
                  {"comment", node("frequency (Hz) of the mass on this spring; or give \"value\", N/m")}}})},
          {"dampers",
           list({{{"name", node("c")},
                  {"at", node(dof)},
                  {"damping_ratio", node(ratio)},
                  {"comment", node("without friction, of critical damping; or give \"value\", N s/m")}}})}};
}

Object force(const std::string& dof, double amplitude) {
  return {{"name", node("force")},
          {"at", node(dof)},
          {"cosine", node(amplitude)},
          {"comment", node("amplitude of the force, N")}};
}

/// frf for several values, the peaks over them and the optimum, of a normal load.
std::vector<Object> studies_of_load(const std::string& load, double balance) {
  const std::vector<double> bounds = {rounded(least_load * balance), rounded(most_load * balance)};
  return {{{"name", node("responses")},
           {"kind", node("frf")},
           {"for_each", {Object{{load, node(multiples(balance))}}}},
           {"comment", node("frequency responses for loads around force/friction")}},
          {{"name", node("peaks")},
           {"kind", node("peaks")},
           {"over", node(load)},
           {"from", node(bounds[0])},
           {"to", node(bounds[1])},
           {"comment", node("the resonance peak over the load, 0.05 to 20 times force/friction")}},
          {{"name", node("best load")},
           {"kind", node("optimum")},
           {"over", {Node::List{node(load)}}},
           {"bounds", {Node::List{node(bounds)}}},
           {"comment", node("the load with the lowest resonance peak, with a certificate")}}};
}

constexpr const char* ratio_of_contact = "stiffness of the contact over that of the spring";
constexpr const char* how_to_continue =
    "Written by arcslip new, in kg, m, s and N. Change any number; arcslip check describes the model, "
    "and "
    "arcslip run writes results and report.html";

Object damper(const Given& of) {
  const double mass = of("mass"), w = circle * of("frequency"), k = mass * w * w;
  const Derived contact = kept(of("contact-stiffness-ratio") * k, "ratio*k"),
                load = derived(of("force") / of("friction"), "force/friction");
  Object root = head("A mass with a friction damper", how_to_continue);
  root.push_back(constant_ratio(of("contact-stiffness-ratio"), ratio_of_contact));
  root.push_back({"structure", {one_mass("mass", mass, of("frequency"), of("damping-ratio"))}});
  root.push_back({"elements", list({{{"name", node("damper")},
                                     {"type", node("jenkins")},
                                     {"between", to_ground("mass")},
                                     {"stiffness", node(contact)},
                                     {"friction_coefficient", node(of("friction"))},
                                     {"normal_load", node(load)},
                                     {"comment", node("a spring in series with a slider; " +
                                                      formulas({{"normal_load", load}}))}}})});
  root.push_back({"excitation", list({force("mass", of("force"))})});
  root.push_back({"studies", list(studies_of_load("damper.normal_load", load.value))});
  return root;
}

/// Deflection of a cantilever at x under a force at its end x = 1, over that at the end.
double deflection_of_cantilever(double x) {
  return x * x * (3 - x) / 2;
}

Object beam(const Given& of) {
  const double length = of("length"), at = of("contact-position") * length;
  const double inertia = of("width") * std::pow(of("height"), 3) / 12;
  const double k = 3 * of("young") * inertia / std::pow(at, 3);
  const Derived contact =
      derived(of("contact-stiffness-ratio") * k,
              results::shortest(of("contact-stiffness-ratio")) + " * 3 E I/a^3, with the contact at a");
  const Derived load =
      derived(of("force") / of("friction") / deflection_of_cantilever(of("contact-position")),
              "force/friction, by the deflection of the tip over that of the contact");
  const double area = of("width") * of("height");
  const double first = first_root_of_cantilever * first_root_of_cantilever / (length * length) *
                       std::sqrt(of("young") * inertia / (of("density") * area)) / circle;
  const Derived highest = derived(highest_over_first * first, "40 times the first natural frequency");
  const std::string place = of("contact-position") == 1 ? "tip" : "contact";
  Object points;
  if (place != "tip") points.push_back({place, node(at)});
  points.push_back({"tip", node(length)});
  Object root = head("A cantilever beam with a friction damper", how_to_continue);
  root.push_back(
      {"structure",
       {Object{{"beam",
                {Object{{"elements", node(20.0)},
                        {"length", node(length)},
                        {"young", node(of("young"))},
                        {"density", node(of("density"))},
                        {"width", node(of("width"))},
                        {"height", node(of("height"))},
                        {"ends", {Node::List{node("clamped"), node("free")}}},
                        {"points", {points}},
                        {"highest_frequency", node(highest)},
                        {"comment", node("it bends along its height; m, Pa, kg/m^3; " +
                                         formulas({{"highest_frequency", highest}}))}}}},
               {"damping", list({{{"name", node("material")},
                                  {"type", node("modal")},
                                  {"ratio", node(of("damping-ratio"))},
                                  {"comment", node("damping ratio of each mode, without friction")}}})}}}});
  root.push_back(
      {"elements", list({{{"name", node("damper")},
                          {"type", node("jenkins")},
                          {"between", to_ground(place)},
                          {"stiffness", node(contact)},
                          {"friction_coefficient", node(of("friction"))},
                          {"normal_load", node(load)},
                          {"comment", node(formulas({{"stiffness", contact}, {"normal_load", load}}))}}})});
  root.push_back({"excitation", list({force("tip", of("force"))})});
  root.push_back({"response", {Object{{"at", node("tip")}}}});
  root.push_back({"studies", list(studies_of_load("damper.normal_load", load.value))});
  return root;
}

Object modes_over(const std::vector<double>& amplitudes, const std::string& comment) {
  return {{"name", node("mode")},
          {"kind", node("modes")},
          {"amplitude", node(amplitudes)},
          {"comment", node(comment)}};
}

Object duffing(const Given& of) {
  const double mass = of("mass"), w = circle * of("frequency"), k = mass * w * w;
  const double linear =
      of("force") / (2 * of("damping-ratio") * k);  // at resonance, without the cubic spring
  Object root = head("A Duffing oscillator", how_to_continue);
  root.push_back({"structure", {one_mass("x", mass, of("frequency"), of("damping-ratio"))}});
  root.push_back(
      {"elements",
       list({{{"name", node("cubic")},
              {"type", node("cubic_spring")},
              {"at", node("x")},
              {"stiffness", node(of("cubic-stiffness"))},
              {"comment", node("force = stiffness * x^3, N/m^3; negative: a spring that softens")}}})});
  root.push_back({"excitation", list({force("x", of("force"))})});
  root.push_back(
      {"studies",
       list({{{"name", node("responses")},
              {"kind", node("frf")},
              {"stability", {true}},
              {"for_each",
               {Object{{"force.cosine", node(std::vector{rounded(of("force") / 4), rounded(of("force") / 2),
                                                         of("force")})}}}},
              {"comment", node("unstable parts are dashed; folds are where the response jumps")}},
             modes_over({rounded(smallest_motion * linear), rounded(linear)},
                        "frequency of free motions over their amplitude: the backbone of the responses")})});
  return root;
}

Object contact(const Given& of) {
  const double mass = of("mass"), w = circle * of("frequency"), k = mass * w * w;
  const Derived tangential = kept(of("contact-stiffness-ratio") * k, "ratio*k"),
                normal = kept(of("contact-stiffness-ratio") * k, "ratio*k"),
                load = derived(of("force") / of("friction"), "force/friction"),
                press = kept(0.2 * of("force"), "0.2*force.cosine");
  Object structure = one_mass("slide", mass, of("frequency"), of("damping-ratio"));
  structure = {
      {"dofs", {Node::List{node("slide"), node("press")}}},
      {"masses", list({{{"name", node("m")}, {"at", node("slide")}, {"value", node(mass)}},
                       {{"name", node("m2")}, {"at", node("press")}, {"value", node(mass)}}})},
      {"springs", list({{{"name", node("k")}, {"at", node("slide")}, {"frequency", node(of("frequency"))}},
                        {{"name", node("k2")},
                         {"at", node("press")},
                         {"frequency", node(rounded(2 * of("frequency")))},
                         {"comment", node("twice the frequency of the sliding motion")}}})},
      {"dampers",
       list({{{"name", node("c")}, {"at", node("slide")}, {"damping_ratio", node(of("damping-ratio"))}},
             {{"name", node("c2")}, {"at", node("press")}, {"damping_ratio", node(of("damping-ratio"))}}})}};
  Object root = head("A mass that slides and presses on a contact", how_to_continue);
  root.push_back(constant_ratio(of("contact-stiffness-ratio"), ratio_of_contact));
  root.push_back({"structure", {structure}});
  root.push_back(
      {"elements", list({{{"name", node("contact")},
                          {"type", node("contact_2d")},
                          {"tangential", {Object{{"at", node("slide")}}}},
                          {"normal", {Object{{"at", node("press")}}}},
                          {"tangential_stiffness", node(tangential)},
                          {"normal_stiffness", node(normal)},
                          {"friction_coefficient", node(of("friction"))},
                          {"normal_load", node(load)},
                          {"comment", node("the normal load varies with the motion and may vanish; " +
                                           formulas({{"normal_load", load}}))}}})});
  root.push_back(
      {"excitation", list({force("slide", of("force")),
                           {{"name", node("pressing")}, {"at", node("press")}, {"sine", node(press)}}})});
  root.push_back({"response", {Object{{"at", node("slide")}}}});
  root.push_back({"studies", list(studies_of_load("contact.normal_load", load.value))});
  return root;
}

Object joint(const Given& of) {
  const double mass = of("mass"), w = circle * of("frequency"), k = mass * w * w;
  const double of_joint = of("joint-stiffness-ratio") * k;
  const Derived stiffness = kept(of_joint, "ratio*k");
  const double slip = of("slip-force") / of_joint;  // deflection of the joint at macroslip, without microslip
  Object root = head("A mass on a joint with microslip", how_to_continue);
  root.push_back(
      constant_ratio(of("joint-stiffness-ratio"), "stiffness of the joint over that of the spring"));
  root.push_back({"structure", {one_mass("mass", mass, of("frequency"), of("damping-ratio"))}});
  root.push_back(
      {"elements",
       list({{{"name", node("joint")},
              {"type", node("iwan")},
              {"distribution", node("four-parameter")},
              {"between", to_ground("mass")},
              {"stiffness", node(stiffness)},
              {"slip_force", node(of("slip-force"))},
              {"exponent", node(-0.5)},
              {"beta", node(0.1)},
              {"comment", node("Segalman's four-parameter Iwan model, fitted to tests; in microslip the "
                               "dissipation grows as amplitude^(3 + exponent)")}}})});
  root.push_back({"excitation", list({force("mass", of("force"))})});
  root.push_back(
      {"studies", list({{{"name", node("responses")},
                         {"kind", node("frf")},
                         {"for_each", {Object{{"force.cosine", node(multiples(of("force")))}}}},
                         {"comment", node("frequency responses for forces of several sizes")}},
                        modes_over({rounded(smallest_motion * slip), rounded(slip)},
                                   "frequency and damping ratio over the amplitude, up to macroslip")})});
  return root;
}

/// A path as the scene has it, relative to the folder of the scene.
std::string from_scene(const std::string& path, const std::string& scene) {
  namespace fs = std::filesystem;
  const fs::path file(path);
  if (path.empty() || scene.empty() || file.is_absolute()) return path;
  const fs::path folder = fs::absolute(fs::path(scene)).lexically_normal().parent_path();
  return fs::absolute(file).lexically_normal().lexically_relative(folder).string();
}

/// The names of the rows that the scene uses: those of a file, or made of the numbers of the options.
struct RowNames {
  std::string file, force, response, contact;
};

RowNames row_names(const Given& of, NewScene& scene) {
  const std::string out = of.options().out, names = of.text("names");
  RowNames all{from_scene(names, out), of.text("at"), of.text("response"), of.text("contact")};
  if (all.force.empty())
    throw UsageError(
        "new from-matrices needs --at ROW, the row that the force acts on: its number, from 1, or "
        "its name in the file of --names");
  if (all.response.empty()) all.response = all.force;
  if (!names.empty()) return all;
  if (out.empty())
    throw UsageError(
        "new from-matrices writes the names of the rows next to the scene: give --out FILE, or "
        "--names FILE with names of your own");
  std::string text = "name,row\n";
  std::vector<std::string> written;
  for (std::string* row : {&all.force, &all.response, &all.contact}) {
    if (row->empty()) continue;
    if (row->find_first_not_of("0123456789") != std::string::npos)
      throw UsageError("the row \"" + results::visible(*row) +
                       "\" is no number: give --names FILE, a CSV file "
                       "with the columns name and row");
    *row = "row" + *row;
    if (std::find(written.begin(), written.end(), *row) == written.end())
      text += *row + "," + row->substr(3) + "\n";
    written.push_back(*row);
  }
  const std::filesystem::path file = std::filesystem::path(out).replace_extension(".names.csv");
  scene.files.emplace_back(file.string(), text);
  all.file = file.filename().string();
  return all;
}

Object from_matrices(const Given& of, NewScene& scene) {
  const std::string out = of.options().out;
  const RowNames rows = row_names(of, scene);
  Object matrices{{"mass", node(from_scene(of.text("M.mtx"), out))},
                  {"stiffness", node(from_scene(of.text("K.mtx"), out))}};
  if (const std::string damping = of.text("damping"); !damping.empty())
    matrices.push_back({"damping", node(from_scene(damping, out))});
  if (of.has("highest-frequency")) matrices.push_back({"highest_frequency", node(of("highest-frequency"))});
  matrices.push_back({"comment", node("kg, N/m, N s/m; \"highest_frequency\" (Hz) reduces large matrices")});
  Object structure{{"matrices", {matrices}}, {"names", node(rows.file)}};
  const bool has_own = !of.text("damping").empty() && of.options().new_numbers.count("damping-ratio") == 0;
  if (!has_own)
    structure.push_back({"damping", list({{{"name", node("material")},
                                           {"type", node("modal")},
                                           {"ratio", node(of("damping-ratio"))},
                                           {"comment", node("damping ratio of each mode")}}})});
  Object root = head("A structure from matrices", how_to_continue);
  root.push_back({"structure", {structure}});
  const bool has_contact = !rows.contact.empty();
  const double balance = of("force") / of("friction");
  if (has_contact) {
    if (!of.has("contact-stiffness")) throw UsageError("--contact needs --contact-stiffness K, in N/m");
    root.push_back({"elements", list({{{"name", node("damper")},
                                       {"type", node("jenkins")},
                                       {"between", to_ground(rows.contact)},
                                       {"stiffness", node(of("contact-stiffness"))},
                                       {"friction_coefficient", node(of("friction"))},
                                       {"normal_load", node(rounded(balance))},
                                       {"comment", node("normal_load = force/friction")}}})});
  }
  root.push_back({"excitation", list({force(rows.force, of("force"))})});
  root.push_back({"response", {Object{{"at", node(rows.response)}}}});
  std::vector<Object> studies = {{{"name", node("responses")}, {"kind", node("frf")}}};
  if (has_contact) studies = studies_of_load("damper.normal_load", balance);
  root.push_back({"studies", list(std::move(studies))});
  return root;
}

/// Writes the windows that are proposed into the studies of the scene.
void add_windows(Object& root, const std::string& folder, const scene::Catalogue& catalogue,
                 const NewScene& files, const control::Control& control) {
  std::vector<scene::NamedFile> known;
  for (const auto& [path, text] : files.files)
    known.push_back(
        {std::filesystem::path(path).filename().string(), std::make_shared<const std::string>(text)});
  scene::Scene scene =
      scene::read(scene::file::print_tree({root}), catalogue, folder, std::move(known), control);
  auto& studies = std::get<Node::List>(root.back().value.value);
  for (std::size_t i = 0; i < scene.studies.size(); ++i) {
    if (studies::propose_window(scene, i, control).empty()) continue;
    const scene::Study& study = scene.studies[i];
    Object written;
    study.type->settings().write(study.settings, scene, written);
    auto& object = std::get<Object>(studies[i].value);
    const auto keys = study.type->keys();
    for (const Member& member : written) {
      const bool is_window = std::any_of(keys.begin(), keys.end(), [&](const scene::Key& key) {
        return key.name == member.key && key.unit == "frequency";
      });
      if (is_window) object.insert(object.end() - (object.back().key == "comment" ? 1 : 0), member);
    }
  }
}

}  // namespace

const std::vector<NewKind>& new_kinds() {
  const NewNumber mass{"mass", "mass", 1, "kg"},
      frequency{"frequency", "natural frequency without friction", 50, "Hz"},
      ratio{"damping-ratio", "damping ratio without friction, of critical damping", 0.002, "-", false, 1},
      stiffness{"contact-stiffness-ratio", "stiffness of the contact, over that of the structure", 0.1, "-"},
      friction{"friction", "friction coefficient", 0.3, "-"}, load{"force", "amplitude of the force", 1, "N"};
  static const std::vector<NewKind> kinds = {
      {"damper",
       "a mass with a friction damper, and its best load",
       {mass, frequency, ratio, stiffness, friction, load}},
      {"beam",
       "a cantilever with a friction damper, and its best load",
       {{"length", "length", 1, "m"},
        {"width", "width", 0.04, "m"},
        {"height", "height, along which it bends", 0.02, "m"},
        {"young", "Young's modulus", 2.1e11, "Pa"},
        {"density", "density", 7850, "kg/m^3"},
        ratio,
        {"contact-position", "place of the contact, over the length", 0.5, "-", true, 1},
        stiffness,
        friction,
        load}},
      {"duffing",
       "a Duffing oscillator: responses with their stability, and the backbone",
       {mass,
        {"frequency", "natural frequency of small motions", 1, "Hz"},
        {"damping-ratio", "damping ratio of small motions", 0.01, "-", true, 1},
        {"cubic-stiffness", "stiffness of the cubic spring", 500, "N/m^3", false},
        {"force", "amplitude of the force", 0.1, "N"}}},
      {"contact",
       "a mass on a contact whose normal load varies, and its best load",
       {mass, frequency, ratio, stiffness, friction, load}},
      {"joint",
       "a mass on a joint with microslip: responses, and damping over the amplitude",
       {mass,
        frequency,
        ratio,
        {"joint-stiffness-ratio", "stiffness of the joint, over that of the rest", 1, "-"},
        {"slip-force", "force of macroslip", 50, "N"},
        load}},
      {"from-matrices",
       "a structure of mass and stiffness matrices",
       {{"highest-frequency", "reduce the matrices up to this frequency; required above 500 rows", NAN, "Hz"},
        {"damping-ratio", "damping ratio of each mode, in addition to --damping", 0.005, "-", false, 1},
        {"contact-stiffness", "stiffness of a friction damper at the row of --contact", NAN, "N/m"},
        friction,
        load},
       {{"at", "row of the force: its number, from 1, or its name", "ROW"},
        {"response", "row of the response (default: that of the force)", "ROW"},
        {"contact", "row of a friction damper to ground (default: none)", "ROW"},
        {"names", "names of rows, a CSV file with the columns name and row", "FILE"},
        {"damping", "damping matrix", "C.mtx"}},
       {"M.mtx", "K.mtx"}}};
  return kinds;
}

NewScene new_scene(const CommandOptions& options, const scene::Catalogue& catalogue,
                   const control::Control& control) {
  const auto& kinds = new_kinds();
  const auto kind = std::find_if(kinds.begin(), kinds.end(),
                                 [&](const NewKind& each) { return each.name == options.new_kind; });
  const Given of(*kind, options);
  NewScene scene;
  const std::function<Object(const Given&)> make[] = {
      damper, beam, duffing, contact, joint, [&](const Given& given) { return from_matrices(given, scene); }};
  Object root = make[static_cast<std::size_t>(kind - kinds.begin())](of);
  const std::string folder = std::filesystem::path(options.out).parent_path().string();
  add_windows(root, folder, catalogue, scene, control);
  scene.text = scene::file::print_tree({root});
  return scene;
}

}  // namespace arcslip::app
