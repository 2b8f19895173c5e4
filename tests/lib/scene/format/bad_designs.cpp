#include "bad_topics.hpp"

namespace arcslip::scene::test {

void add_bad_designs(std::vector<BadScene>& rows) {
  const auto add = [&](const std::string& name, const std::string& keys, const std::string& place,
                       const std::string& message) {
    rows.push_back(
        {name,
         good_scene_with(
             "{\"kind\": \"frf\", \"from\": 1, \"to\": 2, \"for_each\": {\"d.normal_load\": [1, 2]}}",
             "{\"kind\": \"optimum\", \"over\": [\"d.normal_load\", \"k.value\"], "
             "\"bounds\": [[1, 2], [1, 2]], \"frequency\": [1, 2], " +
                 keys + "}"),
         "/studies/0/" + place, message});
  };
  const auto constraint = [&](const std::string& name, const std::string& text, const std::string& place,
                              const std::string& message) {
    add(name, "\"constraints\": [" + text + "]", "constraints/0" + place, message);
  };
  const auto cases = [&](const std::string& name, const std::string& text, const std::string& place,
                         const std::string& message) {
    add(name, "\"cases\": " + text, "cases" + place, message);
  };

  constraint("limit on nothing", R"({"at_most": 1})", "",
             "found neither \"observable\" nor \"sum\", must have one of them");
  constraint("limit on two things", R"({"observable": "frequency", "sum": {"k.value": 1}, "at_most": 1})", "",
             "found \"observable\" and \"sum\" together, must have one of them");
  constraint("sum without a limit", R"({"sum": {"k.value": 1}})", "",
             "found neither \"at_least\" nor \"at_most\", must have one of them");
  constraint("sum between limits that are reversed",
             R"({"sum": {"k.value": 1}, "at_least": 3, "at_most": 2})", "",
             "found \"at_least\" 3 and \"at_most\" 2, must be the lower and the upper limit");
  constraint("sum that is no object", R"({"sum": ["k.value"], "at_most": 1})", "/sum",
             "found a list, must be an object");
  constraint(
      "sum of a parameter that the design does not hold", R"({"sum": {"m.value": 1}, "at_most": 1})",
      "/sum/m.value",
      "found \"m.value\", must be one of the parameters that the study is \"over\", \"d.normal_load\", "
      "\"k.value\"");
  constraint("sum of a misspelt parameter", R"({"sum": {"d.normal_laod": 1}, "at_most": 1})",
             "/sum/d.normal_laod", "did you mean \"d.normal_load\"?");
  constraint("sum with a weight that is no number", R"({"sum": {"k.value": [1]}, "at_most": 1})",
             "/sum/k.value", "found a list, must be a finite number");
  constraint("sum of nothing", R"({"sum": {}, "at_most": 1})", "/sum",
             "found no weight other than 0, must have one for at least one of \"d.normal_load\"");
  constraint("sum with weights of zero", R"({"sum": {"k.value": 0}, "at_most": 1})", "/sum",
             "found no weight other than 0");
  constraint("misspelt key of a limit", R"({"sum": {"k.value": 1}, "at_mots": 1, "at_least": 0})", "/at_mots",
             "did you mean \"at_most\"?");

  cases("cases that are a number", "3", "",
        "found 3 (a number), must be a list of at least one object with the keys \"set\", \"weight\", "
        "\"response\", or an object with a list of values for each of its parameters");
  cases("no case in a list", "[]", "", "found an empty list, must be a list of at least one object");
  cases("no case in an object", "{}", "", "found an empty object, must be a list of at least one object");
  cases("case that is no object", "[1]", "/0", "found 1 (a number), must be an object with the keys \"set\"");
  cases("misspelt key of a case", R"([{"wieght": 2}])", "/0/wieght", "did you mean \"weight\"?");
  cases("case with a weight of zero", R"([{"weight": 0}])", "/0/weight", "found 0, must be above 0");
  cases("case that sets a list", R"([{"set": [1]}])", "/0/set", "found a list, must be an object");
  cases("case with a parameter of the design", R"([{"set": {"d.normal_load": 1}}])", "/0/set/d.normal_load",
        "found \"d.normal_load\", which the study is \"over\"; must be another parameter");
  cases("case with an unknown parameter", R"([{"set": {"m.valu": 1}}])", "/0/set/m.valu",
        "did you mean \"m.value\"?");
  cases("case with a value out of bounds", R"([{"set": {"m.value": -1}}])", "/0/set/m.value",
        "found -1, must be at least 0 kg");
  cases("case that sets a parameter twice", R"([{"set": {"m.value": 1, "m.value": 2}}])", "/0/set/m.value",
        "found the key \"m.value\" again, must stand only once");
  cases("case with a response that is nowhere", R"([{"response": {"at": "c"}}])", "/0/response/at",
        "found \"c\", must be one of the degrees of freedom \"a\", \"b\" or \"ground\"");
  cases("case with a response in two ways", R"([{"response": {"at": "a", "between": ["a", "b"]}}])",
        "/0/response", "found \"at\", \"between\" together, must have exactly one of");
  cases("cases with a parameter of the design", R"({"k.value": [1, 2]})", "/k.value",
        "found \"k.value\", which the study is \"over\"; must be another parameter");
  cases("cases with values out of bounds", R"({"m.value": [1, -2]})", "/m.value/1",
        "found -2, must be at least 0 kg");
  cases("cases without a value", R"({"m.value": []})", "/m.value",
        "found an empty list, must be a list of at least one number");
  std::string many = "{}", values = "1";
  for (int i = 0; i < 1000; ++i) many += ", {}";
  for (int i = 1; i < 40; ++i) values += ", 1";
  cases("a thousand cases and one", "[" + many + "]", "", "found 1001 cases, must be at most 1000");
  cases("forty values of each of two parameters",
        "{\"m.value\": [" + values + "], \"c.value\": [" + values + "]}", "",
        "found more than 1000 cases, which are all combinations of the values, or parameters; must be at "
        "most 1000");

  add("misspelt criterion", R"("cases": [{}], "criterion": "wrost")", "criterion",
      "found \"wrost\", must be one of \"worst\", \"mean\"; did you mean \"worst\"?");
  add("mean of no cases", R"("criterion": "mean")", "criterion",
      "found \"mean\" without \"cases\"; must be \"worst\"");
  add("mean with scatter", R"("criterion": "mean", "cases": [{}], "scatter": {"m.value": [1, 2]})",
      "criterion", "found \"mean\" together with \"scatter\", which takes the worst case; must be \"worst\"");
  add("scatter that is a list", R"("scatter": [1, 2])", "scatter", "found a list, must be an object");
  add("scatter of one value", R"("scatter": {"m.value": 1})", "scatter/m.value",
      "found 1 (a number), must be a pair [lower, upper], each at least 0 kg");
  add("scatter between bounds that are reversed", R"("scatter": {"m.value": [2, 1]})", "scatter/m.value/1",
      "found 1, must be above the lower bound, which is 2 kg");
  add("scatter of a parameter of the design", R"("scatter": {"k.value": [1, 2]})", "scatter/k.value",
      "found \"k.value\", which the study is \"over\"; must be another parameter");
  add("scatter of what cases set", R"("cases": {"m.value": [1, 2]}, "scatter": {"m.value": [1, 2]})",
      "scatter/m.value", "found \"m.value\", which \"cases\" set; must be another parameter");
  add("scatter of an unknown parameter", R"("scatter": {"m.valu": [1, 2]})", "scatter/m.valu",
      "did you mean \"m.value\"?");

  const std::string range = ", \"from\": 1, \"to\": 2";
  add("along no parameter", R"("along": "f.cosin")" + range, "along", "did you mean \"f.cosine\"?");
  add("along the frequency", R"("along": "frequency")" + range, "along",
      "found \"frequency\", must be another parameter");
  add("along a parameter of the design", R"("along": "k.value")" + range, "along",
      "found \"k.value\", which the study is \"over\"; must be another parameter");
  add("along a parameter with cases and a limit",
      R"("cases": [{}], "constraints": [{"observable": "frequency", "at_most": 2}], "along": "f.sine")" +
          range,
      "along",
      "found \"along\" together with \"constraints\", \"cases\", which it does not support; must be given "
      "alone");
  add("along an uncertain parameter", R"("scatter": {"c.value": [1, 2]}, "along": "c.value")" + range,
      "along", "found \"along\" together with \"scatter\"");
  add("along a parameter without its end", R"("along": "f.sine", "from": 1)", "to",
      "found no key \"to\", which is required: must be a finite number (N)");
  add("along a parameter backwards", R"("along": "f.sine", "from": 1, "to": 0)", "to",
      "found 0, must be above \"from\", which is 1 N");
  add("range along nothing", R"("from": 1)", "from",
      "found the key \"from\" without \"along\", whose range it belongs to");
  add("for each of what cases set", R"("cases": {"m.value": [1]}, "for_each": {"m.value": [2]})",
      "for_each/m.value", "found \"m.value\", which \"cases\" set; must be another parameter");
  add("for each of an uncertain parameter", R"("scatter": {"m.value": [1, 2]}, "for_each": {"m.value": [2]})",
      "for_each/m.value", "found \"m.value\", which is in \"scatter\"; must be another parameter");
  add("for each of what the study goes along", R"("along": "f.sine", "for_each": {"f.sine": [2]})" + range,
      "for_each/f.sine", "found \"f.sine\", which the study goes \"along\"; must be another parameter");

  add("search without an evaluation", R"("evaluations": 0)", "evaluations",
      "found 0, must be an integer from 1 to 100000000");
  add("search of half an evaluation", R"("evaluations": 1.5)", "evaluations",
      "found 1.5, must be an integer");
  add("search of less than no time", R"("seconds": -1)", "seconds", "found -1, must be at least 0 s");
  add("search with a negative population", R"("population": -1)", "population",
      "found -1, must be an integer from 0 to 100000000");
  add("search with a seed that is no number", R"("seed": "x")", "seed",
      "found \"x\" (a string), must be an integer from 0 to 100000000");
  add("local search that is no name", R"("local": {})", "local",
      "found an object, must be a string, the name of an NLopt algorithm");
  add("misspelt setting of a search", R"("evaluation": 100)", "evaluation", "did you mean \"evaluations\"?");
}

}  // namespace arcslip::scene::test
