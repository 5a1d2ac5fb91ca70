#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "tabor/core/error.hpp"
#include "tabor/io/files/atomic_file.hpp"
#include "tabor/io/files/sealed_file.hpp"
#include "tabor/io/hdf5/chunks.hpp"
#include "tabor/io/hdf5/hdf5.hpp"
#include "tabor/io/hdf5/library.hpp"

namespace tabor::io {
namespace {

using namespace hdf5;
namespace fs = std::filesystem;

Handle text_type() {
  Handle type(H5Tcopy(H5T_C_S1), &H5Tclose);
  H5Tset_size(type, H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

Handle simple_space(const std::vector<hsize_t>& shape) {
  return {H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), &H5Sclose};
}

Handle scalar_space() { return {H5Screate(H5S_SCALAR), &H5Sclose}; }

Handle link_creation() {
  Handle creation(H5Pcreate(H5P_LINK_CREATE), &H5Pclose);
  H5Pset_create_intermediate_group(creation, 1);
  H5Pset_char_encoding(creation, H5T_CSET_UTF8);
  return creation;
}

/// The same bytes for the same content: no time stamps.
Handle dataset_creation() {
  Handle creation(H5Pcreate(H5P_DATASET_CREATE), &H5Pclose);
  H5Pset_obj_track_times(creation, false);
  return creation;
}

/// Chunks of a map, none larger than it unless it is empty: a band of rows, so that one line across
/// the map touches few of them; at most 0.5 MB of doubles.
ChunkLayout layout_of(Index rows, Index columns, std::size_t element_size) {
  return {{rows, columns},
          {std::clamp<Index>(rows, 1, 64), std::clamp<Index>(columns, 1, 1024)},
          element_size};
}

/// Chunked; the filters are those that pack_chunks() has applied.
Handle map_creation(const ChunkLayout& layout) {
  Handle creation = dataset_creation();
  const std::array<hsize_t, 2> chunk{static_cast<hsize_t>(layout.chunk[0]),
                                     static_cast<hsize_t>(layout.chunk[1])};
  H5Pset_chunk(creation, 2, chunk.data());
  H5Pset_shuffle(creation);
  H5Pset_deflate(creation, 4);
  return creation;
}

/// Copies part of a row of a map, converted to the element type of the file.
template <typename Stored, typename Map>
CopyRow rows_of(const Map& map) {
  return [&map](Index row, Index column, Index count, char* to) {
    using Row = Eigen::Array<Stored, 1, Eigen::Dynamic>;
    const Row values = map.row(row).segment(column, count).template cast<Stored>();
    std::memcpy(to, values.data(), static_cast<std::size_t>(count) * sizeof(Stored));
  };
}

std::vector<const char*> c_strings(const std::vector<std::string>& values) {
  std::vector<const char*> pointers;
  pointers.reserve(values.size() + 1);
  for (const std::string& value : values) pointers.push_back(value.c_str());
  pointers.push_back(nullptr);  // so that data() of an empty list is a valid address
  return pointers;
}

/// Closes its dataset within a session, whatever ends the writing.
struct OpenMap {
  Handle dataset;
  ~OpenMap() {
    const Session session;
    dataset.reset();
  }
};

}  // namespace

struct Hdf5Writer::File {
  File(const fs::path& name, Seal wanted)
      : temporary(name), id(create(temporary.path()), &H5Fclose), seal(wanted) {
    if (!id.valid()) fail("");
  }

  static hid_t create(const fs::path& path) {
    const Session session;
    const Handle access = writing_access();
    return H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  }

  [[noreturn]] void fail(const std::string& path) const {
    throw OutputError(temporary.final_path().string() + ": cannot write" +
                      (path.empty() ? "" : " " + path) + " (disk full or not writable?)");
  }

  void check(bool done, const std::string& path) const {
    if (!done || write_failed(id)) fail(path);
  }

