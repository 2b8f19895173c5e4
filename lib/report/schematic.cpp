#include <arcslip/report/schematic.hpp>

#include <arcslip/results/text.hpp>
#include <arcslip/scene/part_type.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>

namespace arcslip::report {
namespace {

using scene::Direction;
using scene::Part;
using scene::Scene;
using scene::Term;

constexpr std::size_t most_columns = 12;
constexpr std::size_t most_links = 60;
constexpr std::size_t most_others = 24;
constexpr int weight_digits = 6;

/// "0.94 y - blade"; the ground stands for no term.
std::string words_of(const Scene& scene, const Direction& direction) {
  std::string words;
  for (const Term& term : direction) {
    words += words.empty() ? (term.weight < 0 ? "-" : "") : term.weight < 0 ? " - " : " + ";
    if (std::abs(term.weight) != 1) words += results::to_digits(std::abs(term.weight), weight_digits) + " ";
    words += scene.dofs[static_cast<std::size_t>(term.dof)] + (term.next ? " of the next sector" : "");
  }
  return words.empty() ? "ground" : words;
}

/// The ends of a link: degrees of freedom, of which one may be ground.
struct Ends {
  int positive = ground, negative = ground;
};

std::optional<Ends> ends_of(const Direction& direction) {
  if (direction.empty() || direction.size() > 2) return std::nullopt;
  Ends ends;
  for (const Term& term : direction) {
    if (std::abs(term.weight) != 1 || term.next) return std::nullopt;
    (term.weight > 0 ? ends.positive : ends.negative) = term.dof;
  }
  const bool is_sum = direction.size() == 2 && (ends.positive == ground || ends.negative == ground);
  return is_sum ? std::nullopt : std::optional(ends);
}

/// "17890 N/m", of the first field that is not 0.
std::string value_of(const Part& part) {
  const auto fields = part.fields();
  for (std::size_t i = 0; i < std::min(fields.size(), part.values.size()); ++i)
    if (part.values[i] != 0)
      return plain_number(part.values[i]) + (fields[i].unit == "-" ? "" : " " + std::string(fields[i].unit));
  return "0";
}

bool has_normal_load(const Part& part) {
  const auto fields = part.fields();
  return std::any_of(fields.begin(), fields.end(),
                     [](const scene::Field& field) { return field.name == "normal_load"; });
}

Symbol symbol_of(const Part& element) {
  if (has_normal_load(element)) return Symbol::friction;
  const auto fields = element.fields();
  const bool has_stiffness = std::any_of(fields.begin(), fields.end(), [](const scene::Field& field) {
    return field.unit.starts_with("N/m") && field.name.find("stiffness") != std::string_view::npos;
  });
  return has_stiffness ? Symbol::nonlinear_spring : Symbol::other;
}

/// Collects parts by degrees of freedom, and gives these their columns.
class Layout {
 public:
  explicit Layout(const Scene& scene) : scene_(scene), used_(scene.dofs.size(), !scene.matrices) {}

  Schematic take() {
    add_all();
    if (std::string why = too_much(); !why.empty()) {
      found_.columns.clear();
      found_.links.clear();
      found_.why_not = std::move(why);
      return std::move(found_);
    }
    place_columns();
    place_links();
    return std::move(found_);
  }

 private:
  void add_all() {
    for (const Part& mass : scene_.masses) add_to_place(mass, true);
    for (const Part& spring : scene_.springs) add_link(spring, Symbol::spring, value_of(spring));
    for (const Part& damper : scene_.dampers) add_link(damper, Symbol::damper, value_of(damper));
    for (const Part& element : scene_.elements) {
      found_.has_normal_loads = found_.has_normal_loads || has_normal_load(element);
      add_link(element, symbol_of(element), std::string(element.type->name()));
    }
    found_.has_normal_loads = found_.has_normal_loads || !scene_.patches.empty();
    for (const Part& patch : scene_.patches) add_other("contacts of the patch \"" + patch.name + "\"");
    for (const Part& force : scene_.excitation) add_to_place(force, false);
    for (const scene::Response& response : scene_.responses)
      for (const Term& term : response.direction) use(term.dof);
    if (scene_.cyclic)
      add_other("a ring of " + std::to_string(scene_.cyclic->sectors) + " sectors, of which this is one");
    if (others_left_out_ > 0) found_.others.push_back("and " + std::to_string(others_left_out_) + " more");
  }

  void use(int dof) {
    if (dof != ground) used_[static_cast<std::size_t>(dof)] = true;
  }

  void add_other(std::string words) {
    if (found_.others.size() < most_others)
      found_.others.push_back(std::move(words));
    else
      ++others_left_out_;
  }

  void add_link(const Part& part, Symbol symbol, std::string value) {
    const auto ends = part.directions.empty() ? std::nullopt : ends_of(part.directions.front());
    if (ends && ends->positive != ends->negative) {
      use(ends->positive);
      use(ends->negative);
      ends_.push_back(*ends);
      found_.links.push_back({part.name, std::move(value), symbol});
    }
    if (ends && part.directions.size() == 1) return;
    const auto slots = part.type->slots_with(part.options);
    std::string words = part.name + " (" + std::string(part.type->name()) + ")";
    for (std::size_t i = 0; i < part.directions.size(); ++i) {
      const std::string slot = i < slots.size() ? std::string(slots[i]) : std::string("displacement");
      words += (i == 0 ? ": " : ", ") + slot + " = " + words_of(scene_, part.directions[i]);
    }
    add_other(std::move(words));
  }

