// Containers of contact.engineering: a ZIP archive of measurements with an index (index.json, in
// older ones meta.yml) that names their files, sizes and units (SurfaceTopography,
// Container/IO/Schema.py).
#include <fmt/format.h>

#include <memory>

#include "tabor/core/checks.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/io/files/atomic_file.hpp"
#include "tabor/io/files/subprocess.hpp"
#include "tabor/io/text/json.hpp"
#include "tabor/io/text/yaml.hpp"
#include "tabor/scan/formats/archive.hpp"
#include "tabor/scan/formats/readers.hpp"

namespace tabor::scan::format {
namespace {

constexpr const char* kName = "ce";
constexpr const char* kProvider = "contact.engineering";
/// Every measurement is opened to describe it.
constexpr std::size_t kMostMeasurements = 1000;

/// One measurement as the index describes it.
struct Measurement {
  std::string name = {};
  std::string surface = {};
  std::string prepared = {};  ///< entry with the heights as contact.engineering treated them, or ""
  std::string original = {};  ///< entry with the file of the instrument, or ""
  std::vector<double> size = {};
  std::string unit = {};
  double height_scale = 1;
  std::optional<bool> is_periodic = {};
  std::string fill = {};     ///< how missing heights were filled
  std::string detrend = {};  ///< what was subtracted

  const std::string& entry() const { return prepared.empty() ? original : prepared; }
};

std::string text_of(const io::Json& object, const char* key) {
  const bool is_text = object.is_object() && object.contains(key) && object.at(key).is_string();
  return is_text ? object.at(key).get<std::string>() : "";
}

io::Json list_of(const io::Json& object, const char* key) {
  const bool is_list = object.is_object() && object.contains(key) && object.at(key).is_array();
  return is_list ? object.at(key) : io::Json::array();
}

std::vector<double> numbers_of(const io::Json& object, const char* key) {
  std::vector<double> numbers;
  for (const io::Json& value : list_of(object, key)) {
    numbers.push_back(value.is_number() ? value.get<double>() : kHole);
  }
  return numbers;
}

Measurement measurement_of(const io::Json& entry, const std::string& surface) {
  Measurement one{.name = text_of(entry, "name"), .surface = surface};
  if (entry.is_object() && entry.contains("datafile")) {
    one.prepared = text_of(entry["datafile"], "squeezed-netcdf");
    one.original = text_of(entry["datafile"], "original");
  }
  one.size = numbers_of(entry, "size");
  one.unit = text_of(entry, "unit");
  const auto is = [&](const char* key, bool (io::Json::*kind)() const noexcept) {
    return entry.is_object() && entry.contains(key) && (entry[key].*kind)();
  };
  if (is("height_scale", &io::Json::is_number)) {
    one.height_scale = entry["height_scale"].get<double>();
  }
  if (is("is_periodic", &io::Json::is_boolean)) one.is_periodic = entry["is_periodic"].get<bool>();
  one.fill = text_of(entry, "fill_undefined_data_mode");
  one.detrend = text_of(entry, "detrend_mode");
  return one;
}

std::vector<Measurement> measurements_of(const Contents& contents, const io::Json& index) {
  std::vector<Measurement> all;
  const io::Json surfaces = list_of(index, "surfaces");
  for (const io::Json& surface : surfaces) {
    for (const io::Json& entry : list_of(surface, "topographies")) {
      all.push_back(measurement_of(entry, text_of(surface, "name")));
      Measurement& one = all.back();
      if (surfaces.size() > 1 && !one.surface.empty()) one.name = one.surface + ": " + one.name;
      if (one.entry().empty()) {
        reject(contents, "measurement '" + one.name + "' without a data file", "its name",
               kDamaged);
      }
      if (all.size() > kMostMeasurements) {
        reject(contents, fmt::format("more than {} measurements", kMostMeasurements),
               "fewer in one archive", "unpack it and read its files one by one");
      }
    }
  }
  if (all.empty()) reject(contents, "no measurement in its index", "at least one", kDamaged);
  return all;
}

std::shared_ptr<const Archive> archive_of(const Contents& contents) {
  try {
    return std::make_shared<const Archive>(contents, "index.json", kProvider);
  } catch (const Unrecognised&) {
    return std::make_shared<const Archive>(contents, "meta.yml", kProvider);
  }
}

io::Json index_of(const Contents& contents, const Archive& archive) {
  const std::string text = archive.main();
  const std::string name = contents.file.string() + ": " + archive.main_entry().name;
  if (name.ends_with(".yml")) return io::parse_yaml(text, name);
  try {
    return io::parse_json(text);
  } catch (const InputError& error) {
    throw InputError(name + ": " + error.what() + "; " + kDamaged);
  }
}

/// A file of the archive in a temporary folder: some formats are read by the name of the file.
class Member {
 public:
  Member(const Contents& archive_contents, const Archive& archive, const std::string& name)
      : said_(archive_contents.file.string() + ": " + name) {
    const io::ZipEntry& entry = archive.find(name);
    check_memory(said_, "its unpacked file", static_cast<double>(entry.size), "");
    io::write_file(path(), [&](const io::Append& append) { archive.read(entry, append); });
    observer_ = archive_contents.observer;
  }

  /// Runs an action on the opened file; messages name the archive and its entry.
  template <typename Action>
  auto with(const Action& action) const {
    try {
      const io::MappedFile mapped(path());
      const Contents contents{path(), mapped.bytes(), &mapped, observer_};
      return action(open_document(contents, kName));
    } catch (const InputError& error) {
      std::string text = error.what();
      const std::string hidden = path().string();
      for (std::size_t at = text.find(hidden); at != std::string::npos;
           at = text.find(hidden, at + said_.size())) {
        text.replace(at, hidden.size(), said_);
      }
      throw InputError(text);
    }
  }

