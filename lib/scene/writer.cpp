// A scene as the tree of its file, with every default.
#include <arcslip/scene/json_tree.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/scene/words.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace arcslip::scene {
namespace detail {
namespace {

Node node(std::string_view text) {
  return {std::string(text)};
}

Node node(double value) {
  return {value};
}

Node node(int value) {
  return {static_cast<double>(value)};
}

Node node(const std::vector<double>& values) {
  Node::List list;
  for (const double value : values) {
    list.push_back(node(value));
  }
  return {std::move(list)};
}

Node node(const std::vector<std::string>& texts) {
  Node::List list;
  for (const std::string& text : texts) {
    list.push_back(node(text));
  }
  return {std::move(list)};
}

// "at", "between" or "direction", whichever is the plainest that gives the same terms in the same order.
Member place_member(const Direction& direction, const std::vector<std::string>& dofs) {
  const auto name = [&](std::size_t i) { return dofs[static_cast<std::size_t>(direction[i].dof)]; };
  if (direction.size() == 1 && direction[0].weight == 1) {
    return {"at", node(name(0))};
  }
  if (direction.size() == 2 && direction[0].weight == 1 && direction[1].weight == -1) {
    return {"between", node(std::vector<std::string>{name(0), name(1)})};
  }
  Node::Object weights;
  for (std::size_t i = 0; i < direction.size(); ++i) {
    weights.push_back({name(i), node(direction[i].weight)});
  }
  return {"direction", {std::move(weights)}};
}

Node node(const std::vector<Part>& parts, const std::vector<std::string>& dofs, bool with_type = false) {
  Node::List list;
  for (const Part& part : parts) {
    Node::Object object = {{"name", node(part.name)}};
    if (with_type) {
      object.push_back({"type", node(part.type->name)});
    }
    object.push_back(place_member(part.direction, dofs));
    if (part.type == &force_type) {
      object.push_back({"harmonic", node(part.harmonic)});
    }
    for (std::size_t i = 0; i < part.type->fields.size(); ++i) {
      object.push_back({std::string(part.type->fields[i].name), node(part.values[i])});
    }
    list.push_back({std::move(object)});
  }
  return {std::move(list)};
}

Node node(const std::vector<Tie>& ties) {
  Node::Object object;
  for (const Tie& tie : ties) {
    object.push_back({tie.name, node(tie.members)});
  }
  return {std::move(object)};
}

Node node(const Harmonics& harmonics) {
  return {Node::Object{{"order", node(harmonics.order)},
                       {"friction", node(word_of(friction_methods, harmonics.friction))},
                       {"samples", node(harmonics.samples)}}};
}

void add_limits(double at_least, double at_most, Node::Object& object) {
  if (std::isfinite(at_least)) {
    object.push_back({"at_least", node(at_least)});
  }
  if (std::isfinite(at_most)) {
    object.push_back({"at_most", node(at_most)});
  }
}

Node node(const std::vector<std::pair<std::string, double>>& values) {
  Node::Object object;
  for (const auto& [name, value] : values) {
    object.push_back({name, node(value)});
  }
  return {std::move(object)};
}

Node constraints_node(const Study& study) {
  Node::List list;
  for (const ObservableLimit& limit : study.constraints) {
    Node::Object each = {{"observable", node(limit.observable)}};
    add_limits(limit.at_least, limit.at_most, each);
    list.push_back({std::move(each)});
  }
  for (const LinearLimit& limit : study.linear_constraints) {
    Node::Object each = {{"sum", node(limit.weights)}};
    add_limits(limit.at_least, limit.at_most, each);
    list.push_back({std::move(each)});
  }
  return {std::move(list)};
}

Node node(const std::vector<DesignCase>& cases, const std::vector<std::string>& dofs) {
  Node::List list;
  for (const DesignCase& each : cases) {
    Node::Object object = {{"set", node(each.set)}, {"weight", node(each.weight)}};
    if (each.response) {
      object.push_back({"response", {Node::Object{place_member(*each.response, dofs)}}});
    }
    list.push_back({std::move(object)});
  }
  return {std::move(list)};
}

// What a study of kind optimum has between its kind and for_each.
void add_design(const Study& study, const std::vector<std::string>& dofs, Node::Object& object) {
  std::vector<std::string> over;
  Node::List bounds;
  for (const DesignVariable& variable : study.design) {
    over.push_back(variable.name);
    bounds.push_back(node(std::vector{variable.lower, variable.upper}));
  }
  object.push_back({"over", node(over)});
  object.push_back({"bounds", {std::move(bounds)}});
  object.push_back({"frequency", node(std::vector{study.frequency_from, study.frequency_to})});
  for (const auto& [key, name] :
       {std::pair{"algorithm", study.search.algorithm}, std::pair{"local", study.search.local}}) {
    if (!name.empty()) {
      object.push_back({key, node(name)});
    }
  }
  object.push_back({"evaluations", node(study.search.evaluations)});
  object.push_back({"seconds", node(study.search.seconds)});
  object.push_back({"population", node(study.search.population)});
  object.push_back({"seed", node(study.search.seed)});
  object.push_back({"constraints", constraints_node(study)});
  if (!study.cases.empty()) {
    object.push_back({"cases", node(study.cases, dofs)});
  }
  object.push_back({"criterion", node(word_of(criteria, study.criterion))});
  Node::Object scatter;
  for (const DesignVariable& variable : study.scatter) {
    scatter.push_back({variable.name, node(std::vector{variable.lower, variable.upper})});
  }
  object.push_back({"scatter", {std::move(scatter)}});
  if (study.along) {
    object.push_back({"along", node(study.along->name)});
    object.push_back({"from", node(study.along->lower)});
    object.push_back({"to", node(study.along->upper)});
  }
}

Node node(const Study& study, const std::vector<std::string>& dofs) {
  const bool is_time = study.kind == StudyKind::time;
  const bool is_optimum = study.kind == StudyKind::optimum;
  const bool has_over = study.kind != StudyKind::frf && !is_time && !is_optimum;
  Node::Object object = {{"name", node(study.name)}, {"kind", node(word_of(study_kinds, study.kind))}};
  if (has_over) {
    object.push_back({"over", node(study.over)});
  }
  if (is_optimum) {
    add_design(study, dofs, object);
  } else if (!is_time) {
    object.push_back({"from", node(study.from)});
    object.push_back({"to", node(study.to)});
  }
  if (has_over || is_time) {
    object.push_back({"frequency", is_time || study.kind == StudyKind::trace
                                       ? node(study.frequency_from)
                                       : node(std::vector{study.frequency_from, study.frequency_to})});
  }
  if (is_time) {
    object.push_back({"method", node(word_of(time_methods, study.time.method))});
    object.push_back({"steps", node(study.time.steps)});
    object.push_back({"periods", node(study.time.periods)});
    object.push_back({"recorded", node(study.time.recorded)});
    object.push_back({"tolerance", node(study.time.tolerance)});
  }
  Node::Object lists;
  for (const auto& [parameter, values] : study.for_each) {
    lists.push_back({parameter, node(values)});
  }
  object.push_back({"for_each", {std::move(lists)}});
  return {std::move(object)};
}

Node node(const std::vector<Study>& studies, const std::vector<std::string>& dofs) {
  Node::List list;
  for (const Study& study : studies) {
    list.push_back(node(study, dofs));
  }
  return {std::move(list)};
}

Node node(const Scene& scene) {
  const Node structure{Node::Object{{"dofs", node(scene.dofs)},
                                    {"masses", node(scene.masses, scene.dofs)},
                                    {"springs", node(scene.springs, scene.dofs)},
                                    {"dampers", node(scene.dampers, scene.dofs)}}};
  return {Node::Object{{"format", node(format_name)},
                       {"title", node(scene.title)},
                       {"frequency_unit", node(word_of(frequency_units, scene.frequency_unit))},
                       {"structure", structure},
                       {"elements", node(scene.elements, scene.dofs, true)},
                       {"excitation", node(scene.excitation, scene.dofs)},
                       {"ties", node(scene.ties)},
                       {"harmonics", node(scene.harmonics)},
                       {"response", {Node::Object{place_member(scene.response, scene.dofs)}}},
                       {"studies", node(scene.studies, scene.dofs)}}};
}

}  // namespace
}  // namespace detail

