#include "tabor/cli/psd_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tabor/cli/table.hpp"

namespace tabor::cli {

namespace {

using metrology::HeightDifference;
using metrology::PowerSpectra;
using metrology::Spectrum;

/// A Hurst exponent with its error; "-" where no range of scales is long enough for one.
std::string exponent(const metrology::HurstFit& fit) {
  if (!std::isfinite(fit.hurst)) return "-";
  return plain(fit.hurst, 3) + " ± " + plain(fit.standard_error, 1);
}

/// The same with the error that is a lower bound.
std::string exponent(const metrology::DifferenceHurst& fit) {
  if (!std::isfinite(fit.hurst)) return "-";
  return plain(fit.hurst, 3) + " ± " + plain(fit.standard_error, 1) + " or more";
}

/// The range of a fit; "no range" where there is none.
template <typename Fit>
std::string range_of(const Fit& fit, const std::string& range) {
  return std::isfinite(fit.hurst) ? range : "no range";
}

void add_row(const std::string& name, const Spectrum& spectrum, Table& table) {
  if (spectrum.q.empty()) return;
  const metrology::HurstFit& fit = spectrum.hurst;
  table.row({name, exponent(fit),
             range_of(fit, fmt::format("{:.3g} to {:.3g} rad/m", fit.q_min, fit.q_max)),
             fmt::format("{}", fit.n_bins), si(spectrum.rms_height, "m"),
             fmt::format("{} [{}]", spectrum.density.size(), spectrum.unit)});
}

void add_row(const std::string& name, const HeightDifference& difference, double mean_square,
             Table& table) {
  if (difference.lag.empty()) return;
  const metrology::DifferenceHurst fit = metrology::fit_hurst(difference, mean_square);
  table.row({name, exponent(fit),
             range_of(fit, fmt::format("{} to {}", si(fit.lag_min, "m"), si(fit.lag_max, "m"))),
             fmt::format("{}", fit.n_bins), "-", fmt::format("{} [m^2]", difference.lag.size())});
}

void describe(const PowerSpectra& spectra, Facts& facts) {
  facts.fact("convention", std::string(name_of(spectra.convention)));
  std::string window(name_of(spectra.window));
  if (spectra.window_gain != 1) {
    window += fmt::format(" (multiplies the variance by {:.3g})", spectra.window_gain);
  }
  facts.fact("window", window);
  facts.fact("rms height", si(spectra.rms_height, "m"));
  facts.fact("rms slope", plain(spectra.rms_slope));
}

void describe(const metrology::TrustedRange& range, bool with_tip, Facts& facts) {
  const std::string from = range.tip_limits ? "what the tip leaves" : "4 pixels";
  facts.fact("trust", range.shortest < range.longest
                          ? fmt::format("wavelengths {} to {} (rule of thumb: {} to a quarter of "
                                        "the side{})",
                                        si(range.shortest, "m"), si(range.longest, "m"), from,
                                        with_tip ? "" : "; --tip-radius judges a probing tip")
                          : fmt::format("no wavelength: from {} ({}) would be above {}, a quarter "
                                        "of the side",
                                        si(range.shortest, "m"), from, si(range.longest, "m")));
}

}  // namespace

std::string text_of(const Scan& scan, const cases::SpectraRecord& curves) {
  Facts facts;
  describe(scan, facts);
  if (curves.spectra) describe(*curves.spectra, facts);
  describe(curves.trusted, curves.with_tip, facts);
  if (curves.acf) {
    const auto lengths = metrology::correlation_lengths(*curves.acf);
    const auto aspect = lengths.texture_aspect();
    const std::string texture =
        topography::is_profile(curves.acf->grid())
            ? ""
            : ", Str " + (aspect ? plain(*aspect) : "< " + plain(lengths.texture_bound()));
    facts.fact("autocorrelation", "Sal " + si(lengths.shortest, "m") + texture);
  }
  Table table({"curve", "Hurst exponent", "fitted over", "bins", "rms height", "points"});
  if (curves.spectra) {
    add_row("C1D along x", curves.spectra->x, table);
    add_row("C1D along y", curves.spectra->y, table);
    add_row("C2D radial", curves.spectra->radial, table);
  }
  if (curves.hdf) {
    add_row("differences along x", curves.hdf->x, curves.mean_square, table);
    add_row("differences along y", curves.hdf->y, curves.mean_square, table);
    add_row("differences, radial", curves.hdf->radial, curves.mean_square, table);
  }
  return facts.text() + (curves.spectra || curves.hdf ? '\n' + table.text() : "");
}

std::string text_of(const std::vector<cases::GroupSpectra>& groups, bool has_window) {
  Table table({"group", "scans", has_window ? "rms height in window, mean" : "rms height, mean",
               "standard deviation", "points, x y radial"});
  const auto points = [](const std::optional<metrology::MeanSpectrum>& mean) {
    return mean ? fmt::format("{}", mean->q.size()) : std::string("-");
  };
  for (const cases::GroupSpectra& group : groups) {
    table.row({group.name, fmt::format("{}", group.scans.size()), si(group.rms_height.mean, "m"),
               std::isnan(group.rms_height.standard_deviation)
                   ? "-"
                   : si(group.rms_height.standard_deviation, "m"),
               fmt::format("{} {} {}", points(group.x), points(group.y), points(group.radial))});
  }
  return table.text();
}

}  // namespace tabor::cli
