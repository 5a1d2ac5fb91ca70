#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>

#include "tabor/core/error.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/io/files/regular_file.hpp"
#include "tabor/io/hdf5/hdf5.hpp"
#include "tabor/io/hdf5/library.hpp"
#include "tabor/io/hdf5/records.hpp"

namespace tabor::io {
namespace {

using namespace hdf5;
namespace fs = std::filesystem;

std::vector<hsize_t> shape_of(hid_t space) {
  const int rank = H5Sget_simple_extent_ndims(space);
  std::vector<hsize_t> shape(static_cast<std::size_t>(std::max(rank, 0)));
  if (rank > 0) H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  return shape;
}

/// What a dataset or attribute says about itself.
struct Described {
  Handle type;
  Handle space;
  std::vector<hsize_t> shape;
  std::uint64_t count;
  H5T_class_t kind;
};

Described describe(Handle type, Handle space) {
  std::vector<hsize_t> shape = space.valid() ? shape_of(space) : std::vector<hsize_t>{};
  const std::uint64_t count = count_of(shape);
  const H5T_class_t kind = type.valid() ? H5Tget_class(type) : H5T_NO_CLASS;
  return {std::move(type), std::move(space), std::move(shape), count, kind};
}

/// A two-dimensional dataset of numbers.
struct OpenMap {
  Handle dataset;
  Described what;
  Index ny() const { return static_cast<Index>(what.shape[0]); }
  Index nx() const { return static_cast<Index>(what.shape[1]); }
};

/// Rows of a map to read at once: whole chunks of some 32 MiB.
hsize_t rows_per_slab(const OpenMap& map) {
  constexpr hsize_t wanted_bytes = hsize_t{32} << 20;
  hsize_t chunk[2] = {1, 1};
  const Handle created(H5Dget_create_plist(map.dataset), &H5Pclose);
  if (H5Pget_layout(created) == H5D_CHUNKED) H5Pget_chunk(created, 2, chunk);
  const hsize_t row_bytes = std::max<hsize_t>(1, map.what.shape[1] * sizeof(double));
  const hsize_t n_chunks = std::max<hsize_t>(1, wanted_bytes / row_bytes / chunk[0]);
  return n_chunks * chunk[0];
}

/// Calls action(first_row, n_rows) for such pieces, from the top.
template <typename Action>
void for_slabs(const OpenMap& map, const Action& action) {
  const hsize_t n_rows = map.what.count > 0 ? map.what.shape[0] : 0;
  const hsize_t at_once = rows_per_slab(map);
  for (hsize_t row = 0; row < n_rows; row += at_once) {
    action(static_cast<Index>(row), static_cast<Index>(std::min(at_once, n_rows - row)));
  }
}

bool is_number(H5T_class_t kind) { return kind == H5T_INTEGER || kind == H5T_FLOAT; }

}  // namespace

struct Hdf5Reader::File {
  explicit File(const fs::path& file) : name(file), id(open(file), &H5Fclose) {
    if (!id.valid()) {
      throw InputError(name.string() + (is_hdf5(file) ? ": damaged or incomplete HDF5 file"
                                                      : ": cannot be read as HDF5"));
    }
  }

  static hid_t open(const fs::path& file) {
    const RegularFile regular(file);  // the library would wait for a pipe
    const Session session;
    return open_for_reading(file.string());
  }

  [[noreturn]] void fail(const std::string& path, const std::string& problem) const {
    throw InputError(name.string() + ": " + path + " " + problem);
  }

  /// True if every link on the way exists and leads somewhere.
  bool exists(const std::string& path) const {
    for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
      const std::string part = path.substr(0, end);
      if (part != "/" && (H5Lexists(id, part.c_str(), H5P_DEFAULT) <= 0 ||
                          H5Oexists_by_name(id, part.c_str(), H5P_DEFAULT) <= 0)) {
        return false;
      }
      if (end == std::string::npos) return true;
    }
  }

  Handle open_dataset(const std::string& path) const {
    if (!exists(path)) {
      reject_foreign_link(path);
      fail(path, "is missing");
    }
    Handle dataset(H5Dopen2(id, path.c_str(), H5P_DEFAULT), &H5Dclose);
    if (!dataset.valid()) fail(path, "is not a readable dataset");
    reject_values_elsewhere(dataset, path);
    return dataset;
  }

