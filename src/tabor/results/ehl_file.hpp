#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tabor/cases/ehl/program.hpp"
#include "tabor/results/findings.hpp"

namespace tabor::results {

/// The result file of one film case (docs/ehl.md): its head, /result with its numbers, and its
/// histories and profiles. Throws OutputError.
void write_case(const std::filesystem::path& file, const std::string& command,
                const ehl::Program& program, const io::Config& config,
                const ehl::CaseResult& result, const std::vector<Finding>& warnings);

}  // namespace tabor::results
