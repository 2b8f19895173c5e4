// Statistics of the samples of a file, against the formulas over all values at once.
#include "catch.hpp"
#include "lib/hbm/scenes.hpp"
#include "lib/scene/folder.hpp"
#include "lib/scene/format/bad_scenes.hpp"

#include <arcslip/ensemble/database.hpp>
#include <arcslip/ensemble/ensemble.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace arcslip;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using ensemble::Database;
using ensemble::Statement;

namespace {

scene::Scene scene_of(const std::string& for_each) {
  return scenes::parse(scene::test::good_scene_with("{\"d.normal_load\": [1, 2]}", for_each));
}

/// Computes an ensemble of 150 samples, with its statistics.
std::string computed(const std::string& path, const std::string& keep, const std::string& for_each) {
  const scene::Scene scene = scene_of(for_each);
  const ensemble::Outcome outcome = ensemble::run(scene, scene.studies[0], {.path = path, .keep = keep});
  CHECK_FALSE(outcome.stopped);
  CHECK(outcome.progress.done == outcome.progress.all);
  return ensemble::add_statistics(path);
}

const std::string two_parameters = R"({"distributions": {"k.value": {"normal": [100, 5]},
    "f.cosine": {"uniform": [1, 2]}}, "count": 150})";

/// A Duffing oscillator with a peak and two folds at each level of its force.
scene::Scene duffing_scene() {
  return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": 0.1}]},
    "elements": [{"name": "nl", "type": "cubic_spring", "at": "x", "stiffness": 1}],
    "excitation": [{"name": "force", "at": "x", "cosine": 1}], "response": {"at": "x"},
    "harmonics": {"order": 5},
    "studies": [{"kind": "frf", "from": 0.5, "to": 4, "stability": true, "for_each": {"force.cosine": [0.5, 1, 2]}}]})");
}

std::vector<double> values(Database& database, const std::string& column) {
  std::vector<double> all;
  Statement select(database, "SELECT \"" + column + "\" FROM samples WHERE status = 'complete'");
  while (select.step()) all.push_back(select.number(0));
  return all;
}

double mean(const std::vector<double>& x) {
  return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
}

double covariance(const std::vector<double>& x, const std::vector<double>& y) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += (x[i] - mean(x)) * (y[i] - mean(y));
  return sum / static_cast<double>(x.size() - 1);
}

double quantile(std::vector<double> x, double probability) {
  std::sort(x.begin(), x.end());
  const double place = probability * static_cast<double>(x.size() - 1);
  const auto i = static_cast<std::size_t>(place);
  const std::size_t next = std::min(i + 1, x.size() - 1);
  return x[i] + (place - static_cast<double>(i)) * (x[next] - x[i]);
}

}  // namespace

TEST_CASE("mean, deviation, quantiles, histogram and correlation are those of the values") {
  const Folder folder;
  const std::string path = folder / "a.sqlite";
  const std::string text = computed(path, "amplitude,frequency", two_parameters);
  Database database(path, Database::Access::read);
  for (const std::string name : {"k.value", "f.cosine", "amplitude", "frequency"}) {
    CAPTURE(name);
    const std::vector<double> x = values(database, name);
    REQUIRE(x.size() == 150);
    Statement select(database,
                     "SELECT count, mean, standard_deviation, least, q01, q05, q25, median, q75, q95, q99, "
                     "largest FROM statistics WHERE name = '" +
                         name + "'");
    REQUIRE(select.step());
    CHECK(select.whole(0) == 150);
    CHECK_THAT(select.number(1), WithinRel(mean(x), 1e-12));
    CHECK_THAT(select.number(2), WithinRel(std::sqrt(covariance(x, x)), 1e-9));
    const std::vector<double> probabilities = {0, 0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99, 1};
    for (std::size_t i = 0; i < probabilities.size(); ++i)
      CHECK_THAT(select.number(3 + i), WithinRel(quantile(x, probabilities[i]), 1e-12));
    Statement bins(database,
                   "SELECT lower, upper, count FROM histograms WHERE name = '" + name + "' ORDER BY lower");
    long all = 0;
    while (bins.step()) {
      const bool is_last = bins.number(1) == *std::max_element(x.begin(), x.end());
      const auto in_bin = std::count_if(x.begin(), x.end(), [&](double value) {
        return value >= bins.number(0) && (value < bins.number(1) || is_last);
      });
      CHECK(std::abs(in_bin - bins.whole(2)) <= 1);  // of those on an edge
      all += bins.whole(2);
    }
    CHECK(all == 150);
    for (const std::string of : {"amplitude", "frequency"}) {
      const std::vector<double> y = values(database, of);
      const ensemble::Cell found = database.value("SELECT coefficient FROM correlations WHERE name = '" + of +
                                                  "' AND other = '" + name + "'");
      CHECK_THAT(std::get<double>(found),
                 WithinAbs(covariance(x, y) / std::sqrt(covariance(x, x) * covariance(y, y)), 1e-10));
    }
  }
  CHECK_THAT(text, Contains("quantity") && Contains("k.value (kN/m)") && Contains("correlation"));
}