  /// Says so where a link on the way leads to a file that is not followed.
  void reject_foreign_link(const std::string& path) const {
    for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
      const std::string part = path.substr(0, end);
      H5L_info_t link{};
      if (part == "/" || H5Lget_info(id, part.c_str(), &link, H5P_DEFAULT) < 0) return;
      if (link.type == H5L_TYPE_EXTERNAL) {
        fail(part, "is a link into another file; expected the values in the file itself");
      }
      if (end == std::string::npos) return;
    }
  }

  /// Values may lie in any file that whoever made this one has named: also in one that is no
  /// HDF5, or in a pipe. Before anything is asked of the dataset, since the library looks there.
  void reject_values_elsewhere(hid_t dataset, const std::string& path) const {
    const Handle created(H5Dget_create_plist(dataset), &H5Pclose);
    if (!created.valid() || H5Pget_layout(created) == H5D_VIRTUAL ||
        H5Pget_external_count(created) != 0) {
      fail(path, "keeps its values in other files; expected them in the file itself");
    }
  }

  Handle open_attribute(const std::string& path, const std::string& attribute) const {
    // By name from this file, the library (1.10.8) would look for texts of an object behind an
    // external link in this file.
    const Handle object(H5Oopen(id, path.c_str(), H5P_DEFAULT), &H5Oclose);
    Handle opened(H5Aopen(object, attribute.c_str(), H5P_DEFAULT), &H5Aclose);
    if (!opened.valid()) fail(path, "has no attribute " + attribute);
    return opened;
  }

  /// Rejects sizes that the file's own bytes cannot hold, before memory is asked for.
  void check_size(hid_t dataset, const Described& what, const std::string& path,
                  std::uint64_t bytes_per_value) const {
    // Deflate shrinks at most 1032 : 1 (zlib technical note), no other common filter does better.
    constexpr std::uint64_t largest_ratio = 1100;
    const Handle file(H5Iget_file_id(dataset), &H5Fclose);
    hsize_t file_bytes = 0;
    H5Fget_filesize(file, &file_bytes);
    const std::uint64_t stored = std::min<std::uint64_t>(H5Dget_storage_size(dataset), file_bytes);
    const std::uint64_t limit =
        stored * largest_ratio / std::max<std::size_t>(H5Tget_size(what.type), 1);
    if (what.count > limit) {
      fail(path, fmt::format("claims {} values but the file holds {} bytes of it",
                             fmt::join(what.shape, " x "), stored));
    }
    const std::uint64_t available = available_memory_bytes();
    if (available > 0 && what.count > available / bytes_per_value) {
      fail(path, fmt::format("needs {} bytes of memory, {} are free", what.count * bytes_per_value,
                             available));
    }
  }

  /// Rejects what is no dataset of numbers of this rank or does not fit into memory.
  Described checked_numbers(hid_t dataset, const std::string& path, std::size_t rank,
                            std::uint64_t bytes_per_value) const {
    Described what =
        describe(Handle(H5Dget_type(dataset), &H5Tclose), Handle(H5Dget_space(dataset), &H5Sclose));
    if (!is_number(what.kind) || what.shape.size() != rank) {
      fail(path, fmt::format("is not a {}-dimensional dataset of numbers", rank));
    }
    check_size(dataset, what, path, bytes_per_value);
    return what;
  }

  OpenMap open_map(const std::string& path) const {
    Handle dataset = open_dataset(path);
    Described what = checked_numbers(dataset, path, 2, sizeof(double));
    return {std::move(dataset), std::move(what)};
  }

  void read_rows(const OpenMap& map, const std::string& path, Index first, Index n,
                 double* destination) const {
    const hsize_t start[2] = {static_cast<hsize_t>(first), 0};
    const hsize_t count[2] = {static_cast<hsize_t>(n), map.what.shape[1]};
    const Handle slab(H5Screate_simple(2, count, nullptr), &H5Sclose);
    const hid_t space = map.what.space;
    if (H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, count, nullptr) < 0 ||
        H5Dread(map.dataset, H5T_NATIVE_DOUBLE, slab, space, H5P_DEFAULT, destination) < 0) {
      fail(path, "is damaged");
    }
  }

  template <typename Value>
  void read_numbers(const std::string& path, std::size_t rank, hid_t memory_type,
                    const std::function<Value*(const std::vector<hsize_t>&)>& allocate) const {
    const Session session;
    const Handle dataset = open_dataset(path);
    const Described what = checked_numbers(dataset, path, rank, sizeof(Value));
    Value* destination = allocate(what.shape);
    if (what.count > 0 &&
        H5Dread(dataset, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, destination) < 0) {
      fail(path, "is damaged");
    }
  }

  template <typename Value>
  std::vector<Value> read_vector(const std::string& path, hid_t memory_type) const {
    std::vector<Value> values;
    read_numbers<Value>(path, 1, memory_type, [&values](const std::vector<hsize_t>& shape) {
      values.resize(shape[0]);
      return values.data();
    });
    return values;
  }

  template <typename Map>
  Map read_map(const std::string& path, hid_t memory_type) const {
    Map map;
    read_numbers<typename Map::Scalar>(
        path, 2, memory_type, [&map](const std::vector<hsize_t>& shape) {
          map.resize(static_cast<Index>(shape[0]), static_cast<Index>(shape[1]));
          return map.data();
        });
    return map;
  }

  /// Strings of either kind HDF5 knows. `read` is H5Dread or H5Aread bound to its object.
  std::vector<std::string> read_texts(const Described& what, const std::string& path,
                                      const std::function<herr_t(hid_t, void*)>& read) const {
    if (what.kind != H5T_STRING || what.shape.size() > 1 || what.count > (1u << 24)) {
      fail(path, "is not text");
    }
    std::vector<std::string> values;
    if (what.count == 0) return values;
    if (H5Tis_variable_str(what.type) > 0) {
      std::vector<char*> pointers(what.count, nullptr);
      const Handle memory_type(H5Tcopy(what.type), &H5Tclose);
      if (read(memory_type, pointers.data()) < 0) fail(path, "is damaged");
      for (const char* pointer : pointers) values.emplace_back(pointer == nullptr ? "" : pointer);
      H5Dvlen_reclaim(memory_type, what.space, H5P_DEFAULT, pointers.data());
      return values;
    }
    const std::size_t size = H5Tget_size(what.type);
    if (size > (1u << 20) || what.count * size > (1u << 28)) fail(path, "is too long a text");
    std::vector<char> block(what.count * size);
    if (read(what.type, block.data()) < 0) fail(path, "is damaged");
    for (std::size_t i = 0; i < what.count; ++i) {
      const char* begin = block.data() + i * size;
      values.emplace_back(begin, std::find(begin, begin + size, '\0'));
    }
    return values;
  }

  template <typename Value>
  Value read_attribute(const std::string& path, const std::string& attribute,
                       hid_t memory_type) const {
    const Session session;
    const Handle opened = open_attribute(path, attribute);
    const Described what =
        describe(Handle(H5Aget_type(opened), &H5Tclose), Handle(H5Aget_space(opened), &H5Sclose));
    Value value{};
    if (!is_number(what.kind) || what.count != 1 || H5Aread(opened, memory_type, &value) < 0) {
      fail(path + "@" + attribute, "is not a number");
    }
    return value;
  }

  fs::path name;
  Handle id;
};

