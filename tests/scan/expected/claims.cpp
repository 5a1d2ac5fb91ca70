#include "claims.hpp"

#include <cmath>
#include <stdexcept>

#include "quirks.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/metrology/profile/profile.hpp"
#include "tabor/metrology/spectra/psd.hpp"
#include "tabor/topography/filters.hpp"
#include "tabor/topography/geometry.hpp"
#include "tabor/topography/holes.hpp"

namespace tabor::scan::test {
namespace {

using Measure = std::function<double(Subject&)>;

// Tolerances of the specification (section 8), relative.
constexpr double kByDigits = 0;
constexpr double kMoments = 1e-9;       // of order one: Ssk itself may be near zero
constexpr double kDifferences = 1e-12;  // Sdq, Sdr of the same definition
constexpr double kArea = 1e-12;         // in per cent: the list's Sdr is a ratio of areas minus one
constexpr double kCoreHeights = 3e-3;   // Sk family
constexpr double kMaterialRatio = 0.2;  // Smrk1, Smrk2: percentage points
constexpr double kVolumes = 2e-3;
constexpr double kDecayLength = 1e-2;    // Sal
constexpr double kAspectRatio = 3e-2;    // Str
constexpr double kSurfalizeArea = 1e-5;  // its sum of triangles itself, whose divisor is wrong
constexpr double kGwyddionArea = 5e-3;   // four triangles, its borders included

struct Source {
  std::string convention;  ///< begins with this
  bool (*of_file)(const std::string& file) = nullptr;
  std::string provenance = "";  ///< begins with this
};

Claim claim(const Source& source, const std::string& quantity, Measure ours,
            double tolerance = kByDigits) {
  const auto applies = [source, quantity](const Row& row) {
    return row.quantity == quantity && row.convention.starts_with(source.convention) &&
           row.provenance.starts_with(source.provenance) &&
           (!source.of_file || source.of_file(row.file));
  };
  return {applies, std::move(ours), tolerance, 0, false, {}};
}

Measure value(topography::Form form, metrology::ParameterSet set, const std::string& symbol) {
  return [=](Subject& subject) { return subject.parameter(form, set, symbol).value; };
}

/// rms over all rows (x) or columns (y) about their own means: that of their spectra.
Measure profile_rms(topography::Form form, metrology::Spectrum metrology::PowerSpectra::*axis) {
  return [=](Subject& subject) {
    metrology::PsdOptions options;
    options.window = metrology::PsdWindow::none;
    return (metrology::power_spectra(subject.levelled(form), options).*axis).rms_height;
  };
}

Measure quirk(topography::Form form, double (*of_surface)(const topography::Topography&)) {
  return [=](Subject& subject) { return of_surface(subject.levelled(form)); };
}

Claim wrong(Claim claim, Measure true_value) {
  claim.true_value = std::move(true_value);
  return claim;
}

bool is_synthetic(const std::string& file) { return file.starts_with("synthetic_surfalize"); }
bool is_sine(const std::string& file) { return file == "analytic sine"; }

void add_reader_rows(std::vector<Claim>& all) {
  const auto add = [&](const char* convention, const char* quantity, auto ours) {
    all.push_back(claim({convention}, quantity,
                        [ours](Subject& s) { return static_cast<double>(ours(s.as_read())); }));
  };
  for (const char* convention : {"size = n*pixel", "header"}) {
    add(convention, "nx", [](const topography::Topography& t) { return t.grid.nx; });
    add(convention, "ny", [](const topography::Topography& t) { return t.grid.ny; });
    add(convention, "size_x", [](const topography::Topography& t) { return t.grid.lx; });
    add(convention, "size_y", [](const topography::Topography& t) { return t.grid.ly; });
  }
  const char* valid = "valid points only";
  add(valid, "nx", [](const topography::Topography& t) { return t.grid.nx; });
  add(valid, "ny", [](const topography::Topography& t) { return t.grid.ny; });
  add(valid, "dx", [](const topography::Topography& t) { return t.grid.dx(); });
  add(valid, "dy", [](const topography::Topography& t) { return t.grid.dy(); });
  add(valid, "missing", [](const topography::Topography& t) { return topography::count_holes(t); });
}

void add_height_rows(std::vector<Claim>& all) {
  const auto height = [](topography::Form form, const char* symbol) {
    return value(form, metrology::ParameterSet::height, symbol);
  };
  const Source valid{"valid points only"}, population{"population std"};
  all.push_back(claim(valid, "Sq_raw", height(topography::Form::none, "Sq")));
  all.push_back(claim(valid, "Sq_quad", height(topography::Form::poly2, "Sq")));
  for (const char* symbol : {"Sq", "Sa", "Sz"}) {
    all.push_back(
        claim(valid, std::string(symbol) + "_plane", height(topography::Form::plane, symbol)));
  }
  all.push_back(claim(valid, "Sku_plane", height(topography::Form::plane, "Sku")));
  all.push_back(claim(valid, "Ssk_plane", height(topography::Form::plane, "Ssk")));
  all.back().absolute_tolerance = kMoments;
  for (const char* quantity : {"Sq", "Sq um", "Sq nm"}) {
    all.push_back(claim(population, quantity, height(topography::Form::none, "Sq")));
  }
  all.push_back(claim(population, "Sq quad", height(topography::Form::poly2, "Sq")));
  for (const char* quantity : {"Rq", "Rq_x"}) {
    all.push_back(claim(population, quantity,
                        profile_rms(topography::Form::none, &metrology::PowerSpectra::x)));
  }
  all.push_back(
      claim(population, "Rq_y", profile_rms(topography::Form::none, &metrology::PowerSpectra::y)));
  all.push_back(claim(population, "Rq quad",
                      profile_rms(topography::Form::poly2, &metrology::PowerSpectra::x)));
}

void add_quirks(std::vector<Claim>& all) {
  const Source source{"UPSTREAM QUIRK"};
  const auto sq = [](topography::Form form) {
    return value(form, metrology::ParameterSet::height, "Sq");
  };
  const auto of = [&](const char* quantity, topography::Form form,
                      double (*other)(const topography::Topography&)) {
    all.push_back(wrong(claim(source, quantity, quirk(form, other)), sq(form)));
  };
  of("Sq", topography::Form::none, rms_height_over_all_points);
  of("Sq(n_total)", topography::Form::none, rms_height_over_all_points);
  of("Sq quad(n_total)", topography::Form::poly2, rms_height_over_all_points);
  of("Rq(n_total)", topography::Form::none, rms_row_height_over_all_points);
  of("Rq quad(n_total)", topography::Form::poly2, rms_row_height_over_all_points);
}

/// Gwyddion's Sdq: both sums over the mean number of differences along x and along y.
double gwyddion_slope(Subject& subject, topography::Form form) {
  const Grid& grid = subject.as_read().grid;
  const auto along_x = static_cast<double>((grid.nx - 1) * grid.ny);
  const auto along_y = static_cast<double>(grid.nx * (grid.ny - 1));
  const double x = subject.parameter(form, metrology::ParameterSet::spectral, "m2_x").value;
  const double y = subject.parameter(form, metrology::ParameterSet::spectral, "m2_y").value;
  return std::sqrt((x * along_x + y * along_y) / ((along_x + along_y) / 2));
}

/// Both sums over their own number of differences: sqrt(m2_x + m2_y).
double separate_slope(Subject& subject) {
  return std::sqrt(
      2 *
      subject.parameter(topography::Form::plane, metrology::ParameterSet::spectral, "m2").value);
}

double area_of_four(Subject& subject, topography::Form form) {
  return metrology::developed_area_ratio(subject.levelled(form), metrology::AreaTriangles::four);
}

void add_hybrid_rows(std::vector<Claim>& all) {
  const Measure sdq = value(topography::Form::plane, metrology::ParameterSet::hybrid, "Sdq");
  const Source plane{"after LSQ plane removal"};
  all.push_back(claim({"forward differences"}, "rms_gradient trunc",
                      value(topography::Form::none, metrology::ParameterSet::hybrid, "Sdq"),
                      kDifferences));
  all.push_back(claim({"valid points only"}, "Sdq_plane", separate_slope, kDifferences));
  all.push_back(claim(plane, "Sdq_trunc", sdq, kDifferences));
  all.push_back(claim(plane, "Sdr_tri2_pct",
                      value(topography::Form::plane, metrology::ParameterSet::hybrid, "Sdr"),
                      kDifferences));
  all.back().absolute_tolerance = kArea;
  all.push_back(claim(
      plane, "Sdr_tri4_pct", [](Subject& s) { return area_of_four(s, topography::Form::plane); },
      kDifferences));
  all.back().absolute_tolerance = kArea;
  all.push_back(claim(
      plane, "gwy_Sdq", [](Subject& s) { return gwyddion_slope(s, topography::Form::plane); },
      kDifferences));
  all.push_back(claim(
      plane, "gwy_Sdr_pct", [](Subject& s) { return area_of_four(s, topography::Form::plane); },
      kGwyddionArea));
}

/// The height, material ratio, volume and spatial parameters, of one source and treatment.
void add_areal_rows(std::vector<Claim>& all, const Source& source, topography::Form form) {
  const auto add = [&](metrology::ParameterSet set, const char* symbol, double tolerance) {
    // The list calls Smrk1, Smrk2 by their older names.
    const std::string quantity = std::string(symbol) == "Smrk1"   ? "Smr1"
                                 : std::string(symbol) == "Smrk2" ? "Smr2"
                                                                  : symbol;
    all.push_back(claim(source, quantity, value(form, set, symbol), tolerance));
  };
  for (const char* symbol : {"Sa", "Sq", "Sp", "Sv", "Sz"}) {
    add(metrology::ParameterSet::height, symbol, kByDigits);
  }
  add(metrology::ParameterSet::height, "Sku", kByDigits);
  add(metrology::ParameterSet::height, "Ssk", kByDigits);
  all.back().absolute_tolerance = kMoments;
  for (const char* symbol : {"Sk", "Spk", "Svk", "Spkx", "Svkx", "Sxp"}) {
    add(metrology::ParameterSet::function, symbol, kCoreHeights);
  }
  for (const char* symbol : {"Smrk1", "Smrk2"}) {
    add(metrology::ParameterSet::function, symbol, kByDigits);
    all.back().absolute_tolerance = kMaterialRatio;
  }
  for (const char* symbol : {"Vmp", "Vmc", "Vvv", "Vvc"}) {
    add(metrology::ParameterSet::volume, symbol, kVolumes);
  }
  add(metrology::ParameterSet::spatial, "Sal", kDecayLength);
}

/// Str; where the ACF never falls to 0.2 along the lay, the list has 0 and we have no value.
double aspect_ratio_or_zero(Subject& subject) {
  const metrology::Parameter& str =
      subject.parameter(topography::Form::plane, metrology::ParameterSet::spatial, "Str");
  const bool bounded = std::isnan(str.value) && str.note.starts_with("< ");
  return bounded ? 0 : str.value;
}

/// The published Str of the synthetic surface is Sal over the length of the field, which is what we
/// give as a bound.
double bound_of_aspect_ratio(Subject& subject) {
  const std::string& note =
      subject.parameter(topography::Form::none, metrology::ParameterSet::spatial, "Str").note;
  return note.starts_with("< ") ? std::stod(note.substr(2)) : std::nan("");
}

Measure after_low_pass(const char* filter) {
  return [filter](Subject& subject) {
    // Its reflecting edges are our mirror tiling.
    const topography::Topography tiled =
        topography::mirror(topography::crop(subject.as_read(), {0, 0, 1000, 700}));
    return metrology::rms_height(topography::low_pass(tiled, topography::parse_filter(filter)));
  };
}

void add_synthetic_rows(std::vector<Claim>& all) {
  add_areal_rows(all, {"see report 3"}, topography::Form::none);
  const Source surfalize{"", is_synthetic, "surfalize"};
  const Source gwyddion{"libgwyddion 2.62", is_synthetic};
  for (const char* symbol : {"Sa", "Sq", "Ssk", "Sku"}) {
    all.push_back(claim(gwyddion, symbol,
                        value(topography::Form::none, metrology::ParameterSet::height, symbol)));
  }
  all.push_back(claim(gwyddion, "avg", [](Subject& s) {
    return sum(s.as_read().height) / static_cast<double>(s.as_read().grid.size());
  }));
  all.push_back(
      claim(gwyddion, "Sdq", [](Subject& s) { return gwyddion_slope(s, topography::Form::none); }));
  all.push_back(claim(
      gwyddion, "surface_area/projected",
      [](Subject& s) { return 1 + area_of_four(s, topography::Form::none) / 100; }, kGwyddionArea));
  all.push_back(
      wrong(claim(surfalize, "Sdq", quirk(topography::Form::none, rms_slope_over_all_points)),
            value(topography::Form::none, metrology::ParameterSet::hybrid, "Sdq")));
  all.push_back(wrong(claim(
                          surfalize, "Sdr",
                          [](Subject& s) {
                            const Grid& grid = s.as_read().grid;
                            const auto cells = static_cast<double>((grid.nx - 1) * (grid.ny - 1));
                            const auto fewer = static_cast<double>((grid.nx - 2) * (grid.ny - 2));
                            const double sdr = metrology::developed_area_ratio(s.as_read());
                            return 100 * ((1 + sdr / 100) * cells / fewer - 1);
                          },
                          kSurfalizeArea),
                      value(topography::Form::none, metrology::ParameterSet::hybrid, "Sdr")));
  all.push_back(claim(surfalize, "Str", bound_of_aspect_ratio, kAspectRatio));
  // Its kernel ends at four sigma, which leaves 6e-5 of the weight out.
  for (const auto& [length, filter] :
       {std::pair{"2", "gauss:2um"}, {"5", "gauss:5um"}, {"1.5", "gauss:1.5um"}}) {
    all.push_back(claim(surfalize, std::string("Sq after Gaussian low-pass lc=") + length + " um",
                        after_low_pass(filter), 1e-4));
  }
}

void add_sine_rows(std::vector<Claim>& all) {
  const Source sine{"", is_sine};
  const auto height = [](const char* symbol) {
    return value(topography::Form::none, metrology::ParameterSet::height, symbol);
  };
  all.push_back(claim(sine, "Sa/a", height("Sa")));
  all.push_back(claim(sine, "Sq/a", height("Sq")));
  all.push_back(claim(sine, "Ssk", height("Ssk")));
  all.push_back(claim(sine, "Sku", height("Sku")));
  all.push_back(claim(sine, "Sz/a", height("Sz")));
  all.push_back(
      claim(sine, "Sdq", value(topography::Form::none, metrology::ParameterSet::hybrid, "Sdq")));
  all.push_back(claim(sine, "m0/a^2",
                      value(topography::Form::none, metrology::ParameterSet::spectral, "m0")));
  all.push_back(claim(sine, "Smr(c=0)",
                      value(topography::Form::none, metrology::ParameterSet::function, "Smr(c)")));
}

Measure profile_value(const metrology::ProfileOptions& options, const std::string& symbol) {
  return [=](Subject& subject) {
    for (const metrology::Parameter& found :
         metrology::profile_parameters(subject.as_read(), metrology::ProfileAxis::x, options)) {
      if (found.symbol == symbol + "_x") return found.value;
    }
    throw std::out_of_range("no profile parameter " + symbol);
  };
}

/// The file holds the roughness profile, as filtered by the instrument.
void add_instrument_rows(std::vector<Claim>& all) {
  const Source source{"ISO 1997"};
  metrology::ProfileOptions options;
  options.standard = metrology::ProfileStandard::iso4287;
  options.cutoff = 2.5e-3;
  options.sections = 4;
  options.filtered = true;
  for (const char* symbol : {"Ra", "Rq", "Rp", "Rv", "Rz", "Rt", "Rz1max", "Rsk", "Rku", "Rdq"}) {
    all.push_back(claim(source, symbol, profile_value(options, symbol)));
  }
  // The instrument's own come from the second filter of ISO 13565-1, which the file does not hold;
  // the list's are those of the plain curve.
  for (const char* symbol : {"Rk", "Rpk", "Rvk"}) {
    all.push_back(claim(source, symbol, profile_value(options, symbol), kCoreHeights));
    all.back().against_recomputed = true;
  }
  for (const char* symbol : {"Mr1", "Mr2"}) {
    all.push_back(claim(source, symbol, profile_value(options, symbol)));
    all.back().absolute_tolerance = kMaterialRatio;
    all.back().against_recomputed = true;
  }
  // Areas of the triangles of Rpk and Rvk, from the numbers printed beside them.
  all.push_back(claim(source, "A1", [](Subject&) { return 2.912e-6 * 5.822 / 2; }));
  all.push_back(claim(source, "A2", [](Subject&) { return 3.98e-6 * (100 - 92.617) / 2; }));
}

/// Published about the mean, with forward differences for the slope.
void add_synthetic_profile_rows(std::vector<Claim>& all) {
  const Source source{"RandomState(0)"};
  metrology::ProfileOptions options;
  options.cutoff = 20e-6;
  options.sections = 5;
  options.filtered = true;
  options.forward_slopes = true;
  for (const char* symbol : {"Ra", "Rq", "Rp", "Rv", "Rz", "Rt", "Rsk", "Rku", "Rdq"}) {
    all.push_back(claim(source, symbol, profile_value(options, symbol)));
  }
}

std::vector<Claim> all_claims() {
  std::vector<Claim> all;
  add_reader_rows(all);
  add_height_rows(all);
  add_quirks(all);
  add_hybrid_rows(all);
  add_areal_rows(all, {"after LSQ plane removal"}, topography::Form::plane);
  all.push_back(claim({"after LSQ plane removal"}, "Str", aspect_ratio_or_zero, kAspectRatio));
  add_synthetic_rows(all);
  add_sine_rows(all);
  add_instrument_rows(all);
  add_synthetic_profile_rows(all);
  return all;
}

}  // namespace

const std::vector<Claim>& claims() {
  static const std::vector<Claim> all = all_claims();
  return all;
}

std::string unclaimed_reason(const Row& row) {
  if (row.file.starts_with("(upstream ")) return "the file is not among the scans";
  if (row.text == "nan") return "the file has no lateral scale: it is rejected without --pixel";
  return "";
}

}  // namespace tabor::scan::test