std::string write(const Scene& scene) {
  return detail::print_tree(detail::node(scene));
}

std::string hash(const Scene& scene) {
  std::uint64_t state = 0xcbf29ce484222325u;  // FNV-1a, 64 bits (Fowler, Noll, Vo)
  for (const char c : write(scene)) {
    state = (state ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  }
  std::array<char, 16> digits{};
  for (auto digit = digits.rbegin(); digit != digits.rend(); ++digit, state >>= 4) {
    *digit = "0123456789abcdef"[state & 15];
  }
  return {digits.data(), digits.size()};
}

std::string_view unit_name(FrequencyUnit unit) {
  return detail::word_of(detail::frequency_units, unit);
}

std::string_view kind_name(StudyKind kind) {
  return detail::word_of(detail::study_kinds, kind);
}

std::string_view method_name(TimeMethod method) {
  return detail::word_of(detail::time_methods, method);
}

std::string_view criterion_name(Criterion criterion) {
  return detail::word_of(detail::criteria, criterion);
}

std::optional<Criterion> criterion_of(std::string_view name) {
  return detail::value_of<Criterion>(detail::criteria, name);
}

std::optional<TimeMethod> method_of(std::string_view name) {
  return detail::value_of<TimeMethod>(detail::time_methods, name);
}

}  // namespace arcslip::scene