  void write(const std::string& path, hid_t file_type, hid_t memory_type,
             const std::vector<hsize_t>& shape, const void* data) {
    const Session session;
    const Handle space = simple_space(shape);
    const Handle links = link_creation();
    const Handle creation = dataset_creation();
    Handle dataset(H5Dcreate2(id, path.c_str(), file_type, space, links, creation, H5P_DEFAULT),
                   &H5Dclose);
    check(dataset.valid(), path);
    if (count_of(shape) > 0) {
      check(H5Dwrite(dataset, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0, path);
    }
    check(dataset.reset(), path);
  }

  Handle make_map(const std::string& path, hid_t type, const ChunkLayout& layout) {
    const auto [rows, columns] = layout.shape;
    const Handle space = simple_space({static_cast<hsize_t>(rows), static_cast<hsize_t>(columns)});
    const Handle links = link_creation();
    const bool is_empty = rows == 0 || columns == 0;
    const Handle creation = is_empty ? dataset_creation() : map_creation(layout);
    Handle dataset(H5Dcreate2(id, path.c_str(), type, space, links, creation, H5P_DEFAULT),
                   &H5Dclose);
    check(dataset.valid(), path);
    return dataset;
  }

  /// Within no session: others write while this one packs.
  void write_map(const std::string& path, hid_t type, const ChunkLayout& layout,
                 const CopyRow& copy_row) {
    OpenMap map{[&] {
      const Session session;
      return make_map(path, type, layout);
    }()};
    pack_chunks(layout, copy_row, [&](const PackedChunk& chunk) {
      const Session session;
      check(write_chunk(map.dataset, chunk) >= 0, path);
    });
    const Session session;
    check(map.dataset.reset(), path);
  }

  static herr_t write_chunk(hid_t dataset, const PackedChunk& chunk) {
    const std::array<hsize_t, 2> offset{static_cast<hsize_t>(chunk.offset[0]),
                                        static_cast<hsize_t>(chunk.offset[1])};
    return H5Dwrite_chunk(dataset, H5P_DEFAULT, 0, offset.data(), chunk.bytes.size(),
                          chunk.bytes.data());
  }

  void attribute(const std::string& path, const std::string& name, hid_t type, const Handle& space,
                 const void* data) {
    const Handle object(H5Oopen(id, path.c_str(), H5P_DEFAULT), &H5Oclose);
    check(object.valid(), path);
    if (H5Aexists(object, name.c_str()) > 0) H5Adelete(object, name.c_str());
    Handle made(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), &H5Aclose);
    check(made.valid() && H5Awrite(made, type, data) >= 0 && made.reset(), path + "@" + name);
  }

