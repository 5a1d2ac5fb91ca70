#include "tabor/record/settings_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "tabor/core/text.hpp"

namespace tabor {
namespace {

constexpr double kIcePoint = 273.15;  // K

/// "24 degC" in kelvin. Degrees Celsius are no unit like the others: two of them do not make twice
/// the temperature.
std::optional<double> kelvin_of(std::string_view text) {
  for (const std::string_view unit : {"degC", "°C"}) {
    if (!text.ends_with(unit)) continue;
    const auto celsius = parse_number(trim(text.substr(0, text.size() - unit.size())));
    if (celsius) return *celsius + kIcePoint;
  }
  return std::nullopt;
}

class Entry : public Given {
 public:
  Entry(const io::Config& file, const ParameterHead& parameter)
      : file_(file), key_(parameter.file_key()), bounds_(parameter.bounds) {}

  double number(const Dimension& expected) const override {
    if (expected == dimension::temperature) {
      const std::vector<std::string> words = file_.words(key_);
      if (const auto kelvin = kelvin_of(words.front()); kelvin && words.size() == 1) return *kelvin;
    }
    return file_.quantity(key_, expected);
  }
  std::vector<double> numbers(const Dimension& expected) const override {
    return file_.quantities(key_, expected);
  }
  std::uint64_t count() const override {
    const std::int64_t value = file_.integer(key_);
    if (value >= 0) return static_cast<std::uint64_t>(value);
    throw InputError(file_.place(key_), fmt::format("{}", value),
                     bounds_.text.empty() ? bounds::zero_or_more.text : bounds_.text, "");
  }
  bool flag() const override { return file_.flag(key_); }
  std::string word(const std::vector<std::string>& choices) const override {
    return checked_choice(file_.place(key_), file_.text(key_), choices);
  }
  std::string text() const override { return file_.text(key_); }
  std::vector<std::string> texts() const override { return file_.texts(key_); }
  bool is_word(const std::string& word) const override {
    const std::vector<std::string> words = file_.words(key_);
    return words.size() == 1 && words.front() == word;
  }

 private:
  const io::Config& file_;
  std::string key_;
  Bounds bounds_;
};

}  // namespace

std::unique_ptr<Given> given(const io::Config& file, const ParameterHead& parameter) {
  return std::make_unique<Entry>(file, parameter);
}

}  // namespace tabor
