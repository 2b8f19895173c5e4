// "for_each" by distributions: samples of parameters.
#include <arcslip/results/text.hpp>
#include <arcslip/sampling/distribution.hpp>
#include <arcslip/scene/formulas.hpp>
#include <arcslip/scene/keys/study_parameters.hpp>

#include <algorithm>
#include <limits>

namespace arcslip::scene::file {
namespace {

using sampling::Distribution;
using sampling::DistributionDescription;
using sampling::DistributionType;

constexpr double most_samples_beyond = 1e-3;  // expected, of all samples

std::vector<std::string> distribution_names() {
  std::vector<std::string> names;
  for (const DistributionDescription& each : sampling::distribution_types()) names.emplace_back(each.name);
  return names;
}

/// "a list of the mean and the standard deviation"
std::string values_text(const DistributionDescription& of) {
  std::string text = "a list of " + std::to_string(of.values.size()) + " numbers: ";
  for (std::size_t i = 0; i < of.values.size(); ++i) text.append(i == 0 ? "" : ", ").append(of.values[i]);
  return text;
}

/// Reports numbers that make no distribution.
bool are_valid(const Distribution& of, const std::string& pointer, Faults& faults) {
  const std::size_t before = faults.count();
  const auto at = [&](std::size_t i) { return child(pointer, i); };
  const auto wrong = [&](std::size_t i, const std::string& must_be) {
    faults.add(at(i), "found " + number_text(of.values[i]) + ", must be " + must_be);
  };
  const bool uniform = of.type == DistributionType::uniform;
  if (!uniform && !(of.values[1] > 0)) wrong(1, "above 0: it is the standard deviation");
  if (of.type == DistributionType::lognormal && !(of.values[0] > 0))
    wrong(0, "above 0: it is the mean of a lognormal distribution");
  const std::size_t lower = uniform ? 0 : 2;
  if ((uniform || of.type == DistributionType::truncated_normal) &&
      !(of.values[lower] < of.values[lower + 1]))
    wrong(lower + 1, "above the lower end, which is " + number_text(of.values[lower]));
  if (of.type == DistributionType::truncated_normal && faults.count() == before) {
    const Distribution whole{DistributionType::normal, of.values};
    const double inside =
        of.values[2] > of.values[0]
            ? probability_above(whole, of.values[2]) - probability_above(whole, of.values[3])
            : probability_below(whole, of.values[3]) - probability_below(whole, of.values[2]);
    if (!(inside > std::numeric_limits<double>::min()))
      faults.add(pointer, "found no probability between the ends, must be ends nearer to the mean");
  }
  return faults.count() == before;
}

/// Reports samples that lie beyond the bounds of a field.
void check_bounds(const Distribution& of, int count, const Field& field, const std::string& pointer,
                  Faults& faults) {
  if (of.type == DistributionType::uniform || of.type == DistributionType::truncated_normal) {
    for (const std::size_t i : of.type == DistributionType::uniform ? std::array<std::size_t, 2>{0, 1}
                                                                    : std::array<std::size_t, 2>{2, 3}) {
      Field bounds = field;
      bounds.lower_open = false;  // an end is no sample
      if (!within(bounds, of.values[i])) faults.add(child(pointer, i), bound_fault(bounds, of.values[i]));
    }
    return;
  }
  if (!within(field, of.values[0])) {
    faults.add(child(pointer, std::size_t{0}), bound_fault(field, of.values[0]));
    return;
  }
  const double beyond = probability_below(of, field.lower) + probability_above(of, field.upper);
  if (beyond * count > most_samples_beyond)
    faults.add(pointer, "found samples beyond the bounds of the parameter with a probability of " +
                            results::to_digits(beyond, 2) + ", must be " + allowed_text(field) +
                            ": use \"truncated_normal\", with a lower and an upper end");
}

class SamplesReader {
 public:
  SamplesReader(const Parameters& all, const std::vector<ParameterUse>& taken, Faults& faults)
      : all_(all), taken_(taken), faults_(faults) {}

