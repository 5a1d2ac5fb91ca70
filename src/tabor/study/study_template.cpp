#include <fmt/format.h>

#include "tabor/cases/parameters.hpp"
#include "tabor/cases/slide/slide.hpp"
#include "tabor/scan/read_parameters.hpp"
#include "tabor/study/study.hpp"

namespace tabor::study {
namespace {

constexpr std::size_t kCommentColumn = 42;

std::string with_comment(std::string line, const std::string& comment) {
  if (line.size() + 1 < kCommentColumn) line.resize(kCommentColumn, ' ');
  return fmt::format("{}{}# {}\n", line, line.ends_with(' ') ? "" : " ", comment);
}

/// "# tolerance = 1e-6      # certificate to reach".
std::string line_of(const ParameterHead& parameter) {
  const std::string key = parameter.study_name();
  std::string comment = parameter.help;
  if (!parameter.words.empty()) {
    comment = fmt::format("{}: {}", fmt::join(parameter.words, "|"), comment);
  }
  if (!parameter.absent.empty() && !parameter.is_of_material) {
    comment += fmt::format(" [{}]", parameter.absent);
  }
  // A choice that is none by default shows the word that turns it on.
  const bool is_off = !parameter.words.empty() && parameter.words.front() == "none";
  const std::string value = parameter.kind == ValueKind::flag ? "true"
                            : is_off                          ? parameter.words.at(1)
                                                              : parameter.example;
  return with_comment(fmt::format("# {} = {}", key, parameter.in_toml(value)), comment);
}

/// A line for each parameter of a table, "lubricant"; "" is the head of the file.
std::string lines_of(std::string_view table) {
  std::string lines;
  const auto add = [&](const ParameterHead& one) {
    if (one.is_in_table(table)) lines += line_of(one);
  };
  for (const ParameterHead& one : cases::case_parameters()) add(one);
  for (const ParameterHead& one : scan::read_parameters()) add(one);
  for (const ParameterHead& one : cases::slide_parameters()) add(one);
  return lines;
}

}  // namespace

std::string study_template() {
  std::string text =
      R"(# A study: scans x pressures x lubricant densities. Lines that begin with # show what else there is.
title = "Sheets before sliding"
)";
  text += lines_of("");
  text += R"(
[material]
name = "aluminium-6016"                   # 'tabor materials' lists them; in its place, or over it:
)";
  text += lines_of("material");
  text += R"(
[treatment]
steps = ["level=plane"]                   # in this order, as 'tabor params --help' names them
)";
  text += lines_of("treatment");
  text += R"(
[contact]
# edges = "cut"                           # a cut-out, mirrored; tile: it repeats; end: the body ends
)";
  text += lines_of("contact");
  text += R"(
[sweep]
mean_pressure = ["2 MPa", "7 MPa", "15 MPa"]  # or a range: "2 MPa..15 MPa:7"
lubricant_density = ["0.45 g/m^2", "0.9 g/m^2"]
# sliding_speed = ["0.01 m/s", "0.1 m/s"] # with fluid = "reynolds"

[lubricant]
)";
  text += lines_of("lubricant");
  text += R"(
# [slide]                                 # a rough tool (contact.tool) slides over each sheet, under each pressure and density
)";
  text += lines_of("slide");
  text += R"(
[[scan]]
file = "surfaces/edt_before.x3p"          # or a pattern, "scans/before_*.x3p"; from this file's folder
group = "before"                          # averages are taken over a group
)";
  text += lines_of("treatment");
  text +=
      R"(# pressure = "7 MPa"                      # of these scans alone, as the rest of this table
# density = "0 g/m^2"
# treatment = ["level=plane", "lowpass=hann:4.5um"]
# contact = "elastic"                     # or saturated
# reading = "literal"

# [experiment]
# file = "measured.csv"                   # friction to compare with; columns: docs/results.md
)";
  return text;
}

}  // namespace tabor::study
