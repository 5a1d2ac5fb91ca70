// A DATX file as Zygo's Mx writes it, with the C library of HDF5: compound types of texts and
// lists.
#include <hdf5.h>

#include "support/container_files.hpp"
#include "support/sample_map.hpp"

namespace tabor::test {
namespace {

constexpr const char* kGroup = "/Data/Surface";
constexpr const char* kPath = "/Data/Surface/{surface}";
constexpr double kNoData = 1.7e308;

struct Row {
  const char* source;
  const char* link;
  const char* destination;
};

struct Converter {
  const char* category;
  const char* unit;
  hvl_t parameters;
};

hid_t text_type() {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, H5T_VARIABLE);
  return type;
}

void write_attribute(hid_t object, const char* name, hid_t type, const void* value) {
  const hsize_t one = 1;
  const hid_t space = H5Screate_simple(1, &one, nullptr);
  const hid_t attribute = H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(attribute, type, value);
  H5Aclose(attribute);
  H5Sclose(space);
}

void write_table(hid_t file) {
  const Row rows[]{
      {"Root", "Measurement", "{m}"}, {"{m}", "Surface", "{s}"}, {"{s}", "Path", kPath}};
  const hid_t text = text_type();
  const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof(Row));
  H5Tinsert(type, "Source", HOFFSET(Row, source), text);
  H5Tinsert(type, "Link", HOFFSET(Row, link), text);
  H5Tinsert(type, "Destination", HOFFSET(Row, destination), text);
  const hsize_t n = std::size(rows);
  const hid_t space = H5Screate_simple(1, &n, nullptr);
  const hid_t table =
      H5Dcreate2(file, "/MetaData", type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Dwrite(table, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, rows);
  H5Dclose(table);
  H5Sclose(space);
  H5Tclose(type);
  H5Tclose(text);
}

void write_converter(hid_t surface, const char* name, double metres) {
  double parameters[]{0, metres, 0, 0};
  const Converter converter{"LateralCat", "Pixels", {std::size(parameters), parameters}};
  const hid_t text = text_type();
  const hid_t list = H5Tvlen_create(H5T_NATIVE_DOUBLE);
  const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof(Converter));
  H5Tinsert(type, "Category", HOFFSET(Converter, category), text);
  H5Tinsert(type, "BaseUnit", HOFFSET(Converter, unit), text);
  H5Tinsert(type, "Parameters", HOFFSET(Converter, parameters), list);
  write_attribute(surface, name, type, &converter);
  H5Tclose(type);
  H5Tclose(list);
  H5Tclose(text);
}

}  // namespace

void write_datx(const std::filesystem::path& name, const std::string& unit) {
  const hid_t file = H5Fcreate(name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  write_table(file);
  H5Gclose(H5Gcreate2(file, "/Data", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  H5Gclose(H5Gcreate2(file, kGroup, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  const double heights[]{1, 2, 3, 4, 5, kNoData};
  const hsize_t shape[]{2, 3};
  const hid_t space = H5Screate_simple(2, shape, nullptr);
  const hid_t surface =
      H5Dcreate2(file, kPath, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Dwrite(surface, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, heights);
  const hid_t text = text_type();
  const char* unit_text = unit.c_str();
  write_attribute(surface, "Unit", text, &unit_text);
  write_attribute(surface, "No Data", H5T_NATIVE_DOUBLE, &kNoData);
  write_converter(surface, "X Converter", 2e-6);
  write_converter(surface, "Y Converter", 4e-6);
  H5Tclose(text);
  H5Dclose(surface);
  H5Sclose(space);
  H5Fclose(file);
}

}  // namespace tabor::test