 private:
  std::filesystem::path path() const { return folder_.path() / "measurement"; }

  io::TemporaryFolder folder_;
  std::string said_;
  const Observer* observer_ = nullptr;
};

/// Rejects indices whose entries, also those that they name often, unpack to more than an archive
/// of this size can hold.
void check_unpacked_size(const Contents& contents, const Archive& archive,
                         const std::vector<Measurement>& measurements) {
  std::size_t size = 0;
  for (const Measurement& one : measurements) {
    size += archive.find(one.entry()).size;
    if (size <= kLargestDeflateRatio * contents.bytes.size()) continue;
    reject(contents, fmt::format("more than {} bytes of measurements", size),
           "as many as the archive can hold", kDamaged);
  }
}

/// What the file of an instrument lacks, the index may know.
void complete(const Measurement& one, Layer& layer) {
  const auto factor = unit_factor(one.unit, dimension::length);
  if (layer.unit.empty() && factor) {
    layer.unit = one.unit;
    layer.scale *= one.height_scale;
    layer.is_count = false;
  }
  if (!layer.pixel_x && factor && !one.size.empty()) {
    layer.pixel_x = one.size[0] * *factor / static_cast<double>(layer.nx);
    layer.pixel_y =
        one.size.size() < 2 ? layer.pixel_x : one.size[1] * *factor / static_cast<double>(layer.ny);
    layer.said_x = layer.said_y = "the size in the index";
  }
}

/// What contact.engineering did to the prepared heights.
std::vector<std::string> treatment_of(const Measurement& one) {
  if (one.prepared.empty() || one.original.empty()) return {};
  std::vector<std::string> notes{
      fmt::format("{} has treated these heights (detrend: {}); the archive also holds {}",
                  kProvider, one.detrend.empty() ? "unknown" : one.detrend, one.original)};
  if (!one.fill.empty() && one.fill != "do-not-fill") {
    notes.push_back(fmt::format("{} may have filled missing heights ({})", kProvider, one.fill));
  }
  return notes;
}

bool may_hold_heights(const Layer& layer) {
  return !layer.is_picture &&
         (layer.unit.empty() || unit_factor(layer.unit, dimension::length).has_value());
}

std::vector<std::string> late_of(const Layer& layer) {
  return layer.late_warnings ? *layer.late_warnings : std::vector<std::string>();
}

/// The layers of one measurement; heights are unpacked anew when they are loaded.
std::vector<Layer> layers_of(const Contents& contents, std::shared_ptr<const Archive> archive,
                             const Measurement& one, const Document& document) {
  std::vector<Layer> layers;
  for (std::size_t i = 0; i < document.layers.size(); ++i) {
    Layer layer = document.layers[i];
    if (!may_hold_heights(layer)) continue;
    complete(one, layer);
    layer.index.reset();
    layer.late_warnings = std::make_shared<std::vector<std::string>>();
    layer.load = [contents, archive, one, i, late = layer.late_warnings] {
      const Member member(contents, *archive, one.entry());
      return member.with([&](const Document& opened) {
        if (i >= opened.layers.size()) reject(contents, "fewer layers than before", "", kDamaged);
        Field heights = opened.layers[i].load();
        *late = treatment_of(one);
        for (const auto& more : {opened.warnings, late_of(opened.layers[i])}) {
          late->insert(late->end(), more.begin(), more.end());
        }
        return heights;
      });
    };
    layers.push_back(std::move(layer));
  }
  for (Layer& layer : layers) {
    if (one.name.empty()) continue;
    layer.name = layers.size() == 1 ? one.name : one.name + ": " + layer.name;
  }
  return layers;
}

/// What the file of the only measurement says about its heights.
void describe(const Document& opened, Document& document) {
  document.instrument = opened.instrument;
  document.metadata = opened.metadata;
  document.history = opened.history;
  document.lasting = opened.lasting;
  document.tiles = opened.tiles;
  document.edges = opened.edges;
}

}  // namespace

Match identify_ce(std::string_view head) { return is_zip(head) ? Match::maybe : Match::no; }

Document open_ce(const Contents& contents) {
  const auto archive = archive_of(contents);
  const io::Json index = index_of(contents, *archive);
  if (!index.is_object() || !index.contains("surfaces")) {
    throw Unrecognised(contents, fmt::format("an index without surfaces (so not {})", kProvider),
                       "unpack it if it holds several files");
  }
  const std::vector<Measurement> measurements = measurements_of(contents, index);
  Document document{.format = kName, .periodic = true};
  check_unpacked_size(contents, *archive, measurements);
  for (const Measurement& one : measurements) {
    Member(contents, *archive, one.entry()).with([&](const Document& opened) {
      if (measurements.size() == 1) describe(opened, document);
      if (!one.is_periodic.value_or(opened.periodic)) document.periodic = false;
      for (Layer& layer : layers_of(contents, archive, one, opened)) {
        document.layers.push_back(std::move(layer));
      }
    });
  }
  const std::string& surface = measurements.front().surface;
  if (!surface.empty() && measurements.back().surface == surface) {
    document.metadata["surface"] = surface;
  }
  if (document.layers.empty()) reject(contents, "no heights in its measurements", "heights");
  return document;
}

}  // namespace tabor::scan::format
