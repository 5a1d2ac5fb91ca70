#include "tabor/cases/lowpass.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tabor/cases/states.hpp"
#include "tabor/metrology/areal/parameters.hpp"
#include "tabor/topography/filters.hpp"
#include "tabor/topography/treatment.hpp"

namespace tabor::cases {
namespace {

void add_friction(const ContactSettings& settings, const FrictionSettings& friction,
                  LowpassRecord& record) {
  const friction::Estimate estimate =
      dry_friction(record.contact, 0, 0, settings, friction, record.contact.warnings);
  record.friction_dry = estimate.friction_dry;
  record.dry_at_bound = estimate.at_bound;
}

/// The columns of a contact with no heading but these: a scan of cutoffs has columns of its own.
Columns<ContactRecord> contact_columns_headed(const std::vector<std::string>& keys) {
  Columns<ContactRecord> columns = contact_columns();
  for (auto& column : columns) {
    if (std::find(keys.begin(), keys.end(), column.key) == keys.end()) column.heading.clear();
  }
  return columns;
}

}  // namespace

const Columns<LowpassRecord>& lowpass_columns() {
  using Record = LowpassRecord;
  static const Columns<Record> all = joined<Record>(
      joined<Record>({{"lowpass", "", "", &Record::filter},
                      {"", "", "cutoff",
                       [](const Record& one) { return fmt::format("{:.4g}/L", one.cutoff); }},
                      {"cutoff_per_length", "", "", &Record::cutoff},
                      {"cutoff_wavelength_m", "m", "shortest wave", &Record::wavelength},
                      {"rms_slope", "", "rms slope", &Record::rms_slope}},
                     within(contact_columns_headed({"mean_pressure_Pa", "contact_area_fraction",
                                                    "contact_area_fraction_pixels"}),
                            &Record::contact)),
      {{"friction_dry", "", "friction dry", &Record::friction_dry},
       {"dry_at_bound", "", "",
        [](const Record& one) { return one.friction_dry ? Cell(one.dry_at_bound) : Cell(); }},
       {"",
        "",
        "certificate",
        [](const Record& one) { return one.contact.convergence.certificate; },
        {.shown = Shown::exponent}},
       {"", "", "converged",
        [](const Record& one) { return one.contact.convergence.converged(); }}});
  return all;
}

void lowpass_states(const topography::Topography& surface, const ContactSettings& settings,
                    const std::vector<double>& mean_pressures, const std::vector<double>& cutoffs,
                    const std::optional<FrictionSettings>& friction,
                    const std::function<void(LowpassRecord&&, std::size_t pressure)>& receive,
                    const Observer& observer) {
  const auto elasticity = make_operator(settings, surface.grid);
  const std::vector<contact::Control> controls = controls_of({.mean_pressures = mean_pressures});
  for (const double cutoff : cutoffs) {
    const std::string filter = fmt::format("lowpass=hann:{}/L", cutoff);
    const topography::Topography filtered = topography::apply({filter}, surface, observer);
    std::size_t pressure = 0;
    const auto receive_contact = [&](ContactRecord&& contact) {
      LowpassRecord record{.filter = filter,
                           .cutoff = cutoff,
                           .wavelength = topography::filter_side(filtered) / cutoff,
                           .rms_slope = metrology::rms_slope(filtered),
                           .contact = std::move(contact)};
      if (friction) add_friction(settings, *friction, record);
      receive(std::move(record), pressure++);
    };
    contact_states(*elasticity, filtered, settings, controls, receive_contact, observer);
  }
}

}  // namespace tabor::cases
