#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tabor/analysis/warnings.hpp"
#include "tabor/cli/scan.hpp"
#include "tabor/cli/table.hpp"
#include "tabor/cli/verb.hpp"
#include "tabor/contact/contact.hpp"
#include "tabor/elastic/operator.hpp"
#include "tabor/friction/bowden_tabor.hpp"
#include "tabor/io/json.hpp"

namespace tabor::cli {

/// The contact options shared by `contact` and `friction`.
struct ContactRequest {
  std::vector<double> pressures;  ///< [Pa]
  double youngs_modulus = 0;      ///< [Pa]
  double poissons_ratio = 0;
  std::optional<double> counter_youngs_modulus;  ///< [Pa], absent: rigid
  std::optional<double> counter_poissons_ratio;
  std::optional<double> saturation_pressure;  ///< [Pa], absent: elastic
  std::string boundary = "periodic";
  std::string solver = "fast";
  double tolerance = 1e-6;
  bool load_path = false;   ///< plastic indentation of a state is kept in the next
  bool statistics = false;  ///< stiffness and histograms too

  bool is_periodic() const { return boundary == "periodic"; }
};

/// One solved state with what a user reads about it.
struct ContactResult {
  contact::State state;
  contact::Summary summary;
  analysis::Warnings warnings;  ///< of its surface and its own
  double fft_seconds = 0;
  double seconds = 0;
};

void declare_contact(OptionSet& set, ContactRequest& request);

/// Refuses what no solver could do, before a scan is read: P >= p_sat, a counter body half given.
void check(const ContactRequest& request);

double effective_modulus(const ContactRequest& request);
std::unique_ptr<elastic::ElasticOperator> make_operator(const ContactRequest& request,
                                                        const Grid& grid);

/// What friction takes from the contact, with the share of it that is wet.
friction::Contact for_friction(const ContactResult& result, const ContactRequest& request,
                               double lubricated_share = 0);

/// Solves one state. Throws Interrupted when the user stopped it.
ContactResult solve(elastic::ElasticOperator& elasticity, const Field& height, double pressure,
                    const ContactRequest& request, Context& context);

/// Solves every pressure, hands each result on and drops it. Ctrl-C keeps the finished ones.
/// Returns the exit code: done, not converged or interrupted.
int solve_all(elastic::ElasticOperator& elasticity, const Scan& scan, const ContactRequest& request,
              Context& context, const std::function<void(const ContactResult&)>& receive);

/// Keys of references.bib.
std::vector<std::string> methods_of(const ContactRequest& request);

/// Settings in force, for the JSON head and the result file.
io::Json settings_json(const ContactRequest& request);
/// Contact stiffness and histograms of one state, where --statistics asks for them, else empty.
io::Json statistics_json(elastic::ElasticOperator& elasticity, const ContactResult& result,
                         const ContactRequest& request, Context& context);
/// The keys of one state.
io::Json state_json(const ContactResult& result);
void describe(const ContactRequest& request, Facts& facts);

}  // namespace tabor::cli
