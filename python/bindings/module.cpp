#include "bindings.hpp"
#include "tabor/core/error.hpp"

namespace tabor::python {
namespace {

/// What the library throws on purpose, as the exception that Python has for it.
void translate(const std::exception_ptr& thrown, void*) {
  try {
    std::rethrow_exception(thrown);
  } catch (const InputError& error) {
    PyErr_SetString(PyExc_ValueError, error.what());
  } catch (const UsageError& error) {
    PyErr_SetString(PyExc_ValueError, error.what());
  } catch (const OutputError& error) {
    PyErr_SetString(PyExc_OSError, error.what());
  } catch (const Interrupted&) {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
  } catch (const Error& error) {
    PyErr_SetString(PyExc_RuntimeError, error.what());
  }
}

}  // namespace
}  // namespace tabor::python

NB_MODULE(_tabor, module) {
  using namespace tabor::python;
  nanobind::register_exception_translator(translate);
  bind_interpreter(module);
  bind_values(module);
  bind_surface(module);
  bind_contact(module);
  bind_film(module);
  bind_friction(module);
  bind_ehl(module);
  bind_slide(module);
  bind_save(module);
  bind_synthesis(module);
  bind_study(module);
  bind_setting_tables(module);
}
