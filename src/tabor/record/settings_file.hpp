#pragma once

#include <memory>

#include "tabor/core/error.hpp"
#include "tabor/io/text/toml.hpp"
#include "tabor/record/parameter.hpp"

// Settings out of study and case files, by the tables of their parameters.
namespace tabor {

/// What a file says of a parameter; the file outlives it. A temperature may be in degrees Celsius,
/// "24 degC".
std::unique_ptr<Given> given(const io::Config& file, const ParameterHead& parameter);

/// Takes what the file says of a parameter. Throws InputError with file, line and key where that is
/// missing, of another kind, or out of its bounds.
template <typename Settings>
void read_setting(const io::Config& file, const Parameter<Settings>& parameter,
                  Settings& settings) {
  parameter.read(settings, *given(file, parameter));
  if (const auto found = objection_to_bounds(Parameters<Settings>{parameter}, settings)) {
    throw InputError(file.place(parameter.file_key()), found->got, found->expected, found->remedy);
  }
}

/// Takes what the file says of each parameter; what it does not say stays as it is. `has_material`:
/// a named material gives those that would be needed without. Throws as read_setting().
template <typename Settings>
void read_settings(const io::Config& file, const Parameters<Settings>& parameters,
                   Settings& settings, bool has_material = false) {
  for (const Parameter<Settings>& one : parameters) {
    const bool is_needed =
        one.needed == Needed::yes || (one.needed == Needed::unless_material && !has_material);
    if (is_needed || file.has(one.file_key())) read_setting(file, one, settings);
  }
}

}  // namespace tabor