Hdf5Reader::Hdf5Reader(const fs::path& file) : file_(std::make_unique<File>(file)) {}

Hdf5Reader::Hdf5Reader(Hdf5Reader&&) noexcept = default;

Hdf5Reader::~Hdf5Reader() {
  const Session session;
  file_.reset();
}

bool Hdf5Reader::exists(const std::string& path) const {
  const Session session;
  return file_->exists(path);
}

std::vector<std::string> Hdf5Reader::children(const std::string& group) const {
  const Session session;
  const Handle opened(H5Gopen2(file_->id, group.c_str(), H5P_DEFAULT), &H5Gclose);
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* data) -> herr_t {
    auto& list = *static_cast<std::vector<std::string>*>(data);
    list.emplace_back(name);
    return list.size() < (1u << 20) ? 0 : -1;
  };
  if (!opened.valid() ||
      H5Literate(opened, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, collect, &names) < 0) {
    file_->fail(group, "is not a readable group");
  }
  std::sort(names.begin(), names.end());
  return names;
}

bool Hdf5Reader::is_dataset(const std::string& path) const {
  const Session session;
  const Handle object(H5Oopen(file_->id, path.c_str(), H5P_DEFAULT), &H5Oclose);
  if (!object.valid()) file_->fail(path, "is missing");
  return H5Iget_type(object) == H5I_DATASET;
}

std::vector<Index> Hdf5Reader::shape(const std::string& path) const {
  const Session session;
  const Handle dataset = file_->open_dataset(path);
  const Handle space(H5Dget_space(dataset), &H5Sclose);
  std::vector<Index> shape;
  for (const hsize_t n : shape_of(space)) shape.push_back(static_cast<Index>(n));
  return shape;
}

std::array<Index, 2> Hdf5Reader::map_shape(const std::string& path) const {
  const Session session;
  const OpenMap map = file_->open_map(path);
  return {map.ny(), map.nx()};
}

Precision Hdf5Reader::precision(const std::string& path) const {
  const Session session;
  const OpenMap map = file_->open_map(path);
  const std::size_t exact = map.what.kind == H5T_FLOAT ? sizeof(float) : sizeof(std::int16_t);
  return H5Tget_size(map.what.type) <= exact ? Precision::float32 : Precision::float64;
}

Field Hdf5Reader::field(const std::string& path,
                        const std::function<void(double)>& progress) const {
  const Session session;
  const OpenMap map = file_->open_map(path);
  Field field(map.ny(), map.nx());
  for_slabs(map, [&](Index first, Index n) {
    file_->read_rows(map, path, first, n, &field(first, 0));
    if (progress) progress(static_cast<double>(first + n) / static_cast<double>(map.ny()));
  });
  return field;
}

