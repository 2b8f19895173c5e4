#include <arcslip/studies/stability_keys.hpp>

namespace arcslip::studies {

using observables::StabilityRequest;
using scene::Key;
using scene::file::KeyGroup;
using scene::file::Node;
using scene::file::Reading;

namespace {

constexpr const char* hill = "hill";
constexpr int most_multipliers = 10'000;

KeyGroup<StabilityRequest> stability_key(const std::string& help) {
  Key key{"stability",
          scene::KeyType::other,
          "",
          "true, false or \"hill\"",
          "false",
          false,
          help + "; \"hill\": by Hill's method, for laws without memory"};
  key.schema = R"({"enum": [true, false, "hill"]})";
  return {
      {key},
      [key](const Reading& reading, StabilityRequest& request) {
        const scene::file::Location place = reading.keys.find("stability");
        if (place.node == nullptr) return;
        const bool* is = place.node->get<bool>();
        const std::string* by = place.node->get<std::string>();
        if (is == nullptr && (by == nullptr || *by != hill))
          return scene::file::add_wrong_type(place, key.allowed, reading.faults);
        request.wanted = by != nullptr || *is;
        request.by_hill = by != nullptr;
      },
      [](const StabilityRequest& request, const scene::Scene&, Node::Object& to_file) {
        to_file.push_back({"stability", request.by_hill ? Node{std::string(hill)} : Node{request.wanted}});
      }};
}

}  // namespace

std::vector<KeyGroup<StabilityRequest>> stability_keys(const std::string& help) {
  auto kept =
      scene::file::whole("multipliers", &StabilityRequest::multipliers, 0, most_multipliers,
                         "number of multipliers in the results, those of the largest modulus; 0: all");
  kept.write = [write = kept.write](const StabilityRequest& request, const scene::Scene& scene,
                                    Node::Object& to_file) {
    if (request.wanted) write(request, scene, to_file);
  };
  return {stability_key(help), std::move(kept)};
}

}  // namespace arcslip::studies
