#include "tabor/io/text/xml.hpp"

#include <fmt/format.h>

#include <pugixml.hpp>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"

namespace tabor::io {
namespace {

/// True if an element or attribute has this name, whatever prefix its namespace has.
template <typename Named>
bool is_called(const Named& named, std::string_view name) {
  const std::string_view full = named.name();
  return full.substr(full.find(':') + 1) == name;
}

}  // namespace

std::string XmlElement::name() const { return pugi::xml_node(node_).name(); }

std::string XmlElement::text() const {
  std::string text;  // comments may stand between its parts
  for (const pugi::xml_node& child : pugi::xml_node(node_).children()) {
    if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata) {
      text += child.value();
    }
  }
  return std::string(trim(text));
}

std::string XmlElement::attribute(std::string_view name) const {
  return pugi::xml_node(node_)
      .find_attribute([&](const pugi::xml_attribute& one) { return is_called(one, name); })
      .value();
}

XmlElement XmlElement::at(std::string_view path) const {
  pugi::xml_node node(node_);
  for (const std::string& name : split(path, '/')) {
    node = node.find_child([&](const pugi::xml_node& child) { return is_called(child, name); });
  }
  return XmlElement(node.internal_object());
}

std::vector<XmlElement> XmlElement::children(const std::string& name) const {
  std::vector<XmlElement> found;
  for (const pugi::xml_node& child : pugi::xml_node(node_).children()) {
    if (is_called(child, name)) found.emplace_back(child.internal_object());
  }
  return found;
}

XmlDocument::XmlDocument(std::string_view text, const std::string& name)
    : document_(std::make_unique<pugi::xml_document>()) {
  const pugi::xml_parse_result result = document_->load_buffer(text.data(), text.size());
  if (!result) {
    throw InputError(name,
                     fmt::format("XML broken at byte {} ({})", result.offset, result.description()),
                     "well-formed XML", "export the file again");
  }
}

XmlDocument::~XmlDocument() = default;

XmlElement XmlDocument::root() const {
  return XmlElement(document_->document_element().internal_object());
}

std::string xml_escape(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

}  // namespace tabor::io