void Hdf5Reader::for_rows(const std::string& path,
                          const std::function<void(Index, const Field&)>& accept) const {
  const Session session;
  const OpenMap map = file_->open_map(path);
  for_slabs(map, [&](Index first, Index n) {
    Field rows(n, map.nx());
    file_->read_rows(map, path, first, n, rows.data());
    accept(first, rows);
  });
}

ByteMap Hdf5Reader::bytes(const std::string& path) const {
  return file_->read_map<ByteMap>(path, H5T_NATIVE_UINT8);
}

std::vector<double> Hdf5Reader::numbers(const std::string& path) const {
  return file_->read_vector<double>(path, H5T_NATIVE_DOUBLE);
}

std::vector<std::int64_t> Hdf5Reader::integers(const std::string& path) const {
  return file_->read_vector<std::int64_t>(path, H5T_NATIVE_INT64);
}

std::vector<std::string> Hdf5Reader::texts(const std::string& path) const {
  const Session session;
  const Handle dataset = file_->open_dataset(path);
  const Described what =
      describe(Handle(H5Dget_type(dataset), &H5Tclose), Handle(H5Dget_space(dataset), &H5Sclose));
  file_->check_size(dataset, what, path, sizeof(std::string));
  return file_->read_texts(what, path, [&](hid_t type, void* data) {
    return H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data);
  });
}

std::vector<Hdf5Record> Hdf5Reader::records(const std::string& path) const {
  const Session session;
  const Handle dataset = file_->open_dataset(path);
  const Described what =
      describe(Handle(H5Dget_type(dataset), &H5Tclose), Handle(H5Dget_space(dataset), &H5Sclose));
  auto records = read_records(what.type, what.space, what.count, [&](hid_t type, void* data) {
    return H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data);
  });
  if (!records) file_->fail(path, "is no table of texts and numbers");
  return std::move(*records);
}

std::vector<Hdf5Record> Hdf5Reader::attribute_records(const std::string& path,
                                                      const std::string& name) const {
  const Session session;
  const Handle opened = file_->open_attribute(path, name);
  const Described what =
      describe(Handle(H5Aget_type(opened), &H5Tclose), Handle(H5Aget_space(opened), &H5Sclose));
  auto records = read_records(what.type, what.space, what.count,
                              [&](hid_t type, void* data) { return H5Aread(opened, type, data); });
  if (!records) file_->fail(path + "@" + name, "is no table of texts and numbers");
  return std::move(*records);
}

bool Hdf5Reader::has_attribute(const std::string& path, const std::string& name) const {
  const Session session;
  return file_->exists(path) &&
         H5Aexists_by_name(file_->id, path.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::string> Hdf5Reader::attribute_names(const std::string& path) const {
  const Session session;
  const Handle object(H5Oopen(file_->id, path.c_str(), H5P_DEFAULT), &H5Oclose);
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5A_info_t*, void* data) -> herr_t {
    static_cast<std::vector<std::string>*>(data)->emplace_back(name);
    return 0;
  };
  if (!object.valid() ||
      H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, collect, &names) < 0) {
    file_->fail(path, "is missing or damaged");
  }
  std::sort(names.begin(), names.end());
  return names;
}

double Hdf5Reader::number(const std::string& path, const std::string& name) const {
  return file_->read_attribute<double>(path, name, H5T_NATIVE_DOUBLE);
}

std::int64_t Hdf5Reader::integer(const std::string& path, const std::string& name) const {
  return file_->read_attribute<std::int64_t>(path, name, H5T_NATIVE_INT64);
}

std::vector<std::string> Hdf5Reader::attribute_texts(const std::string& path,
                                                     const std::string& name) const {
  const Session session;
  const Handle opened = file_->open_attribute(path, name);
  const Described what =
      describe(Handle(H5Aget_type(opened), &H5Tclose), Handle(H5Aget_space(opened), &H5Sclose));
  return file_->read_texts(what, path + "@" + name,
                           [&](hid_t type, void* data) { return H5Aread(opened, type, data); });
}

std::string Hdf5Reader::text(const std::string& path, const std::string& name) const {
  const std::vector<std::string> values = attribute_texts(path, name);
  if (values.size() != 1) file_->fail(path + "@" + name, "is not one text");
  return values.front();
}

bool is_hdf5(const fs::path& file) {
  std::array<char, 8> begin{};
  try {
    RegularFile(file).read(begin.data(), begin.size());
  } catch (const InputError&) {
    return false;
  }
  return std::string_view(begin.data(), begin.size()) == std::string_view("\x89HDF\r\n\x1a\n", 8);
}

}  // namespace tabor::io
