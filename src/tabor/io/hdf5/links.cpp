#include <array>
#include <filesystem>

#include "tabor/core/error.hpp"
#include "tabor/io/files/regular_file.hpp"
#include "tabor/io/hdf5/library.hpp"

// External links of HDF5 (HDF5 user guide, "External Links") lead to any file that whoever made
// the file has named. Only those of a study's results into the folder `store` beside them are
// followed; all others dangle.
namespace tabor::io::hdf5 {
namespace {

namespace fs = std::filesystem;

/// Name of the file that holds this group.
fs::path file_of(hid_t group) {
  std::array<char, 4096> name{};
  const ssize_t size = H5Fget_name(group, name.data(), name.size());
  return size > 0 && static_cast<std::size_t>(size) < name.size() ? name.data() : "";
}

hid_t open_in(const fs::path& file, const char* object) {
  try {
    const RegularFile regular(file);
  } catch (const InputError&) {
    return -1;
  }
  const Handle opened(open_for_reading(file.string()), &H5Fclose);
  return opened.valid() ? H5Oopen(opened, object, H5P_DEFAULT) : -1;
}

hid_t traverse(const char*, hid_t group, const void* value, size_t size, hid_t, hid_t) {
  const char* file = nullptr;
  const char* object = nullptr;
  if (H5Lunpack_elink_val(value, size, nullptr, &file, &object) < 0) return -1;
  const fs::path parent = file_of(group);
  return is_store_file(file) && !parent.empty() ? open_in(parent.parent_path() / file, object) : -1;
}

}  // namespace

bool is_store_file(const std::string& target) {
  const fs::path path(target);
  return path.is_relative() && path.parent_path() == "store" && path.extension() == ".h5";
}

void follow_store_links_only() {
  H5L_class_t links{};
  links.version = H5L_LINK_CLASS_T_VERS;
  links.id = H5L_TYPE_EXTERNAL;
  links.comment = "external, into store/ only";
  links.trav_func = &traverse;
  static const herr_t registered = H5Lregister(&links);
  if (registered < 0) throw Error("the HDF5 library cannot be kept from following links");
}

}  // namespace tabor::io::hdf5