  sampling::Plan read(const Location& place) {
    const Keys keys(place, {"distributions", "count", "seed", "design"}, faults_);
    const std::string wanted =
        "an integer from 1 to " + std::to_string(sampling::largest_sample_count) + ", the number of samples";
    const auto count =
        read_integer(keys.require("count", wanted, faults_), 1, sampling::largest_sample_count, faults_);
    plan_.count = count.value_or(1);
    const Location seed = keys.find("seed");
    if (seed.node != nullptr)
      plan_.seed = read_integer(seed, 0, std::numeric_limits<int>::max(), faults_).value_or(1);
    plan_.design = read_choice(keys.find("design"), sampling::designs(), plan_.design, faults_);
    const Location distributions = keys.find("distributions");
    for (const Member* member : members(distributions, faults_))
      read_parameter(*member, distributions.pointer);
    if (const auto* object = distributions.node->get<Node::Object>(); object != nullptr && object->empty())
      faults_.add(distributions.pointer, "found no parameter, must be an object with a distribution of each");
    if (plan_.parameters.size() > sampling::most_sampled_parameters)
      faults_.add(distributions.pointer, "found " + std::to_string(plan_.parameters.size()) +
                                             " parameters, must be at most " +
                                             std::to_string(sampling::most_sampled_parameters));
    if (plan_.parameters.empty()) return {};
    return std::move(plan_);
  }

 private:
  void read_parameter(const Member& member, const std::string& pointer) {
    const Location item{&member.value, child(pointer, member.key)};
    std::string parameter = member.key;
    const Field field = bounds_of(parameter, item.pointer, all_, faults_);
    if (is_taken(parameter, item.pointer, taken_, faults_)) return;
    const std::vector<std::string> names = distribution_names();
    const auto* object = member.value.get<Node::Object>();
    const std::string wanted = "an object with one of " + listed(names);
    if (object == nullptr) return add_wrong_type(item, wanted, faults_);
    std::vector<const Member*> given;
    for (const Member* each : members(item, faults_))
      if (each->key != comment_key) given.push_back(each);
    if (given.size() != 1) {
      faults_.add(item.pointer,
                  "found an object of " + std::to_string(given.size()) + " keys, must be " + wanted);
      return;
    }
    for (const DistributionDescription& type : sampling::distribution_types())
      if (type.name == given.front()->key) {
        read_distribution(parameter, type, {&given.front()->value, child(item.pointer, type.name)}, field);
        return;
      }
    faults_.add(child(item.pointer, given.front()->key), "found the unknown distribution " +
                                                             shown(given.front()->key) + ", must be one of " +
                                                             listed(names) + hint(given.front()->key, names));
  }

  void read_distribution(const std::string& parameter, const DistributionDescription& type,
                         const Location& place, const Field& field) {
    const std::string wanted = values_text(type);
    const Node::List* list = read_list(place, wanted, faults_);
    if (list == nullptr) return;
    if (list->size() != type.values.size()) {
      faults_.add(place.pointer, "found a list of " + std::to_string(list->size()) + ", must be " + wanted);
      return;
    }
    Distribution distribution{type.type, {}};
    const std::size_t before = faults_.count();
    Field number = any_number;
    number.unit = field.unit;
    for (std::size_t i = 0; i < list->size(); ++i)
      distribution.values[i] =
          read_number({&(*list)[i], child(place.pointer, i)}, number, faults_).value_or(0);
    if (faults_.count() > before || !are_valid(distribution, place.pointer, faults_)) return;
    check_bounds(distribution, static_cast<int>(plan_.count), field, place.pointer, faults_);
    plan_.parameters.emplace_back(parameter, distribution);
  }

  const Parameters& all_;
  const std::vector<ParameterUse>& taken_;
  Faults& faults_;
  sampling::Plan plan_;
};

}  // namespace

bool are_samples(const Location& place, const Parameters& all) {
  const Node::Object* object = place.node != nullptr ? place.node->get<Node::Object>() : nullptr;
  return object != nullptr && parameter_of(all.scene, "distributions").empty() &&
         std::any_of(object->begin(), object->end(),
                     [](const Member& member) { return member.key == "distributions"; });
}

sampling::Plan read_samples(const Location& place, const Parameters& all,
                            const std::vector<ParameterUse>& taken, Faults& faults) {
  return SamplesReader(all, taken, faults).read(place);
}

}  // namespace arcslip::scene::file
