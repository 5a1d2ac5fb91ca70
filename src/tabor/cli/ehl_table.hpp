#pragma once

#include <string>
#include <vector>

#include "tabor/cli/ehl.hpp"
#include "tabor/cli/table.hpp"

/// The numbers of many cases, as columns of a table.
namespace tabor::cli {

using EhlColumns = std::vector<EhlColumn>;

/// The number at a key, "wear.mean_depth_m" being that of an object inside; NaN if there is none.
double number_of(const io::Json& scalars, const std::string& key);

/// Those of the program that these cases have.
EhlColumns columns_of(const EhlProgram& program, const std::vector<EhlAnswer>& answers);

/// `first`, and behind it what stands above the columns, or in them for one case.
std::vector<std::string> headings_of(std::vector<std::string> first, const EhlColumns& columns);
std::vector<std::string> row_of(std::vector<std::string> first, const EhlColumns& columns,
                                const io::Json& scalars);

/// Adds limits of all columns, and the order of the error that they show, as rows and JSON objects.
/// `values`: of what the study varies.
void add_limits(const EhlColumns& columns, const EhlStudy& study, const std::vector<double>& values,
                const std::vector<EhlAnswer>& answers, Table& table, io::Json& object);

}  // namespace tabor::cli
