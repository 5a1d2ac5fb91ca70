#pragma once

#include "tabor/cases/parameters.hpp"
#include "values.hpp"

// Properties of settings, made from tables of parameters.
namespace tabor::python {

/// What a program gave; throws as a conversion does, and InputError for a word that is no choice.
class GivenObject : public Given {
 public:
  GivenObject(std::string name, nb::handle value) : name_(std::move(name)), value_(value) {}

  double number(const Dimension&) const override { return nb::cast<double>(value_); }
  std::vector<double> numbers(const Dimension&) const override {
    return nb::cast<std::vector<double>>(value_);
  }
  std::uint64_t count() const override { return nb::cast<std::uint64_t>(value_); }
  bool flag() const override { return nb::cast<bool>(value_); }
  std::string word(const std::vector<std::string>& choices) const override {
    return checked_choice(name_, nb::cast<std::string>(value_), choices);
  }
  std::string text() const override { return nb::cast<std::string>(value_); }
  std::vector<std::string> texts() const override {
    return nb::cast<std::vector<std::string>>(value_);
  }
  bool is_word(const std::string&) const override { return false; }  // None says it

 private:
  std::string name_;
  nb::handle value_;
};

/// A value of a setting; None where it is not given.
nb::object given_value(const Cell& cell);

/// One property for each parameter that is no list; None leaves the default.
template <typename Settings>
void bind_parameters(nb::class_<Settings>& settings, const Parameters<Settings>& parameters) {
  for (const Parameter<Settings>& one : parameters) {
    if (one.kind == ValueKind::numbers) continue;
    settings.def_prop_rw(
        one.name.c_str(), [&one](const Settings& self) { return given_value(one.in_force(self)); },
        [&one](Settings& self, const nb::object& value) {
          if (!value.is_none()) one.read(self, GivenObject(one.python_argument(), value));
        },
        nb::for_setter(nb::arg("value").none()));
  }
}

}  // namespace tabor::python
