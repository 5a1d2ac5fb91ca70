#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tabor/analysis/records.hpp"
#include "tabor/contact/contact.hpp"
#include "tabor/deposition/deposition.hpp"
#include "tabor/io/hdf5.hpp"
#include "tabor/metrology/psd.hpp"
#include "tabor/study/case.hpp"
#include "tabor/study/store.hpp"
#include "tabor/topography/topography.hpp"

// What the store's files hold and how they are written and read back (docs/results.md). Writing
// throws OutputError; reading a damaged file throws InputError.
namespace tabor::study {

using analysis::kNoValue;

/// One row of results.csv. Numbers are NaN in a row that failed.
struct Row : analysis::FrictionRecord {
  std::string case_id;
  std::string scan;
  std::string group;
  std::string error;  ///< why there are no numbers; empty if there are

  bool failed() const { return !error.empty(); }
};

void write_row(const Store& store, const Task& task, const Row& row);
Row read_row(const Store& store, const Task& task);

void write_surface(const Store& store, const Task& task, const topography::Topography& topography,
                   const metrology::PowerSpectra& spectra);

/// What a stored surface says about itself, for readers that look at no map.
struct SurfaceFacts {
  Index nx = 0;
  Index ny = 0;
  double pixel_x = 0;  ///< [m]
  double pixel_y = 0;  ///< [m]
  double rms_height = 0;
  double rms_slope = 0;
  std::vector<std::string> treatment;
  std::vector<std::string> warnings;
};
SurfaceFacts read_surface_facts(const Store& store, const Task& task);

/// What a row needs of a stored contact: the record with no maps but these.
struct StoredContact : analysis::ContactRecord {
  Mask contact;  ///< true where the solids touch
  Field gap;     ///< [m]
  Grid grid;
};
void write_contact(const Store& store, const Task& task, const Grid& grid,
                   double saturation_pressure, const analysis::ContactRecord& record);
StoredContact read_contact(const Store& store, const Task& task);
/// Its numbers alone.
analysis::ContactRecord read_contact_record(const Store& store, const Task& task);
/// Its mask alone: true where the solids touch.
Mask read_contact_mask(const Store& store, const Task& task);

/// Films arrive one after the other, in any order; commit() when all are there.
class FilmFile {
 public:
  FilmFile(const Store& store, const Task& task, const Grid& grid);
  void add(const analysis::FilmRecord& record);
  void commit();

 private:
  Grid grid_;
  io::Hdf5Writer writer_;
};
Field read_film(const Store& store, const Task& task, std::size_t density);
/// All that is kept of it.
analysis::FilmRecord read_film_record(const Store& store, const Task& task, std::size_t density);

/// Names and values of attributes.
using Scalars = std::vector<std::pair<std::string, double>>;

/// One state whose oil flows, under these conditions: numbers, and maps for the report, which are
/// not read back.
void write_fluid(const Store& store, const Task& task, const Grid& grid,
                 const analysis::FluidRecord& record, const Scalars& conditions);
analysis::FluidRecord read_fluid(const Store& store, const Task& task);

/// Empty if the file in the store has all its bytes as they were written and belongs to the task,
/// otherwise what is wrong with it.
std::string defect(const Store& store, const Task& task);

/// "/films/0003"
std::string film_group(std::size_t density);

/// What every HDF5 file of tabor says about itself.
void write_root(io::Hdf5Writer& writer, const std::string& default_group);

}  // namespace tabor::study