  /// A mass or a force at one degree of freedom.
  void add_to_place(const Part& part, bool is_mass) {
    const auto ends = part.directions.size() == 1 ? ends_of(part.directions.front()) : std::nullopt;
    const bool at_one = ends && (ends->positive == ground || ends->negative == ground);
    if (!at_one || scene::is_base_motion(*part.type)) {
      const std::string at = part.directions.empty() ? "" : words_of(scene_, part.directions.front());
      add_other(part.name + " (" + std::string(part.type->name()) + ")" + (at.empty() ? "" : ": " + at));
      return;
    }
    const int dof = std::max(ends->positive, ends->negative);
    use(dof);
    const std::string sign = ends->positive == ground && !is_mass ? "-" : "";
    (is_mass ? masses_ : forces_)[dof].push_back(sign + part.name + " = " + value_of(part));
  }

  std::string too_much() const {
    const auto columns = std::count(used_.begin(), used_.end(), true);
    if (columns > static_cast<std::ptrdiff_t>(most_columns))
      return "The structure is not drawn: it has " + std::to_string(columns) +
             " degrees of freedom, and a drawing has room for " + std::to_string(most_columns) + ".";
    if (found_.links.size() > most_links)
      return "The structure is not drawn: it has " + std::to_string(found_.links.size()) +
             " springs, dampers and elements, and a drawing has room for " + std::to_string(most_links) + ".";
    return columns == 0 ? "The structure has no part that can be drawn." : "";
  }

  /// Degrees of freedom by their distance from the ground along links, those of matrices first.
  std::vector<int> order() const {
    std::vector<int> distance(scene_.dofs.size(), static_cast<int>(scene_.dofs.size()));
    for (std::size_t round = 0; round < scene_.dofs.size(); ++round)
      for (const Ends& ends : ends_)
        for (const auto& [a, b] : {std::pair(ends.positive, ends.negative), {ends.negative, ends.positive}})
          if (a != ground) {
            int& own = distance[static_cast<std::size_t>(a)];
            own = std::min(own, b == ground ? 1 : distance[static_cast<std::size_t>(b)] + 1);
          }
    std::vector<int> dofs;
    for (std::size_t i = 0; i < used_.size(); ++i)
      if (used_[i]) dofs.push_back(static_cast<int>(i));
    std::stable_sort(dofs.begin(), dofs.end(), [&](int a, int b) {
      const bool body_a = is_of_body(a), body_b = is_of_body(b);
      if (body_a || body_b) return body_a && !body_b;
      return distance[static_cast<std::size_t>(a)] < distance[static_cast<std::size_t>(b)];
    });
    return dofs;
  }

  bool is_of_body(int dof) const {
    return scene_.matrices && static_cast<std::size_t>(dof) < scene_.matrices->named();
  }

  void place_columns() {
    for (const int dof : order()) {
      column_of_[dof] = static_cast<int>(found_.columns.size());
      const auto& direction = scene_.response();
      const bool responds =
          std::any_of(direction.begin(), direction.end(), [&](const Term& term) { return term.dof == dof; });
      found_.columns.push_back(
          {scene_.dofs[static_cast<std::size_t>(dof)], masses_[dof], forces_[dof], responds});
      if (is_of_body(dof)) ++found_.of_matrices;
    }
    if (found_.of_matrices == 0) return;
    const scene::Matrices& matrices = *scene_.matrices;
    if (matrices.bar)
      found_.body = std::string(matrices.bar->bends ? "beam of " : "rod of ") +
                    std::to_string(matrices.bar->elements) + " finite elements";
    else
      found_.body = "matrices of " + std::to_string(matrices.size()) + " rows";
  }

  /// The first row that is free between the columns of each link, shorter links first. Columns in between do
  /// not reach down to it.
  void place_links() {
    for (std::size_t i = 0; i < found_.links.size(); ++i) {
      Link& link = found_.links[i];
      const int positive = ends_[i].positive == ground ? ground : column_of_.at(ends_[i].positive),
                negative = ends_[i].negative == ground ? ground : column_of_.at(ends_[i].negative);
      link.is_positive_right = positive > negative;
      link.to = std::max(positive, negative);
      link.from = std::min(positive, negative);
    }
    const auto span = [](const Link& link) { return link.from == ground ? 1 : link.to - link.from; };
    std::stable_sort(found_.links.begin(), found_.links.end(),
                     [&](const Link& a, const Link& b) { return span(a) < span(b); });
    std::map<int, int> next;  // free row, by the gap on the left of a column
    for (Link& link : found_.links) {
      const int first = link.to - span(link) + 1;
      for (int gap = first; gap <= link.to; ++gap) link.row = std::max(link.row, next[gap]);
      for (int column = first; column < link.to; ++column)
        link.row = std::max(link.row, found_.columns[static_cast<std::size_t>(column)].rows);
      for (int gap = first; gap <= link.to; ++gap) next[gap] = link.row + 1;
      for (const int column : {link.from, link.to})
        if (column != ground) {
          int& rows = found_.columns[static_cast<std::size_t>(column)].rows;
          rows = std::max(rows, link.row + 1);
        }
      found_.rows = std::max(found_.rows, link.row + 1);
    }
  }

  const Scene& scene_;
  Schematic found_;
  std::vector<Ends> ends_;  // of the links
  std::vector<bool> used_;
  std::map<int, std::vector<std::string>> masses_, forces_;
  std::map<int, int> column_of_;
  std::size_t others_left_out_ = 0;
};

}  // namespace

Schematic schematic(const Scene& scene) {
  return Layout(scene).take();
}

}  // namespace arcslip::report
