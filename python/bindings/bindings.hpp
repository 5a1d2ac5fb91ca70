#pragma once

#include <nanobind/nanobind.h>

// The extension module tabor._tabor: the thinnest layer over the library, for the classes of the
// package in python/tabor alone. Numbers are SI, texts are those of the command line.
namespace tabor::python {

namespace nb = nanobind;

void bind_interpreter(nb::module_& module);
void bind_values(nb::module_& module);
void bind_surface(nb::module_& module);
void bind_combine(nb::module_& module);
void bind_contact(nb::module_& module);
void bind_film(nb::module_& module);
void bind_friction(nb::module_& module);
void bind_ehl(nb::module_& module);
void bind_slide(nb::module_& module);
void bind_save(nb::module_& module);
void bind_synthesis(nb::module_& module);
void bind_study(nb::module_& module);
void bind_setting_tables(nb::module_& module);

}  // namespace tabor::python
