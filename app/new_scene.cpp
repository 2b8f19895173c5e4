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
#include <optional>
#include <utility>

namespace arcslip::app {
namespace {

using scene::file::Member;
using scene::file::Node;
using Object = Node::Object;

constexpr int digits_kept = 4;                       // of numbers that follow from others
constexpr int digits_of_window = 3;                  // over the natural frequency
constexpr double least_load = 0.05, most_load = 20;  // bounds of a normal load, over that of balance
constexpr double levels[] = {0.1, 0.3, 1, 3, 10};    // of a study for each of them
constexpr double smallest_motion = 1e-2;  // of modes, over that where friction begins
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

Member constant(const std::string& name, Node value, const std::string& help) {
  return {name, {Object{{"value", std::move(value)}, {"help", node(help)}}}};
}

/// The stiffness of a contact or joint over that of the structure, for formulas.
Member ratio(double value, const std::string& of) {
  return constant("ratio", node(value), "stiffness of the " + of + " over that of the spring");
}

/// The load of a contact that the bounds of studies follow. share: of the motion of the response that it has.
Member balance(const std::string& contact, double share = 1) {
  std::string value = "force.cosine/" + contact + ".friction_coefficient";
  if (share != 1) value += "/" + results::shortest(share);
  return constant("balance", node(value),
                  share == 1 ? "normal load at which the friction limit equals the force, N"
                             : "normal load at which friction balances the force, by the deflections, N");
}

constexpr const char* natural_frequency = "f0";

/// The frequency that windows follow.
Member frequency_of_mass(const std::string& when) {
  return constant(natural_frequency, node("sqrt(k/m)/(2*pi)"), "natural frequency " + when + ", Hz");
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

/// A number that follows a constant.
Node times(double factor, const std::string& constant) {
  return node(results::shortest(factor) + "*" + constant);
}

/// frf for several values, the peaks over them and the optimum, of a normal load. value: of the constant
/// balance.
std::vector<Object> studies_of_load(const std::string& load, double value) {
  const Node least = times(least_load, "balance"), most = times(most_load, "balance");
  return {{{"name", node("responses")},
           {"kind", node("frf")},
           {"for_each", {Object{{load, node(multiples(value))}}}},
           {"comment", node("frequency responses for loads around force/friction")}},
          {{"name", node("peaks")},
           {"kind", node("peaks")},
           {"over", node(load)},
           {"from", least},
           {"to", most},
           {"comment", node("the resonance peak over the load")}},
          {{"name", node("best load")},
           {"kind", node("optimum")},
           {"over", {Node::List{node(load)}}},
           {"bounds", {Node::List{{Node::List{least, most}}}}},
           {"comment", node("the load with the lowest resonance peak, with a certificate")}}};
}

constexpr const char* how_to_continue =
    "Written by arcslip new, in kg, m, s and N. Change any number; arcslip check describes the model, "
    "and "
    "arcslip run writes results and report.html";

Object damper(const Given& of) {
  const double mass = of("mass"), w = circle * of("frequency"), k = mass * w * w;
  const Derived contact = kept(of("contact-stiffness-ratio") * k, "ratio*k"),
                load = derived(of("force") / of("friction"), "force/friction");
  Object root = head("A mass with a friction damper", how_to_continue);
  root.push_back({"constants",
                  {Object{ratio(of("contact-stiffness-ratio"), "contact"),
                          frequency_of_mass("without friction"), balance("damper")}}});
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
  root.push_back({"studies", list(studies_of_load("damper.normal_load", of("force") / of("friction")))});
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
  const double deflection = rounded(deflection_of_cantilever(of("contact-position")));
  const Derived load = derived(of("force") / of("friction") / deflection,
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
  root.push_back({"constants", {Object{balance("damper", deflection)}}});
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
  root.push_back(
      {"studies", list(studies_of_load("damper.normal_load", of("force") / of("friction") / deflection))});
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
  root.push_back({"constants", {Object{frequency_of_mass("of small motions")}}});
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
  root.push_back({"constants",
                  {Object{ratio(of("contact-stiffness-ratio"), "contact"),
                          frequency_of_mass("of sliding without friction"), balance("contact")}}});
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
  root.push_back({"studies", list(studies_of_load("contact.normal_load", of("force") / of("friction")))});
  return root;
}

Object joint(const Given& of) {
  const double mass = of("mass"), w = circle * of("frequency"), k = mass * w * w;
  const double of_joint = of("joint-stiffness-ratio") * k;
  const Derived stiffness = kept(of_joint, "ratio*k");
  const double slip = of("slip-force") / of_joint;  // deflection of the joint at macroslip, without microslip
  Object root = head("A mass on a joint with microslip", how_to_continue);
  root.push_back({"constants",
                  {Object{ratio(of("joint-stiffness-ratio"), "joint"), frequency_of_mass("without joint")}}});
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
  const bool has_contact = !rows.contact.empty();
  if (has_contact) root.push_back({"constants", {Object{balance("damper")}}});
  root.push_back({"structure", {structure}});
  const double load = of("force") / of("friction");
  if (has_contact) {
    if (!of.has("contact-stiffness")) throw UsageError("--contact needs --contact-stiffness K, in N/m");
    root.push_back({"elements", list({{{"name", node("damper")},
                                       {"type", node("jenkins")},
                                       {"between", to_ground(rows.contact)},
                                       {"stiffness", node(of("contact-stiffness"))},
                                       {"friction_coefficient", node(of("friction"))},
                                       {"normal_load", node(rounded(load))},
                                       {"comment", node("normal_load = force/friction")}}})});
  }
  root.push_back({"excitation", list({force(rows.force, of("force"))})});
  root.push_back({"response", {Object{{"at", node(rows.response)}}}});
  std::vector<Object> studies = {{{"name", node("responses")}, {"kind", node("frf")}}};
  if (has_contact) studies = studies_of_load("damper.normal_load", load);
  root.push_back({"studies", list(std::move(studies))});
  return root;
}

/// Frequencies as multiples of the constant f0, for a scene that has it.
Node following(const Node& window, std::optional<double> f0) {
  if (!f0) return window;
  if (const auto* value = std::get_if<double>(&window.value))
    return node(results::to_digits(*value / *f0, digits_of_window) + "*" + natural_frequency);
  const auto* values = std::get_if<Node::List>(&window.value);
  if (values == nullptr) return window;
  Node::List all;
  for (const Node& each : *values) all.push_back(following(each, f0));
  return {std::move(all)};
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
  const auto names = scene::parameter_names(scene);
  std::optional<double> f0;
  if (std::find(names.begin(), names.end(), natural_frequency) != names.end())
    f0 = scene::value(scene, natural_frequency);
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
      if (is_window)
        object.insert(object.end() - (object.back().key == "comment" ? 1 : 0),
                      {member.key, following(member.value, f0)});
    }
  }
}

}  // namespace

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
