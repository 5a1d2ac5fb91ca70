#include "tabor/study/wet_shares.hpp"

#include <string>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/io/files/atomic_file.hpp"
#include "tabor/io/files/sealed_file.hpp"
#include "tabor/io/text/json.hpp"
#include "tabor/study/case.hpp"
#include "tabor/study/record.hpp"

namespace tabor::study {

void write_wet_shares(const engine::Store& store, const engine::Task& task,
                      const WetShares& shares) {
  io::Json json = {{"canonical_text", task.text},
                   {"lubricant_density_kg_per_m2", shares.lubricant_densities},
                   {"lubricated_share", shares.lubricated_shares}};
  io::write_file(store.path(task), io::to_text(io::sealed(std::move(json))) + "\n");
}

WetShares read_wet_shares(const engine::Store& store, const engine::Task& task) {
  const io::Json json = io::read_json(store.path(task));
  const std::string name = store.path(task).string();
  try {
    if (!io::is_sealed(json)) throw InputError(name + ": not the wet shares that were written");
    if (json.at("canonical_text").get<std::string>() != task.text) {
      throw InputError(name + ": belongs to another contact");
    }
    WetShares shares{json.at("lubricant_density_kg_per_m2").get<std::vector<double>>(),
                     json.at("lubricated_share").get<std::vector<double>>()};
    if (shares.lubricant_densities.size() == shares.lubricated_shares.size()) return shares;
  } catch (const io::Json::exception&) {  // said below
  }
  throw InputError(name + ": not complete");
}

std::vector<ScanCurve> density_curves_in(const engine::Store& store, const Study& study,
                                         const std::vector<ScanTasks>& tasks) {
  std::vector<ScanCurve> curves;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const Scan& scan = study.scans[i];
    const Study alone = study.of(scan);
    for (std::size_t pressure = 0; pressure < tasks[i].wet_shares.size(); ++pressure) {
      const engine::Task& task = tasks[i].wet_shares[pressure];
      const engine::Task& contact = tasks[i].contacts[pressure];
      if (!store.has(task) || !defect(store, task).empty() || !store.has(contact)) continue;
      const WetShares shares = read_wet_shares(store, task);
      if (shares.lubricant_densities.empty()) continue;
      curves.push_back(
          {scan.label, scan.group,
           cases::density_curve(shares.lubricant_densities, shares.lubricated_shares,
                                read_contact_record(store, contact).summary, alone.settings)});
    }
  }
  return curves;
}

}  // namespace tabor::study
