#include <arcslip/scene/keys/section_keys.hpp>

#include <algorithm>

namespace arcslip::scene {
namespace {

// By the default accuracy, for each period of the excitation: no minutes that nobody has asked for.
constexpr int default_highest = 55;

// An accuracy chooses the order, up to the one that is given.
file::KeyGroup<Harmonics> order_and_accuracy() {
  auto accuracy = file::number(
      &Harmonics::accuracy, {"accuracy", "-", finest_accuracy, coarsest_accuracy},
      "relative accuracy of amplitudes, by which studies choose the order; 1e-4 where no `order` is given");
  auto both = file::whole("order", &Harmonics::order, 1, largest_order,
                          "highest harmonic of the harmonic balance; with an `accuracy` the highest that is "
                          "tried, by default 499, and with neither 55 times the `period`");
  both.keys.push_back(accuracy.keys.front());
  for (Key& key : both.keys) key.otherwise.clear();
  both.read = [order = both.read, accuracy = accuracy.read](const file::Reading& reading, Harmonics& of) {
    order(reading, of);
    accuracy(reading, of);
  };
  both.write = [order = both.write, accuracy = accuracy.write](const Harmonics& of, const Scene& scene,
                                                               file::Node::Object& to) {
    if (of.accuracy > 0) accuracy(of, scene, to);
    order(of, scene, to);
  };
  return both;
}

file::KeysOf<Harmonics> keys_of_harmonics() {
  file::KeysOf<Harmonics> all;
  all.add(order_and_accuracy());
  all.add(file::whole("period", &Harmonics::period, 1, largest_period,
                      "period of the motion, in excitation periods"));
  all.add(file::word("friction", &Harmonics::friction, file::friction_methods,
                     "friction integrated exactly between stick-slip transitions, or sampled in time"));
  auto samples =
      file::whole("samples", &Harmonics::samples, 1, largest_samples,
                  "samples per period of the motion, with sampled friction: at least 4 `order` + 4");
  samples.read = [](const file::Reading& reading, Harmonics& of) {
    of.samples = file::read_integer(reading.keys.find("samples"), 1, largest_samples, reading.faults,
                                    ", and at least 4*order + 4 where it is used")
                     .value_or(of.samples);
  };
  all.add(std::move(samples));
  all.add(
      file::word("kinks", &Harmonics::kinks, file::kinks_words,
                 "changes of contact state along a branch over the frequency or of a mode: each is located, "
                 "or they are passed; auto: passed with more than 20 contacts"));
  all.check([](const file::Reading& reading, Harmonics& of) {
    const bool by_order = reading.keys.has("order"), by_accuracy = reading.keys.has("accuracy");
    if (of.accuracy == 0 && !by_order) of.accuracy = default_accuracy;
    if (!by_order)
      of.order = by_accuracy ? largest_chosen_order : std::min(default_highest * of.period, largest_order);
  });
  return all;
}

}  // namespace

const SettingsKeys& harmonics_keys() {
  static const file::KeysOf<Harmonics> all = keys_of_harmonics();
  return all;
}

}  // namespace arcslip::scene
