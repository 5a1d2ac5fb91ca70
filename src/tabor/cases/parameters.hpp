#pragma once

#include "tabor/cases/settings.hpp"
#include "tabor/record/parameter.hpp"

// The settings of contact, film, trapped oil, flowing oil and friction, each said in one line.
// Verbs, study files, stored results and Python take them from these tables.
namespace tabor::cases {

const Parameters<ContactSettings>& contact_parameters();
const Parameters<FilmSettings>& film_parameters();
const Parameters<TrappedSettings>& trapped_parameters();
const Parameters<FluidSettings>& fluid_parameters();
const Parameters<FrictionSettings>& friction_parameters();

/// Mean pressures, and all of the above.
const Parameters<CaseSettings>& case_parameters();

/// The parameter of this name; nullptr where there is none.
const ParameterHead* find_parameter(std::string_view name);

}  // namespace tabor::cases
