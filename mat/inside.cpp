#include "inside.hpp"
#include "answer.hpp"

#include <arcslip/scene/files/mat_protocol.hpp>

#include <hdf5.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace arcslip::mat {
namespace {

constexpr std::size_t most_links = 1'000'000;

// An identifier of HDF5, closed by the function for its kind.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  explicit operator bool() const { return id_ >= 0; }
  hid_t id() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

// The links of a file, or of a group in it.
struct Links {
  std::string variable;  // of the group, "" of the file
  std::size_t count = 0;
  std::vector<std::string> of_objects;
  std::string leads_out;  // the first that does, by its name
};

// C calls it: it throws nothing.
herr_t take(hid_t, const char* name, const H5L_info_t* info, void* data) noexcept {
  Links& links = *static_cast<Links*>(data);
  if (++links.count > most_links) return 1;
  if (info->type == H5L_TYPE_HARD)
    links.of_objects.emplace_back(name);
  else if (info->type != H5L_TYPE_SOFT) {
    links.leads_out = name;
    return 1;
  }
  return 0;
}

void check(const Links& links) {
  if (links.count > most_links)
    throw Fault("found more than " + std::to_string(most_links) + " links in it, must have fewer");
  if (links.leads_out.empty()) return;
  throw Fault("found a link to another file, must hold its data itself",
              links.variable.empty() ? links.leads_out : links.variable);
}

void check_storage(hid_t dataset, const std::string& variable) {
  const Handle creation(H5Dget_create_plist(dataset), H5Pclose);
  if (!creation) return;
  const H5D_layout_t layout = H5Pget_layout(creation.id());
  if (layout == H5D_VIRTUAL || H5Pget_external_count(creation.id()) > 0)
    throw Fault("found data that are in another file, must hold its data itself", variable);
  const int filters = H5Pget_nfilters(creation.id());
  for (int k = 0; k < filters; ++k) {
    unsigned flags = 0, configuration = 0;
    std::size_t values = 0;
    const H5Z_filter_t filter = H5Pget_filter2(creation.id(), static_cast<unsigned>(k), &flags, &values,
                                               nullptr, 0, nullptr, &configuration);
    if (filter >= 0 && filter != H5Z_FILTER_DEFLATE && filter != H5Z_FILTER_SHUFFLE &&
        filter != H5Z_FILTER_FLETCHER32)
      throw Fault("found data of the HDF5 filter " + std::to_string(filter) +
                      ", must have none but deflate, shuffle and fletcher32; in MATLAB, save it by save(..., "
                      "\"-v7.3\")",
                  variable);
  }
}

std::size_t numbers(hid_t dataset) {
  const Handle space(H5Dget_space(dataset), H5Sclose);
  const hssize_t count = space ? H5Sget_simple_extent_npoints(space.id()) : 0;
  return count > 0 ? static_cast<std::size_t>(count) : 0;
}

// A group: a struct, or a sparse matrix, whose arrays are "ir", "jc" and "data".
std::size_t look_through_group(hid_t group, const std::string& variable) {
  Links links;
  links.variable = variable;
  H5Lvisit(group, H5_INDEX_NAME, H5_ITER_NATIVE, take, &links);
  check(links);
  std::size_t longest = 0;
  for (const std::string& name : links.of_objects) {
    const Handle object(H5Oopen(group, name.c_str(), H5P_DEFAULT), H5Oclose);
    if (!object || H5Iget_type(object.id()) != H5I_DATASET) continue;
    check_storage(object.id(), variable);
    if (name == "ir" || name == "jc" || name == "data") longest = std::max(longest, numbers(object.id()));
  }
  return longest;
}

}  // namespace

std::map<std::string, std::size_t> look_through(const char* path) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  H5PLset_loading_state(0);
  std::map<std::string, std::size_t> longest;
  const Handle file(H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (!file) return longest;  // matio reports
  Links links;
  H5Literate(file.id(), H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, take, &links);
  check(links);
  for (const std::string& name : links.of_objects) {
    if (name.starts_with('#')) continue;  // "#refs#", "#subsystem#": no variables
    const Handle object(H5Oopen(file.id(), name.c_str(), H5P_DEFAULT), H5Oclose);
    if (!object) continue;
    const H5I_type_t type = H5Iget_type(object.id());
    if (type == H5I_DATASET) check_storage(object.id(), name);
    if (type == H5I_GROUP) longest[name] = look_through_group(object.id(), name);
  }
  return longest;
}

}  // namespace arcslip::mat
