#include "bad_topics.hpp"

namespace arcslip::scene::test {
namespace {

void add_studies(std::vector<BadScene>& rows) {
  const std::string study =
      "{\"kind\": \"frf\", \"from\": 1, \"to\": 2, \"for_each\": {\"d.normal_load\": [1, 2]}}";
  const auto with_study = [&](const std::string& text) { return good_scene_with(study, text); };
  rows.push_back({"studies that are no list", good_scene_with("[" + study + "]", "{}"), "/studies",
                  "found an object, must be a list of objects"});
  rows.push_back({"study that is no object", with_study("\"frf\""), "/studies/0",
                  "found \"frf\" (a string), must be an object with the keys \"name\", \"kind\""});
  rows.push_back({"study without a kind", with_study("{\"from\": 1, \"to\": 2}"), "/studies/0/kind",
                  "found no key \"kind\", which is required: must be one of \"frf\""});
  rows.push_back(
      {"unknown kind of study", with_study("{\"kind\": \"ffr\", \"over\": 1}"), "/studies/0/kind",
       "found \"ffr\", must be one of \"frf\", \"trace\", \"peaks\", \"folds\", \"bifurcations\", \"time\", "
       "\"point\", \"modes\", \"sweep\", \"accuracy\", \"optimum\"; did you "
       "mean \"frf\"?"});
  rows.push_back({"kind that is no string", with_study("{\"kind\": 1}"), "/studies/0/kind",
                  "found 1 (a number), must be one of \"frf\""});
  rows.push_back({"unknown key of a study",
                  with_study("{\"kind\": \"frf\", \"from\": 1, \"to\": 2, \"foreach\": {}}"),
                  "/studies/0/foreach", "did you mean \"for_each\"?"});
  rows.push_back({"name of a study that is no string",
                  with_study("{\"name\": 1, \"kind\": \"frf\", \"from\": 1, \"to\": 2}"), "/studies/0/name",
                  "found 1 (a number), must be a string, the name of the study"});
  for (const std::string name : {"", "../x", "a/b", "a\\\\b", "a\\nb"}) {
    rows.push_back({"study \"" + name + "\"",
                    with_study("{\"name\": \"" + name + "\", \"kind\": \"frf\", \"from\": 1, \"to\": 2}"),
                    "/studies/0/name", "must be a name of 1 to 100 characters"});
  }
  rows.push_back({"two studies of one name",
                  with_study("{\"name\": \"x\", \"kind\": \"frf\", \"from\": 1, \"to\": 2}, "
                             "{\"name\": \"x\", \"kind\": \"frf\", \"from\": 1, \"to\": 2}"),
                  "/studies/1/name", "found the name \"x\" again, which is also at /studies/0/name"});
  rows.push_back({"no from", with_study("{\"kind\": \"frf\", \"to\": 2}"), "/studies/0/from",
                  "found no key \"from\", which is required: must be above 0 Hz"});
  rows.push_back({"method of a frequency response that there is not",
                  with_study("{\"kind\": \"frf\", \"from\": 1, \"to\": 2, \"method\": \"shoot\"}"),
                  "/studies/0/method", "must be one of \"harmonic_balance\", \"shooting\""});
  rows.push_back({"all branches by shooting",
                  with_study("{\"kind\": \"frf\", \"from\": 1, \"to\": 2, \"method\": \"shooting\", "
                             "\"branches\": \"all\"}"),
                  "/studies/0/branches",
                  "found \"all\" next to the method \"shooting\", which follows one branch"});
  rows.push_back({"Hill's method by shooting",
                  with_study("{\"kind\": \"frf\", \"from\": 1, \"to\": 2, \"method\": \"shooting\", "
                             "\"stability\": \"hill\"}"),
                  "/studies/0/stability",
                  "found \"hill\" next to the method \"shooting\", whose multipliers are exact"});
  rows.push_back({"Hill's method by shooting over a parameter",
                  with_study("{\"kind\": \"trace\", \"over\": \"d.normal_load\", \"from\": 1, \"to\": 2, "
                             "\"frequency\": 1, \"method\": \"shooting\", \"stability\": \"hill\"}"),
                  "/studies/0/stability",
                  "found \"hill\" next to the method \"shooting\", whose multipliers are exact"});
  rows.push_back(
      {"no to", with_study("{\"kind\": \"frf\", \"from\": 2}"), "/studies/0/to", "found no key \"to\""});
  rows.push_back({"from of zero", with_study("{\"kind\": \"frf\", \"from\": 0, \"to\": 2}"),
                  "/studies/0/from", "found 0, must be above 0 Hz"});
  rows.push_back({"from that is no number", with_study("{\"kind\": \"frf\", \"from\": true, \"to\": 2}"),
                  "/studies/0/from", "found true, must be a number, above 0 Hz"});
  rows.push_back({"a frequency whose square is no number",
                  with_study("{\"kind\": \"frf\", \"from\": 1, \"to\": 1e300}"), "/studies/0/to",
                  "found 1e+300, must be at most 1e+100 Hz: numbers with its square would overflow"});
  rows.push_back({"from above to", with_study("{\"kind\": \"frf\", \"from\": 3, \"to\": 2}"), "/studies/0/to",
                  "found 2, must be above \"from\", which is 3 Hz"});
  rows.push_back({"from equal to to", with_study("{\"kind\": \"frf\", \"from\": 2, \"to\": 2}"),
                  "/studies/0/to", "found 2, must be above \"from\", which is 2 Hz"});
  const auto with_sweep = [&](const std::string& text) {
    return good_scene_with("{\"d.normal_load\": [1, 2]}", text);
  };
  rows.push_back({"for_each that is no object", with_sweep("1"), "/studies/0/for_each",
                  "found 1 (a number), must be an object"});
  rows.push_back({"no rows", with_sweep("[]"), "/studies/0/for_each",
                  "found an empty list, must be a list of at least one row {\"part.field\": value}"});
  rows.push_back({"row that is no object", with_sweep("[{\"m.value\": 1}, [1]]"), "/studies/0/for_each/1",
                  "found a list, must be an object"});
  rows.push_back({"first row that is no object", with_sweep("[1]"), "/studies/0/for_each/0",
                  "found 1 (a number), must be an object"});
  rows.push_back({"row without parameters", with_sweep("[{}]"), "/studies/0/for_each/0",
                  "found no parameter, must be an object with a value of each of some parameters"});
  rows.push_back({"unknown parameter in a row", with_sweep("[{\"m.valu\": 1}, {\"m.valu\": 2}]"),
                  "/studies/0/for_each/0/m.valu", "did you mean \"m.value\"?"});
  rows.push_back({"parameter twice in a row", with_sweep("[{\"m.value\": 1, \"m.value\": 2}]"),
                  "/studies/0/for_each/0/m.value", "found the key \"m.value\" again, must stand only once"});
  rows.push_back({"value out of bounds in a row", with_sweep("[{\"m.value\": 1}, {\"m.value\": -2}]"),
                  "/studies/0/for_each/1/m.value", "found -2, must be at least 0 kg"});
  rows.push_back({"list in a row", with_sweep("[{\"m.value\": [1]}]"), "/studies/0/for_each/0/m.value",
                  "found a list, must be a number, at least 0 kg"});
  rows.push_back({"row with fewer parameters",
                  with_sweep("[{\"m.value\": 1, \"k.value\": 1}, {\"m.value\": 2}]"), "/studies/0/for_each/1",
                  "found no value of \"k.value\", which the first row has"});
  rows.push_back(
      {"row with more parameters", with_sweep("[{\"m.value\": 1}, {\"m.value\": 2, \"k.value\": 1}]"),
       "/studies/0/for_each/1/k.value", "found \"k.value\", must be one of the parameters of the first row"});
  rows.push_back({"sweep of an unknown parameter", with_sweep("{\"d.normal_laod\": [1]}"),
                  "/studies/0/for_each/d.normal_laod", "did you mean \"d.normal_load\"?"});
  rows.push_back(
      {"sweep of the frequency", with_sweep("{\"frequency\": [1]}"), "/studies/0/for_each/frequency",
       "found the unknown parameter \"frequency\", must be one of \"m.value\", \"k.value\", \"k2.value\""});
  rows.push_back({"sweep twice", with_sweep("{\"m.value\": [1], \"m.value\": [2]}"),
                  "/studies/0/for_each/m.value", "found the key \"m.value\" again, must stand only once"});
  rows.push_back({"sweep without values", with_sweep("{\"m.value\": []}"), "/studies/0/for_each/m.value",
                  "found an empty list, must be a list of at least one number"});
  rows.push_back({"sweep that is no list", with_sweep("{\"m.value\": 3}"), "/studies/0/for_each/m.value",
                  "found 3 (a number), must be a list of at least one number"});
  rows.push_back({"sweep over a range without its end",
                  with_sweep("{\"m.value\": {\"from\": 1, \"count\": 3}}"), "/studies/0/for_each/m.value/to",
                  "found no key \"to\", which is required: must be at least 0 kg"});
  rows.push_back({"sweep over a range of one value",
                  with_sweep("{\"m.value\": {\"from\": 1, \"to\": 2, \"count\": 1}}"),
                  "/studies/0/for_each/m.value/count", "found 1, must be an integer from 2 to 100000"});
  rows.push_back({"sweep over a range out of bounds",
                  with_sweep("{\"m.value\": {\"from\": 1, \"to\": -2, \"count\": 3}}"),
                  "/studies/0/for_each/m.value/to", "found -2, must be at least 0 kg"});
  rows.push_back(
      {"sweep over a logarithmic range from 0",
       with_sweep("{\"m.value\": {\"from\": 0, \"to\": 2, \"count\": 3, \"spacing\": \"logarithmic\"}}"),
       "/studies/0/for_each/m.value/from", "found 0, must be above 0 where the spacing is \"logarithmic\""});
  rows.push_back({"sweep over an empty range",
                  with_sweep("{\"m.value\": {\"from\": 2, \"to\": 2, \"count\": 3}}"),
                  "/studies/0/for_each/m.value/to", "found 2, must differ from \"from\""});
  rows.push_back({"comment that is no text",
                  with_sweep("{\"m.value\": {\"from\": 1, \"to\": 2, \"count\": 3, \"comment\": 1}}"),
                  "/studies/0/for_each/m.value/comment", "found 1 (a number), must be a string, a comment"});
  rows.push_back({"sweep over words", with_sweep("{\"m.value\": [1, true]}"),
                  "/studies/0/for_each/m.value/1",
                  "found true, must be a number, at least 0 kg"});
  rows.push_back({"sweep out of bounds", with_sweep("{\"m.value\": [1, -2]}"),
                  "/studies/0/for_each/m.value/1", "found -2, must be at least 0 kg"});
  rows.push_back({"sweep to 1e999", with_sweep("{\"k.value\": [1, 1e999]}"), "/studies/0/for_each/k.value/1",
                  "found 1e999 (a number that is too large), must be a finite number"});
}

void add_samples(std::vector<BadScene>& rows) {
  const std::string place = "/studies/0/for_each";
  const auto add = [&](const std::string& name, const std::string& text, const std::string& where,
                       const std::string& message) {
    rows.push_back({name, good_scene_with("{\"d.normal_load\": [1, 2]}", text), place + where, message});
  };
  const auto add_one = [&](const std::string& name, const std::string& distribution, const std::string& where,
                           const std::string& message) {
    add(name, "{\"distributions\": {\"m.value\": " + distribution + "}, \"count\": 10}",
        "/distributions/m.value" + where, message);
  };
  const std::string good = "{\"distributions\": {\"m.value\": {\"uniform\": [1, 2]}}, \"count\": ";
  add("distributions without a number of samples",
      "{\"distributions\": {\"m.value\": {\"uniform\": [1, 2]}}}", "/count",
      "found no key \"count\", which is required: must be an integer from 1 to 1000000000");
  add("no samples", good + "0}", "/count", "found 0, must be an integer from 1 to 1000000000");
  add("seed below zero", good + "5, \"seed\": -1}", "/seed",
      "found -1, must be an integer from 0 to 2147483647");
  add("unknown design of samples", good + "5, \"design\": \"sobbol\"}", "/design",
      "found \"sobbol\", must be one of \"random\", \"latin_hypercube\", \"sobol\"; did you mean \"sobol\"?");
  add("unknown key next to distributions", good + "5, \"sed\": 1}", "/sed", "did you mean \"seed\"?");
  add("distributions that are no object", "{\"distributions\": 1, \"count\": 5}", "/distributions",
      "found 1 (a number), must be an object");
  add("distributions of no parameter", "{\"distributions\": {}, \"count\": 5}", "/distributions",
      "found no parameter, must be an object with a distribution of each");
  add("distribution of an unknown parameter",
      "{\"distributions\": {\"m.valu\": {\"uniform\": [1, 2]}}, \"count\": 5}", "/distributions/m.valu",
      "did you mean \"m.value\"?");
  add_one("distribution that is no object", "[1, 2]", "",
          "found a list, must be an object with one of \"normal\"");
  add_one("two distributions of a parameter", "{\"uniform\": [1, 2], \"normal\": [1, 2]}", "",
          "found an object of 2 keys, must be an object with one of \"normal\"");
  add_one("unknown distribution", "{\"unifrm\": [1, 2]}", "/unifrm",
          "found the unknown distribution \"unifrm\", must be one of \"normal\", \"uniform\", \"lognormal\", "
          "\"truncated_normal\"; did you mean \"uniform\"?");
  add_one("distribution with too few numbers", "{\"normal\": [1]}", "/normal",
          "found a list of 1, must be a list of 2 numbers: mean, standard deviation");
  add_one("distribution of texts", "{\"uniform\": [1, true]}", "/uniform/1",
          "found true, must be");
  add_one("standard deviation of zero", "{\"normal\": [1, 0]}", "/normal/1",
          "found 0, must be above 0: it is the standard deviation");
  add_one("lognormal distribution about zero", "{\"lognormal\": [0, 1]}", "/lognormal/0",
          "found 0, must be above 0: it is the mean of a lognormal distribution");
  add_one("ends in the wrong order", "{\"uniform\": [2, 1]}", "/uniform/1",
          "found 1, must be above the lower end, which is 2");
  add_one("ends of a truncated distribution in the wrong order", "{\"truncated_normal\": [1, 1, 2, 2]}",
          "/truncated_normal/3", "found 2, must be above the lower end, which is 2");
  add_one("ends far from the mean", "{\"truncated_normal\": [1, 1e-3, 50, 51]}", "/truncated_normal",
          "found no probability between the ends, must be ends nearer to the mean");
  add_one("uniform distribution beyond the bounds", "{\"uniform\": [-1, 2]}", "/uniform/0",
          "found -1, must be at least 0 kg");
  add_one("truncated distribution beyond the bounds", "{\"truncated_normal\": [1, 1, -1, 2]}",
          "/truncated_normal/2", "found -1, must be at least 0 kg");
  add_one("mean beyond the bounds", "{\"normal\": [-1, 1]}", "/normal/0", "found -1, must be at least 0 kg");
  add_one(
      "normal distribution with samples beyond the bounds", "{\"normal\": [1, 0.5]}", "/normal",
      "found samples beyond the bounds of the parameter with a probability of 0.023, must be at least 0 kg: "
      "use \"truncated_normal\", with a lower and an upper end");
}

void add_studies_over_a_parameter(std::vector<BadScene>& rows) {
  const auto add = [&](const std::string& name, const std::string& study, const std::string& place,
                       const std::string& message) {
    rows.push_back(
        {name,
         good_scene_with(
             "{\"kind\": \"frf\", \"from\": 1, \"to\": 2, \"for_each\": {\"d.normal_load\": [1, 2]}}",
             "{" + study + "}"),
         "/studies/0/" + place, message});
  };
  const std::string kind = "\"kind\": \"peaks\", ";
  const std::string trace = "\"kind\": \"trace\", \"over\": \"d.normal_load\", \"from\": 1, \"to\": 2, ";
  const std::string over = "\"over\": \"d.normal_load\", ";
  const std::string range = "\"from\": 1, \"to\": 2, ";
  const std::string window = "\"frequency\": [1, 2]";

  add("no parameter to go over", kind + range + window, "over",
      "found no key \"over\", which is required: must be a string, the parameter \"part.field\" or constant");
  add("over that is no string", kind + range + window + ", \"over\": [\"d.normal_load\"]", "over",
      "found a list, must be a string, the parameter \"part.field\" or constant");
  add("over an unknown parameter", kind + range + window + ", \"over\": \"d.normal_laod\"", "over",
      "found the unknown parameter \"d.normal_laod\", must be one of \"m.value\"");
  add("over a part without its field", kind + range + window + ", \"over\": \"d\"", "over",
      "found the unknown parameter \"d\", must be one of \"m.value\"");
  add("over the frequency", kind + range + window + ", \"over\": \"frequency\"", "over",
      "must be another parameter; over the frequency is a study of kind \"frf\"");
  rows.push_back(
      {"over a tied field",
       good_scene_with(
           "\"studies\": [{\"kind\": \"frf\", \"from\": 1, \"to\": 2, "
           "\"for_each\": {\"d.normal_load\": [1, 2]}}]",
           "\"ties\": {\"t\": [\"d.normal_load\"]}, \"studies\": [{" + kind + over + range + window + "}]"),
       "/studies/0/over",
       "found \"d.normal_load\", which is given by the formula \"t\"; must be what that follows: \"t\""});
  rows.push_back(
      {"over a tie with the name of a result",
       good_scene_with("\"studies\": [{\"kind\": \"frf\", \"from\": 1, \"to\": 2, "
                       "\"for_each\": {\"d.normal_load\": [1, 2]}}]",
                       "\"ties\": {\"phase\": [\"d.normal_load\"]}, \"studies\": [{" + kind +
                           "\"over\": \"phase\", " + range + window + "}]"),
       "/studies/0/over",
       "found \"phase\", by which results name a quantity of their own; must be a constant of another name"});
  add("over the same parameter as for_each",
      kind + over + range + window + ", \"for_each\": {\"d.normal_load\": [1, 2]}", "for_each/d.normal_load",
      "found \"d.normal_load\", which the study is \"over\"; must be another parameter");
  add("no beginning of the parameter", kind + over + "\"to\": 2, " + window, "from",
      "found no key \"from\", which is required: must be at least 0 N");
  add("beginning below the parameter's bound", kind + over + "\"from\": -1, \"to\": 2, " + window, "from",
      "found -1, must be at least 0 N");
  add("beginning at an open bound", kind + "\"over\": \"d.stiffness\", \"from\": 0, \"to\": 2, " + window,
      "from", "found 0, must be above 0 N/m");
  add("parameter from above to", kind + over + "\"from\": 3, \"to\": 2, " + window, "to",
      "found 2, must be above \"from\", which is 3 N");
  add("pure number from above to",
      kind + "\"over\": \"d.friction_coefficient\", \"from\": 0.5, \"to\": 0.5, " + window, "to",
      "found 0.5, must be above \"from\", which is 0.5");
  add("window of frequencies in a trace", trace + window, "frequency",
      "found a list, must be one frequency, above 0 Hz");
  add("trace without its frequency", trace + "\"for_each\": {}", "frequency",
      "found no key \"frequency\", which is required: must be one frequency, above 0 Hz");
  add("trace at zero frequency", trace + "\"frequency\": 0", "frequency", "found 0, must be above 0 Hz");
  add("one frequency in place of a window", kind + over + range + "\"frequency\": 1.5", "frequency",
      "found 1.5 (a number), must be a window [lower, upper] of two frequencies, each above 0 Hz");
  add("window of three frequencies", kind + over + range + "\"frequency\": [1, 2, 3]", "frequency",
      "found a list of 3, must be a window [lower, upper] of two frequencies");
  add("window from zero", kind + over + range + "\"frequency\": [0, 2]", "frequency/0",
      "found 0, must be above 0 Hz");
  add("window that ends before it begins", kind + over + range + "\"frequency\": [2, 1]", "frequency/1",
      "found 1, must be above the lower end, which is 2 Hz");
  add("window with a word", kind + over + range + "\"frequency\": [1, true]", "frequency/1",
      "found true, must be a number, above 0 Hz");
  add("parameter of a study over the frequency", "\"kind\": \"frf\", " + over + "\"from\": 1, \"to\": 2",
      "over",
      "found the key \"over\", which belongs to studies of kind \"trace\", \"peaks\", \"folds\", "
      "\"bifurcations\", "
      "\"optimum\", must be one "
      "of "
      "\"name\", \"kind\", \"from\", \"to\", \"method\", \"stability\", \"multipliers\", \"branches\", "
      "\"doublings\", \"most_branches\", \"searches\", \"for_each\"");
  add("misspelt key of a study over a parameter", kind + over + range + window + ", \"frequencies\": 1",
      "frequencies", "did you mean \"frequency\"?");

  const std::string time = "\"kind\": \"time\", ";
  const std::string at = time + "\"frequency\": 1, ";
  add("motion in time without its frequency", time + "\"steps\": 100", "frequency",
      "found no key \"frequency\", which is required: must be one frequency, above 0 Hz");
  add("motion in time at two frequencies", time + window, "frequency",
      "found a list, must be one frequency, above 0 Hz");
  add("motion in time by an unknown method", at + "\"method\": \"newmrak\"", "method",
      "found \"newmrak\", must be one of \"shooting\", \"newmark-shooting\", \"newmark\", \"event-driven\"; "
      "did "
      "you mean \"newmark\"?");
  add("motion in time by a method that is no string", at + "\"method\": 2", "method",
      "found 2 (a number), must be one of \"shooting\"");
  add("no step in a period", at + "\"steps\": 0", "steps", "found 0, must be an integer from 1 to 10000000");
  add("half a step in a period", at + "\"steps\": 100.5", "steps",
      "found 100.5, must be an integer from 1 to 10000000");
  add("no period at all", at + "\"periods\": 0", "periods",
      "found 0, must be an integer from 1 to 100000000");
  add("no recorded period", at + "\"recorded\": -1", "recorded",
      "found -1, must be an integer from 1 to 100000000");
  add("more to record than a result can hold", at + "\"recorded\": 20000", "recorded",
      "found 20000 periods of 1000 steps to record, must be at most 10000000 steps together");
  add("negative tolerance of a motion", at + "\"tolerance\": -1e-9", "tolerance", "found -1e-09, must be");
  add("tolerance of a motion that is no number", at + "\"tolerance\": true", "tolerance",
      "found true, must be a number");
  add("range in a motion in time", at + "\"from\": 1", "from",
      "found the key \"from\", which belongs to studies of kind \"frf\", \"trace\", \"peaks\", \"folds\", "
      "\"bifurcations\", "
      "\"sweep\", \"accuracy\", \"optimum\", must be");
  add("steps in a frequency response", "\"kind\": \"frf\", \"from\": 1, \"to\": 2, \"steps\": 100", "steps",
      "found the key \"steps\", which belongs to studies of kind \"time\", \"point\", \"sweep\", must be");
  const std::string mode = "\"kind\": \"modes\", ";
  const std::string frf = "\"kind\": \"frf\", \"from\": 1, \"to\": 2, ";
  add("stability by an unknown method", frf + "\"stability\": \"hil\"", "stability",
      "found \"hil\" (a string), must be true, false or \"hill\"");
  add("stability that is a number", frf + "\"stability\": 1", "stability",
      "found 1 (a number), must be true, false or \"hill\"");
  add("less than no multipliers", frf + "\"stability\": true, \"multipliers\": -1", "multipliers",
      "found -1, must be an integer from 0 to 10000");
  add("resonance of an unknown kind", kind + over + range + window + ", \"resonance\": \"phases\"",
      "resonance", "found \"phases\", must be one of \"amplitude\", \"phase\"; did you mean \"phase\"?");
  add("less than no true peaks", mode + "\"amplitude\": [1, 2], \"true_peaks\": -1", "true_peaks",
      "found -1, must be an integer from 0 to 1000");
  add("mode without amplitudes", mode + "\"mode\": 1", "amplitude",
      "found no key \"amplitude\", which is required: must be two values [from, to], each above 0 and at "
      "most "
      "1e+100 m");
  add("mode at one amplitude", mode + "\"amplitude\": 1", "amplitude",
      "found 1 (a number), must be two values [from, to], each above 0");
  add("mode at three amplitudes", mode + "\"amplitude\": [1, 2, 3]", "amplitude",
      "found a list of 3, must be two values [from, to]");
  add("mode from amplitude zero", mode + "\"amplitude\": [0, 1]", "amplitude/0", "found 0, must be above 0");
  add("mode to a smaller amplitude", mode + "\"amplitude\": [1, 0.5]", "amplitude/1",
      "found 0.5, must be above the lower end, which is 1 m");
  add("mode number zero", mode + "\"amplitude\": [1, 2], \"mode\": 0", "mode",
      "found 0, must be an integer from 1 to 10000");
  add("amplitudes of a frequency response",
      "\"kind\": \"frf\", \"from\": 1, \"to\": 2, \"amplitude\": [1, 2]", "amplitude",
      "found the key \"amplitude\", which belongs to studies of kind \"modes\", must be");
  add("misspelt key of a motion in time", at + "\"step\": 100", "step", "did you mean \"steps\"?");
}

}  // namespace

void add_bad_studies(std::vector<BadScene>& rows) {
  add_studies(rows);
  add_samples(rows);
  add_studies_over_a_parameter(rows);
}

}  // namespace arcslip::scene::test