TEST_CASE("values that are all the same have no correlation, and one bin") {
  const Folder folder;
  const std::string path = folder / "a.sqlite";
  computed(path, "amplitude,nonsmooth", two_parameters);
  Database database(path, Database::Access::read);
  Statement bins(database, "SELECT lower, upper, count FROM histograms WHERE name = 'nonsmooth'");
  REQUIRE(bins.step());
  CHECK(bins.whole(2) == 150);
  CHECK_FALSE(bins.step());
  Statement select(database,
                   "SELECT coefficient FROM correlations WHERE name = 'nonsmooth' AND other = 'k.value'");
  REQUIRE(select.step());
  CHECK(select.is_null(0));
}

TEST_CASE("statistics of a single sample are that sample, without a deviation") {
  const Folder folder;
  const std::string path = folder / "a.sqlite";
  computed(path, "amplitude", R"({"distributions": {"k.value": {"normal": [100, 5]}}, "count": 1})");
  Database database(path, Database::Access::read);
  Statement select(
      database, "SELECT mean, standard_deviation, q01, median, q99 FROM statistics WHERE name = 'amplitude'");
  REQUIRE(select.step());
  CHECK(select.number(1) == 0);
  for (const std::size_t column : {2, 3, 4}) CHECK(select.number(column) == select.number(0));
}

TEST_CASE("whole tables have the rows of the results, and what is not kept is not there") {
  const Folder folder;
  const std::string path = folder / "a.sqlite";
  computed(path, "amplitude,events,points", two_parameters);
  Database database(path, Database::Access::read);
  CHECK(std::get<long>(database.value("SELECT count(DISTINCT sample) FROM points")) == 150);
  CHECK(std::get<long>(database.value("SELECT count(*) FROM points WHERE result != 1")) == 0);
  // The quantity is the amplitude of the largest event.
  Statement select(database,
                   "SELECT samples.amplitude, (SELECT max(amplitude) FROM events WHERE events.sample = "
                   "samples.sample) FROM samples");
  while (select.step()) CHECK(select.number(0) == select.number(1));
  const std::string few = folder / "few.sqlite";
  computed(few, "amplitude", two_parameters);
  Database without(few, Database::Access::read);
  CHECK(std::get<long>(
            without.value("SELECT count(*) FROM sqlite_master WHERE name IN ('points', 'events')")) == 0);
  CHECK(std::get<long>(without.value("SELECT count(*) FROM columns WHERE of = 'samples' AND unit = 'm'")) ==
        1);
}

TEST_CASE(
    "quantities without the curve between events are those with it, also where motions lose their "
    "stability") {
  const Folder folder;
  const scene::Scene duffing = duffing_scene();
  for (const std::string keep :
       {"fold.amplitude,fold.frequency,stable", "fold.amplitude,fold.frequency,stable,points"})
    ensemble::run(duffing, duffing.studies[0], {.path = folder / keep, .keep = keep});
  Database few_points(folder / "fold.amplitude,fold.frequency,stable", Database::Access::read),
      all_points(folder / "fold.amplitude,fold.frequency,stable,points", Database::Access::read);
  for (const std::string name : {"fold.amplitude", "fold.frequency", "stable"}) {
    const std::vector<double> a = values(few_points, name), b = values(all_points, name);
    REQUIRE(a.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) CHECK_THAT(a[i], WithinRel(b[i], 1e-8));
  }
  computed(folder / "a.sqlite", "amplitude,frequency", two_parameters);
  computed(folder / "b.sqlite", "amplitude,frequency,points", two_parameters);
  Database few(folder / "a.sqlite", Database::Access::read), all(folder / "b.sqlite", Database::Access::read);
  const std::vector<double> a = values(few, "amplitude"), b = values(all, "amplitude");
  for (std::size_t i = 0; i < 150; ++i) CHECK_THAT(a[i], WithinRel(b[i], 1e-9));
}

TEST_CASE("a quantity is that of the event with the largest amplitude, of a kind or of all") {
  const Folder folder;
  const std::string path = folder / "a.sqlite";
  const scene::Scene duffing = duffing_scene();
  ensemble::run(duffing, duffing.studies[0],
                {.path = path, .keep = "frequency,fold.frequency,cusp.frequency,events", .threads = 2});
  Database database(path, Database::Access::read);
  CHECK(std::get<long>(database.value("SELECT count(*) FROM events WHERE kind = 'fold'")) >= 4);
  Statement select(
      database,
      "SELECT frequency, (SELECT frequency FROM events AS e WHERE e.sample = s.sample ORDER BY "
      "amplitude DESC LIMIT 1), \"fold.frequency\", (SELECT frequency FROM events AS e WHERE e.sample "
      "= s.sample AND kind = 'fold' ORDER BY amplitude DESC LIMIT 1), \"cusp.frequency\" FROM samples AS s");
  while (select.step()) {
    CHECK(select.number(0) == select.number(1));
    CHECK(select.number(2) == select.number(3));
    CHECK(select.is_null(4));
  }
}
