#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "tabor/cli/result.hpp"
#include "tabor/cli/table.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/printable.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/forming/darmstad.hpp"
#include "tabor/forming/deck.hpp"
#include "tabor/io/files/atomic_file.hpp"
#include "tabor/study/friction_table.hpp"

namespace tabor::cli {

namespace {

using forming::Condition;
using forming::FrictionTable;
using forming::Program;

struct Request {
  std::string results;
  Program program = Program::csv;
  std::optional<forming::UnitSystem> units;
  study::FrictionTableChoice choice;
  int first_id = 1;
  std::optional<std::string> output;
};

/// Returns the extensions of decks for a program.
std::vector<std::string> extensions_for(Program program) {
  switch (program) {
    case Program::abaqus:
      return {".inp"};
    case Program::lsdyna:
      return {".k", ".key", ".dyn"};
    case Program::ansys:
      return {".inp", ".mac", ".dat"};
    case Program::openradioss:
      return {".rad", ".inc"};
    case Program::csv:
      break;
  }
  return {".csv"};
}

std::vector<std::string> all_extensions() {
  std::vector<std::string> all;
  for (const std::string& name : forming::kPrograms.all()) {
    for (const std::string& one : extensions_for(*forming::kPrograms.find(name))) {
      if (std::find(all.begin(), all.end(), one) == all.end()) all.push_back(one);
    }
  }
  return all;
}

void check_extension(const Request& request) {
  if (!request.output) return;
  const std::string extension = lower(std::filesystem::path(*request.output).extension().string());
  const std::vector<std::string> known = extensions_for(request.program);
  if (std::find(known.begin(), known.end(), extension) != known.end()) return;
  std::string expected;
  for (const std::string& one : known) expected += (expected.empty() ? "" : " ") + one;
  throw InputError(*request.output, fmt::format("the extension '{}'", extension),
                   fmt::format("{} for {}", expected, forming::kPrograms.of(request.program)), "");
}

io::Json json_of(const Condition& at) {
  io::Json object = {{"mean_pressure_Pa", at.mean_pressure},
                     {"lubricant_density_g_per_m2", in_g_per_m2(at.lubricant_density)}};
  if (at.sliding_speed) object["sliding_speed_m_per_s"] = *at.sliding_speed;
  return object;
}

io::Json json_of(const FrictionTable& table) {
  io::Json entries = io::Json::array();
  for (const forming::FrictionEntry& entry : table.entries) {
    io::Json object = json_of(entry.at);
    object["friction_coefficient"] = entry.friction;
    object["standard_deviation"] = io::number(entry.standard_deviation);
    object["n"] = entry.n;
    entries.push_back(std::move(object));
  }
  return entries;
}

io::Json left_out_json(const FrictionTable& table) {
  io::Json all = io::Json::array();
  for (const forming::LeftOut& one : table.left_out) {
    io::Json object = json_of(one.at);
    object.update({{"code", one.code}, {"scans", one.scans}, {"whole", one.whole}});
    all.push_back(std::move(object));
  }
  return all;
}

std::string text_of(const Condition& at) {
  std::string text =
      fmt::format("{} {} g/m^2", si(at.mean_pressure, "Pa"), in_g_per_m2(at.lubricant_density));
  if (at.sliding_speed) text += " " + si(*at.sliding_speed, "m/s");
  return text;
}

/// One line for each reason, with the numbers it took.
void warn_of_left_out(const FrictionTable& table, Context& context) {
  std::vector<std::string> said;
  for (const forming::LeftOut& first : table.left_out) {
    const std::string kind = first.code + (first.whole ? "" : " (scans)");
    if (std::find(said.begin(), said.end(), kind) != said.end()) continue;
    said.push_back(kind);
    std::string places;
    for (const forming::LeftOut& one : table.left_out) {
      if (one.code != first.code || one.whole != first.whole) continue;
      places += (places.empty() ? "" : ", ") + text_of(one.at);
    }
    context.warn(first.whole ? fmt::format("left out ({}): {}", first.code, places)
                             : fmt::format("means over fewer scans ({}): {}", first.code, places));
  }
}

/// Below it the error of a fit is one of rounding, and no digit of a deck.
constexpr double kSmallestShownError = 1e-9;

/// What the law of OpenRadioss misses, for each density.
io::Json report_fits(const FrictionTable& table, Context& context) {
  io::Json all = io::Json::array();
  for (const forming::DarmstadFit& fit : forming::fit_darmstad(table)) {
    const double density = in_g_per_m2(fit.lubricant_density);
    all.push_back({{"lubricant_density_g_per_m2", density}, {"largest_error", fit.largest_error}});
    if (fit.largest_error < kSmallestShownError) continue;
    context.warn(
        fmt::format("{} g/m^2: the fitted law misses a friction coefficient by up to {:.3g}",
                    density, fit.largest_error));
  }
  return all;
}

std::string summary_of(const Request& request, const forming::UnitSystem& units,
                       const FrictionTable& table) {
  Facts facts;
  facts.fact("results", request.results);
  facts.fact("group", table.group);
  facts.fact("numbers", std::to_string(table.entries.size()));
  facts.fact("fewer scans", reasons_for_fewer_scans(table));
  facts.fact("left out", reasons_of(table));
  facts.fact("units", fmt::format("{}: {}, {}, {}", units.words, units.pressure.name,
                                  units.speed.name, units.areal_density.name));
  facts.fact("written", *request.output);
  return facts.text();
}

FrictionTable table_for(const Request& request, Context& context) {
  const study::FrictionNumbers numbers = study::read_friction(request.results);
  context.files.reads(numbers.file);
  if (!numbers.incomplete.empty()) context.warn(numbers.incomplete);
  FrictionTable table = study::friction_table(numbers, request.choice);
  table.origin.insert(table.origin.begin(), "command: " + context.command_line);
  if (request.program == Program::lsdyna) table = forming::complete_rows(std::move(table));
  if (request.program != Program::csv) forming::require_two_pressures(table);
  return table;
}

forming::UnitSystem units_of(const Request& request) {
  if (request.units) return *request.units;
  if (request.program == Program::csv) return forming::unit_system("m,s,kg");
  throw UsageError("--units L,T,M is missing, such as mm,s,t (MPa): a deck carries no units");
}

int show(const Request& request, Context& context) {
  const forming::UnitSystem units = units_of(request);
  check_extension(request);
  const FrictionTable table = table_for(request, context);
  const std::string deck =
      forming::deck_for(request.program, table, units, static_cast<int>(request.first_id));
  warn_of_left_out(table, context);
  io::Json object = json_head(context);
  object.update({{"results", request.results},
                 {"for", forming::kPrograms.of(request.program)},
                 {"units", units.words},
                 {"pressure_unit", units.pressure.name},
                 {"sliding_speed_unit", units.speed.name},
                 {"lubricant_density_unit", units.areal_density.name},
                 {"group", table.group},
                 {"numbers", json_of(table)},
                 {"left_out", left_out_json(table)}});
  if (request.program == Program::openradioss) object["fits"] = report_fits(table, context);
  if (request.output) {
    io::write_file(*request.output, deck);
    object["output"] = *request.output;
  } else {
    object["deck"] = deck;
  }
  return finish(context, object, request.output ? summary_of(request, units, table) : deck);
}

int id_of(const std::string& word) {
  constexpr int kLargest = 9999999;  // of seven digits, so that more follow in eight
  const std::optional<double> number = parse_number(word);
  if (number && *number >= 1 && *number <= kLargest && *number == std::floor(*number)) {
    return static_cast<int>(*number);
  }
  throw UsageError(
      fmt::format("--id: got '{}'; expected a whole number from 1 to {}", word, kLargest));
}

void declare_options(OptionSet& set, Request& request) {
  set.group("Table");
  set.input("RESULTS", "folder of 'tabor sweep', or a file of 'tabor friction -o'",
            request.results);
  set.choice("--for", forming::kPrograms, "forming code to write for", request.program).required =
      true;
  set.add({.flag = "--units",
           .placeholder = "L,T,M",
           .help =
               "units of length, time and mass (or force) of the deck, e.g. mm,s,t for MPa; csv "
               "does without [m,s,kg]",
           .assign = [&request](const std::string& words) {
             request.units = forming::unit_system(words);
           }});
  set.text("--group", "NAME", "group of scans, if the study has several", request.choice.group);
  set.quantities("--density", "D[,D2,...]",
                 "computed lubricant densities to write; 0g/m^2 is dry friction [all]",
                 dimension::areal_density, request.choice.lubricant_densities);
  set.add({.flag = "--keep",
           .placeholder = "CODE[,CODE2,...]",
           .help = "keep numbers in spite of these warnings, e.g. frictionless",
           .assign = [&request](const std::string& codes) {
             request.choice.kept_codes = split(codes, ',');
           }});
  set.add({.flag = "--id",
           .placeholder = "N",
           .help = "first number of tables and curves (lsdyna), materials (ansys) or friction "
                   "cards (openradioss) [1]",
           .assign = [&request](const std::string& word) { request.first_id = id_of(word); }});
  set.group("Output");
  set.output("FILE", "write the deck to a file [the terminal]", all_extensions(), request.output);
}

}  // namespace

Verb table_verb() {
  return {.name = "table",
          .arguments = "RESULTS --for PROGRAM [--units L,T,M] [options]",
          .summary = "write friction as input for a forming code",
          .details =
              "The table gives friction against mean pressure, areal density of the lubricant "
              "and, for oil that flows, sliding speed, as means over the scans of a group. tabor "
              "leaves out and names numbers with a serious warning (not-converged, flood, "
              "flooded, frictionless, implausible-friction, those of flowing oil). A deck "
              "carries no units, so give them with --units, such as mm,s,t (MPa), m,s,kg (Pa), "
              "mm,ms,kg "
              "(GPa) or in,s,lbf (psi). docs/friction_tables.md shows each format.",
          .examples = {"tabor table study_results --for abaqus --units mm,s,t --group before",
                       "tabor table study_results --for lsdyna --units mm,s,t --group before "
                       "--density 0.45g/m^2 -o friction.k"},
          .declare = [](OptionSet& set) -> Action {
            const auto request = std::make_shared<Request>();
            declare_options(set, *request);
            return [request](Context& context) { return show(*request, context); };
          }};
}

}  // namespace tabor::cli
