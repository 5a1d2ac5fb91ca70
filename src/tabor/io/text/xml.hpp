#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

// Parses XML text and finds elements in it.
namespace pugi {
class xml_document;
struct xml_node_struct;
}  // namespace pugi

namespace tabor::io {

/// Element of an XmlDocument, or no element at all: then its name and text are empty and it has no
/// children. Valid as long as the document.
class XmlElement {
 public:
  explicit XmlElement(pugi::xml_node_struct* node = nullptr) : node_(node) {}

  explicit operator bool() const { return node_ != nullptr; }
  std::string name() const;  ///< with its namespace prefix
  std::string text() const;  ///< of this element alone, without surrounding blanks

  /// Returns the value of an attribute, name without namespace prefix; "" if there is none.
  std::string attribute(std::string_view name) const;

  /// Returns the first descendant along "Record1/Axes/CX", names without namespace prefixes.
  XmlElement at(std::string_view path) const;
  std::vector<XmlElement> children(const std::string& name) const;

 private:
  pugi::xml_node_struct* node_;
};

/// Parsed XML text. Throws InputError if the text is not well-formed. `name` is what error messages
/// call the text.
class XmlDocument {
 public:
  XmlDocument(std::string_view text, const std::string& name);
  ~XmlDocument();
  XmlElement root() const;

 private:
  std::unique_ptr<pugi::xml_document> document_;
};

/// Returns the text with &, <, > and quotes written as entities.
std::string xml_escape(std::string_view text);

}  // namespace tabor::io
