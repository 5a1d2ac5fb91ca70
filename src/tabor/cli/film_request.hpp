#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tabor/cli/scan.hpp"
#include "tabor/cli/verb.hpp"
#include "tabor/io/json.hpp"
#include "tabor/lubrication/deposition.hpp"

namespace tabor::cli {

/// The lubricant options shared by `lubricate` and `friction`.
struct FilmRequest {
  std::vector<double> densities;  ///< areal, as dosed [kg/m^2]
  double oil_density = 900;       ///< [kg/m^3]
  double droplet_height = 1e-7;   ///< [m]
  std::string model = "droplets";
  std::string reading = "conserving";
  std::string edge = "closed";
};

void declare_film(OptionSet& set, FilmRequest& request);

/// Refuses what makes no sense, before a scan is read.
void check(const FilmRequest& request);

/// Rains all densities in one run; `sink` receives each film with its place in request.densities.
/// Throws Interrupted when the user stopped it.
void rain(const Scan& scan, const FilmRequest& request, Context& context,
          const std::function<void(std::size_t, lubrication::Film&&)>& sink);

/// "0.9 g/m^2"
std::string density_text(double density);

/// Settings in force, for the JSON head and the result file.
io::Json settings_json(const FilmRequest& request, const Context& context);
/// The keys of one state.
io::Json state_json(double density, const lubrication::Film& film);
void describe(const FilmRequest& request, const Context& context, Facts& facts);

std::vector<std::string> methods_of(const FilmRequest& request);

}  // namespace tabor::cli
