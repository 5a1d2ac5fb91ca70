#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tabor/cases/records.hpp"
#include "tabor/contact/contact.hpp"
#include "tabor/deposition/deposition.hpp"
#include "tabor/engine/store.hpp"
#include "tabor/io/hdf5/hdf5.hpp"
#include "tabor/metrology/spectra/psd.hpp"
#include "tabor/study/case.hpp"
#include "tabor/topography/topography.hpp"

// Defines what the files of the store hold, and writes and reads them (docs/results.md). Writing
// throws OutputError; reading a damaged file throws InputError.
namespace tabor::study {

using cases::kNoValue;

/// Row of results.csv. Numbers are NaN in a row that failed.
struct Row : cases::FrictionRecord {
  std::string case_id;
  std::string scan;
  std::string group;
  std::string error;  ///< why there are no numbers; empty if there are

  bool failed() const { return !error.empty(); }
};

void write_row(const engine::Store& store, const engine::Task& task, const Row& row);
Row read_row(const engine::Store& store, const engine::Task& task);

void write_surface(const engine::Store& store, const engine::Task& task,
                   const topography::Topography& topography,
                   const metrology::PowerSpectra& spectra);

/// Facts of a stored surface, for readers that need no map.
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
SurfaceFacts read_surface_facts(const engine::Store& store, const engine::Task& task);

/// Stored contact as a row needs it: the record with no maps but these.
struct StoredContact : cases::ContactRecord {
  Mask contact;  ///< true where the solids touch
  Field gap;     ///< [m]
  Grid grid;
};
void write_contact(const engine::Store& store, const engine::Task& task, const Grid& grid,
                   double saturation_pressure, const cases::ContactRecord& record);
StoredContact read_contact(const engine::Store& store, const engine::Task& task);
/// Reads the numbers of a contact alone.
cases::ContactRecord read_contact_record(const engine::Store& store, const engine::Task& task);
/// Reads the mask of a contact alone: true where the solids touch.
Mask read_contact_mask(const engine::Store& store, const engine::Task& task);

/// Writes the file of films, which arrive one after the other, in any order; to be committed when
/// it is complete.
class FilmFile {
 public:
  FilmFile(const engine::Store& store, const engine::Task& task, const Grid& grid);
  void add(const cases::FilmRecord& record);
  void commit();

 private:
  Grid grid_;
  io::Hdf5Writer writer_;
};
Field read_film(const engine::Store& store, const engine::Task& task, std::size_t density);
/// Reads all that is stored of a film.
cases::FilmRecord read_film_record(const engine::Store& store, const engine::Task& task,
                                   std::size_t density);

/// Names and values of attributes.
using Scalars = std::vector<std::pair<std::string, double>>;

/// Writes one contact with trapped oil, under these conditions: numbers, and maps for the report,
/// which are not read back.
void write_trapped(const engine::Store& store, const engine::Task& task, const Grid& grid,
                   const cases::TrappedRecord& record, const Scalars& conditions);
cases::TrappedRecord read_trapped(const engine::Store& store, const engine::Task& task);

/// Writes one state with flowing oil, under these conditions: numbers, and maps for the report,
/// which are not read back.
void write_fluid(const engine::Store& store, const engine::Task& task, const Grid& grid,
                 const cases::FluidRecord& record, const Scalars& conditions);
cases::FluidRecord read_fluid(const engine::Store& store, const engine::Task& task);

/// Returns "" if the file in the store is complete, unchanged and of this task, otherwise its
/// defect.
std::string defect(const engine::Store& store, const engine::Task& task);

/// Returns the group of a film, "/films/0003".
std::string film_group(std::size_t density);

/// Writes the root attributes of every HDF5 file of tabor.
void write_root(io::Hdf5Writer& writer, const std::string& default_group);

}  // namespace tabor::study
