// Elements of XML as text, each on a line.
#pragma once

#include <string>

#include "io/bytes/text_numbers.h"
#include "io/bytes/xml_escaped.h"

namespace voxtet {

inline std::string xml_number(double value) {
  char text[kRealChars];
  return {text, format_real(text, value)};
}

/// Values are written as they are: xml_escaped() is the caller's.
class XmlText {
 public:
  /// `attributes`: as they stand in the tag, `name="x"`.
  XmlText& open(const std::string& tag, const std::string& attributes = "") {
    text_ += "<" + tag + (attributes.empty() ? "" : " " + attributes) + ">\n";
    return *this;
  }
  XmlText& close(const std::string& tag) {
    text_ += "</" + tag + ">\n";
    return *this;
  }
  XmlText& set(const std::string& tag, const std::string& value, const std::string& attributes = "") {
    text_ += "<" + tag + (attributes.empty() ? "" : " " + attributes) + ">" + value + "</" + tag + ">\n";
    return *this;
  }
  XmlText& set(const std::string& tag, double value, const std::string& attributes = "") {
    return set(tag, xml_number(value), attributes);
  }
  XmlText& comment(const std::string& text) {
    text_ += "<!-- " + text + " -->\n";
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace voxtet
