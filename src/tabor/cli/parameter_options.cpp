#include "tabor/cli/parameter_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "tabor/core/text.hpp"

namespace tabor::cli {
namespace {

class Word : public Given {
 public:
  Word(std::string flag, std::string word) : flag_(std::move(flag)), word_(std::move(word)) {}

  double number(const Dimension& expected) const override {
    return expected == dimension::none ? finite_number(flag_, word_)
                                       : parse_si(word_, expected, flag_);
  }
  std::vector<double> numbers(const Dimension& expected) const override {
    return parse_si_list(word_, expected, flag_);
  }
  std::uint64_t count() const override { return whole_number(flag_, word_); }
  bool flag() const override { return !flag_.starts_with("--not-"); }
  std::string word(const std::vector<std::string>& choices) const override {
    return chosen_word(flag_, word_, choices);
  }
  std::string text() const override { return word_; }
  std::vector<std::string> texts() const override { return split(word_, ','); }
  bool is_word(const std::string& word) const override { return word_ == word; }

 private:
  std::string flag_;
  std::string word_;
};

std::string help_of(const ParameterHead& parameter, bool has_default) {
  std::string help = parameter.help;
  const std::string example = in_a_shell(parameter.example);
  if (!has_default && parameter.words.empty() && !example.empty()) help += ", e.g. " + example;
  if (has_default) return help + " [" + example + "]";
  return parameter.absent.empty() ? help : help + " [" + parameter.absent + "]";
}

}  // namespace

std::string in_a_shell(std::string text) {
  if (const std::size_t one = text.find(" 1/"); one != std::string::npos) text.erase(one, 2);
  if (const std::size_t blank = text.find(' '); blank != std::string::npos) text.erase(blank, 1);
  for (std::size_t comma = text.find(','); comma != std::string::npos;
       comma = text.find(',', comma + 1)) {
    if (const std::size_t blank = text.find(' ', comma); blank != std::string::npos) {
      text.erase(blank, 1);
    }
  }
  std::replace(text.begin(), text.end(), ' ', '*');
  return text;
}

Option option_of(const ParameterHead& parameter, bool has_default) {
  Option option{.flag = parameter.option(),
                .placeholder = parameter.words.empty()
                                   ? parameter.placeholder
                                   : fmt::format("{}", fmt::join(parameter.words, "|")),
                .help = help_of(parameter, has_default),
                .group = parameter.group,
                .words = parameter.words};
  if (parameter.option_by_name() != option.flag) option.also = parameter.option_by_name();
  option.required = parameter.needed != Needed::no;
  if (parameter.is_of_material) option.unless = kMaterial;
  return option;
}

std::unique_ptr<Given> given(const std::string& flag, const std::string& word) {
  return std::make_unique<Word>(flag, word);
}

}  // namespace tabor::cli
