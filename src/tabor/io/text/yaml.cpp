// The only file that knows libyaml.
#include "tabor/io/text/yaml.hpp"

#include <fmt/format.h>
#include <yaml.h>

#include <cmath>
#include <map>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"

namespace tabor::io {
namespace {

constexpr int kDeepest = 100;
constexpr std::size_t kMostValues = 1'000'000;

/// An event of the parser, freed with this object.
class Event {
 public:
  Event() = default;
  ~Event() { yaml_event_delete(&event_); }
  Event(const Event&) = delete;
  Event& operator=(const Event&) = delete;
  yaml_event_t* get() { return &event_; }
  yaml_event_type_t type() const { return event_.type; }
  const yaml_event_t* operator->() const { return &event_; }

 private:
  yaml_event_t event_{};
};

std::string text_of(const yaml_char_t* text) {
  return text == nullptr ? "" : reinterpret_cast<const char*>(text);
}

Json plain_scalar(const std::string& text) {
  if (text.empty() || text == "~" || lower(text) == "null") return nullptr;
  if (lower(text) == "true") return true;
  if (lower(text) == "false") return false;
  const auto value = parse_number(text);
  return value && std::isfinite(*value) ? Json(*value) : Json(text);
}

/// Returns the number of values in a tree; 16 bytes of text count as one more.
std::size_t count(const Json& value) {
  constexpr std::size_t kBytes = 16;
  std::size_t n = 1;
  if (value.is_string()) n += value.get_ref<const std::string&>().size() / kBytes;
  if (!value.is_structured()) return n;
  for (const auto& [key, child] : value.items()) n += count(child) + key.size() / kBytes;
  return n;
}

/// Builds values from the events of the parser.
class Builder {
 public:
  Builder(std::string_view text, std::string name) : name_(std::move(name)) {
    if (yaml_parser_initialize(&parser_) == 0) fail("out of memory");
    yaml_parser_set_input_string(&parser_, reinterpret_cast<const unsigned char*>(text.data()),
                                 text.size());
  }
  ~Builder() { yaml_parser_delete(&parser_); }
  Builder(const Builder&) = delete;
  Builder& operator=(const Builder&) = delete;

  Json document() {
    Event event;
    take(event);  // start of the stream
    Event start;
    take(start);
    if (start.type() == YAML_STREAM_END_EVENT) return nullptr;
    Event first;
    take(first);
    return value(first, 0);
  }

 private:
  [[noreturn]] void fail(const std::string& got) const {
    throw InputError(name_, got, "YAML",
                     "the file is damaged or truncated: export or copy it again");
  }

  void take(Event& event) {
    if (yaml_parser_parse(&parser_, event.get()) == 1) return;
    fail(fmt::format("text that is no YAML on line {} ({})", parser_.problem_mark.line + 1,
                     parser_.problem == nullptr ? "" : parser_.problem));
  }

  void count_values(std::size_t n) {
    n_values_ += n;
    if (n_values_ > kMostValues) fail(fmt::format("more than {} values", kMostValues));
  }

  Json value(const Event& event, int depth) {
    if (depth > kDeepest) fail(fmt::format("values nested more than {} deep", kDeepest));
    count_values(1);
    switch (event.type()) {
      case YAML_ALIAS_EVENT:
        return repeated(text_of(event->data.alias.anchor));
      case YAML_SCALAR_EVENT: {
        const auto& scalar = event->data.scalar;
        const std::string text(reinterpret_cast<const char*>(scalar.value), scalar.length);
        const bool is_plain = scalar.style == YAML_PLAIN_SCALAR_STYLE;
        return remembered(text_of(scalar.anchor), is_plain ? plain_scalar(text) : Json(text));
      }
      case YAML_SEQUENCE_START_EVENT:
        return remembered(text_of(event->data.sequence_start.anchor), list(depth));
      case YAML_MAPPING_START_EVENT:
        return remembered(text_of(event->data.mapping_start.anchor), mapping(depth));
      default:
        fail("no value");
    }
  }

  Json list(int depth) {
    Json values = Json::array();
    while (true) {
      Event event;
      take(event);
      if (event.type() == YAML_SEQUENCE_END_EVENT) return values;
      values.push_back(value(event, depth + 1));
    }
  }

  Json mapping(int depth) {
    Json values = Json::object();
    while (true) {
      Event event;
      take(event);
      if (event.type() == YAML_MAPPING_END_EVENT) return values;
      const Json key = value(event, depth + 1);
      Event second;
      take(second);
      // The object is searched for each key: that of a file has a few.
      constexpr std::size_t kMostKeys = 1000;
      if (values.size() > kMostKeys) fail(fmt::format("a mapping of more than {} keys", kMostKeys));
      values[key.is_string() ? key.get<std::string>() : to_text(key, -1)] =
          value(second, depth + 1);
    }
  }

  Json remembered(const std::string& anchor, Json value) {
    if (anchor.empty()) return value;
    count_values(count(value));  // anchors inside of each other are copied again and again
    anchors_[anchor] = value;
    return value;
  }

  Json repeated(const std::string& anchor) {
    const auto found = anchors_.find(anchor);
    if (found == anchors_.end()) fail("an alias '" + anchor + "' of nothing");
    count_values(count(found->second));
    return found->second;
  }

  std::string name_;
  yaml_parser_t parser_{};
  std::map<std::string, Json> anchors_;
  std::size_t n_values_ = 0;
};

}  // namespace

Json parse_yaml(std::string_view text, const std::string& name) {
  return Builder(text, name).document();
}

}  // namespace tabor::io
