#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tabor/cli/contact_request.hpp"
#include "tabor/cli/fields_file.hpp"
#include "tabor/friction/mixed_friction.hpp"

namespace tabor::cli {

/// The options of `friction` for a film that carries part of the load.
struct FluidRequest {
  std::string fluid = "none";
  std::optional<double> speed;               ///< [m/s], sliding
  std::optional<double> viscosity;           ///< [Pa s]
  std::optional<double> pressure_viscosity;  ///< [1/Pa], absent: constant viscosity
  std::optional<double> eyring_stress;       ///< [Pa], absent: Newtonian

  bool asked() const { return fluid != "none"; }
};

void declare_fluid(OptionSet& set, FluidRequest& request);

/// Refuses what makes no sense, before a scan is read.
void check(const FluidRequest& request, const ContactRequest& contact);

struct FluidResult {
  friction::FluidFilmState state;
  friction::FluidSummary summary;
  std::vector<std::string> doubts;
};

/// The film of one state of contact and deposited oil.
FluidResult solve_fluid(elastic::ElasticOperator& elasticity, const Field& height,
                        const ContactResult& dry, const Field& film, const ContactRequest& contact,
                        const FluidRequest& request, Context& context);

io::Json fluid_json(const friction::FluidSummary& fluid, const friction::MixedEstimate& mixed);
std::vector<StateField> fields_of(const friction::FluidFilmState& state);

io::Json settings_json(const FluidRequest& request);
void describe(const FluidRequest& request, Facts& facts);
std::vector<std::string> methods_of(const FluidRequest& request);

}  // namespace tabor::cli
