#include <arcslip/scene/reduction.hpp>

#include <arcslip/scene/keys/section_keys.hpp>

#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace arcslip::scene {
namespace {

constexpr int most_modes = 10000;
constexpr std::array<file::Word<ReductionMethod>, 3> reduction_methods = {
    {{"krylov", ReductionMethod::krylov},
     {"craig_bampton", ReductionMethod::craig_bampton},
     {"rubin", ReductionMethod::rubin}}};
constexpr Field dynamic_accuracy{
    .name = "accuracy", .unit = "-", .lower = 1e-11, .upper = 1e-3, .help = "of the dynamic stiffness"};

// Keys that the method does not have, and two that say the same.
void check_keys_of_method(const file::Reading& reading, Reduction& of) {
  const bool by_modes = of.method != ReductionMethod::krylov;
  const auto fault = [&](const std::string& key, const std::string& what) {
    if (reading.keys.has(key))
      reading.faults.add(reading.keys.find(key).pointer, "found the key \"" + key + "\" " + what);
  };
  const std::string next_to = "next to the method \"" +
                              std::string(file::word_of(reduction_methods, of.method)) +
                              "\", must be left out: ";
  if (by_modes)
    fault("accuracy", next_to + "\"modes\" or \"cutoff\" decide it");
  else
    for (const char* key : {"modes", "cutoff"})
      fault(key, next_to + "its coordinates are no modes; \"accuracy\" decides how many there are");
  if (by_modes && reading.keys.has("cutoff")) fault("modes", "next to \"cutoff\", must be one of them");
}

file::KeysOf<Reduction> keys_of_reduction() {
  file::KeysOf<Reduction> all;
  all.add(file::word(
      "method", &Reduction::method, reduction_methods,
      "the coordinates next to the rows that the scene uses: those that the dynamic stiffness needs, "
      "modes with these rows held, or modes with these rows free"));
  auto of_accuracy = file::number(&Reduction::accuracy, dynamic_accuracy,
                                  "of `\"krylov\"`: of the dynamic stiffness up to the `highest_frequency`");
  of_accuracy.write = [](const Reduction& of, const Scene&, file::Node::Object& to) {
    if (of.method == ReductionMethod::krylov) to.push_back({"accuracy", file::node(of.accuracy)});
  };
  of_accuracy.numbers = {};
  all.add(std::move(of_accuracy));
  all.add(file::optional(
      &Reduction::modes,
      file::whole("modes", &Reduction::modes, 0, most_modes,
                  "of the other two methods: how many, with those of motions as a rigid body")));
  all.add(file::within(&Reduction::cutoff,
                       file::optional_frequency("cutoff",
                                                "the modes up to this frequency, by default up to four "
                                                "times the `highest_frequency`")));
  all.check(check_keys_of_method);
  return all;
}

}  // namespace

std::string_view name(ReductionMethod method) {
  return file::word_of(reduction_methods, method);
}

const SettingsKeys& reduction_keys() {
  static const file::KeysOf<Reduction> all = keys_of_reduction();
  return all;
}

}  // namespace arcslip::scene