  TemporaryFile temporary;
  Handle id;
  Seal seal;
};

Hdf5Writer::Hdf5Writer(const fs::path& file, Seal seal)
    : file_(std::make_unique<File>(file, seal)) {}

Hdf5Writer::Hdf5Writer(Hdf5Writer&&) noexcept = default;

Hdf5Writer::~Hdf5Writer() {
  const Session session;
  file_.reset();
}

const fs::path& Hdf5Writer::close() {
  const Session session;
  file_->check(H5Fflush(file_->id, H5F_SCOPE_GLOBAL) >= 0, "");
  if (!file_->id.reset()) file_->fail("");
  return file_->temporary.path();
}

void Hdf5Writer::commit() {
  close();
  if (file_->seal == Seal::yes) io::seal(file_->temporary.path());
  file_->temporary.commit();
}

void Hdf5Writer::group(const std::string& path) {
  const Session session;
  const Handle links = link_creation();
  const Handle made(H5Gcreate2(file_->id, path.c_str(), links, H5P_DEFAULT, H5P_DEFAULT),
                    &H5Gclose);
  file_->check(made.valid(), path);
}

void Hdf5Writer::write(const std::string& path, const Field& map, Precision precision) {
  if (precision == Precision::float32) {
    file_->write_map(path, H5T_IEEE_F32LE, layout_of(map.rows(), map.cols(), sizeof(float)),
                     rows_of<float>(map));
  } else {
    file_->write_map(path, H5T_IEEE_F64LE, layout_of(map.rows(), map.cols(), sizeof(double)),
                     rows_of<double>(map));
  }
}

void Hdf5Writer::write(const std::string& path, const ByteMap& map) {
  file_->write_map(path, H5T_STD_U8LE, layout_of(map.rows(), map.cols(), 1),
                   rows_of<std::uint8_t>(map));
}

void Hdf5Writer::write(const std::string& path, const std::vector<double>& values) {
  file_->write(path, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {values.size()}, values.data());
}

void Hdf5Writer::write(const std::string& path, const std::vector<std::int64_t>& values) {
  file_->write(path, H5T_STD_I64LE, H5T_NATIVE_INT64, {values.size()}, values.data());
}

void Hdf5Writer::write(const std::string& path, const std::vector<std::string>& values) {
  const Session session;
  const Handle type = text_type();
  file_->write(path, type, type, {values.size()}, c_strings(values).data());
}

void Hdf5Writer::attribute(const std::string& path, const std::string& name, double value) {
  const Session session;
  file_->attribute(path, name, H5T_NATIVE_DOUBLE, scalar_space(), &value);
}

void Hdf5Writer::attribute(const std::string& path, const std::string& name, std::int64_t value) {
  const Session session;
  file_->attribute(path, name, H5T_NATIVE_INT64, scalar_space(), &value);
}

void Hdf5Writer::attribute(const std::string& path, const std::string& name,
                           const std::string& value) {
  const Session session;
  const char* pointer = value.c_str();
  file_->attribute(path, name, text_type(), scalar_space(), &pointer);
}

void Hdf5Writer::attribute(const std::string& path, const std::string& name,
                           const std::vector<std::string>& values) {
  const Session session;
  file_->attribute(path, name, text_type(), simple_space({values.size()}),
                   c_strings(values).data());
}

void Hdf5Writer::describe(const std::string& path, const std::string& units,
                          const std::string& long_name) {
  attribute(path, "units", units);
  attribute(path, "long_name", long_name);
}

void Hdf5Writer::axes(const std::string& group, const Grid& grid, double left, double top) {
  const Session session;
  for (const bool along_x : {true, false}) {
    const Index n = along_x ? grid.nx : grid.ny;
    const double spacing = along_x ? grid.dx() : grid.dy();
    const std::string name = along_x ? "x" : "y";
    const Eigen::ArrayXd centres =
        (along_x ? left : top) + (Eigen::ArrayXd::LinSpaced(n, 0, double(n - 1)) + 0.5) * spacing;
    std::string path = group;
    path.append("/").append(name);
    write(path, std::vector<double>(centres.begin(), centres.end()));
    const Handle scale(H5Dopen2(file_->id, path.c_str(), H5P_DEFAULT), &H5Dclose);
    file_->check(scale.valid() && H5DSset_scale(scale, name.c_str()) >= 0, path);
    describe(path, "m", along_x ? "x, sliding direction" : "y, downwards");
  }
}

void Hdf5Writer::attach_axes(const std::string& map) {
  const Session session;
  const std::string group = map.substr(0, map.rfind('/'));
  const Handle dataset(H5Dopen2(file_->id, map.c_str(), H5P_DEFAULT), &H5Dclose);
  for (const unsigned dimension : {0u, 1u}) {
    const std::string path = group + (dimension == 0 ? "/y" : "/x");
    const Handle scale(H5Dopen2(file_->id, path.c_str(), H5P_DEFAULT), &H5Dclose);
    file_->check(
        dataset.valid() && scale.valid() && H5DSattach_scale(dataset, scale, dimension) >= 0, map);
  }
}

void Hdf5Writer::nxdata(const std::string& group, const std::string& signal,
                        const std::vector<std::string>& axes) {
  attribute(group, "NX_class", "NXdata");
  attribute(group, "signal", signal);
  attribute(group, "axes", axes);
}

void Hdf5Writer::link(const std::string& path, const std::string& target) {
  const Session session;
  const Handle links = link_creation();
  file_->check(
      H5Lcreate_hard(file_->id, target.c_str(), file_->id, path.c_str(), links, H5P_DEFAULT) >= 0,
      path);
}

void Hdf5Writer::external_link(const std::string& path, const std::string& file,
                               const std::string& target) {
  const Session session;
  const Handle links = link_creation();
  file_->check(H5Lcreate_external(file.c_str(), target.c_str(), file_->id, path.c_str(), links,
                                  H5P_DEFAULT) >= 0,
               path);
}

}  // namespace tabor::io
