#include <string>

#include "bindings.hpp"
#include "tabor/core/error.hpp"
#include "values.hpp"

namespace tabor::python {
namespace {

/// Classes of exceptions, which live as long as the interpreter.
PyObject* input_error = PyExc_ValueError;
PyObject* incomplete_error = PyExc_ValueError;
PyObject* output_error = PyExc_OSError;

/// Takes the classes of the package in place of Python's own.
void take_errors(const nanobind::object& input, const nanobind::object& incomplete,
                 const nanobind::object& output) {
  input_error = nanobind::object(input).release().ptr();
  incomplete_error = nanobind::object(incomplete).release().ptr();
  output_error = nanobind::object(output).release().ptr();
}

/// The message, with the settings that it names as arguments: "step: got ...; add pixel='0.67um'".
std::string in_python(const Error& error) {
  std::string text = advised(error.what(), spelled);
  const std::size_t end = text.find("=: ");
  if (end < text.find(' ')) text.erase(end, 1);  // it begins with one
  return text;
}

/// What the library throws on purpose, as the exception that Python has for it.
void translate(const std::exception_ptr& thrown, void*) {
  try {
    std::rethrow_exception(thrown);
  } catch (const IncompleteError& error) {
    PyErr_SetString(incomplete_error, in_python(error).c_str());
  } catch (const InputError& error) {
    PyErr_SetString(input_error, in_python(error).c_str());
  } catch (const UsageError& error) {
    PyErr_SetString(input_error, error.what());
  } catch (const OutputError& error) {
    PyErr_SetString(output_error, in_python(error).c_str());
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
  module.def("take_errors", &take_errors, nanobind::arg("input"), nanobind::arg("incomplete"),
             nanobind::arg("output"));
  bind_interpreter(module);
  bind_values(module);
  bind_surface(module);
  bind_combine(module);
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
