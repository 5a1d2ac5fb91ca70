#include <fmt/format.h>

#include "tabor/cli/contact_request.hpp"
#include "tabor/contact/distributions.hpp"
#include "tabor/contact/stiffness.hpp"

namespace tabor::cli {

namespace {

io::Json histogram_json(const contact::Histogram& histogram, const std::string& edge_key) {
  return {{edge_key, histogram.edges}, {"count", histogram.counts}};
}

}  // namespace

io::Json statistics_json(elastic::ElasticOperator& elasticity, const ContactResult& result,
                         const ContactRequest& request, Context& context) {
  if (!request.statistics) return io::Json::object();
  const contact::Stiffness stiffness = contact::contact_stiffness(
      elasticity, result.state, request.saturation_pressure.value_or(contact::kNoSaturation));
  if (!stiffness.convergence.converged) {
    context.warn(fmt::format("contact stiffness: NOT CONVERGED, residual {:.1e}",
                             stiffness.convergence.certificate));
  }
  return {
      {"contact_stiffness_Pa_per_m", io::number(stiffness.value)},
      {"pressure_histogram", histogram_json(contact::pressure_histogram(result.state), "edge_Pa")},
      {"gap_histogram", histogram_json(contact::gap_histogram(result.state), "edge_m")},
      {"patch_area_histogram",
       histogram_json(
           contact::patch_area_histogram(result.state, elasticity.grid(), request.is_periodic()),
           "edge_m2")}};
}

}  // namespace tabor::cli
